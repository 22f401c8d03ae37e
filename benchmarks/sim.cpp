// How much faster than real time a team plays: the scenario `hour` with five robots and the world, noise, messages and
// measurements that `rota reproduce` has. One iteration is one simulated minute, warm-up included.

#include "support.hpp"

#include <rota/sim/evaluation.hpp>

#include <cstdint>

namespace {

namespace sim = rota::sim;

sim::playbook four_tasks() {
  sim::plan_sketch sketch;
  sketch.id = {1};
  sketch.name = "Play";
  sketch.tasks = {{{1}, "Attack", {1, 1}, {1}},
                  {{2}, "Defend", {0, 2}, {2}},
                  {{3}, "Support", {0, 1}, {3}},
                  {{4}, "Goalkeeper", {1, 1}, {4}}};
  return *sim::make_playbook({1}, {sketch});
}

sim::play_options minute(std::size_t robots, std::uint64_t seed) {
  sim::play_options options;
  options.what = sim::scenario::hour;
  options.robots = robots;
  options.length = rota::seconds(60) - options.warm_up;
  options.team.seed = seed;
  return options;
}

std::uint64_t deliberations(sim::playbook const& book, sim::play_options const& options) {
  std::uint64_t count = 0;
  auto const measured =
      sim::play(book, options, [&](sim::log_record const& r) { count += r.what == sim::happening::deliberated; });
  benchmark::DoNotOptimize(measured);
  return count;
}

void simulated_minute(benchmark::State& state) {
  auto const book = four_tasks();
  auto const robots = static_cast<std::size_t>(state.range(0));
  auto const ticks = deliberations(book, minute(robots, 1));
  auto const due = robots * 60'000 / 30;
  check(ticks > due * 99 / 100 && ticks < due * 101 / 100, "a deliberation every 30 ms, give or take the drift");
  check(ticks == deliberations(book, minute(robots, 1)), "the same seed, the same minute");
  std::uint64_t seed = 0;
  std::uint64_t total = 0;
  for (auto _ : state) total += deliberations(book, minute(robots, ++seed));
  state.counters["agent_ticks"] = benchmark::Counter(static_cast<double>(total), benchmark::Counter::kIsRate);
  state.counters["times_real_time"] =
      benchmark::Counter(60.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

BENCHMARK(simulated_minute)->Name("simulate/minute")->ArgName("robots")->Arg(2)->Arg(5)->Arg(11);

}  // namespace
