#pragma once

#include <rota/core/lifetime.hpp>
#include <rota/sim/clock.hpp>
#include <rota/sim/faults.hpp>
#include <rota/sim/interference.hpp>
#include <rota/sim/knowledge.hpp>
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

/// A simulated team. The seed decides the phases of loops and messages, all noise, and where chance decides in faults.
struct simulation_options {
  std::uint64_t seed = 1;
  robot_options robot;  ///< of every robot; each robot's clock sets `first_message`
  clock_options clock;
  network_options network;
  sensor_options sensor;
  sim::faults faults;  ///< nothing goes wrong by default
  /// How sure each robot is of its claims; if empty, as `robot` says. What it throws leaves `run`, which can be called again: the
  /// robot has missed one deliberation.
  stamp_function stamp;
  bool digests = false;  ///< look whether messages that do not count change who hears them
};

/// A team of robots in virtual time: discrete events, a scripted world, and the same `robot` that a real robot runs.
///
/// Deterministic: events are totally ordered by time, then kind, then robot, then order of creation. What the robots decide
/// changes nothing in the random streams of world, perceptions and network.
/// Faults draw from streams of their own, too: without them a run is the same, byte for byte.
/// Memory: bounded by robots and messages under way.
template <world World, class Monitor = conflict_monitor<names>>
class simulation {
public:
  using robot_type = rota::robot<names, Monitor>;

  /// The incarnation of every robot at the beginning.
  static constexpr incarnation first_life{1000};

  /// `book` must outlive the simulation.
  simulation(playbook const& book ROTA_LIFETIMEBOUND, World world, simulation_options const& options = {})
      : book_(book),
        world_(std::move(world)),
        members_(team_of(world_.state().robots.size())),
        network_(options.network, members_.size(), options.seed),
        air_(options.faults, members_.size(), options.seed),
        faults_(options.faults),
        stamp_(options.stamp),
        digests_(options.digests) {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      auto engine = engine_for(options.seed, stream::clock, i);
      robot_clock clock(options.clock, options.robot.message_period, engine);
      for (clock_drift const& d : faults_.drifts)
        if (d.robot == i) clock.drift_by(d.ppm);
      robot_options mine = options.robot;
      mine.first_message = clock.first_message();
      robots_.push_back({clock,
                         robot_type(members_.agents()[i], members_.agents(), first_life, mine),
                         sensor(options.sensor, i, options.seed),
                         {},
                         clock.first_loop(),
                         {},
                         never,
                         0,
                         first_life,
                         1,
                         true,
                         notebook(i, members_.size())});
    }
    schedule();
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
      case kind::deliberation: deliberate(e, observe); break;
      case kind::transmission: transmit(e, observe); break;
      case kind::upheaval: undergo(upheavals_[e.slot], observe); break;
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
  /// Whether the robot runs; while it does not, `robot(i)` is what it was when it crashed.
  [[nodiscard]] bool up(std::size_t i) const noexcept { return robots_[i].up; }
  /// Whether it runs and executes the plan type.
  [[nodiscard]] bool plays(std::size_t i) const { return up(i) && robots_[i].mind.executes(book_.type.id()); }
  [[nodiscard]] robot_clock const& clock(std::size_t i) const noexcept { return robots_[i].clock; }
  /// A digest of all perceptions of all robots so far. It does not depend on the protocol.
  [[nodiscard]] std::uint64_t perception_digest() const noexcept {
    std::uint64_t digest = 0;
    for (auto const& r : robots_) digest = scatter(digest ^ r.eyes.digest());
    return digest;
  }

private:
  enum class kind : unsigned char { delivery, deliberation, transmission, upheaval };

  /// A fault that changes a robot at one instant.
  struct upheaval {
    enum class kind : unsigned char { crash, restart, leave, enter, confidence };
    instant at{};
    std::size_t robot = 0;
    kind what{};
    std::uint32_t value = 0;  // the confidence, or which crash it is
  };

