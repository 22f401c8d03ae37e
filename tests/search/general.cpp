// Branch and bound on general utilities, as best_allocation and reallocate use it: lies and gaps are reported, outlooks and
// kinds save work, a search that is stopped at once has an answer.
#include "allocation/small_world.hpp"
#include "support/allocation_counter.hpp"

#include <rota/search/best_allocation.hpp>
#include <rota/search/reallocate.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace general_test {

using small_world::names;
using plan_t = rota::plan<names, rota::no_beliefs>;
using view_t = rota::allocation_view<names>;
using rest_t = std::span<names::agent const>;

struct team_of {
  explicit team_of(int n) {
    for (int a = 0; a < n; ++a) members.add(names::agent(a));
  }
  rota::solution<names> solve(rota::plan_description<names, rota::no_beliefs> d, rota::search_budget budget = {}) {
    auto const type = rota::plan_type<names>::make({}, {plan_t::make(std::move(d)).value()}).value();
    auto const found = best_allocation(rota::problem{type, members}, space, budget);
    EXPECT_TRUE(found);
    return found ? *found : rota::solution<names>{};
  }
  rota::team<names> members;
  rota::workspace space;
};

rota::plan_description<names, rota::no_beliefs> three_tasks() {
  rota::plan_description<names, rota::no_beliefs> d;
  for (int t = 0; t < 3; ++t) d.tasks.push_back({names::task(t), {0, 3}, {}});
  return d;
}

/// One for each task that is served by an odd number of agents.
double odd_tasks(view_t c) {
  std::ptrdiff_t odd = 0;
  for (int t = 0; t < 3; ++t)
    odd += std::count_if(c.begin(), c.end(), [&](auto const& x) { return x.task == names::task(t); }) % 2;
  return static_cast<double>(odd);
}

TEST(best_allocation, reports_a_lying_bound_with_the_partial_allocation) {
  auto d = three_tasks();
  d.utility = rota::general_utility<names, rota::no_beliefs>{
      [](auto, view_t c) { return odd_tasks(c); }, [](auto, view_t, rest_t rest) { return rest.empty() ? 3.0 : 0.5; }};
  auto const s = team_of(5).solve(d, {.audit = true});
  ASSERT_TRUE(s.lie);
  EXPECT_FALSE(s.proved);
  EXPECT_EQ(s.gap, std::numeric_limits<double>::infinity());
  EXPECT_EQ(s.lie->bound, 0.5);
  EXPECT_GE(s.lie->value, 1.0);
  EXPECT_EQ(s.lie->partial.size() + s.lie->undecided, 5u) << "in this one, nobody that is decided is idle";
  EXPECT_TRUE(is_subset(s.lie->partial, s.lie->complete));
  EXPECT_EQ(odd_tasks(s.lie->complete.atoms()), s.lie->value);
  EXPECT_EQ(odd_tasks(s.atoms.atoms()), s.utility) << "what it returns is valid all the same";
}

TEST(reallocate, passes_on_what_a_search_complains_of) {
  auto d = three_tasks();
  d.utility = rota::general_utility<names, rota::no_beliefs>{
      [](auto, view_t c) { return c.size() == 5 ? std::nan("") : odd_tasks(c); },
      [](auto, view_t, rest_t rest) { return rest.empty() ? 3.0 : 0.5; }};
  team_of team(5);
  auto const ask = [&] {
    auto const type = rota::plan_type<names>::make({}, {plan_t::make(d).value()}).value();
    return reallocate(rota::problem{type, team.members}, {}, team.space, {.audit = true});
  };
  auto const some = ask();
  EXPECT_TRUE(some.plan);
  EXPECT_FALSE(some.proved);
  ASSERT_TRUE(some.lie);
  EXPECT_EQ(some.lie->bound, 0.5);
  ASSERT_TRUE(some.ignored);
  EXPECT_EQ(some.ignored->reason, rota::utility_fault::not_a_number);
  d.utility = rota::general_utility<names, rota::no_beliefs>{[](auto, view_t) { return -1.0; },
                                                             [](auto, view_t, rest_t) { return -2.0; }};
  auto const none = ask();
  EXPECT_FALSE(none.plan);
  EXPECT_EQ(none.reason, rota::reallocation_reason::search_incomplete);
  ASSERT_TRUE(none.lie);
  EXPECT_EQ(none.lie->value, -1.0);
}

TEST(best_allocation, says_how_far_it_may_be_from_the_optimum) {
  auto d = three_tasks();
  d.utility = rota::general_utility<names, rota::no_beliefs>{[](auto, view_t c) { return odd_tasks(c); },
                                                             [](auto, view_t, rest_t) { return 3.0; }};
  for (auto& t : d.tasks) t.bounds = {0, 4};
  team_of team(7);
  auto const best = team.solve(d, {.nodes = 1u << 20});
  EXPECT_TRUE(best.proved);
  EXPECT_EQ(best.utility, 3.0);
  EXPECT_EQ(best.gap, 0.0);
  auto const some = team.solve(d, {.nodes = 7});
  EXPECT_FALSE(some.proved);
  EXPECT_EQ(some.gap, 3.0 - some.utility);
}

