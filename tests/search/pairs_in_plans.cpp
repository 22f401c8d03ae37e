#include "allocation/small_world.hpp"
#include "support/allocation_counter.hpp"

#include <rota/allocation/validate.hpp>
#include <rota/search/best_allocation.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace pairs_in_plans_test {

namespace {

using small_world::any_seed;
using small_world::between;
using small_world::dice;

using small_world::names;
using plan_t = rota::plan<names, rota::no_beliefs>;

/// A plan whose utility is a table of numbers drawn once. Some of them may be NaN.
struct drawn {
  int agents = 0;
  int tasks = 0;
  std::vector<double> alone;     // [agent, task]
  std::vector<double> together;  // [agent, task, agent, task]
  std::vector<rota::plan_task<names>> list;

  drawn(dice& d, int n, int m, int levels, int faults) : agents(n), tasks(m) {
    auto const size = static_cast<std::size_t>(n * m);
    for (std::size_t i = 0; i < size; ++i) alone.push_back(4.0 + 0.5 * d.below(levels));
    for (std::size_t i = 0; i < size * size; ++i)
      together.push_back(d.chance(faults) ? std::numeric_limits<double>::quiet_NaN()
                                          : 0.5 * (d.below(levels) - d.below(levels)));
    for (int t = 0; t < m; ++t) {
      auto const least = static_cast<std::uint32_t>(d.below(3));
      list.push_back({names::task(t), {least, least + static_cast<std::uint32_t>(d.below(n))}, {}});
    }
  }
  [[nodiscard]] std::size_t index(int a, int s, int b, int t) const {
    return static_cast<std::size_t>(((a * tasks + s) * agents + b) * tasks + t);
  }
  [[nodiscard]] double pair(int a, int s, int b, int t) const { return together[index(a, s, b, t)]; }
  double& of(rota::in<names> const& x, rota::in<names> const& y) {
    return together[index(static_cast<int>(x.agent), static_cast<int>(x.task), static_cast<int>(y.agent),
                          static_cast<int>(y.task))];
  }
  /// The plan. With a precondition, which always holds, it is searched as a tree; without one by the pairwise solver.
  [[nodiscard]] rota::plan_type<names> type(bool as_tree) const {
    rota::plan_description<names, rota::no_beliefs> d;
    d.tasks = list;
    d.utility = rota::pairwise_utility<names, rota::no_beliefs>{
        [this](names::agent a, names::task t, rota::no_beliefs) -> std::optional<double> {
          return alone[static_cast<std::size_t>(static_cast<int>(a) * tasks + static_cast<int>(t))];
        },
        [this](names::agent a, names::task s, names::agent b, names::task t, rota::no_beliefs) {
          return pair(static_cast<int>(a), static_cast<int>(s), static_cast<int>(b), static_cast<int>(t));
        }};
    if (as_tree) d.precondition = [](rota::no_beliefs, rota::allocation_view<names>) { return true; };
    return rota::plan_type<names>::make({}, {plan_t::make(std::move(d)).value()}).value();
  }
};

rota::team<names> team_of(int n) {
  rota::team<names> t;
  for (int a = 0; a < n; ++a) t.add(names::agent(a));
  return t;
}

// At most 6^7 allocations each.
TEST(pairwise_plans, solver_and_tree_agree) {
  rota::workspace work;
  int found = 0;
  int faulty = 0;
  int cases = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    int const n = *between(4, 7).as("agents");
    int const m = *between(2, 4).as("tasks");
    drawn const world(d, n, m, 1 + d.below(6), d.chance(50) ? 0 : 1 + d.below(30));
    auto const pairs = world.type(false);
    auto const tree = world.type(true);
    auto const members = team_of(n);
    rota::problem ask{pairs, members};
    rota::problem ask_tree{tree, members};
    if (d.chance(30)) ask.idle = ask_tree.idle = rota::idling::forbidden;
    rota::search_budget enough;
    enough.nodes = ~std::uint64_t{0};
    auto const one = best_allocation(ask, work, enough);
    auto const other = best_allocation(ask_tree, work, enough);
    ++cases;
    RC_ASSERT(one.has_value() == other.has_value());
    if (!one) {
      RC_ASSERT(one.error().proved() && other.error().proved());
      return;
    }
    ++found;
    faulty += one->ignored.has_value();
    RC_ASSERT(one->proved && other->proved);
    RC_ASSERT(one->objective == other->objective);
    RC_ASSERT(one->atoms == other->atoms);
    RC_ASSERT(one->ignored == other->ignored);
    RC_ASSERT(validate(ask, pairs.plans()[0], one->atoms, rota::plan_phase::entering).valid());
  }));
  EXPECT_GE(found * 100, cases * 40) << found << "/" << cases;
  EXPECT_GE(faulty * 100, cases * 10) << faulty << "/" << cases;
}

