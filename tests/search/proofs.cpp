// What is called optimal is proved to be the canonical optimum; what cannot be summed exactly is not searched.
#include "allocation/small_world.hpp"

#include <rota/allocation/validate.hpp>
#include <rota/search/print.hpp>
#include <rota/search/reallocate.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace proofs_test {

namespace {

using namespace small_world;

/// Agents who may do all tasks of one plan.
struct question {
  rota::plan_type<names> type;
  rota::team<names> team;
  question(int agents, std::vector<rota::plan_task<names>> tasks, rota::utility<names, rota::no_beliefs> utility)
      : type(make(std::move(tasks), std::move(utility))) {
    for (int a = 0; a < agents; ++a) team.add(names::agent(a));
  }
  static rota::plan_type<names> make(std::vector<rota::plan_task<names>> tasks,
                                     rota::utility<names, rota::no_beliefs> utility) {
    rota::plan_description<names, rota::no_beliefs> d;
    d.tasks = std::move(tasks);
    d.utility = std::move(utility);
    return rota::plan_type<names>::make({}, {plan_t::make(std::move(d)).value()}).value();
  }
};

TEST(optimal, is_the_canonical_optimum_or_not_called_so) {
  question const q(2, {{names::task(0), {0, 1}, {}}, {names::task(1), {0, 1}, {}}, {names::task(2), {1, 2}, {}}},
                   [](names::agent a, names::task t, rota::no_beliefs) {
                     return std::optional<double>(a == names::agent(1) && t == names::task(2) ? 0 : 2);
                   });
  rota::problem const problem{q.type, q.team, rota::idling::forbidden};
  rota::workspace plenty;
  auto const best = best_allocation(problem, plenty).value();
  EXPECT_TRUE(best.proved);
  EXPECT_EQ(best.gap, 0);
  rota::search_budget none;
  none.relaxations = 0;
  rota::workspace fresh;
  for (int round = 0; round < 3; ++round) {  // fresh, then used
    auto const hurried = best_allocation(problem, fresh, none).value();
    EXPECT_TRUE(validate(problem, q.type.plans()[0], hurried.atoms).valid());
    EXPECT_LE(hurried.utility, best.utility);
    EXPECT_GE(hurried.utility + hurried.gap, best.utility);
    EXPECT_TRUE(!hurried.proved || hurried.atoms == best.atoms) << round;
  }
  auto const after = best_allocation(problem, fresh).value();
  EXPECT_TRUE(after.proved);
  EXPECT_EQ(after.atoms, best.atoms);
}

// The same of any problem and any budget: two robots that both say "optimal" say the same.
TEST(optimal, is_the_same_under_every_budget_and_history) {
  int unproved = 0;
  int equally_good = 0;
  rota::workspace used;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    dice d(seed);
    auto raw = random_problem(d, {.agents = 5,
                                  .tasks = 3,
                                  .plans = 3,
                                  .levels = 2,
                                  .general = d.chance(50),
                                  .preconditions = d.chance(50),
                                  .sums = d.chance(50)});
    built const b(raw);
    rota::problem const problem{b.type, b.team, b.beliefs, b.participants};
    rota::workspace fresh;
    auto const best = best_allocation(problem, fresh);
    if (!best) continue;
    ASSERT_TRUE(best->proved);
    for (std::uint64_t const nodes : {0u, 3u, 30u, 1u << 20})
      for (std::uint64_t const relaxations : {std::uint64_t{0}, std::uint64_t{20}, ~std::uint64_t{0}}) {
        rota::search_budget const budget{.nodes = nodes, .relaxations = relaxations};
        auto const some = best_allocation(problem, used, budget);
        if (!some) continue;
        EXPECT_LE(some->objective, best->objective) << seed;
        EXPECT_GE(rota::to_double(some->objective) + some->gap, rota::to_double(best->objective)) << seed;
        if (some->proved) {
          EXPECT_EQ(some->plan, best->plan) << seed;
          EXPECT_EQ(some->atoms, best->atoms) << seed;
          EXPECT_EQ(some->gap, 0) << seed;
        }
        unproved += !some->proved;
        equally_good += !some->proved && some->objective == best->objective && some->atoms != best->atoms;
      }
  }
  EXPECT_GE(unproved, 300);
  EXPECT_GE(equally_good, 30);
}