  struct robot_record {
    robot_clock clock;
    robot_type mind;
    sensor eyes;
    perceived belief;
    instant next_loop;     // on its own clock
    instant due;           // when it has to speak next, on its own clock
    instant wakeup;        // the same in simulated time, or never; other transmissions in the queue are void
    std::uint64_t reign;   // the number of the claim it leads with, or 0
    incarnation greatest;  // that it has had
    std::uint32_t life;    // how many it has had; deliberations of others in the queue are void
    bool up;
    notebook notes;  // empty where no stamps are asked for
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
    std::optional<testimony> beside;
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
      push(r.clock.global(r.next_loop), kind::deliberation, i, r.life);
      speak(i, observe);
    }
  }

  /// Puts the faults that change a robot into the queue.
  void schedule() {
    using what = typename upheaval::kind;
    std::uint32_t which = 0;
    for (crash const& c : faults_.crashes) schedule({c.at, c.robot, what::crash, which++});
    for (absence const& a : faults_.absences) {
      schedule({a.when.from, a.robot, what::leave});
      if (a.when.until != never) schedule({a.when.until, a.robot, what::enter});
    }
    for (confidence_change const& c : faults_.confidences) schedule({c.at, c.robot, what::confidence, c.confidence});
  }
  void schedule(upheaval const& u) {
    push(u.at, kind::upheaval, u.robot, static_cast<std::uint32_t>(upheavals_.size()));
    upheavals_.push_back(u);
  }

  template <class Observer>
  void undergo(upheaval u, Observer& observe) {
    robot_record& r = robots_[u.robot];
    instant const local = r.clock.local(now_);
    switch (u.what) {
    case upheaval::kind::crash:
      if (!std::exchange(r.up, false)) return;
      if (std::exchange(r.reign, 0) != 0) tell(observe, u.robot, happening::reign_ended, {});
      r.wakeup = never;
      tell(observe, u.robot, happening::crashed, {});
      if (auto const down = faults_.crashes[u.value].down; down != crash::for_good)
        schedule({now_ + down, u.robot, upheaval::kind::restart, u.value});
      return;
    case upheaval::kind::restart: {
      if (r.up) return;
      auto const last = r.mind.incarnation();
      auto const as = faults_.crashes[u.value].as;
      incarnation const life{as == rebirth::greater ? r.greatest.value + 1
                             : as == rebirth::equal ? last.value
                                                    : (std::max<std::uint64_t>)(last.value - 1, 1)};
      r.greatest = (std::max)(r.greatest, life);
      r.mind = robot_type(r.mind.self(), members_.agents(), life, robot_options(r.mind.options()));
      r.up = true;
      r.notes = notebook(u.robot, members_.size());
      ++r.life;
      while (r.next_loop <= local) r.next_loop += r.clock.loop();
      tell(observe, u.robot, happening::restarted, {});
      r.mind.enter(book_.type, local);
      tell(observe, u.robot, happening::entered, {});
      push(r.clock.global(r.next_loop), kind::deliberation, u.robot, r.life);
      break;
    }
    case upheaval::kind::leave:
      if (!r.up || !r.mind.leave(book_.type.id())) return;
      note_reign(u.robot, observe);
      tell(observe, u.robot, happening::left, {});
      break;
    case upheaval::kind::enter:
      if (!r.up || !r.mind.enter(book_.type, local)) return;
      tell(observe, u.robot, happening::entered, {});
      break;
    case upheaval::kind::confidence: r.mind.set_confidence(u.value); return;
    }
    speak(u.robot, observe);
  }

  template <class Observer>
  void deliberate(entry const& e, Observer& observe) {
    std::size_t const i = e.robot;
    robot_record& r = robots_[i];
    if (!r.up || e.slot != r.life) return;
    r.next_loop += r.clock.loop();
    push(r.clock.global(r.next_loop), kind::deliberation, i, r.life);
    world_.advance(now_);
    see(r, i);
    if (stamp_) {
      instant const local = r.clock.local(now_);
      r.notes.look(r.belief, local);
      r.mind.set_confidence(stamp_(r.notes.know(r.belief, local, book_, members_, space_)));
    }
    if (!r.mind.executes(book_.type.id())) return speak(i, observe);
    auto const d = r.mind.deliberate(book_.type, members_, r.belief, r.clock.local(now_), space_);
    details more;
    more.cycles = d.cycles;
    more.detected = d.detected.has_value();
    if (d.search) more.abstains = !d.search->plan;
    if (d.deleted.empty()) {
      tell(observe, i, happening::deliberated, d.event, more);
    } else {
      tell(observe, i, happening::deliberated, compose(d.deleted, d.event), more);
    }
    if (d.reign_renewed) {
      r.reign = r.mind.rule(book_.type.id())->current().number;
      tell(observe, i, happening::reign_renewed, {});
    }
    note_reign(i, observe, d.reign_began);
    speak(i, observe);
  }

  void see(robot_record& r, std::size_t i) {
    auto const covers = [&](auto const& faults) {
      return std::any_of(faults.begin(), faults.end(),
                         [&](auto const& f) { return f.robot == i && f.when.covers(now_); });
    };
    if (covers(faults_.stuck) && !r.belief.robots.empty()) {
      r.eyes.look(world_.state(), unseen_);  // the random stream goes on
    } else {
      r.eyes.look(world_.state(), r.belief);
    }
    r.belief.blind = covers(faults_.blind);
  }

  template <class Observer>
  void deliver(entry const& e, Observer& observe) {
    broadcast& b = messages_[e.slot];
    robot_record& r = robots_[e.robot];
    if (--b.copies == 0) free_.push_back(e.slot);  // nobody says anything before it is heard
    if (!r.up) return;
    auto const flipped = air_.flipped(b.content, b.sender, e.robot, now_);
    message<names> const& heard = flipped ? *flipped : b.content;
    instant const local = r.clock.local(now_);
    auto const before = digests_ ? r.mind.digest(local) : 0;
    auto answer = r.mind.receive(heard, local);
    details more;
    more.other = b.sender;
    more.claim = answer.claim;
    more.content = &heard;
    more.verdict = answer.verdict;
    more.reason = answer.reason;
    more.genuine = !flipped;
    more.changed = digests_ && answer.verdict != verdict::accepted && r.mind.digest(local) != before;
    bool const plan = std::holds_alternative<plan_message<names>>(heard);
    if (plan && b.beside && answer.verdict == verdict::accepted) r.notes.hear(b.sender, *b.beside, r.clock.local(now_));
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
      details more;
      more.content = &*said;
      bool const plan = std::holds_alternative<plan_message<names>>(*said);
      tell(observe, i, plan ? happening::said_plan : happening::said_claim, {}, more);
      send(i, *std::move(said));
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
      auto delays = network_.send(from, to);
      air_.disturb(delays, from, to, now_);
      for (duration const delay : delays) {
        push(now_ + delay, kind::delivery, to, slot);
        ++copies;
      }
    }
    if (copies == 0) return;
    free_.pop_back();
    messages_[slot] = {std::move(content), static_cast<std::uint32_t>(from), copies,
                       robots_[from].notes.account(robots_[from].belief, robots_[from].clock.local(now_))};
  }

  struct details {
    std::size_t other = 0;
    std::uint32_t cycles = 0;
    bool detected = false;
    bool superseded = false;
    std::optional<claim_outcome> claim{};
    message<names> const* content = nullptr;
    rota::verdict verdict = verdict::accepted;
    refusal reason = refusal::none;
    bool genuine = true;
    std::optional<bool> abstains{};
    bool changed = false;
  };

  template <class Observer>
  void tell(Observer& observe, std::size_t i, happening what, event<in<names>> const& change,
            details const& more = {}) {
    auto const& mind = robots_[i].mind;
    auto const* const believed = mind.believes(book_.type.id());
    auto const* const rule = mind.rule(book_.type.id());
    observe(log_record{now_, i, what, change, believed ? believed->atoms() : nothing_, world_.state(), more.other,
                       more.cycles, more.detected, rule && rule->leading(), more.superseded, more.claim, more.content,
                       more.verdict, more.reason, more.genuine, more.abstains, more.changed});
  }

  template <class Observer>
  void note_reign(std::size_t i, Observer& observe, bool detected = false) {
    auto const* const rule = robots_[i].mind.rule(book_.type.id());
    std::uint64_t const reign = rule && rule->leading() ? rule->current().number : 0;
    std::uint64_t const before = std::exchange(robots_[i].reign, reign);
    if (reign == before) return;
    details ended;
    ended.superseded = rule && rule->obeying();
    if (before != 0) tell(observe, i, happening::reign_ended, {}, ended);
    details began;
    began.detected = detected;
    if (reign != 0) tell(observe, i, happening::reign_began, {}, began);
  }

  playbook const& book_;
  World world_;
  team<names> members_;
  network network_;
  interference air_;
  faults faults_;
  stamp_function stamp_;
  bool digests_;
  std::vector<upheaval> upheavals_;
  std::vector<robot_record> robots_;
  perceived unseen_;
  allocation_atoms<names> nothing_;  // believed by who does not execute the plan type
  workspace space_;
  std::vector<entry> queue_;  // a binary heap, earliest first
  std::vector<broadcast> messages_;
  std::vector<std::uint32_t> free_;
  std::uint64_t sequence_ = 0;
  instant now_{};
  bool started_ = false;
};

}  // namespace rota::sim
