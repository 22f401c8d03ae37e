#pragma once

#include <rota/core/lifetime.hpp>
#include <rota/sim/clock.hpp>
#include <rota/sim/closed/coordinator.hpp>
#include <rota/sim/closed/figures.hpp>
#include <rota/sim/closed/world.hpp>
#include <rota/sim/network.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace rota::sim::closed {

/// How a game is played. The radio, the eyes and the clocks are those of `simulation`.
struct game_options {
  trouble what = trouble::none;
  std::size_t robots = 5;
  std::uint64_t seed = 1;
  duration length = seconds(600);  ///< of measured time
  duration warm_up = seconds(2);   ///< not measured: the robots hear of each other
  closed::rules rules;
  world_numbers world;
  clock_options clock;
  network_options network;
  sensor_options sensor;

  /// When measuring begins: not before somebody is deluded.
  [[nodiscard]] instant begin() const {
    return instant{} + warm_up + (what == trouble::delusion ? world.sane : duration{});
  }
};

/// A team in virtual time that moves in its world as it decides.
///
/// Deterministic: events are totally ordered by time, then kind, then robot, then order of creation.
template <coordinator C>
class game {
public:
  using message = typename C::message;

  /// `book` must outlive the game.
  game(playbook const& book ROTA_LIFETIMEBOUND, game_options const& o)
      : options_(o),
        book_(book),
        members_(team_of(o.robots)),
        world_(o.what, o.robots, o.seed, o.world),
        network_(o.network, o.robots, o.seed),
        tally_(o.robots, o.begin()) {
    for (std::size_t i = 0; i < o.robots; ++i) {
      auto engine = engine_for(o.seed, stream::clock, i);
      robot_clock const clock(o.clock, o.rules.message_period, engine);
      robots_.push_back({clock, sensor(o.sensor, i, o.seed), {}, {}, clock.first_loop(), {}, never, 0, std::nullopt});
    }
    push({}, kind::tick, 0);
    for (std::size_t i = 0; i < o.robots; ++i) switch_on(i);
    if (o.what == trouble::breakdowns) push(instant{} + o.world.between_breakdowns, kind::breakdown, o.robots - 1);
  }
  game(playbook&&, game_options const&) = delete;
  game(game const&) = delete;
  game& operator=(game const&) = delete;
  ~game() = default;

  /// Plays everything up to and including time t. `observe(game)` is called after each event.
  template <class Observer>
  void run(instant until, Observer&& observe) {
    while (queue_.front().time <= until) {
      std::pop_heap(queue_.begin(), queue_.end(), later);
      entry const e = queue_.back();
      queue_.pop_back();
      now_ = e.time;
      tally_.pass_to(now_);
      happen(e);
      observe(std::as_const(*this));
    }
    now_ = until;
  }
  void run(instant until) {
    run(until, [](game const&) {});
  }

  /// Plays it to its end. Call it once.
  [[nodiscard]] game_figures play() {
    instant const begin = options_.begin();
    run(begin);
    auto const won = world_.won();
    auto const free = world_.free();
    run(begin + options_.length);
    auto f = tally_.finish(now_);
    f.won = world_.won() - won;
    f.free = world_.free() - free;
    return f;
  }

  [[nodiscard]] instant now() const noexcept { return now_; }
  [[nodiscard]] std::size_t size() const noexcept { return robots_.size(); }
  [[nodiscard]] closed_world const& world() const noexcept { return world_; }
  /// Robot i's way of deciding, or nullptr while it is off.
  [[nodiscard]] C const* mind(std::size_t i) const noexcept { return robots_[i].mind ? &*robots_[i].mind : nullptr; }

private:
  enum class kind : unsigned char { tick, breakdown, repair, delivery, deliberation, transmission };

  struct player {
    robot_clock clock;
    sensor eyes;
    perceived seen;
    point stood;        // when it saw that
    instant next_loop;  // on its own clock
    instant due;        // when it has to speak next, on its own clock
    instant wakeup;     // the same in simulated time, or never; other transmissions in the queue are void
    std::uint64_t life;
    std::optional<C> mind;
  };
  struct entry {
    instant time;
    kind what{};
    std::size_t robot = 0;
    std::uint64_t number = 0;
    std::uint64_t life = 0;   // of a deliberation: void if the robot has had a later one
    std::size_t message = 0;  // of a delivery
  };
  static bool later(entry const& a, entry const& b) noexcept {
    if (a.time != b.time) return a.time > b.time;
    if (a.what != b.what) return a.what > b.what;
    if (a.robot != b.robot) return a.robot > b.robot;
    return a.number > b.number;
  }
  void push(instant time, kind what, std::size_t robot, std::uint64_t life = 0, std::size_t message_at = 0) {
    queue_.push_back({time, what, robot, number_++, life, message_at});
    std::push_heap(queue_.begin(), queue_.end(), later);
  }

