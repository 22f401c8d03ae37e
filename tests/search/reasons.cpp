#include "allocation/small_world.hpp"
#include "support/allocation_counter.hpp"

#include <rota/search/best_allocation.hpp>
#include <rota/search/print.hpp>
#include <rota/search/reallocate.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace reasons_test {

namespace {

using namespace small_world;
using reason = rota::no_plan_reason;

/// Solves a plan with the given tasks for agents 0..n−1; a test may change the data first.
struct fixture {
  raw_problem raw;
  rota::workspace work;
  fixture(int agents, std::vector<raw_task> tasks) {
    for (int a = 0; a < agents; ++a) raw.members.push_back(a);
    raw.participants = raw.members;
    raw_plan p;
    p.id = 1;
    p.tasks = std::move(tasks);
    for (auto& row : p.u) row.fill(1.0);
    raw.plans = {p};
  }
  raw_plan& plan() { return raw.plans[0]; }
  std::optional<double>& u(std::size_t a, std::size_t t) { return plan().u[a][t]; }
  auto solve(rota::search_budget budget = {}) {
    built const b(raw);
    return best_allocation(rota::problem{b.type, b.team, b.beliefs, b.participants,
                                         raw.idle ? rota::idling::allowed : rota::idling::forbidden},
                           work, budget);
  }
  rota::plan_refusal<names> refusal(rota::search_budget budget = {}) {
    auto const r = solve(budget);
    EXPECT_FALSE(r.has_value());
    if (r) return {};
    EXPECT_EQ(r.error().plans.size(), 1u);
    EXPECT_FALSE(rota::describe(r.error().plans[0]).empty());
    return r.error().plans[0];
  }
};

TEST(no_allocation, cardinalities_that_contradict_the_team_size) {
  fixture f(5, {{0, 2, 2}, {1, 2, 3}});
  f.plan().team_max = 3;
  auto const r = f.refusal();
  EXPECT_EQ(r.reason, reason::contradictory_cardinalities);
  EXPECT_EQ(r.count, 4u);
  f.plan().team_max = unlimited;
  f.plan().team_min = 6;
  EXPECT_EQ(f.refusal().reason, reason::contradictory_cardinalities);
  EXPECT_EQ(f.refusal().count, 5u);
}

TEST(no_allocation, too_few_and_too_many_agents) {
  fixture f(3, {{0, 2, 2}, {1, 2, 2}});
  EXPECT_EQ(f.refusal().reason, reason::too_few_agents);
  EXPECT_EQ(f.refusal().count, 3u);
  EXPECT_EQ(f.refusal().bounds.lower(), 4u);
  fixture g(5, {{0, 0, 2}, {1, 0, 2}});
  EXPECT_TRUE(g.solve());
  g.raw.idle = false;
  EXPECT_EQ(g.refusal().reason, reason::too_many_agents);
  EXPECT_EQ(g.refusal().bounds.upper(), 4u);
}

TEST(no_allocation, forbidden_pairs) {
  fixture f(3, {{0, 0, 3}, {1, 2, 2}});
  f.u(0, 1).reset();
  f.raw.forbidden[2][1] = true;
  auto const r = f.refusal();
  EXPECT_EQ(r.reason, reason::task_short);
  EXPECT_EQ(r.task, names::task(1));
  EXPECT_EQ(r.count, 1u);

  fixture g(3, {{0, 0, 3}});
  g.raw.idle = false;
  g.u(1, 0).reset();
  EXPECT_EQ(g.refusal().reason, reason::agent_without_task);
  EXPECT_EQ(g.refusal().agent, names::agent(1));

  // Hall's condition fails: agents 0 and 1 may do task 0 only, which takes one.
  fixture h(3, {{0, 0, 1}, {1, 0, 2}});
  h.raw.idle = false;
  h.u(0, 1).reset();
  h.u(1, 1).reset();
  EXPECT_EQ(h.refusal().reason, reason::pairs_contradict);
  // And its mirror image: tasks 0 and 1 both need agent 0.
  fixture k(3, {{0, 1, 1}, {1, 1, 1}, {2, 0, 3}});
  for (std::size_t a : {1u, 2u}) k.u(a, 0).reset(), k.u(a, 1).reset();
  EXPECT_EQ(k.refusal().reason, reason::pairs_contradict);
}

TEST(no_allocation, a_precondition_that_never_holds_and_negative_utility) {
  fixture f(3, {{0, 1, 3}});
  f.plan().pre = truth::never;
  EXPECT_EQ(f.refusal().reason, reason::precondition_never_holds);
  fixture g(3, {{0, 2, 3}});
  for (std::size_t a = 0; a < 3; ++a) g.u(a, 0) = -1.0 - static_cast<double>(a);
  EXPECT_EQ(g.refusal().reason, reason::negative_utility);
  EXPECT_EQ(g.refusal().value, -3.0);
}

TEST(no_allocation, a_budget_that_is_spent_is_no_proof) {
  fixture f(6, {{0, 1, 3}, {1, 1, 3}});
  f.plan().pre = truth::never;
  EXPECT_EQ(f.refusal({5}).reason, reason::search_incomplete);
  built const b(f.raw);
  EXPECT_FALSE(best_allocation(rota::problem{b.type, b.team, b.beliefs}, f.work, {5}).error().proved());
  EXPECT_EQ(f.refusal({0}).reason, reason::search_incomplete);
}

TEST(no_allocation, what_is_no_utility_is_named) {
  fixture f(2, {{0, 2, 2}});
  f.u(1, 0) = std::nan("");
  auto const r = f.refusal();
  EXPECT_EQ(r.reason, reason::utility_refused);
  EXPECT_EQ(r.fault, rota::utility_fault::not_a_number);
  EXPECT_EQ(r.agent, names::agent(1));
  EXPECT_EQ(r.task, names::task(0));
  // If the team can do without the pair, it does, and still reports it.
  f.plan().tasks[0].min = 1;
  auto const s = f.solve();
  ASSERT_TRUE(s);
  EXPECT_EQ(s->utility, 1.0);
  ASSERT_TRUE(s->ignored);
  EXPECT_EQ(s->ignored->reason, rota::utility_fault::not_a_number);

  fixture g(2, {{0, 1, 2}});
  g.plan().general = true;
  g.plan().offset = std::numeric_limits<double>::infinity();
  EXPECT_EQ(g.refusal().reason, reason::utility_refused);
  EXPECT_EQ(g.refusal().fault, rota::utility_fault::positive_infinity);
}

/// Plans in which every agent has the same utility on every task.
struct great {
  using V = rota::runtime_vocabulary;
  static rota::plan<V> plan_of(std::uint64_t id, std::uint64_t tasks, double worth) {
    rota::plan_description<V, rota::no_beliefs> d;
    d.plan = {id};
    for (std::uint64_t t = 0; t < tasks; ++t) d.tasks.push_back({{t}, {}, {}});
    d.utility = rota::additive_utility<V, rota::no_beliefs>([worth](auto, auto, auto) { return worth; });
    return rota::plan<V>::make(std::move(d)).value();
  }
  static rota::team<V> team_of(std::uint64_t agents) {
    rota::team<V> team;
    for (std::uint64_t a = 0; a < agents; ++a) team.add({a});
    return team;
  }
};

// Allocations of such a plan may be valid, but they are not searched: so nothing is proved about it.
TEST(no_allocation, utilities_too_great_for_so_many_tasks_prove_nothing) {
  using V = great::V;
  auto const modest = great::plan_of(1, 2, 1);
  auto const much = great::plan_of(2, 50, rota::max_utility);
  auto const team = great::team_of(2);
  rota::no_beliefs const beliefs;
  rota::workspace work;
  auto const alone = rota::plan_type<V>::make({}, {much}).value();
  rota::problem const hopeless{alone, team, beliefs};
  auto const none = best_allocation(hopeless, work);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().plans[0].reason, reason::utilities_too_great);
  EXPECT_EQ(none.error().plans[0].fault, rota::utility_fault::out_of_range);
  EXPECT_FALSE(rota::describe(none.error().plans[0]).empty());
  EXPECT_FALSE(none.error().proved());
  auto const kept = reallocate(hopeless, {}, work);
  EXPECT_EQ(kept.reason, rota::reallocation_reason::kept_unproved);
  EXPECT_FALSE(kept.proved);