TEST(too_great, sums_of_parts_are_refused_as_such) {
  auto const all = [](int parts) {
    rota::weighted_sum<names, rota::no_beliefs> sum;
    for (int i = 0; i < parts; ++i)
      sum.push_back({1.0, rota::additive_utility<names, rota::no_beliefs>(
                              [](auto, auto, auto) { return std::optional<double>(rota::max_utility); })});
    return sum;
  };
  auto const pair = rota::allocation_atoms<names>{{names::agent(0), {}, names::task(0)}};
  rota::workspace work;
  for (int const parts : {33, 1024, 1025, 4096}) {
    question const q(1, {{names::task(0), {0, 1}, {}}}, all(parts));
    rota::problem const problem{q.type, q.team};
    bool const valid = validate(problem, q.type.plans()[0], pair).valid();
    EXPECT_EQ(valid, parts <= 1024);  // a total up to 2^40 is a utility, but beyond what is searched
    auto const none = best_allocation(problem, work);
    ASSERT_FALSE(none) << parts;
    EXPECT_FALSE(none.error().proved());
    EXPECT_EQ(none.error().plans[0].reason, rota::no_plan_reason::utilities_too_great);
    EXPECT_EQ(none.error().plans[0].agent, names::agent(0));
    EXPECT_FALSE(none.error().ignored) << parts << ": every term is a utility";
    auto const kept = reallocate(problem.running(pair), {}, work);
    EXPECT_EQ(kept.reason,
              valid ? rota::reallocation_reason::kept_unproved : rota::reallocation_reason::search_incomplete);
    EXPECT_EQ(kept.atoms, valid ? pair : rota::allocation_atoms<names>{});
    EXPECT_EQ(kept.refusals.size(), 1u);
  }
  question const q(1, {{names::task(0), {0, 1}, {}}}, all(8));
  rota::problem const problem{q.type, q.team};
  auto const most = best_allocation(problem, work);
  ASSERT_TRUE(most);
  EXPECT_EQ(most->utility, 8 * rota::max_utility);
}

// What validate calls no utility, the search leaves out: sums of one agent beyond 64 bits, totals beyond 2^40.
TEST(too_great, totals_that_are_no_utility_are_left_out) {
  rota::weighted_sum<names, rota::no_beliefs> of_agents;
  rota::weighted_sum<names, rota::no_beliefs> of_the_whole;
  for (int i = 0; i < 8192; ++i)
    of_agents.push_back({1.0, [](names::agent, names::task, rota::no_beliefs) { return rota::max_utility; }});
  for (int i = 0; i < 1025; ++i)
    of_the_whole.push_back(
        {1.0, [](rota::no_beliefs, rota::allocation_view<names> c) { return c.empty() ? 0 : rota::max_utility; }});
  auto const pair = rota::allocation_atoms<names>{{names::agent(0), {}, names::task(0)}};
  rota::workspace work;
  for (auto const& sum : {of_agents, of_the_whole}) {
    question const q(1, {{names::task(0), {0, 1}, {}}}, sum);
    rota::problem const problem{q.type, q.team};
    EXPECT_FALSE(validate(problem, q.type.plans()[0], pair).valid());
    auto const idle = best_allocation(problem, work);
    ASSERT_TRUE(idle);
    EXPECT_TRUE(idle->proved);
    EXPECT_TRUE(idle->atoms.empty());
    ASSERT_TRUE(idle->ignored);
    EXPECT_EQ(idle->ignored->reason, rota::utility_fault::out_of_range);
  }
}

// One default for all, so that units compiled with and without NDEBUG agree. Without an audit, a lie can go unseen.
TEST(audit, is_off_by_default_and_finds_a_bound_that_hides_the_optimum) {
  static_assert(!rota::search_budget{}.audit);
  using view = rota::allocation_view<names>;
  auto const first_works = [](view c) { return !c.empty() && c.front().agent == names::agent(0); };
  rota::general_utility<names, rota::no_beliefs> const u{[=](rota::no_beliefs, view c) {
                                                           return first_works(c) ? 1.0 : c.size() == 2 ? 5.0 : 0.0;
                                                         },
                                                         [=](rota::no_beliefs, view c, auto rest) {
                                                           return rest.size() == 3 ? 5.0 : first_works(c) ? 1.0 : 0.5;
                                                         }};
  question const q(3, {{names::task(0), {0, 3}, {}}}, u);
  rota::problem const problem{q.type, q.team};
  rota::workspace work;
  auto const deceived = best_allocation(problem, work).value();
  EXPECT_EQ(deceived.utility, 1);
  EXPECT_FALSE(deceived.lie);
  auto const audited = best_allocation(problem, work, {.audit = true}).value();
  EXPECT_FALSE(audited.proved);
  ASSERT_TRUE(audited.lie);
  EXPECT_EQ(audited.lie->bound, 0.5);
  EXPECT_EQ(audited.lie->value, 5);
}

}  // namespace

}  // namespace proofs_test