TEST(best_allocation, that_is_stopped_at_once_has_an_answer_all_the_same) {
  auto d = three_tasks();
  d.utility = rota::general_utility<names, rota::no_beliefs>{[](auto, view_t c) { return odd_tasks(c); },
                                                             [](auto, view_t, rest_t) { return 3.0; }};
  auto const at_once = [] { return true; };
  rota::search_budget none;
  none.stop = at_once;
  team_of team(5);
  for (auto const& budget : {none, rota::search_budget{.nodes = 0}}) {
    auto const s = team.solve(d, budget);
    EXPECT_EQ(s.work.nodes, 0u);
    EXPECT_FALSE(s.proved);
    EXPECT_EQ(s.gap, 3.0 - s.utility);
    EXPECT_EQ(odd_tasks(s.atoms.atoms()), s.utility);
  }
  // And it is no worse than what runs, if that is valid.
  auto const type = rota::plan_type<names>::make({}, {plan_t::make(d).value()}).value();
  rota::problem<names, rota::no_beliefs> p{type, team.members};
  rota::allocation_atoms<names> runs;
  for (int a = 0; a < 3; ++a) runs.insert({names::agent(a + 1), {}, names::task(2 - a)});
  p.current = runs.atoms();
  auto const s = best_allocation(p, team.space, none);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->utility, 3.0);
  EXPECT_EQ(s->atoms, runs);
}

TEST(best_allocation, leaves_what_an_outlook_calls_impossible) {
  auto d = three_tasks();
  d.utility = rota::additive_utility<names, rota::no_beliefs>([](auto a, auto t, auto) {
    return std::optional<double>(static_cast<int>(a) % 3 == static_cast<int>(t) ? 2 : 1);
  });
  auto const crowd = [](view_t c) {  // at most two agents in all
    return c.size() <= 2;
  };
  d.precondition = [=](auto, view_t c) { return crowd(c); };
  team_of team(7);
  auto const blind = team.solve(d);
  d.outlook = [=](auto, view_t c, rest_t) { return crowd(c) ? rota::possibility::perhaps : rota::possibility::no; };
  auto const foreseeing = team.solve(d);
  EXPECT_TRUE(blind.proved && foreseeing.proved);
  EXPECT_EQ(blind.utility, 4.0);
  EXPECT_EQ(foreseeing.atoms, blind.atoms);
  EXPECT_LT(foreseeing.work.leaves * 10, blind.work.leaves);
}

TEST(best_allocation, interchangeable_agents_cost_little) {
  auto d = three_tasks();
  rota::general_utility<names, rota::no_beliefs> u{[](auto, view_t c) { return odd_tasks(c); }};
  team_of team(8);
  d.utility = u;
  auto const blind = team.solve(d);
  u.kind = [](auto, auto) { return std::uint64_t{0}; };
  d.utility = u;
  auto const seeing = team.solve(d);
  EXPECT_EQ(seeing.atoms, blind.atoms);
  EXPECT_EQ(seeing.utility, 3.0);
  EXPECT_LT(seeing.work.nodes * 100, blind.work.nodes);
}

TEST(best_allocation, branch_and_bound_in_a_steady_loop_allocates_nothing) {
  auto d = three_tasks();
  double more = 0;
  d.utility = rota::weighted_sum<names, rota::no_beliefs>{
      {1, rota::additive_utility<names, rota::no_beliefs>{[&more](auto a, auto t, auto) {
         return more * static_cast<int>(a) + static_cast<int>(t);
       }}},
      {2, rota::general_utility<names, rota::no_beliefs>{[](auto, view_t c) { return odd_tasks(c); },
                                                         [](auto, view_t, rest_t) { return 3.0; }}}};
  d.precondition = [](auto, view_t c) { return c.size() != 3; };
  auto const type = rota::plan_type<names>::make({}, {plan_t::make(d).value()}).value();
  team_of team(8);
  rota::allocation_atoms<names> runs;
  auto const tick = [&](double u) {
    more = u;
    auto const next = reallocate(rota::problem{type, team.members}.running(runs), {}, team.space);
    EXPECT_GT(next.work.nodes, 0u);
    runs = next.atoms;
  };
  tick(1);
  auto const before = rota_test::allocation_count();
  for (int i = 0; i < 20; ++i) tick(i % 5);
  EXPECT_EQ(rota_test::allocation_count(), before);
}

TEST(best_allocation, a_utility_that_throws_leaves_the_workspace_usable) {
  auto d = three_tasks();
  d.utility = rota::pairwise_utility<names, rota::no_beliefs>{
      {}, [](auto a, auto, auto, auto, auto) -> double { return a == names::agent(0) ? throw 1 : 1.0; }};
  team_of team(4);
  auto const s = team.solve(d);
  ASSERT_TRUE(s.ignored);
  EXPECT_EQ(s.ignored->reason, rota::utility_fault::threw);
  EXPECT_TRUE(s.ignored->other);
  EXPECT_EQ(s.utility, 3.0) << "all but the first agent";
  EXPECT_EQ(s.atoms.begin()->agent, names::agent(1));
  d.utility = rota::additive_utility<names, rota::no_beliefs>([](auto, auto, auto) { return 1.0; });
  EXPECT_EQ(team.solve(d).utility, 4.0);
}

}  // namespace general_test