  void happen(entry const& e) {
    player& r = robots_[e.robot];
    switch (e.what) {
    case kind::tick: {
      auto const kicks = world_.kicks();
      auto const won = world_.won();
      world_.advance(now_);
      tally_.look(world_.state(), world_.kicks() != kicks, world_.won() != won);
      push(now_ + options_.world.common.tick, kind::tick, 0);
      return;
    }
    case kind::breakdown:
      r.mind.reset();
      r.wakeup = never;
      world_.stop(e.robot);
      tally_.note(e.robot, nullptr, false);
      push(now_ + options_.world.breakdown, kind::repair, e.robot);
      push(now_ + options_.world.between_breakdowns, kind::breakdown, (e.robot + size() - 1) % size());
      return;
    case kind::repair: return switch_on(e.robot);
    case kind::delivery: {
      broadcast& b = air_[e.message];
      if (r.mind) r.mind->receive(b.content, r.clock.local(now_));
      if (--b.copies == 0) unused_.push_back(e.message);
      return act(e.robot);
    }
    case kind::deliberation:
      if (!r.mind || e.life != r.life) return;
      r.next_loop += r.clock.loop();
      push(r.clock.global(r.next_loop), kind::deliberation, e.robot, r.life);
      r.eyes.look(world_.state(), r.seen);
      r.stood = world_.state().robots[e.robot].position;
      r.mind->tick(r.seen, r.clock.local(now_));
      return act(e.robot);
    case kind::transmission:
      if (r.wakeup != e.time) return;
      r.wakeup = never;
      return act(e.robot);
    }
  }

  void switch_on(std::size_t i) {
    player& r = robots_[i];
    post p;
    p.self = i;
    p.robots = options_.robots;
    p.book = &book_;
    p.members = &members_;
    p.rules = options_.rules;
    p.first_message = r.clock.first_message();
    p.life = ++r.life;
    instant const local = r.clock.local(now_);
    r.mind.emplace(p, local);
    while (r.next_loop <= local) r.next_loop += r.clock.loop();
    push(r.clock.global(r.next_loop), kind::deliberation, i, r.life);
    act(i);
  }

  /// The robot goes where its part of what it believes sends it, and says what is due.
  void act(std::size_t i) {
    player& r = robots_[i];
    if (!r.mind) return;
    auto const& believed = r.mind->believed();
    auto const part = part_of<names>(believed, members_.agents()[i]);
    bool const attacks = !part.empty() && book_.attacks(part.front());
    // It may be wrong about its place, and knows only how far it has to go from there.
    if (part.empty() || r.seen.robots.empty()) {
      world_.stop(i);
    } else {
      world_.send(i, r.stood + (target_of(book_, part.front(), r.seen) - r.seen.robots[i]), attacks);
    }
    tally_.note(i, &believed, attacks);
    if constexpr (requires { r.mind->reigns(); }) tally_.note_reign(i, r.mind->reigns(), attacker_of(believed));
    speak(i);
  }

  [[nodiscard]] std::optional<std::size_t> attacker_of(allocation_atoms<names> const& atoms) const {
    for (in<names> const& x : atoms)
      if (book_.attacks(x)) return x.agent.value - 1;
    return std::nullopt;
  }

  void speak(std::size_t i) {
    player& r = robots_[i];
    instant const local = r.clock.local(now_);
    while (r.mind->next_due() <= local) {
      auto said = r.mind->next_message(local);
      if (!said) break;
      tally_.count(C::bytes(*said));
      send(i, *std::move(said));
    }
    instant const due = (std::max)(r.mind->next_due(), local + nanoseconds(1));
    if (due == never || (r.wakeup != never && due >= r.due)) return;
    r.due = due;
    r.wakeup = r.clock.global(due);
    push(r.wakeup, kind::transmission, i);
  }

  struct broadcast {
    message content;
    std::size_t copies = 0;
  };
  void send(std::size_t from, message content) {
    if (unused_.empty()) {
      unused_.push_back(air_.size());
      air_.emplace_back();
    }
    auto const at = unused_.back();
    std::size_t copies = 0;
    for (std::size_t to = 0; to < size(); ++to) {
      if (to == from) continue;
      for (duration const delay : network_.send(from, to)) {
        push(now_ + delay, kind::delivery, to, 0, at);
        ++copies;
      }
    }
    if (copies == 0) return;
    unused_.pop_back();
    air_[at] = {std::move(content), copies};
  }

  game_options options_;
  playbook const& book_;
  team<names> members_;
  closed_world world_;
  network network_;
  tally tally_;
  std::vector<player> robots_;
  std::vector<entry> queue_;  // a binary heap, earliest first
  std::vector<broadcast> air_;
  std::vector<std::size_t> unused_;
  std::uint64_t number_ = 0;
  instant now_{};
};

}  // namespace rota::sim::closed
