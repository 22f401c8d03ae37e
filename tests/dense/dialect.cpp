// The three solvers speak one dialect: the same question has the same answer, in the same words. Includes dense/ only.
#include "dense/dense_world.hpp"
#include "dense/owned_instance.hpp"

#include <rota/dense/flow/solver.hpp>
#include <rota/dense/pairs/solver.hpp>
#include <rota/dense/tree/solver.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace dialect_test {

using namespace dense_world;
using rota::dense::flow_solver;
using rota::dense::instance;
using rota::dense::outcome;
using rota::dense::pair_solver;
using rota::dense::slot;
using rota::dense::status;
using rota::dense::tree_solver;
using rota::dense::work_limit;

/// The utility of an instance as the value of a tree search: what it is worth, and no bound.
struct sums final : rota::dense::tree_oracle {
  std::optional<std::int64_t> leaf(std::span<slot const>, std::int64_t sum, std::optional<std::int64_t>) override {
    return sum;
  }
  std::int64_t bound(std::span<slot const>, std::int64_t) override { return rota::dense::no_bound; }
  bool hopeless(std::span<slot const>) override { return false; }
};

outcome ask(flow_solver& s, instance const& in, work_limit const& limit = {}) { return s.solve(in, limit); }
outcome ask(tree_solver& s, instance const& in, work_limit const& limit = {}) {
  sums oracle;
  return s.solve(in, oracle, {.limit = limit});
}
outcome ask(pair_solver& s, instance const& in, work_limit const& limit = {}) {
  return s.solve({in.agents, in.utility, {}, in.bounds}, limit);
}

/// What every outcome promises, see `outcome`.
void check_promises(outcome const& got, std::size_t agents) {
  RC_ASSERT(got.found() == (got.status == status::optimal || got.status == status::feasible));
  RC_ASSERT(got.assignment.size() == (got.found() ? agents : 0));
  RC_ASSERT(got.found() || got.value == 0);
  RC_ASSERT(!got.found() || got.value <= got.bound);
  RC_ASSERT(got.status != status::optimal || got.value == got.bound);
  RC_ASSERT((got.bound == rota::dense::no_value) == (got.status == status::infeasible));
}

struct shares {
  int found = 0, infeasible = 0, cut_short = 0;
};

template <class Solver>
void agree(Solver& solver, problem const& p, std::optional<optimum> const& expected, dice& d, shares& s) {
  owned_instance const in(p);
  instance view = in.view();
  view.taking_part = {};
  auto const got = ask(solver, view);
  check_promises(got, p.agents);
  RC_ASSERT(got.status == (expected ? status::optimal : status::infeasible));
  if (expected) RC_ASSERT(got.value == expected->total && slots_of(got) == expected->slot);
  ++(expected ? s.found : s.infeasible);
  auto const some = ask(solver, view, {static_cast<std::uint64_t>(d.below(20)), {}});
  check_promises(some, p.agents);
  if (expected) RC_ASSERT(some.bound >= expected->total);
  if (!expected) RC_ASSERT(!some.found());
  s.cut_short += !some.proved();
}

TEST(dialect, of_three_solvers_is_one) {
  flow_solver flow;
  tree_solver tree;
  pair_solver pairs;
  shares by_flow, by_tree, by_pairs;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    auto p = random_problem(d, {.agents = 5, .slots = 4, .levels = 4});
    p.part.assign(p.agents, 1);
    auto const expected = enumerate(p);
    agree(flow, p, expected, d, by_flow);
    agree(tree, p, expected, d, by_tree);
    agree(pairs, p, expected, d, by_pairs);
  }));
  for (auto const& s : {by_flow, by_tree, by_pairs}) {
    EXPECT_GE(s.found, 300);
    EXPECT_GE(s.infeasible, 100);
  }
  EXPECT_GE(by_tree.cut_short, 100);
}

// What outcomes show lies in the solver: a move must not lose it, and a copy must not share it.
template <class Solver>
void check_copies() {
  std::vector<std::int64_t> const one{5, 1, 1, 5}, other{1, 5, 5, 1};
  std::vector<rota::dense::slot_bounds> const bounds(2, {1, 1});
  std::vector<int> const straight{0, 1}, crossed{1, 0};

  Solver first;
  auto const before = ask(first, {2, one, bounds});
  Solver second = first;
  EXPECT_EQ(slots_of(ask(second, {2, other, bounds})), crossed);
  EXPECT_EQ(slots_of(before), straight) << "a copy overwrites what its original showed";
  Solver third = std::move(first);
  EXPECT_EQ(slots_of(before), straight) << "moved with the solver";
  EXPECT_EQ(slots_of(ask(first, {2, other, bounds})), crossed) << "a solver that was moved from is as good as new";
  EXPECT_EQ(slots_of(before), straight) << "and shares nothing with where it was moved";
  second = third;
  EXPECT_EQ(slots_of(ask(second, {2, one, bounds})), straight);
  second = std::move(third);
  EXPECT_EQ(slots_of(before), straight);
  auto& self = second;
  second = self;
  EXPECT_EQ(slots_of(before), straight) << "assigned to itself";
}

TEST(dialect, a_copy_shares_nothing_and_a_move_loses_nothing) {
  check_copies<flow_solver>();
  check_copies<tree_solver>();
  check_copies<pair_solver>();
}

TEST(dialect, a_copied_flow_solver_begins_anew) {
  std::vector<std::int64_t> const utility{5, 1, 1, 5};
  std::vector<rota::dense::slot_bounds> const bounds(2, {1, 1});
  flow_solver first;
  EXPECT_TRUE(first.prices().empty());
  (void)first.solve({2, utility, bounds});
  EXPECT_EQ(first.prices().size(), 3u);
  flow_solver second = first;
  EXPECT_TRUE(second.prices().empty());
  EXPECT_FALSE(second.resolve({2, utility, bounds}, {}).warm);
  EXPECT_TRUE(first.resolve({2, utility, bounds}, {}).warm);
  EXPECT_EQ(first.most(std::span{utility}.first(2)), std::max(5 - first.prices()[0], 1 - first.prices()[1]));
}

}  // namespace dialect_test
