#pragma once

#include <rota/sim/invariants.hpp>
#include <rota/sim/restless_world.hpp>
#include <rota/team/budget.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

/// Many runs with faults drawn at random, each held to what is promised.
namespace rota::sim {

/// A plan for two to eleven: one attacks, one or two defend, up to two support, and changes must save half a metre.
[[nodiscard]] inline playbook campaign_playbook() {
  plan_sketch s;
  s.id = {1};
  s.name = "Campaign";
  s.tasks = {{{1}, "Attack", {1, 1}, {1}}, {{2}, "Defend", {1, 2}, {2}}, {{3}, "Support", {0, 2}, {3}}};
  s.hysteresis = 0.5;
  return *make_playbook({1}, {s});
}

/// One run of a campaign.
struct campaign_run {
  std::uint64_t seed = 1;
  std::size_t robots = 5;
  simulation_options team;
  restless_options world;
  promises promised;
  instant end{};  ///< some time after the team has settled
};

namespace detail {

/// Draws everything of a run from its seed, one number after the other.
class run_maker {
public:
  explicit run_maker(std::uint64_t seed) : engine_(engine_for(seed, stream::campaign, 0)) { run_.seed = seed; }

  /// Two to seven robots, unless their number is given.
  [[nodiscard]] campaign_run make(std::optional<std::size_t> robots) {
    auto const drawn = static_cast<std::size_t>(uniform(engine_, 2, 7));
    run_.robots = robots.value_or(drawn);
    run_.team.seed = run_.seed;
    run_.team.digests = true;
    draw_robot();
    draw_radio();
    draw_faults();
    run_.promised = promised(run_.team, run_.robots, calm_);
    run_.end = run_.promised.settled + seconds(1);
    return run_;
  }

private:
  [[nodiscard]] bool coin(double p) { return chance(engine_, p); }
  template <class T>
  [[nodiscard]] T one_of(std::initializer_list<T> list) {
    return list.begin()[uniform(engine_, 0, static_cast<std::int64_t>(list.size()) - 1)];
  }
  [[nodiscard]] duration between(duration low, duration high) { return nanoseconds(uniform(engine_, low.ns, high.ns)); }
  [[nodiscard]] std::size_t some_robot() {
    return static_cast<std::size_t>(uniform(engine_, 0, static_cast<std::int64_t>(run_.robots) - 1));
  }
  /// From a second after the beginning on, and over before the calm.
  [[nodiscard]] spell some_time() {
    instant const from = begin_ + between({}, calm_ - begin_ - milliseconds(1));
    return {from, from + between(milliseconds(1), calm_ - from)};
  }
  template <class Fault, class Make>
  void some(std::vector<Fault>& list, double p, std::int64_t most, Make make) {
    if (!coin(p)) return;
    for (auto n = uniform(engine_, 1, most); n > 0; --n) list.push_back(make());
  }

  void draw_robot() {
    robot_options& o = run_.team.robot;
    o.cycles = one_of({2U, 3U, 4U, 4U});
    o.silence = one_of({seconds(1), seconds(2)});
    o.reign = one_of({milliseconds(500), seconds(1), seconds(2)});
    o.max_reign = o.reign;
    o.forget = one_of({seconds(4), seconds(6)});
    o.change_period = one_of({duration{}, milliseconds(30)});
    o.opening = one_of({duration{}, milliseconds(200)});
    o.fingerprints = coin(0.5);
    o.resolution = !coin(0.2);  // then they must agree without a leader
    o.message_period = one_of({milliseconds(50), milliseconds(100), milliseconds(100), milliseconds(250)});
    if (coin(0.2)) o = sparing(one_of({milliseconds(100), milliseconds(200)}), o);
    run_.team.sensor = exact_sensor();
    o.renewals = one_of({0U, 0U, 2U, 30U});
    calm_ = begin_ + between(seconds(4), seconds(10));
    run_.world = {between(milliseconds(200), seconds(4)), between(milliseconds(500), seconds(4)), calm_};
  }

  void draw_radio() {
    network_options& n = run_.team.network;
    n.loss = 0;  // it is lost while the faults last only
    n.latency = between(microseconds(100), milliseconds(5));
    n.jitter = one_of({milliseconds(3), milliseconds(30), milliseconds(300)});
    n.duplication = one_of({0.0, 0.002, 0.2});
    faults& f = run_.team.faults;
    if (coin(0.7)) {
      burst_loss b;
      b.when = {{}, calm_};
      if (coin(0.5)) b.begins = 1, b.ends = 0, b.loss = one_of({0.02, 0.2, 0.6});
      f.bursts = b;
    }
    if (coin(0.3)) {
      late_copies l;
      l.when = {{}, calm_};
      l.probability = one_of({0.01, 0.2});
      l.least = milliseconds(200);
      l.most = one_of({seconds(1), seconds(3)});
      f.late = l;
    }
    if (coin(0.15)) f.flips = flipped_bits{{{}, calm_}, one_of({0.002, 0.02})};
  }