  auto const both = rota::plan_type<V>::make({}, {modest, much}).value();
  auto const some = best_allocation(rota::problem{both, team, beliefs}, work);
  ASSERT_TRUE(some);
  EXPECT_EQ(some->utility, 2);
  EXPECT_FALSE(some->proved) << "the other plan is worth far more";
  EXPECT_EQ(some->gap, std::numeric_limits<double>::infinity());

  auto const fewer = great::plan_of(2, 25, rota::max_utility);
  auto const within = rota::plan_type<V>::make({}, {modest, fewer}).value();
  auto const best = best_allocation(rota::problem{within, team, beliefs}, work);
  ASSERT_TRUE(best);
  EXPECT_TRUE(best->proved);
  EXPECT_EQ(best->utility, 2 * rota::max_utility);
}

// Each agent gains by moving exactly what moving costs. So objectives are 0, although the utilities sum to more than 64 bits
// hold.
TEST(no_allocation, change_costs_count_in_what_is_summed_exactly) {
  using V = great::V;
  auto const type = rota::plan_type<V>::make({}, {great::plan_of(1, 1, rota::max_utility)}).value();
  auto const team = great::team_of(9000);
  rota::no_beliefs const beliefs;
  rota::workspace work;
  rota::problem problem{type, team, beliefs, rota::idling::forbidden};
  problem.change_cost = rota::max_utility;
  auto const none = best_allocation(problem, work);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().plans[0].reason, reason::utilities_too_great);
}

