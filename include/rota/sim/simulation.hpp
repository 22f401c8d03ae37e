#pragma once

#include <rota/core/lifetime.hpp>
#include <rota/sim/clock.hpp>
#include <rota/sim/log.hpp>
#include <rota/sim/network.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace rota::sim {

/// A simulated team. The seed decides the phases of loops and messages, and all noise.
struct simulation_options {
  std::uint64_t seed = 1;
  robot_options robot;  ///< of every robot; each robot's clock sets `first_message`
  clock_options clock;
  network_options network;
  sensor_options sensor;
};

/// A team of robots in virtual time: discrete events, a scripted world, and the same `robot` that a real robot runs.
///
/// Deterministic: events are totally ordered by time, then kind, then robot, then order of creation. What the robots decide
/// changes nothing in the random streams of world, perceptions and network.
/// Memory: bounded by robots and messages under way.
template <world World, class Monitor = conflict_monitor<names>>
class simulation {
public:
  using robot_type = rota::robot<names, Monitor>;

  /// `book` must outlive the simulation. Each robot lives once: its incarnation is 1.
  simulation(playbook const& book ROTA_LIFETIMEBOUND, World world, simulation_options const& options = {})
      : book_(book),
        world_(std::move(world)),
        members_(team_of(world_.state().robots.size())),
        network_(options.network, members_.size(), options.seed) {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      auto engine = engine_for(options.seed, stream::clock, i);
      robot_clock const clock(options.clock, options.robot.message_period, engine);
      robot_options mine = options.robot;
      mine.first_message = clock.first_message();
      robots_.push_back({clock,
                         robot_type(members_.agents()[i], members_.agents(), incarnation{1}, mine),
                         sensor(options.sensor, i, options.seed),
                         {},
                         clock.first_loop(),
                         {},
                         never,
                         0});
    }
  }

  simulation(playbook&&, World, simulation_options const& = {}) = delete;

  /// Plays everything up to and including simulated time `until`, and tells the observer. Call it again to go on.
  template <observer Observer>
  void run(instant until, Observer&& observe) {
    if (!started_) start(observe);
    while (!queue_.empty() && queue_.front().time <= until) {
      std::pop_heap(queue_.begin(), queue_.end(), later);
      entry const e = queue_.back();
      queue_.pop_back();
      now_ = e.time;
      switch (e.what) {
      case kind::delivery: deliver(e, observe); break;
      case kind::deliberation: deliberate(e.robot, observe); break;
      case kind::transmission: transmit(e, observe); break;
      }
    }
    now_ = until;
    world_.advance(until);
  }

  [[nodiscard]] instant now() const noexcept { return now_; }
  [[nodiscard]] std::size_t size() const noexcept { return robots_.size(); }
  [[nodiscard]] team<names> const& members() const noexcept { return members_; }
  [[nodiscard]] playbook const& book() const noexcept { return book_; }
  [[nodiscard]] world_state const& truth() const noexcept { return world_.state(); }
  [[nodiscard]] robot_type const& robot(std::size_t i) const noexcept { return robots_[i].mind; }
  /// A digest of all perceptions of all robots so far. It does not depend on the protocol.
  [[nodiscard]] std::uint64_t perception_digest() const noexcept {
    std::uint64_t digest = 0;
    for (auto const& r : robots_) digest = scatter(digest ^ r.eyes.digest());
    return digest;
  }