TEST(pairwise_plans, a_team_of_fourteen_is_proved_within_the_usual_budget) {
  dice d(3);
  drawn const world(d, 14, 4, 9, 0);
  auto const type = world.type(false);
  auto const members = team_of(14);
  rota::workspace work;
  auto const found = best_allocation(rota::problem{type, members}, work);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->proved);
  EXPECT_EQ(found->gap, 0);
}

TEST(pairwise_plans, any_budget_leaves_a_valid_allocation_and_a_gap) {
  int short_of_it = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    drawn const world(d, 9, 3, 6, d.chance(50) ? 0 : 3);
    auto const type = world.type(false);
    auto const members = team_of(9);
    rota::problem const ask{type, members};
    rota::workspace work;
    rota::workspace spent;
    rota::search_budget little;
    little.nodes = static_cast<std::uint64_t>(*between(0, 3000).as("nodes"));
    auto const some = best_allocation(ask, spent, little);
    auto const best = best_allocation(ask, work);
    if (!best) {
      RC_ASSERT(!some);
      return;
    }
    RC_ASSERT(best->proved);
    if (!some) {
      RC_ASSERT(!some.error().proved());
      return;
    }
    short_of_it += !some->proved;
    RC_ASSERT(validate(ask, type.plans()[0], some->atoms, rota::plan_phase::entering).valid());
    RC_ASSERT(some->utility <= best->utility && some->utility + some->gap >= best->utility);
    RC_ASSERT(!some->proved || some->atoms == best->atoms);
    // With enough budget the used workspace finds the same as a fresh one.
    auto again = best_allocation(ask, spent);
    RC_ASSERT(again && again->atoms == best->atoms && again->proved);
  }));
  EXPECT_GE(short_of_it, 100);
}

TEST(pairwise_plans, what_has_not_changed_is_not_searched_again_and_allocates_nothing) {
  dice d(5);
  drawn world(d, 8, 3, 9, 0);
  auto const type = world.type(false);
  auto const members = team_of(8);
  rota::problem const ask{type, members};
  rota::workspace work;
  auto const first = best_allocation(ask, work);
  ASSERT_TRUE(first);
  EXPECT_GT(first->work.nodes, 0u);
  auto const before = rota_test::allocation_count();
  auto const second = best_allocation(ask, work);
  EXPECT_EQ(rota_test::allocation_count(), before);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->work.nodes, 0u);
  EXPECT_EQ(second->atoms, first->atoms);
  auto now = *first;
  int moved = 0;
  // Each round changes one number: of two agents in their current tasks, or of any agent alone.
  for (int round = 0; round < 50; ++round) {
    if (round % 2 == 0) {
      auto const atoms = now.atoms.atoms();
      ASSERT_GE(atoms.size(), 2u);
      auto const j = 1 + d.bits() % (atoms.size() - 1);
      auto const& one = atoms[d.bits() % j];
      auto const& other = atoms[j];
      world.of(one, other) = -0.5 * (1 + d.below(20));
    } else {
      world.alone[d.bits() % world.alone.size()] = 0.5 * d.below(20);
    }
    auto const allocated = rota_test::allocation_count();
    auto const warm = best_allocation(ask, work);
    EXPECT_EQ(rota_test::allocation_count(), allocated) << round;
    rota::workspace fresh;
    auto const cold = best_allocation(ask, fresh);
    ASSERT_TRUE(warm && cold);
    EXPECT_EQ(warm->atoms, cold->atoms) << round;
    EXPECT_EQ(warm->exact, cold->exact) << round;
    moved += warm->atoms != now.atoms;
    now = *warm;
  }
  EXPECT_GE(moved, 10);
}

