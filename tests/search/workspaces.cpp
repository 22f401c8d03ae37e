// A workspace remembers, but may be copied, moved and thrown away at any time.
#include "allocation/small_world.hpp"

#include <rota/search/reallocate.hpp>

#include <gtest/gtest.h>

#include <type_traits>
#include <utility>
#include <vector>

namespace workspaces_test {

namespace {

using namespace small_world;

// Couplings are spans into tables beside them, and outcomes into solvers.
static_assert(!std::is_copy_constructible_v<rota::detail::pair_tables>);
static_assert(!std::is_move_constructible_v<rota::detail::pair_tables>);
static_assert(!std::is_copy_constructible_v<rota::detail::plan_memory>);
static_assert(!std::is_move_constructible_v<rota::detail::plan_memory>);
static_assert(std::is_nothrow_move_constructible_v<rota::workspace>);
static_assert(std::is_nothrow_move_assignable_v<rota::workspace>);

/// A type with a plan for each kind of solver: flow, pairs, branch and bound.
struct world {
  raw_problem raw;
  world() {
    raw.members = raw.participants = {0, 1, 2, 3, 4};
    raw_plan p;
    p.tasks = {{0, 1, 2}, {1, 0, 2}, {2, 0, 3}};
    dice d(7);
    for (auto& row : p.u)
      for (auto& u : row) u = d.below(10);
    raw.plans = {p, p, p};
    raw.plans[1].sum = raw_sum{};
    raw.plans[1].sum->pairs = 1;
    raw.plans[2].general = true;
    for (int i = 0; i < 3; ++i) raw.plans[static_cast<std::size_t>(i)].id = i + 1;
  }
};

/// What a fresh workspace says of it, for comparison; `work` depends on history, so it is left out.
template <class Problem>
auto solved(Problem const& problem, rota::workspace& work) {
  auto found = best_allocation(problem, work).value();
  found.work = {};
  return found;
}

TEST(workspace, is_usable_as_it_was_after_it_is_copied_or_moved) {
  world w;
  built const b(w.raw);
  rota::problem const problem{b.type, b.team, b.beliefs};
  rota::workspace used;
  auto const expected = solved(problem, used);
  ASSERT_TRUE(expected.proved);
  ASSERT_TRUE(expected.runner_up);

  rota::workspace copy(used);
  EXPECT_EQ(solved(problem, copy), expected);
  EXPECT_EQ(solved(problem, used), expected);
  rota::workspace moved(std::move(used));
  EXPECT_EQ(solved(problem, moved), expected);
  EXPECT_EQ(solved(problem, used), expected) << "what was moved from begins anew";
  rota::workspace assigned;
  (void)solved(problem, assigned);
  assigned = moved;
  EXPECT_EQ(solved(problem, assigned), expected);
  assigned = std::move(moved);
  EXPECT_EQ(solved(problem, assigned), expected);
  EXPECT_EQ(solved(problem, moved), expected);
  auto& same = assigned;
  assigned = same;
  EXPECT_EQ(solved(problem, assigned), expected);

  std::vector<rota::workspace> many(1);
  EXPECT_EQ(solved(problem, many[0]), expected);
  many.resize(20);
  for (auto& x : many) EXPECT_EQ(solved(problem, x), expected);
}

TEST(workspace, copied_in_the_middle_of_a_loop_changes_nothing) {
  world w;
  dice d(11);
  rota::workspace work;
  for (int tick = 0; tick < 60; ++tick) {
    auto& plan = w.raw.plans[d.bits() % 3];
    plan.u[d.bits() % 5][d.bits() % 3] = d.below(10);
    built const b(w.raw);
    rota::problem const problem{b.type, b.team, b.beliefs};
    rota::workspace fresh;
    EXPECT_EQ(solved(problem, work), solved(problem, fresh)) << tick;
    if (tick % 3 == 0) work = rota::workspace(work);
    if (tick % 5 == 0) {
      rota::workspace const kept = std::move(work);
      work = kept;
    }
  }
}

// The memory of the plans of a small type stays valid while that of a greater one is added.
TEST(workspace, serves_plan_types_of_any_size_in_turn) {
  world w;
  built const all(w.raw);
  auto one = w.raw;
  one.plans.resize(1);
  built const some(one);
  rota::problem const large{all.type, all.team, all.beliefs};
  rota::problem const small{some.type, some.team, some.beliefs};
  rota::workspace work;
  for (int i = 0; i < 3; ++i) {
    rota::workspace fresh;
    rota::workspace another;
    EXPECT_EQ(solved(small, work), solved(small, fresh));
    EXPECT_EQ(solved(large, work), solved(large, another));
  }
}

TEST(workspace, a_moved_one_still_remembers) {
  world w;
  built const b(w.raw);
  rota::problem const problem{b.type, b.team, b.beliefs};
  rota::workspace used;
  (void)solved(problem, used);
  rota::workspace moved(std::move(used));
  auto const again = best_allocation(problem, moved);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->work.relaxations, 0u) << "the flow is not searched again";
}

}  // namespace

}  // namespace workspaces_test
