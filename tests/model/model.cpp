#include <rota/model/outline.hpp>
#include <rota/model/plan_type.hpp>
#include <rota/model/team.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace {

struct names {
  enum class agent { a = 1, b, c };
  enum class plan_type { play = 1 };
  enum class plan { p = 1, q, r };
  enum class task { attack = 1, block, defend };
  enum class state { first = 1 };
};
using plan_t = rota::plan<names>;
using type_t = rota::plan_type<names>;
using defect = rota::plan_defect<names>;

rota::plan_description<names, rota::no_beliefs> description(names::plan id = names::plan::p) {
  rota::plan_description<names, rota::no_beliefs> d;
  d.plan = id;
  d.tasks = {{names::task::defend, {}, names::state::first}, {names::task::attack, {1, 1}, names::state::first}};
  d.utility = rota::additive_utility<names, rota::no_beliefs>([](auto, auto, auto) { return 1.0; });
  return d;
}

TEST(cardinality, admits_the_closed_interval_and_nothing_else) {
  for (std::uint32_t min = 0; min < 4; ++min)
    for (std::uint32_t max = 0; max < 5; ++max) {
      auto const c = rota::cardinality::make(min, max);
      ASSERT_EQ(c.has_value(), min <= max);
      if (!c) {
        EXPECT_EQ(c.error(), (rota::empty_interval{min, max}));
        continue;
      }
      for (std::size_t n = 0; n < 6; ++n) EXPECT_EQ(c->admits(n), min <= n && n <= max);
    }
}

TEST(cardinality, unbounded_admits_any_number) {
  rota::cardinality const c{2, rota::cardinality::unbounded};
  EXPECT_FALSE(c.is_bounded());
  EXPECT_FALSE(c.admits(1));
  EXPECT_TRUE(c.admits(2));
  EXPECT_TRUE(c.admits(std::size_t{1} << 40));
  EXPECT_TRUE(rota::cardinality{}.admits(0));
  // One less is a number like any other.
  EXPECT_FALSE((rota::cardinality{0, rota::cardinality::unbounded - 1}.admits(std::size_t{1} << 40)));
}

TEST(cardinality, empty_bounds_can_be_written_and_admit_nothing) {
  rota::cardinality const c{3, 1};
  EXPECT_TRUE(c.is_empty());
  for (std::size_t n = 0; n < 6; ++n) EXPECT_FALSE(c.admits(n));
  EXPECT_FALSE((rota::cardinality{1, 1}.is_empty()));
  EXPECT_FALSE(rota::cardinality{}.is_empty());
}

TEST(plan, every_defect_is_refused_by_name) {
  auto d = description();
  EXPECT_TRUE(plan_t::make(d));
  d.tasks.clear();
  EXPECT_EQ(plan_t::make(d).error().what, defect::kind::no_task);
  d = description();
  d.tasks.push_back({names::task::defend, {0, 2}, {}});
  EXPECT_EQ(plan_t::make(d).error(), (defect{defect::kind::repeated_task, names::task::defend}));
  d = description();
  d.utility = rota::additive_utility<names, rota::no_beliefs>{};
  EXPECT_EQ(plan_t::make(d).error().what, defect::kind::missing_utility);
  d.utility = rota::general_utility<names, rota::no_beliefs>{};
  EXPECT_EQ(plan_t::make(d).error().what, defect::kind::missing_utility);
  d = description();
  for (double h : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    d.hysteresis = h;
    EXPECT_EQ(plan_t::make(d).error().what, defect::kind::threshold_not_finite);
  }
  d = description();
  d.tasks.push_back({names::task::block, {3, 1}, {}});
  EXPECT_EQ(plan_t::make(d).error(), (defect{defect::kind::empty_cardinality, names::task::block, {3, 1}}));
  d = description();
  d.team_size = {2, 1};
  EXPECT_EQ(plan_t::make(d).error(), (defect{defect::kind::empty_team_size, {}, {2, 1}}));
}

