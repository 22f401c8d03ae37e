// Additive allocation, warm: some rows of utilities change, and the optimum of the new ones is found from the last.
//
// `rows:10/1000x50`: ten of a thousand agents get other utilities, drawn as the first were. As in `best_allocation`, ties are
// broken by keys, and making those of the changed rows counts. Where it says `ties:sought` there are no keys: the
// lexicographically smallest optimum is sought among all. Every step ends with the same assignment as a search from nothing.

#include "instances.hpp"
#include "ours.hpp"
#include "support.hpp"

#include <rota/dense/ties.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace {

using instances::size;
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
    if (keyed) ties_.emplace(agents_, slots_, static_cast<std::uint64_t>(std::ranges::max(both_)));
    auto random = seeded();
    std::vector<row_index> all(agents_);
    for (std::size_t a = 0; a < agents_; ++a) {
      all[a] = static_cast<row_index>(a);
      write(a);
    }
    for (auto& step : steps_) {
      for (std::size_t i = 0; i < changed; ++i) std::swap(all[i], all[i + pick(random, agents_ - i)]);
      step.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(changed));
    }
  }

  [[nodiscard]] rota::dense::instance view() const {
    rota::dense::instance in{agents_, now_, bounds_};
    in.unique = ties_ && ties_->unique();
    return in;
  }

  /// The next change. @return the rows
  std::span<row_index const> change() {
    auto const& rows = steps_[next_++ % steps_.size()];
    for (auto const a : rows) {
      second_[a] ^= 1u;
      write(a);
    }
    return rows;
  }

private:
  void write(std::size_t a) {
    auto const* const from = both_.data() + (a + second_[a] * agents_) * slots_;
    auto* const to = now_.data() + a * slots_;
    ties_ ? ties_->keys(a, from, to) : void(std::copy_n(from, slots_, to));
  }

  std::size_t agents_;
  std::size_t slots_;
  std::vector<std::int64_t> both_;
  std::vector<std::int64_t> now_;
  std::vector<rota::dense::slot_bounds> bounds_;
  std::optional<rota::dense::tie_rule> ties_;
  std::vector<std::size_t> second_;  // which row an agent has
  std::vector<std::vector<row_index>> steps_{64};
  std::size_t next_ = 0;
};

void warm(benchmark::State& state, peers::additive_instance const& both, std::size_t changed, bool keyed) {
  changing_team team(both, changed, keyed);
  rota::dense::flow_solver solver;
  rota::dense::flow_solver fresh;
  auto step = [&] { return solver.resolve(team.view(), team.change()); };
  auto is_cold = [&](rota::dense::outcome const& found) {
    auto const cold = fresh.solve(team.view());
    return found.proved() && cold.proved() && std::ranges::equal(cold.assignment, found.assignment);
  };
  solver.solve(team.view());
  for (int i = 0; i < 3; ++i) check(is_cold(step()), "warm is cold");
  for (auto _ : state) {
    auto end = step().status;
    benchmark::DoNotOptimize(end);
  }
  check(is_cold(step()), "warm is cold, in the end");
}

using make = std::function<peers::additive_instance(size twice, peers::cardinalities)>;

void add(std::string const& family, size s, std::initializer_list<std::size_t> changed, make const& f,
         bool keyed = true) {
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
  add("digits/ties:sought", {1000, 50}, {1, 10}, of_digits, false);
  add("congested/ties:sought", {10'000, 100}, {1}, congested, false);
  add("congested", {100'000, 100}, {1000}, congested);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