private:
  enum class kind : unsigned char { delivery, deliberation, transmission };

  struct robot_record {
    robot_clock clock;
    robot_type mind;
    sensor eyes;
    perceived belief;
    instant next_loop;    // on its own clock
    instant due;          // when it has to speak next, on its own clock
    instant wakeup;       // the same in simulated time, or never; other transmissions in the queue are void
    std::uint64_t reign;  // the number of the claim it leads with, or 0
  };

  struct entry {
    instant time;
    std::uint64_t sequence = 0;
    std::uint32_t robot = 0;
    std::uint32_t slot = 0;
    kind what{};
  };
  static bool later(entry const& a, entry const& b) noexcept {
    if (a.time != b.time) return a.time > b.time;
    if (a.what != b.what) return a.what > b.what;
    if (a.robot != b.robot) return a.robot > b.robot;
    return a.sequence > b.sequence;
  }

  /// A broadcast under way. When the last copy has arrived, its slot is used again.
  struct broadcast {
    message<names> content;
    std::uint32_t sender = 0;
    std::uint32_t copies = 0;
  };

  void push(instant time, kind what, std::size_t robot, std::uint32_t slot = 0) {
    queue_.push_back({time, sequence_++, static_cast<std::uint32_t>(robot), slot, what});
    std::push_heap(queue_.begin(), queue_.end(), later);
  }

  template <class Observer>
  void start(Observer& observe) {
    started_ = true;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      robot_record& r = robots_[i];
      r.mind.enter(book_.type, r.clock.local(now_));
      tell(observe, i, happening::entered, {});
      push(r.clock.global(r.next_loop), kind::deliberation, i);
      speak(i, observe);
    }
  }

  template <class Observer>
  void deliberate(std::size_t i, Observer& observe) {
    robot_record& r = robots_[i];
    r.next_loop += r.clock.loop();
    push(r.clock.global(r.next_loop), kind::deliberation, i);
    world_.advance(now_);
    r.eyes.look(world_.state(), r.belief);
    auto const d = r.mind.deliberate(book_.type, members_, r.belief, r.clock.local(now_), space_);
    details more;
    more.cycles = d.cycles;
    more.detected = d.detected.has_value();
    if (d.deleted.empty()) {
      tell(observe, i, happening::deliberated, d.event, more);
    } else {
      tell(observe, i, happening::deliberated, compose(d.deleted, d.event), more);
    }
    note_reign(i, observe, d.reign_began);
    speak(i, observe);
  }

  template <class Observer>
  void deliver(entry const& e, Observer& observe) {
    broadcast& b = messages_[e.slot];
    robot_record& r = robots_[e.robot];
    auto answer = r.mind.receive(b.content, r.clock.local(now_));
    details more;
    more.other = b.sender;
    more.claim = answer.claim;
    bool const plan = std::holds_alternative<plan_message<names>>(b.content);
    if (--b.copies == 0) free_.push_back(e.slot);
    auto const change = answer.changes.empty() ? std::move(answer.imposed) : answer.changes[0].part.event();
    tell(observe, e.robot, plan ? happening::heard_plan : happening::heard_claim, change, more);
    note_reign(e.robot, observe);
    speak(e.robot, observe);
  }

  template <class Observer>
  void transmit(entry const& e, Observer& observe) {
    robot_record& r = robots_[e.robot];
    if (r.wakeup != e.time) return;
    r.wakeup = never;
    speak(e.robot, observe);
  }

  /// Sends what is due, and sets the wakeup for what comes next.
  template <class Observer>
  void speak(std::size_t i, Observer& observe) {
    robot_record& r = robots_[i];
    instant const local = r.clock.local(now_);
    while (r.mind.next_due() <= local) {
      auto said = r.mind.next_message(local);
      note_reign(i, observe);  // a reign may have ended just before
      if (!said) break;
      bool const plan = std::holds_alternative<plan_message<names>>(*said);
      send(i, *std::move(said));
      tell(observe, i, plan ? happening::said_plan : happening::said_claim, {});
    }
    instant const due = (std::max)(r.mind.next_due(), local + nanoseconds(1));
    if (r.wakeup != never && due >= r.due) return;
    r.due = due;
    r.wakeup = r.clock.global(due);
    push(r.wakeup, kind::transmission, i);
  }

  void send(std::size_t from, message<names> content) {
    if (free_.empty()) {
      free_.push_back(static_cast<std::uint32_t>(messages_.size()));
      messages_.emplace_back();
    }
    auto const slot = free_.back();
    std::uint32_t copies = 0;
    for (std::size_t to = 0; to < robots_.size(); ++to) {
      if (to == from) continue;
      for (duration const delay : network_.send(from, to)) {
        push(now_ + delay, kind::delivery, to, slot);
        ++copies;
      }
    }
    if (copies == 0) return;
    free_.pop_back();
    messages_[slot] = {std::move(content), static_cast<std::uint32_t>(from), copies};
  }

  struct details {
    std::size_t other = 0;
    std::uint32_t cycles = 0;
    bool detected = false;
    bool superseded = false;
    std::optional<claim_outcome> claim{};
  };

  [[nodiscard]] authority<names> const& rule_of(std::size_t i) const { return *robots_[i].mind.rule(book_.type.id()); }

  template <class Observer>
  void tell(Observer& observe, std::size_t i, happening what, event<in<names>> const& change,
            details const& more = {}) {
    auto const& mind = robots_[i].mind;
    observe(log_record{now_, i, what, change, mind.believes(book_.type.id())->atoms(), world_.state(), more.other,
                       more.cycles, more.detected, rule_of(i).leading(), more.superseded, more.claim});
  }

  template <class Observer>
  void note_reign(std::size_t i, Observer& observe, bool detected = false) {
    auto const& rule = rule_of(i);
    std::uint64_t const reign = rule.leading() ? rule.current().number : 0;
    std::uint64_t const before = std::exchange(robots_[i].reign, reign);
    if (reign == before) return;
    details ended;
    ended.superseded = rule.obeying();
    if (before != 0) tell(observe, i, happening::reign_ended, {}, ended);
    details began;
    began.detected = detected;
    if (reign != 0) tell(observe, i, happening::reign_began, {}, began);
  }

  playbook const& book_;
  World world_;
  team<names> members_;
  network network_;
  std::vector<robot_record> robots_;
  workspace space_;
  std::vector<entry> queue_;  // a binary heap, earliest first
  std::vector<broadcast> messages_;
  std::vector<std::uint32_t> free_;
  std::uint64_t sequence_ = 0;
  instant now_{};
  bool started_ = false;
};

}  // namespace rota::sim