TEST(plan, a_weight_that_is_no_number_is_refused) {
  for (double w : {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    auto d = description();
    d.utility = {{1.0, rota::role_priorities{}}, {w, rota::similarity{}}};
    EXPECT_EQ(plan_t::make(d).error().what, defect::kind::weight_not_finite);
  }
}

/// Which form a utility has, as its place among the forms.
std::size_t form_of(rota::utility<names, rota::no_beliefs> const& u) { return u.form().index(); }

TEST(utility, a_plain_callable_has_the_form_of_its_signature) {
  using agent = names::agent;
  using task = names::task;
  using none = rota::no_beliefs;
  using view = rota::allocation_view<names>;
  enum : std::size_t { additive, pairwise, general, sum };
  EXPECT_EQ(form_of([](agent, task, none const&) { return 1.0; }), additive);
  EXPECT_EQ(form_of([](agent, task, none) { return std::optional<double>(); }), additive);
  EXPECT_EQ(form_of([](auto, auto, auto const&) { return 1; }), additive);
  EXPECT_EQ(form_of(+[](agent, task, none const&) { return 1.0f; }), additive);
  EXPECT_EQ(form_of([](agent, task, agent, task, none const&) { return 1.0; }), pairwise);
  EXPECT_EQ(form_of([](none const&, view) { return 1.0; }), general);
  EXPECT_EQ(form_of(rota::additive_utility<names, none>()), additive);
  EXPECT_EQ(form_of(rota::general_utility<names, none>()), general);
  EXPECT_EQ(form_of({{0.5, [](agent, task, none const&) { return 1.0; }}, {0.5, rota::role_priorities{}}}), sum);
}

TEST(utility, an_empty_function_stays_empty) {
  using none = rota::no_beliefs;
  auto d = description();
  d.utility = {};
  EXPECT_EQ(plan_t::make(d).error().what, defect::kind::missing_utility);
  d.utility = std::function<double(names::agent, names::task, none const&)>{};
  EXPECT_EQ(plan_t::make(d).error().what, defect::kind::missing_utility);
  d.utility = rota::weighted_sum<names, none>{};
  EXPECT_EQ(plan_t::make(d).error().what, defect::kind::missing_utility);
  d.utility = {{1.0, rota::role_priorities{}}, {1.0, rota::pairwise_utility<names, none>{}}};
  EXPECT_EQ(plan_t::make(d).error().what, defect::kind::missing_utility);
}

TEST(plan, does_not_depend_on_the_order_of_its_tasks) {
  auto d = description();
  d.tasks.push_back({names::task::block, {0, 2}, names::state::first});
  auto const forward = plan_t::make(d).value();
  std::reverse(d.tasks.begin(), d.tasks.end());
  auto const backward = plan_t::make(d).value();
  ASSERT_TRUE(std::ranges::equal(forward.tasks(), backward.tasks()));
  EXPECT_TRUE(std::ranges::is_sorted(forward.tasks(), {}, &rota::plan_task<names>::task));
  ASSERT_NE(forward.find(names::task::block), nullptr);
  EXPECT_EQ(forward.find(names::task::block)->bounds, (rota::cardinality{0, 2}));
  EXPECT_EQ(plan_t::make(description()).value().find(names::task::block), nullptr);
}

TEST(plan_type, every_defect_is_refused_and_the_order_of_plans_does_not_matter) {
  using kind = rota::plan_type_defect<names>::kind;
  EXPECT_EQ(type_t::make(names::plan_type::play, {}).error().what, kind::no_plan);
  auto const p = plan_t::make(description(names::plan::p)).value();
  auto const q = plan_t::make(description(names::plan::q)).value();
  EXPECT_EQ(type_t::make(names::plan_type::play, {p, q, p}).error(),
            (rota::plan_type_defect<names>{kind::repeated_plan, names::plan::p}));
  auto const type = type_t::make(names::plan_type::play, {q, p}).value();
  EXPECT_EQ(type.plans().front().id(), names::plan::p);
  ASSERT_NE(type.find(names::plan::q), nullptr);
  EXPECT_EQ(type.find(names::plan::q)->id(), names::plan::q);
  EXPECT_EQ(type.find(names::plan::r), nullptr);
}

TEST(role, what_is_not_listed_has_the_default_priority) {  // ALICA's defect 6: its default is silently 0
  rota::role<names> r(-1);
  r.prioritise(names::task::attack, 2);
  EXPECT_TRUE(r.permits(names::task::attack));
  EXPECT_FALSE(r.permits(names::task::block));
  EXPECT_EQ(r.priority(names::task::block), -1);
  rota::role<names> s(0.5);
  EXPECT_EQ(s.priority(names::task::attack), 0.5);
  s.forbid(names::task::attack);
  EXPECT_FALSE(s.permits(names::task::attack));
  s.prioritise(names::task::attack, 0);
  EXPECT_TRUE(s.permits(names::task::attack));
  EXPECT_TRUE(rota::role<names>{}.permits(names::task::defend));
}

TEST(role, does_not_depend_on_the_order_of_calls) {
  rota::role<names> r;
  rota::role<names> s;
  r.prioritise(names::task::attack, 1).prioritise(names::task::defend, 2);
  s.prioritise(names::task::defend, 2).prioritise(names::task::attack, 1);
  EXPECT_EQ(r, s);
}

TEST(team, does_not_depend_on_the_order_of_its_agents) {
  rota::role<names> keeper;
  keeper.forbid(names::task::attack);
  rota::team<names> one;
  one.add(names::agent::c).add(names::agent::a, keeper).add(names::agent::b);
  rota::team<names> other;
  other.add(names::agent::a).add(names::agent::b).add(names::agent::c).add(names::agent::a, keeper);
  EXPECT_EQ(one, other);
  EXPECT_EQ(one.size(), 3u);
  EXPECT_TRUE(std::ranges::is_sorted(one.agents()));
  EXPECT_FALSE(one.permits(names::agent::a, names::task::attack));
  EXPECT_TRUE(one.permits(names::agent::b, names::task::attack));
  rota::team<names> const two{names::agent::b};
  EXPECT_FALSE(two.permits(names::agent::a, names::task::block));
  EXPECT_EQ(two.role_of(names::agent::a), nullptr);
}

TEST(allocation, an_agents_part_is_its_atoms_over_all_plans) {
  using atom = rota::in<names>;
  rota::allocation_atoms<names> const c{{names::agent::a, names::plan::q, names::task::attack},
                                        {names::agent::b, names::plan::q, names::task::block},
                                        {names::agent::a, names::plan::p, names::task::defend}};
  auto const part = rota::part_of<names>(c, names::agent::a);
  ASSERT_EQ(part.size(), 2u);
  EXPECT_EQ(part[0], (atom{names::agent::a, names::plan::p, names::task::defend}));
  EXPECT_TRUE(rota::part_of<names>(c, names::agent::c).empty());
  auto const e = rota::event<atom>::subtraction({names::agent::b, names::plan::q, names::task::block});
  EXPECT_TRUE(rota::mentions<names>(e, names::agent::b));
  EXPECT_FALSE(rota::mentions<names>(e, names::agent::a));
}

TEST(outline, knows_each_task_of_each_plan) {
  auto q = description(names::plan::q);
  q.tasks = {{names::task::block, {}, names::state::first}};
  auto const type =
      type_t::make(names::plan_type::play, {plan_t::make(q).value(), plan_t::make(description()).value()}).value();
  rota::outline<names> const o(type);
  EXPECT_EQ(o.type(), names::plan_type::play);
  ASSERT_NE(o.find(names::plan::p, names::task::attack), nullptr);
  EXPECT_EQ(o.find(names::plan::p, names::task::attack)->state, names::state::first);
  EXPECT_NE(o.find(names::plan::q, names::task::block), nullptr);
  EXPECT_EQ(o.find(names::plan::q, names::task::attack), nullptr);
  EXPECT_EQ(o.find(names::plan::r, names::task::attack), nullptr);
}

}  // namespace
