#pragma once

#include <rota/sim/metrics.hpp>
#include <rota/sim/scripted_world.hpp>
#include <rota/team/monitors/literal.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace rota::sim {

/// How a scenario is played.
struct play_options {
  scenario what = scenario::ball_fight;
  std::size_t robots = 5;
  std::optional<duration> length{};  ///< measured time; by default that of the scenario
  duration warm_up = seconds(2);     ///< not measured: the robots hear of each other
  world_options world;
  simulation_options team;
};

/// Plays a scenario once and measures it; `observe` sees every record as well, and `before` the simulation before it begins.
/// Equal options give equal figures.
///
/// @pre 2 ≤ robots ≤ max_robots. Complexity: about 1 µs per deliberation and message.
template <class Monitor = conflict_monitor<names>, observer Observer, class Before>
[[nodiscard]] figures play(playbook const& book, play_options const& options, Observer&& observe, Before&& before) {
  simulation<scripted_world, Monitor> team(
      book, scripted_world(options.what, options.robots, options.team.seed, options.world), options.team);
  before(std::as_const(team));
  instant const begin = instant{} + options.warm_up;
  instant const end = begin + options.length.value_or(default_length(options.what));
  metrics measure(team, begin);
  team.run(end, [&](log_record const& r) {
    measure(r);
    observe(r);
  });
  return measure.finish(end);
}
template <class Monitor = conflict_monitor<names>, observer Observer>
[[nodiscard]] figures play(playbook const& book, play_options const& options, Observer&& observe) {
  return play<Monitor>(book, options, observe, [](auto const&) {});
}
template <class Monitor = conflict_monitor<names>>
[[nodiscard]] figures play(playbook const& book, play_options const& options) {
  return play<Monitor>(book, options, [](log_record const&) {});
}

/// As the paper has it: cycles are counted whoever is their sender (`literal_monitor`), a reign has a fixed length, and the greatest
/// id leads.
[[nodiscard]] inline figures play_as_published(playbook const& book, play_options options) {
  options.team.robot.renewals = 0;
  options.team.stamp = {};
  return play<literal_monitor<names>>(book, options);
}

/// How long two robots that begin to fight need to detect it: means over random phases, in ms.
struct timing_figures {
  std::uint64_t samples = 0;    ///< robots that counted two and four subsequent cycles
  double two_cycles_ms = 0;     ///< at one robot, from applying the first e_m to the second e_r
  double four_cycles_ms = 0;    ///< at one robot, from applying the first e_m to the fourth e_r
  double two_detected_ms = 0;   ///< from when both act in conflict until the first robot has counted two cycles
  double four_detected_ms = 0;  ///< from when both act in conflict until the first robot has counted four
};

/// How `timing_figures` are measured: without noise and loss, and with resolution off.
struct timing_options {
  std::uint64_t seed = 1;
  std::size_t runs = 1000;
  duration message_period = milliseconds(100);
  duration latency = milliseconds(2);
};

/// A plan with Attack for one robot and Defend for the others: all that two robots need to fight.
[[nodiscard]] inline playbook duel_playbook() {
  plan_sketch sketch;
  sketch.id = {1};
  sketch.name = "Duel";
  sketch.tasks = {{{1}, "Attack", {1, 1}, {1}}, {{2}, "Defend", {0, cardinality::unbounded}, {2}}};
  return *make_playbook({1}, {sketch});
}

namespace detail {

/// Watches one duel.
class duel_watch {
public:
  explicit duel_watch(instant begin) : begin_(begin) {}

  void operator()(log_record const& r) {
    if (r.what == happening::deliberated) {
      acts_[r.robot] = false;
      for (in<names> const& x : r.believed)
        if (x.agent.value == r.robot + 1 && x.task == names::task{1}) acts_[r.robot] = true;
      if (!fight_ && r.time >= begin_ && acts_[0] && acts_[1]) fight_ = r.time;
    }
    if (!fight_) return;
    auto& mine = robots_[r.robot];
    if (r.what == happening::heard_plan && !r.change.empty() && !mine.first) mine.first = r.time;
    if (r.what != happening::deliberated || !mine.first) return;
    for (std::uint32_t i = 0; i < r.cycles; ++i) {
      ++mine.cycles;
      if (mine.cycles == 2) mine.two = r.time;
      if (mine.cycles == 4) mine.four = r.time;
    }
  }

  void add_to(timing_figures& f) const {
    if (!fight_ || !robots_[0].four || !robots_[1].four) return;
    for (auto const& mine : robots_) {
      ++f.samples;
      f.two_cycles_ms += to_milliseconds(*mine.two - *mine.first);
      f.four_cycles_ms += to_milliseconds(*mine.four - *mine.first);
    }
    f.two_detected_ms += to_milliseconds((std::min)(*robots_[0].two, *robots_[1].two) - *fight_);
    f.four_detected_ms += to_milliseconds((std::min)(*robots_[0].four, *robots_[1].four) - *fight_);
  }

private:
  struct robot {
    std::optional<instant> first, two, four;
    std::uint32_t cycles = 0;
  };
  instant begin_;
  bool acts_[2] = {false, false};
  robot robots_[2];
  std::optional<instant> fight_;
};

}  // namespace detail

/// Measures these figures on whole robots and the network.
[[nodiscard]] inline timing_figures measure_timing(timing_options const& options) {
  timing_figures f;
  playbook const book = duel_playbook();
  for (std::size_t run = 0; run < options.runs; ++run) {
    simulation_options team;
    team.seed = scatter(options.seed) + run;
    team.robot.message_period = options.message_period;
    team.robot.resolution = false;
    team.network = {options.latency, {}, 0, 0};
    team.sensor.ball_noise = team.sensor.ball_noise_permille = team.sensor.mate_noise = 0;
    auto engine = engine_for(team.seed, stream::world, 0);
    instant const begin = instant{} + nanoseconds(uniform(engine, seconds(1).ns, seconds(2).ns));
    simulation<duel_world> duel(book, duel_world(begin), team);
    detail::duel_watch watch(begin);
    duel.run(begin + options.message_period * 8, watch);
    watch.add_to(f);
  }
  auto const per = [](double& sum, std::uint64_t n) { sum = n == 0 ? 0 : sum / static_cast<double>(n); };
  per(f.two_cycles_ms, f.samples);
  per(f.four_cycles_ms, f.samples);
  per(f.two_detected_ms, f.samples / 2);
  per(f.four_detected_ms, f.samples / 2);
  return f;
}

}  // namespace rota::sim
