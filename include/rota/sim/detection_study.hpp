#pragma once

#include <rota/sim/clock.hpp>
#include <rota/sim/playbook.hpp>
#include <rota/sim/random.hpp>
#include <rota/team/robot.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

/// How soon a monitor sees conflicts of several kinds, how often it misses them, and how often it sees one where there is none.
namespace rota::sim {

/// What the robots of a study do.
enum class quarrel : unsigned char {
  fight,           ///< each of the first `fighters` is sure that it is closest to the ball
  join_and_leave,  ///< robot 2 joins with a task, is given another, and leaves, at each of its messages
  no_room,         ///< … and is given none
  insist,          ///< robot 2 says the same each time, and is given something else each time
  yield,           ///< robot 2 takes the ball at one message and yields at the next
  agree,           ///< all see the same, and who is closest changes at random moments
  hand_over        ///< no quarrel: robot 1, who has the ball, leaves; measured is when another takes it
};

struct study_options {
  quarrel what = quarrel::fight;
  std::uint64_t robots = 2;
  std::uint64_t fighters = 2;
  double loss = 0;
  robot_options robot;                 ///< n, patience and so on; resolution is off in any case
  duration limit = seconds(5);         ///< of one run
  duration jumps = milliseconds(100);  ///< `agree`: the mean time between changes
  std::size_t runs = 200;
  std::uint64_t seed = 1;
};

struct study_figures {
  std::size_t runs = 0;
  std::size_t detected = 0;  ///< runs in which somebody detected something, or took over
  double mean_ms = 0;        ///< of these, from the beginning of the quarrel until then
  double slowest_ms = 0;
  double alarms_per_minute = 0;  ///< detections per robot and minute
};

namespace detail {

/// Who is closest to the ball, and which of the other two tasks robot 2 would be given.
struct study_beliefs {
  std::uint64_t closest = 0;
  bool turn = false;
};

[[nodiscard]] inline plan_type<names, study_beliefs> study_play(bool room) {
  std::uint32_t const others = room ? cardinality::unbounded : 0;
  using plan_of = plan<names, study_beliefs>;
  auto const worth = [](names::agent a, names::task t, study_beliefs const& b) {
    if (t.value == 1) return a.value == b.closest ? 1.0 : 0.125;
    return t.value == 2 + (b.turn && a.value == 2 ? 1u : 0u) ? 0.25 : 0.1875;
  };
  auto const p = plan_of::make(
      {.plan = {1}, .tasks = {{{1}, {1, 1}, {1}}, {{2}, {0, others}, {2}}, {{3}, {0, others}, {3}}}, .utility = worth});
  return *plan_type<names, study_beliefs>::make({1}, {*p});
}

/// One run: whole robots, a radio that loses messages and delays the others by 2 ms, each robot with phases of its own.
template <class Monitor>
class study_run {
public:
  study_run(study_options const& o, plan_type<names, study_beliefs> const& play, team<names> const& members,
            std::uint64_t seed)
      : options_(o), play_(play), members_(members), engine_(engine_for(seed, stream::world, 0)) {
    std::vector<names::agent> everybody;
    for (std::uint64_t i = 1; i <= o.robots; ++i) everybody.push_back({i});
    for (std::uint64_t i = 1; i <= o.robots; ++i) {
      auto mine = o.robot;
      mine.resolution = false;
      mine.first_message = instant{} + nanoseconds(uniform(engine_, 0, mine.message_period.ns - 1));
      robots_.push_back({rota::robot<names, Monitor>({i}, everybody, incarnation{1}, mine),
                         instant{} + nanoseconds(uniform(engine_, 0, milliseconds(30).ns - 1))});
      robots_.back().mind.enter(play_, instant{});
    }
    begin_ = instant{} + seconds(1) + nanoseconds(uniform(engine_, 0, milliseconds(300).ns));
    jump_ = begin_;
  }

