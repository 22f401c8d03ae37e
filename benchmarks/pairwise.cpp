// Pairwise utilities, besides the rows that compare rota with peers: how many instances are proved within one tick, and how
// much symmetry saves.
//
// `proved` counts the seeds whose optimum is proved within 30 ms by the clock; `nodes` are placements tried per instance.

#include "instances.hpp"
#include "ours.hpp"
#include "support.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using instances::size;
using clock_type = std::chrono::steady_clock;

/// An instance that owns its numbers.
struct problem {
  peers::pairwise_instance numbers;
  std::vector<rota::dense::slot_bounds> bounds = ours::bounds_of(numbers.bounds);
  std::vector<rota::dense::coupling> couplings = ours::couplings_of(numbers);

  rota::dense::pair_instance view() const { return {numbers.agents, numbers.unary, couplings, bounds}; }
};

using make = peers::pairwise_instance (*)(size, std::uint64_t);

void count(benchmark::State& state, double proved, double nodes) {
  state.counters["proved"] = proved;
  state.counters["nodes"] = nodes;
}

void within_a_tick(benchmark::State& state, size s, make family) {
  constexpr std::uint64_t seeds = 30;
  rota::dense::pair_solver solver;
  double proved = 0;
  double nodes = 0;
  for (auto _ : state) {
    proved = nodes = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      state.PauseTiming();
      problem const p{family(s, seed)};
      state.ResumeTiming();
      auto const end = clock_type::now() + std::chrono::milliseconds{30};
      auto const late = [end] { return clock_type::now() >= end; };
      auto const out = solver.solve(p.view(), {~std::uint64_t{0}, late});
      check(out.found() && out.value <= out.bound, "a valid assignment and a bound");
      proved += out.proved() && clock_type::now() <= end ? 1 : 0;
      nodes += static_cast<double>(out.work.nodes) / static_cast<double>(seeds);
    }
  }
  count(state, proved, nodes);
}

void one_class(benchmark::State& state, size s, bool symmetry) {
  rota::dense::pair_solver solver;
  solver.effort.symmetry = symmetry;
  std::vector<problem> all;
  double nodes = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    all.push_back({instances::pairwise_one_class(s, seed)});
    auto const out = solver.solve(all.back().view());
    check(out.proved(), "the optimum");
    rota::dense::pair_solver other;
    other.effort.symmetry = !symmetry;
    check(other.solve(all.back().view()).value == out.value, "the same with and without symmetry");
    nodes += static_cast<double>(out.work.nodes) / 4;
  }
  rotate(state, all, [&](problem const& p) { return solver.solve(p.view()).value; });
  count(state, 0, nodes);
}

void add(std::string const& family, make f) {
  for (size const s : {size{15, 5}, size{20, 5}})
    benchmark::RegisterBenchmark(
        ("allocate/pairwise/" + family + "/seeds:30/" + std::to_string(s.agents) + 'x' + std::to_string(s.tasks))
            .c_str(),
        [s, f](benchmark::State& state) { within_a_tick(state, s, f); })
        ->Iterations(1);
}

}  // namespace

int main(int argc, char** argv) {
  add("uniform", instances::pairwise_uniform);
  add("distances", instances::pairwise_distances);
  for (bool const symmetry : {true, false})
    benchmark::RegisterBenchmark(symmetry ? "allocate/pairwise/one_class/10x5"
                                          : "allocate/pairwise/one_class/symmetry:off/10x5",
                                 [symmetry](benchmark::State& state) { one_class(state, {10, 5}, symmetry); });
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
