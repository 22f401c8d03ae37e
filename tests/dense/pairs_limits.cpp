// Whatever limit stops the pairwise solver, it leaves a valid assignment and a proven bound; and it reuses its memory.
#include "dense/pairs_world.hpp"
#include "support/allocation_counter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pairs_limits_test {

using namespace pairs_world;

TEST(pair_solver, any_budget_leaves_a_valid_assignment_and_a_bound) {
  int cases = 0, stopped = 0, better = 0;
  pair_solver s;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    s.effort = any_effort(d);
    problem const p = any_problem(d, 3000);
    optimum const best = enumerate(p);
    std::optional<std::int64_t> last;
    for (std::uint64_t budget = 0;; budget = budget * 2 + d.bits() % 3) {
      std::uint64_t const asked = d.chance(50) ? budget : 0;
      std::uint64_t polls = 0;
      auto const impatient = [&] { return ++polls > asked; };
      auto const got = s.solve(p.view(), {budget, impatient});
      ++cases;
      RC_ASSERT(accounted(s, p) == power(p.slots, p.agents));
      if (got.found()) {
        RC_ASSERT(value_of(p, chosen(got)) == got.value);
        RC_ASSERT(got.value <= got.bound);
        better += last && got.value > *last;
        last = got.value;
      } else {
        RC_ASSERT(got.assignment.empty());
      }
      if (best.value) RC_ASSERT(*best.value <= got.bound);
      if (got.found() && got.value == got.bound) RC_ASSERT(got.value == *best.value);
      std::uint64_t open = 0;
      for (auto const& t : s.account()) open += t.open;
      stopped += open > 0;
      if (got.proved()) {
        RC_ASSERT(open == 0u);
        RC_ASSERT(got.found() == best.value.has_value());
        if (got.found()) RC_ASSERT(chosen(got) == best.first);
      }
      if (got.proved() || budget > 100000) break;
    }
  }));
  EXPECT_GE(stopped * 100, cases * 20) << stopped << " of " << cases;
}

// Making bounds takes time, too: for twenty agents more than half a tick.
TEST(pair_solver, may_be_stopped_before_there_is_anything_to_search) {
  problem large = dense_problem(1, 20, 5);
  for (auto& b : large.bounds) b.upper = 5;
  pair_solver s;
  auto const now = [] { return true; };
  auto const at_once = s.solve(large.view(), {~std::uint64_t{0}, now});
  EXPECT_TRUE(at_once.found());
  EXPECT_LE(at_once.work.nodes, 5000u);

  problem const p = dense_problem(2, 14, 4);
  auto const best = s.solve(p.view());
  ASSERT_TRUE(best.proved());
  auto const chosen_then = chosen(best);
  int stopped = 0;
  for (int patience = 0; patience < 60; ++patience) {
    int polls = 0;
    auto const impatient = [&] { return ++polls > patience; };
    auto const got = s.solve(p.view(), {~std::uint64_t{0}, impatient});
    ASSERT_TRUE(got.found()) << patience;
    EXPECT_EQ(value_of(p, chosen(got)), got.value) << patience;
    EXPECT_LE(got.value, best.value) << patience;
    EXPECT_GE(got.bound, best.value) << patience;
    EXPECT_EQ(accounted(s, p), power(4, 14)) << patience;
    EXPECT_TRUE(!got.proved() || chosen(got) == chosen_then) << patience;
    stopped += !got.proved();
  }
  EXPECT_GE(stopped, 15);
}

TEST(pair_solver, sixty_four_agents_fit_and_stop_when_told) {
  problem const p = dense_problem(1, 64, 8);
  pair_solver s;
  auto const got = s.solve(p.view(), {20000, {}});
  EXPECT_TRUE(got.found());
  EXPECT_FALSE(got.proved());
  EXPECT_EQ(value_of(p, chosen(got)), got.value);
  EXPECT_LT(got.value, got.bound);
  EXPECT_EQ(accounted(s, p), power(8, 64));
}

TEST(pair_solver, a_steady_loop_allocates_nothing) {
  pair_solver s;
  problem const large = dense_problem(1, 11, 4);
  problem const small = dense_problem(2, 5, 3);
  problem tied = dense_problem(3, 8, 3);
  for (auto& u : tied.unary) u /= 1 << 18;
  for (auto& t : tied.tables)
    for (auto& w : t.worth) w /= 1 << 18;
  auto const views = {large.view(), small.view(), tied.view()};
  std::vector<std::int64_t> values;
  for (auto const& v : views) values.push_back(s.solve(v).value);
  auto const before = rota_test::allocation_count();
  for (int i = 0; i < 3; ++i) {
    std::size_t k = 0;
    for (auto const& v : views) ASSERT_EQ(s.solve(v).value, values[k++]);
  }
  EXPECT_EQ(rota_test::allocation_count() - before, 0u);
}

}  // namespace pairs_limits_test