  /// When somebody first detected something, or took over, from the beginning of the quarrel; counts all detections.
  std::optional<duration> play(std::size_t& detections) {
    std::optional<duration> first;
    while (true) {
      std::size_t i = 0;  // who acts next
      for (std::size_t k = 1; k < robots_.size(); ++k)
        if (due(k) < due(i)) i = k;
      auto const now = due(i);
      if (now > begin_ + options_.limit) return first;
      while (options_.what == quarrel::agree && jump_ <= now) {
        closest_ = 1 + static_cast<std::uint64_t>(uniform(engine_, 0, static_cast<std::int64_t>(options_.robots) - 1));
        jump_ = jump_ + nanoseconds(1 + geometric());
      }
      if (now < robots_[i].next_thought) {
        speak(i, now);
        continue;
      }
      robots_[i].next_thought = now + milliseconds(30);
      hear(now);
      if (options_.what == quarrel::hand_over && i == 0 && now >= begin_ && robots_[0].mind.leave(play_.id()))
        begin_ = now;
      if (scripted(i)) continue;
      robots_[i].turn = !robots_[i].turn;
      auto const d = robots_[i].mind.deliberate(play_, members_, sight(i, now), now, space_);
      speak(i, now);
      if (options_.what == quarrel::hand_over) {
        bool const gone = !robots_[0].mind.executes(play_.id());
        if (gone && d.own && d.own->task == names::task{1}) return now - begin_;
        continue;
      }
      if (!d.detected || now < begin_) continue;
      ++detections;
      if (!first) first = now - begin_;
      if (options_.what != quarrel::agree) return first;
    }
  }

private:
  struct player {
    rota::robot<names, Monitor> mind;
    instant next_thought;
    bool turn = false;
    std::uint64_t said = 0;
  };
  struct flight {
    message<names> what;
    instant arrives;
    std::size_t to = 0;
  };

  [[nodiscard]] instant due(std::size_t i) const {
    return (std::min)(robots_[i].next_thought, robots_[i].mind.next_due());
  }
  /// Robot 2 plays a part in some quarrels.
  [[nodiscard]] bool scripted(std::size_t i) const {
    return i == 1 && options_.what != quarrel::fight && options_.what != quarrel::agree &&
           options_.what != quarrel::hand_over;
  }
  [[nodiscard]] study_beliefs sight(std::size_t i, instant now) const {
    if (options_.what == quarrel::agree) return {closest_, false};
    bool const fights = options_.what == quarrel::fight && now >= begin_ && i < options_.fighters;
    return {fights ? i + 1 : 1, options_.what == quarrel::insist && robots_[i].turn};
  }
  std::int64_t geometric() {
    std::int64_t ms = 0;
    while (!chance(engine_, 1 / to_milliseconds(options_.jumps))) ++ms;
    return milliseconds(ms).ns;
  }

  void speak(std::size_t i, instant now) {
    while (auto m = robots_[i].mind.next_message(now)) {
      if (scripted(i)) m = part(i, std::move(*m), now);
      for (std::size_t to = 0; to < robots_.size(); ++to)
        if (to != i && !chance(engine_, options_.loss)) air_.push_back({*m, now + milliseconds(2), to});
    }
    hear(now);
  }
  void hear(instant now) {
    for (std::size_t k = 0; k < air_.size();) {
      if (air_[k].arrives > now) {
        ++k;
        continue;
      }
      auto const f = air_[k];
      air_.erase(air_.begin() + static_cast<std::ptrdiff_t>(k));
      robots_[f.to].mind.receive(f.what, now);
    }
  }
  /// What robot 2 says of itself instead.
  message<names> part(std::size_t i, message<names> m, instant now) {
    auto& p = *std::get_if<plan_message<names>>(&m);
    auto const n = robots_[i].said++;
    bool const quarrels = now >= begin_ && (options_.what == quarrel::insist || n % 2 == 0);
    p.types.clear();
    if (quarrels || (options_.what != quarrel::join_and_leave && options_.what != quarrel::no_room)) {
      participation<names> entry;
      entry.type = {1};
      std::uint64_t const task = quarrels ? 1 : 2;
      entry.place = placement<names>{{1}, {task}, {task}};
      p.types.push_back(entry);
    }
    return m;
  }

  study_options const& options_;
  plan_type<names, study_beliefs> const& play_;
  team<names> const& members_;
  random_engine engine_;
  std::vector<player> robots_;
  std::vector<flight> air_;
  workspace space_;
  instant begin_{};
  instant jump_{};
  std::uint64_t closest_ = 1;
};

}  // namespace detail

/// Plays so many runs. Equal options give equal figures.
template <class Monitor>
[[nodiscard]] study_figures study_detection(study_options const& options) {
  auto const play = detail::study_play(options.what != quarrel::no_room);
  team<names> members;
  for (std::uint64_t i = 1; i <= options.robots; ++i) members.add({i});
  study_figures f;
  std::size_t detections = 0;
  for (std::size_t run = 0; run < options.runs; ++run) {
    detail::study_run<Monitor> one(options, play, members, scatter(options.seed) + run);
    auto const first = one.play(detections);
    ++f.runs;
    if (!first) continue;
    ++f.detected;
    f.mean_ms += to_milliseconds(*first);
    f.slowest_ms = (std::max)(f.slowest_ms, to_milliseconds(*first));
  }
  if (f.detected > 0) f.mean_ms /= static_cast<double>(f.detected);
  f.alarms_per_minute = static_cast<double>(detections) /
                        (static_cast<double>(options.runs * options.robots) * to_seconds(options.limit) / 60);
  return f;
}

}  // namespace rota::sim
