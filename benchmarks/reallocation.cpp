// Additive allocation, warm: some rows of utilities change, and the optimum of the new ones is found from the last.
//
// `rows:10/1000x50`: ten of a thousand agents get other utilities, drawn as the first were; writing them counts. Every step
// ends with the same assignment as a search from nothing. `digits` are utilities from 0 to 9, where optima abound and the
// lexicographically smallest is sought; in `digits_keyed` ties are broken by keys beforehand, as `best_allocation` does.

#include "instances.hpp"
#include "ours.hpp"
#include "support.hpp"

#include <rota/search/ties.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace {

using instances::size;
using rota::dense::additive_end;
using rota::dense::row_index;

/// A team whose agents have two rows of utilities each, and changes from one to the other and back.
class changing_team {
public:
  /// @param both twice as many agents: the second rows follow the first
  changing_team(peers::additive_instance const& both, std::size_t changed, bool keyed)
      : agents_(both.agents / 2),
        slots_(both.slots()),
        both_(both.utility),
        now_(agents_ * slots_),
        bounds_(ours::bounds_of(both.bounds)),
        second_(agents_, 0) {
    if (keyed) break_ties();
    std::copy_n(both_.begin(), now_.size(), now_.begin());
    auto random = seeded();
    std::vector<row_index> all(agents_);
    for (std::size_t a = 0; a < agents_; ++a) all[a] = static_cast<row_index>(a);
    for (auto& step : steps_) {
      for (std::size_t i = 0; i < changed; ++i) std::swap(all[i], all[i + pick(random, agents_ - i)]);
      step.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(changed));
    }
  }

  [[nodiscard]] rota::dense::instance view() const {
    rota::dense::instance in{agents_, now_, bounds_};
    in.unique = unique_;
    return in;
  }

  /// The next change. @return the rows
  std::span<row_index const> change() {
    auto const& rows = steps_[next_++ % steps_.size()];
    for (auto const a : rows) {
      second_[a] ^= 1u;
      std::copy_n(both_.data() + (a + second_[a] * agents_) * slots_, slots_, now_.data() + a * slots_);
    }
    return rows;
  }

private:
  void break_ties() {
    auto const greatest = static_cast<std::uint64_t>(std::ranges::max(both_));
    rota::dense::tie_rule const ties(agents_, slots_, greatest);
    unique_ = ties.unique();
    for (std::size_t a = 0; a < 2 * agents_; ++a) {
      auto* const row = both_.data() + a * slots_;
      ties.keys(a % agents_, row, row);
    }
  }

  std::size_t agents_;
  std::size_t slots_;
  std::vector<std::int64_t> both_;
  std::vector<std::int64_t> now_;
  std::vector<rota::dense::slot_bounds> bounds_;
  bool unique_ = false;
  std::vector<std::size_t> second_;  // which row an agent has
  std::vector<std::vector<row_index>> steps_{64};
  std::size_t next_ = 0;
};

void warm(benchmark::State& state, peers::additive_instance const& both, std::size_t changed, bool keyed) {
  changing_team team(both, changed, keyed);
  rota::dense::additive_solver solver;
  rota::dense::additive_solver fresh;
  auto step = [&] { return solver.resolve(team.view(), team.change()).end; };
  auto is_cold = [&] {
    return fresh.solve(team.view()).end == additive_end::optimal &&
           std::ranges::equal(fresh.assignment(), solver.assignment());
  };
  solver.solve(team.view());
  for (int i = 0; i < 3; ++i) check(step() == additive_end::optimal && is_cold(), "warm is cold");
  for (auto _ : state) {
    auto end = step();
    benchmark::DoNotOptimize(end);
  }
  check(is_cold(), "warm is cold, in the end");
}

using make = std::function<peers::additive_instance(size twice, peers::cardinalities)>;

void add(std::string const& family, size s, std::initializer_list<std::size_t> changed, make const& f,
         bool keyed = false) {
  for (auto const rows : changed)
    benchmark::RegisterBenchmark(("reallocate/additive/" + family + "/rows:" + std::to_string(rows) + '/' +
                                  std::to_string(s.agents) + 'x' + std::to_string(s.tasks))
                                     .c_str(),
                                 [=](benchmark::State& state) {
                                   warm(state, f({2 * s.agents, s.tasks}, instances::congested_bounds(s)), rows, keyed);
                                 });
}

}  // namespace

int main(int argc, char** argv) {
  using namespace instances;
  auto const congested = [](size twice, cardinalities b) { return uniform(twice, std::move(b), 1); };
  auto const in_a_plane = [](size twice, cardinalities b) { return distances(twice, std::move(b), 1); };
  auto const of_digits = [](size twice, cardinalities b) { return digits(twice, std::move(b), 1); };
  for (auto const& [name, f] : {std::pair<char const*, make>{"congested", congested}, {"distances", in_a_plane}}) {
    add(name, {5, 3}, {1}, f);
    add(name, {50, 10}, {1, 5}, f);
    add(name, {1000, 50}, {1, 10, 100}, f);
    add(name, {10'000, 100}, {1, 100, 1000}, f);
  }
  add("digits", {1000, 50}, {1, 10}, of_digits);
  add("digits_keyed", {1000, 50}, {1, 10}, of_digits, true);
  add("congested", {100'000, 100}, {1000}, congested);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