TEST(no_allocation, functions_that_throw) {
  rota::plan_description<names, rota::no_beliefs> d;
  d.tasks = {{names::task(0), {1, 2}, {}}};
  d.utility = rota::additive_utility<names, rota::no_beliefs>([](auto, auto, auto) { return 1.0; });
  d.precondition = [](auto, auto) -> bool { throw 1; };
  rota::team<names> const team{names::agent(1), names::agent(2)};
  rota::workspace work;
  auto solve = [&] {
    auto const type = plan_type_t::make(names::plan_type::only, {plan_t::make(d).value()}).value();
    return best_allocation(rota::problem{type, team}, work);
  };
  EXPECT_EQ(solve().error().plans[0].reason, reason::precondition_threw);
  d.precondition = {};
  d.utility =
      rota::additive_utility<names, rota::no_beliefs>([](auto, auto, auto) -> std::optional<double> { throw 1; });
  EXPECT_EQ(solve().error().plans[0].fault, rota::utility_fault::threw);
  d.utility = rota::general_utility<names, rota::no_beliefs>{[](auto, auto) -> double { throw 1; }, {}};
  EXPECT_EQ(solve().error().plans[0].fault, rota::utility_fault::threw);
}

TEST(best_allocation, nobody_and_strangers) {
  fixture f(0, {{0, 0, 2}});
  auto const nobody = f.solve();
  ASSERT_TRUE(nobody);
  EXPECT_TRUE(nobody->atoms.empty());
  EXPECT_EQ(nobody->plan, names::plan(1));
  EXPECT_EQ(nobody->utility, 0.0);
  f.plan().tasks[0].min = 1;
  EXPECT_EQ(f.refusal().reason, reason::too_few_agents);
  // A participant that is not in the team gets no task.
  fixture g(1, {{0, 0, 2}});
  g.raw.participants = {0, 5};
  ASSERT_TRUE(g.solve());
  EXPECT_EQ(g.solve()->atoms.size(), 1u);
}

TEST(best_allocation, of_a_plan_type_is_its_best_plan_not_its_first) {  // ALICA's defect 1
  fixture f(2, {{0, 1, 1}});
  raw_plan better = f.plan();
  better.id = 3;
  better.u[1][0] = 5.0;
  raw_plan middle = f.plan();
  middle.id = 2;
  middle.u[0][0] = 3.0;
  f.raw.plans = {f.raw.plans[0], better, middle};
  auto const s = f.solve();
  ASSERT_TRUE(s);
  EXPECT_EQ(s->plan, names::plan(3));
  EXPECT_EQ(s->utility, 5.0);
  EXPECT_EQ(s->runner_up, (rota::runner_up<names>{names::plan(2), 3.0, 2.0}));
}

TEST(best_allocation, additive_is_polynomial) {  // ALICA's defect 7: 16 x 8 took it more than a minute
  using V = rota::runtime_vocabulary;
  for (auto [n, m] : {std::pair{16, 8}, std::pair{60, 10}, std::pair{300, 12}}) {
    for (int levels : {1, 3, 1000}) {
      rota::team<V> team;
      for (int a = 0; a < n; ++a) team.add({static_cast<std::uint64_t>(a)});
      rota::plan_description<V, rota::no_beliefs> d;
      for (int t = 0; t < m; ++t)
        d.tasks.push_back({{static_cast<std::uint64_t>(t)},
                           {static_cast<std::uint32_t>(t % 3), static_cast<std::uint32_t>(2 + n / m)},
                           {}});
      d.utility = rota::additive_utility<V, rota::no_beliefs>([=](auto a, auto t, auto) -> std::optional<double> {
        if ((a.value + t.value) % 11 == 0) return std::nullopt;
        return static_cast<double>(dice(a.value * 1000 + t.value).below(levels) - (levels > 3 ? 300 : 0));
      });
      auto const type = rota::plan_type<V>::make({}, {rota::plan<V>::make(d).value()}).value();
      rota::workspace work;
      auto const s = best_allocation(rota::problem{type, team}, work);
      ASSERT_TRUE(s);
      EXPECT_TRUE(s->proved);
      auto const agents = static_cast<std::uint64_t>(n);
      auto const slots = static_cast<std::uint64_t>(m + 1);
      EXPECT_EQ(s->work.nodes, 0u);
      EXPECT_LE(s->work.augmentations, 2 * (agents + slots));
      EXPECT_LE(s->work.relaxations, 3 * agents * slots * (slots + agents));
    }
  }
}

}  // namespace

}  // namespace reasons_test