TEST(pairwise_plans, what_is_no_utility_names_both_agents) {
  dice d(7);
  drawn world(d, 2, 1, 1, 0);
  world.list[0] = {names::task(0), {2, 2}, {}};
  world.together[1] = std::numeric_limits<double>::infinity();
  auto const members = team_of(2);
  rota::workspace work;
  for (bool as_tree : {false, true}) {
    auto const type = world.type(as_tree);
    auto const none = best_allocation(rota::problem{type, members}, work);
    ASSERT_FALSE(none);
    ASSERT_EQ(none.error().plans.size(), 1u);
    EXPECT_EQ(none.error().plans[0].reason, rota::no_plan_reason::utility_refused);
    EXPECT_EQ(none.error().plans[0].fault, rota::utility_fault::positive_infinity);
  }
  world.list[0] = {names::task(0), {0, 2}, {}};
  for (bool as_tree : {false, true}) {
    auto const type = world.type(as_tree);
    auto const found = best_allocation(rota::problem{type, members}, work);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->atoms.size(), 1u);
    ASSERT_TRUE(found->ignored && found->ignored->atom && found->ignored->other);
    EXPECT_EQ(found->ignored->reason, rota::utility_fault::positive_infinity);
    EXPECT_EQ(found->ignored->atom->agent, names::agent(0));
    EXPECT_EQ(found->ignored->other->agent, names::agent(1));
  }
}

// With too many agents for tables, or numbers too great for the pairwise solver, branch and bound takes over.
TEST(pairwise_plans, beyond_the_limits_of_the_pairwise_solver) {
  dice d(11);
  rota::workspace work;
  drawn const crowd(d, 65, 2, 3, 0);
  auto const type = crowd.type(false);
  auto const members = team_of(65);
  rota::problem const ask{type, members};
  rota::search_budget little;
  little.nodes = 10000;
  auto const found = best_allocation(ask, work, little);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->proved);
  EXPECT_TRUE(validate(ask, type.plans()[0], found->atoms, rota::plan_phase::entering).valid());

  drawn great(d, 3, 2, 1, 0);
  great.list = {{names::task(0), {0, 3}, {}}, {names::task(1), {0, 3}, {}}};
  for (auto& w : great.together) w = rota::max_utility;
  great.together[0 * 6 + 2] = -rota::max_utility;  // agents 0 and 1, both on task 0
  auto const of_great = great.type(false);
  auto const few = team_of(3);
  auto const best = best_allocation(rota::problem{of_great, few}, work);
  ASSERT_TRUE(best);
  EXPECT_TRUE(best->proved);
  EXPECT_EQ(best->utility, 3 * rota::max_utility + 12);
  EXPECT_EQ(best->atoms.atoms()[1].task, names::task(1)) << "the first two apart, the lexicographically first so";

  // Sums so great that a forbidden combination would look like a gain to the pairwise solver.
  drawn alone(d, 3, 1, 1, 0);
  alone.list = {{names::task(0), {3, 3}, {}}};
  for (auto& u : alone.alone) u = rota::max_utility;
  for (auto& w : alone.together) w = 0;
  auto const of_alone = alone.type(false);
  rota::problem const all_three{of_alone, few};
  auto const possible = best_allocation(all_three, work);
  ASSERT_TRUE(possible);
  EXPECT_EQ(possible->utility, 3 * rota::max_utility);
  alone.together[alone.index(0, 0, 1, 0)] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(best_allocation(all_three, work));
}

}  // namespace

}  // namespace pairs_in_plans_test