  void draw_faults() {
    faults& f = run_.team.faults;
    some(f.partitions, 0.4, 2, [&] {
      auto const side = uniform(engine_, 1, (std::int64_t{1} << run_.robots) - 2);
      return partition{some_time(), static_cast<std::uint32_t>(side)};
    });
    some(f.broken, 0.3, 3, [&] { return broken_link{some_time(), some_robot(), some_robot()}; });
    some(f.crashes, 0.4, 2, [&] {
      auto const when = some_time();
      bool const returns = run_.robots <= 4 || coin(0.8);  // two or more stay
      return crash{some_robot(), when.from, returns ? when.until - when.from : crash::for_good,
                   one_of({rebirth::greater, rebirth::greater, rebirth::equal, rebirth::smaller})};
    });
    some(f.drifts, 0.4, 3, [&] { return clock_drift{some_robot(), uniform(engine_, -10'000, 10'000)}; });
    some(f.stuck, 0.3, 2, [&] { return stuck_sensor{some_robot(), some_time()}; });
    some(f.blind, 0.3, 2, [&] { return blindness{some_robot(), some_time()}; });
    some(f.absences, 0.3, 3, [&] { return absence{some_robot(), some_time()}; });
    some(f.confidences, 0.3, 6, [&] {
      return confidence_change{some_robot(), some_time().from, static_cast<std::uint32_t>(uniform(engine_, 0, 3))};
    });
  }

  static constexpr instant begin_{1'000'000'000};
  instant calm_{};
  random_engine engine_;
  campaign_run run_;
};

}  // namespace detail

/// The run with this seed, which decides everything but the number of robots, if that is given.
/// @pre 2 ≤ robots ≤ max_robots
[[nodiscard]] inline campaign_run make_run(std::uint64_t seed, std::optional<std::size_t> robots = std::nullopt) {
  return detail::run_maker(seed).make(robots);
}

/// What became of one run.
struct run_report {
  sightings seen;
  std::optional<violation> broken;
};

/// Plays one run to its end, or to the first violation; `observe` sees every record as well.
template <class Monitor = conflict_monitor<names>, observer Observer>
[[nodiscard]] run_report play_run(playbook const& book, campaign_run const& run, Observer&& observe) {
  simulation<restless_world, Monitor> team(book, restless_world(run.robots, run.seed, run.world), run.team);
  invariant_watch watch(team, run.promised, run.team.faults);
  auto const both = [&](log_record const& r) {
    watch(r);
    observe(r);
  };
  for (instant t{}; t < run.end && !watch.broken();) {
    t = (std::min)(t + seconds(1), run.end);
    team.run(t, both);
  }
  return {watch.seen(), watch.broken()};
}
template <class Monitor = conflict_monitor<names>>
[[nodiscard]] run_report play_run(playbook const& book, campaign_run const& run) {
  return play_run<Monitor>(book, run, [](log_record const&) {});
}

/// A campaign: the runs with the seeds `seed`, `seed` + 1, …, until so many ticks or runs are played, or a promise is broken. A
/// tick is one deliberation of one robot.
struct campaign_options {
  std::uint64_t seed = 1;
  std::uint64_t ticks = 1'000'000;  ///< if `runs` is not given
  std::optional<std::uint64_t> runs;
  /// Holds teams to this greatest delay, whatever their radios do: to see a broken promise.
  std::optional<duration> delay;
  std::optional<std::size_t> robots;  ///< two to seven, as the seed says, if not given
};

/// What became of a campaign.
struct campaign_report {
  std::uint64_t runs = 0;
  sightings seen;
  std::uint64_t failed = 0;  ///< the seed of the run that broke a promise, if `broken`
  std::optional<violation> broken;
};

/// Equal options give equal reports. `next` is told before each run how many runs and ticks are played.
template <class Monitor = conflict_monitor<names>>
[[nodiscard]] campaign_report
run_campaign(campaign_options const& o, std::function<void(std::uint64_t runs, std::uint64_t ticks)> const& next = {}) {
  campaign_report all;
  playbook const book = campaign_playbook();
  while (!all.broken && (o.runs ? all.runs < *o.runs : all.seen.ticks < o.ticks)) {
    if (next) next(all.runs, all.seen.ticks);
    all.failed = o.seed + all.runs;
    auto run = make_run(all.failed, o.robots);
    if (o.delay) run.promised.delay = *o.delay;
    auto one = play_run<Monitor>(book, run);
    all.seen.add(one.seen);
    all.broken = std::move(one.broken);
    ++all.runs;
  }
  return all;
}

}  // namespace rota::sim
