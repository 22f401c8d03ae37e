// Runs: every bracketing of up to six events.

#include "theory/every_case.hpp"

#include <rota/algebra/apply.hpp>
#include <rota/algebra/runs.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace runs_theory {
namespace {

using namespace theory;

std::vector<event> bracketings(std::vector<event> const& run, std::size_t first, std::size_t last) {
  if (last - first == 1) return {run[first]};
  std::vector<event> all;
  for (auto cut = first + 1; cut < last; ++cut)
    for (auto const& left : bracketings(run, first, cut))
      for (auto const& right : bracketings(run, cut, last)) all.push_back(compose(left, right));
  return all;
}
/// Sequences of events over these atoms.
std::vector<std::vector<event>> sequences(std::vector<std::size_t> const& atoms, std::size_t length) {
  std::vector<std::vector<event>> all{{}};
  for (std::size_t i = 0; i < length; ++i) {
    std::vector<std::vector<event>> longer;
    for (auto const& run : all)
      for (auto const& e : events(atoms)) {
        longer.push_back(run);
        longer.back().push_back(e);
      }
    all = std::move(longer);
  }
  return all;
}
bool applicable_from_somewhere(std::vector<event> const& run, std::vector<atom_set> const& sets) {
  return std::any_of(sets.begin(), sets.end(), [&](atom_set c) {
    for (auto const& e : run) {
      auto next = apply(e, c);
      if (!next) return false;
      c = *std::move(next);
    }
    return true;
  });
}
TEST(run, of_length_six_is_one_event_in_every_bracketing) {
  law iff("compose_run accepts what is consecutively applicable from somewhere, and nothing else");
  law one_event("every bracketing of a run is compose_run, and the sum of its deltas");
  auto const check = [&](std::vector<std::size_t> const& atoms, std::size_t length) {
    std::vector<atom_set> sets;
    for (auto const& members : functions(atoms, 0, 1)) {
      sets.emplace_back();
      for (auto const& [x, n] : members) sets.back().insert(x);
    }
    for (auto const& run : sequences(atoms, length)) {
      auto const composed = rota::compose_run<atom>(run);
      bool const is_run = applicable_from_somewhere(run, sets);
      iff(composed.has_value() == is_run);
      if (!is_run || !composed) continue;
      std::vector<delta> summands;
      for (auto const& e : run) summands.emplace_back(e);
      auto const total = rota::sum<atom, std::int64_t>(summands);
      for (auto const& bracketing : bracketings(run, 0, run.size()))
        one_event(bracketing == *composed && delta(bracketing) == total);
    }
  };
  for (std::size_t length = 1; length <= 6; ++length) check({5}, length);
  for (std::size_t length = 1; length <= 3; ++length) check({5, 8}, length);
}
TEST(run, refusal_names_the_atom_and_both_events) {
  auto const s = event::addition(nth(3));
  auto const other = event::addition(nth(1));
  EXPECT_EQ(rota::compose_run<atom>(std::vector{s, other, s}).error(), (rota::no_run<atom>{nth(3), 0, 2}));
  EXPECT_EQ(rota::compose_run<atom>(std::vector<event>{}).value(), event{});
}

}  // namespace
}  // namespace runs_theory
