#include "allocation/reading.hpp"

#include <rota/allocation/hysteresis.hpp>
#include <rota/allocation/print.hpp>
#include <rota/allocation/validate.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

namespace {

using namespace small_world;
using rota::clause;
using rota::utility_fault;
using rota::validate;

/// A report in the words of the oracle; what it cannot say, it says wrongly.
reading::verdict translate(rota::validity_report<names> const& report) {
  reading::verdict v;
  for (auto const& x : report) {
    fact const f{static_cast<int>(x.atom.agent), static_cast<int>(x.atom.plan), static_cast<int>(x.atom.task)};
    switch (x.what) {
    case clause::one_plan: v.other_plan.insert(f); break;
    case clause::foreign_task: v.foreign.insert(f); break;
    case clause::stranger: v.strangers.insert(f); break;
    case clause::role: v.roles.insert(f); break;
    case clause::cardinality: v.cardinality.insert(static_cast<int>(x.task)); break;
    case clause::one_task: v.two_tasks.insert(static_cast<int>(x.agent)); break;
    case clause::precondition: v.precondition = true; break;
    case clause::utility: v.negative = x.fault == utility_fault::negative; break;
    case clause::forbidden_pair: v.forbidden.insert(f); break;
    case clause::team_size: v.team_size = true; break;
    case clause::idle_forbidden: v.idle.insert(static_cast<int>(x.agent)); break;
    }
  }
  return v;
}

bool same(reading::verdict const& a, reading::verdict const& b) {
  return a.other_plan == b.other_plan && a.foreign == b.foreign && a.strangers == b.strangers && a.roles == b.roles &&
         a.cardinality == b.cardinality && a.two_tasks == b.two_tasks && a.precondition == b.precondition &&
         a.negative == b.negative && a.forbidden == b.forbidden && a.team_size == b.team_size && a.idle == b.idle;
}

flavour const everything{5, 3, 2, 4, true, true, true};
flavour const calm{5, 2, 2, 4};

TEST(validity, every_clause_says_what_the_formula_says) {
  std::map<std::string, int> reached;
  int judged = 0;
  int lower_bounds_matter = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    auto f = d.chance(50) ? everything : calm;
    f.agents = *between(0, 5).as("agents");
    auto const raw = random_problem(d, f);
    built const b(raw);
    rota::problem const problem{b.type, b.team, b.beliefs, b.participants,
                                raw.idle ? rota::idling::allowed : rota::idling::forbidden};
    for (int i = 0; i < 4; ++i) {
      auto const& p = raw.plans[d.bits() % raw.plans.size()];
      auto const c = random_facts(d, raw, d.chance(85) ? p : raw.plans[0]);
      bool const running = d.chance(50);
      auto const expected = reading::judge(raw, p, c, running);
      auto const report = validate(problem, *b.type.find(names::plan(p.id)), to_atoms(c),
                                   running ? rota::plan_phase::running : rota::plan_phase::entering);
      RC_ASSERT(report.valid() == expected.valid());
      RC_ASSERT(same(translate(report), expected));
      RC_ASSERT(report.plan().has_value() == report.valid());
      for (auto const& v : report) {
        RC_ASSERT(report.violates(v.what));
        RC_ASSERT(!rota::describe(v).empty());
        if (v.what == clause::cardinality || v.what == clause::team_size) RC_ASSERT(!v.bounds.admits(v.count));
      }

      ++judged;
      reached["valid"] += expected.valid();
      reached["other plan"] += !expected.other_plan.empty();
      reached["foreign"] += !expected.foreign.empty();
      reached["stranger"] += !expected.strangers.empty();
      reached["role"] += !expected.roles.empty();
      reached["cardinality"] += !expected.cardinality.empty();
      reached["two tasks"] += !expected.two_tasks.empty();
      reached["precondition"] += expected.precondition;
      reached["negative"] += expected.negative;
      reached["forbidden pair"] += !expected.forbidden.empty();
      reached["team size"] += expected.team_size;
      reached["idle"] += !expected.idle.empty();
      // A wrong model: the formulas read without lower bounds.
      auto lax = p;
      for (auto& t : lax.tasks) t.min = 0;
      lower_bounds_matter += !same(reading::judge(raw, lax, c, running), expected);
    }
  }));
  for (auto const& [what, count] : reached) EXPECT_GE(count * 100, judged * 4) << what << " " << count << "/" << judged;
  EXPECT_EQ(reached.size(), 12u);
  EXPECT_GE(lower_bounds_matter * 100, judged * 5);
}

TEST(validity, a_judgement_on_the_type_finds_the_plan) {
  int valid = 0;
  int empty = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    auto const raw = random_problem(d, d.chance(30) ? everything : calm);
    built const b(raw);
    rota::problem const problem{b.type, b.team, b.beliefs, b.participants,
                                raw.idle ? rota::idling::allowed : rota::idling::forbidden};
    auto const c = d.chance(30) ? facts{} : random_facts(d, raw, raw.plans[0]);
    auto const report = validate(problem, to_atoms(c));
    // The least plan that occurs; for the empty allocation the least for which it is valid.
    reading::raw_plan const* expected = nullptr;
    for (auto const& p : raw.plans) {
      bool const occurs = std::any_of(c.begin(), c.end(), [&](fact const& x) { return x.plan == p.id; });
      if (!c.empty() ? occurs : reading::judge(raw, p, c, false).valid())
        if (expected == nullptr || p.id < expected->id) expected = &p;
    }
    bool const should = expected != nullptr && reading::judge(raw, *expected, c, false).valid();
    RC_ASSERT(report.valid() == should);
    if (should) RC_ASSERT(*report.plan() == names::plan(expected->id));
    if (!should) RC_ASSERT(report.size() > 0u);
    valid += should;
    empty += c.empty();
  }));
  EXPECT_GE(valid, 100);
  EXPECT_GE(empty, 250);
}

// One plan with one task for hand-made cases.
struct one_task_world {
  plan_type_t type;
  rota::team<names> team{names::agent(1), names::agent(2), names::agent(3)};
  rota::no_beliefs beliefs{};
  explicit one_task_world(rota::plan_description<names, rota::no_beliefs> d)
      : type(std::move(
            plan_type_t::make(names::plan_type::only, {std::move(plan_t::make(std::move(d)).value())}).value())) {}
  [[nodiscard]] rota::problem<names, rota::no_beliefs> problem() const { return {type, team, beliefs}; }
};

rota::plan_description<names, rota::no_beliefs>
description(std::function<std::optional<double>(names::agent, names::task, rota::no_beliefs)> u) {
  rota::plan_description<names, rota::no_beliefs> d;
  d.plan = names::plan(1);
  d.tasks = {{names::task(1), {}, {}}, {names::task(2), {}, {}}};
  d.utility = rota::additive_utility<names, rota::no_beliefs>(std::move(u));
  return d;
}

constexpr rota::in<names> at(int a, int t = 1, int p = 1) { return {names::agent(a), names::plan(p), names::task(t)}; }

TEST(validity, what_is_no_utility_is_named) {
  auto const infinity = std::numeric_limits<double>::infinity();
  std::map<double, utility_fault> const faults{
      {infinity, utility_fault::positive_infinity},
      {-infinity, utility_fault::negative_infinity},
      {2e9, utility_fault::out_of_range},
      {-2e9, utility_fault::out_of_range},
  };
  auto fault_of = [](double value, bool general) {
    auto d = description([=](auto a, auto, auto) { return a == names::agent(2) ? value : 1.0; });
    if (general) d.utility = rota::general_utility<names, rota::no_beliefs>{[=](auto, auto) { return value; }, {}};
    one_task_world const w(d);
    auto const report = validate(w.problem(), atoms_t{at(1), at(2), at(3)});
    EXPECT_EQ(report.size(), 1u);
    EXPECT_TRUE(report.violates(clause::utility));
    EXPECT_EQ(report.begin()->atom, general ? rota::in<names>{} : at(2));
    EXPECT_EQ(report.begin()->value, 0.0);
    return report.begin()->fault;
  };
  for (bool general : {false, true}) {
    EXPECT_EQ(fault_of(std::nan(""), general), utility_fault::not_a_number);
    for (auto const& [value, fault] : faults) EXPECT_EQ(fault_of(value, general), fault) << value;
  }
}

TEST(validity, a_function_that_throws_is_a_reason) {
  auto d = description([](auto a, auto, auto) -> std::optional<double> {
    if (a == names::agent(2)) throw 42;
    return 1.0;
  });
  d.precondition = [](auto, auto) -> bool { throw 42; };
  one_task_world const w(d);
  auto const report = validate(w.problem(), atoms_t{at(1), at(2)});
  ASSERT_EQ(report.size(), 2u);
  EXPECT_EQ(report.begin()->what, clause::precondition);
  EXPECT_EQ(report.begin()->fault, utility_fault::threw);
  EXPECT_EQ((report.begin() + 1)->what, clause::utility);
  EXPECT_EQ((report.begin() + 1)->fault, utility_fault::threw);
  EXPECT_EQ((report.begin() + 1)->atom, at(2));
}

TEST(validity, one_agent_has_one_task_and_one_state) {
  one_task_world const w(description([](auto, auto, auto) { return 1.0; }));
  using atom = rota::in_state<names>;
  auto with = [](int a, int t, int z) {
    return atom{names::agent(a), names::plan(1), names::task(t), names::state(z)};
  };
  EXPECT_TRUE(validate(w.problem(), rota::atom_set<atom>{with(1, 1, 5), with(2, 1, 6)}).valid());
  auto const states = validate(w.problem(), rota::atom_set<atom>{with(1, 1, 5), with(1, 1, 6), with(2, 1, 5)});
  ASSERT_EQ(states.size(), 1u);
  EXPECT_EQ(states.begin()->what, clause::one_task);
  EXPECT_EQ(states.begin()->state, names::state(5));
  EXPECT_EQ(states.begin()->other_state, names::state(6));
  EXPECT_EQ(states.begin()->atom, states.begin()->other);
  // Without states the two atoms are one.
  EXPECT_TRUE(validate(w.problem(), atoms_t{at(1), at(1)}).valid());
  auto const tasks = validate(w.problem(), rota::atom_set<atom>{with(1, 1, 5), with(1, 2, 5)});
  ASSERT_EQ(tasks.size(), 1u);
  EXPECT_EQ(tasks.begin()->other.task, names::task(2));
}

TEST(validity, users_functions_are_asked_about_nothing_the_problem_does_not_know) {
  std::set<std::pair<int, int>> asked;
  auto d = description([&](names::agent a, names::task t, auto) {
    asked.insert({static_cast<int>(a), static_cast<int>(t)});
    return 1.0;
  });
  d.precondition = [&](auto, rota::allocation_view<names> c) {
    for (auto const& x : c) asked.insert({static_cast<int>(x.agent), static_cast<int>(x.task)});
    return true;
  };
  one_task_world const w(d);
  auto const report = validate(w.problem(), atoms_t{at(1), at(7), at(2, 9), at(3, 1, 5)});
  EXPECT_EQ(asked, (std::set<std::pair<int, int>>{{1, 1}}));
  EXPECT_TRUE(report.violates(clause::stranger));
  EXPECT_TRUE(report.violates(clause::foreign_task));
  EXPECT_TRUE(report.violates(clause::one_plan));
}

TEST(validity, a_total_beyond_the_greatest_is_no_utility) {
  for (std::size_t const parts : {1024u, 1025u}) {
    rota::weighted_sum<names, rota::no_beliefs> sum(parts);
    for (auto& part : sum) part.part = [](auto, auto, auto) { return rota::max_utility; };
    auto d = description({});
    d.utility = sum;
    one_task_world const w(d);
    auto const report = validate(w.problem(), atoms_t{at(1)});
    EXPECT_EQ(report.valid(), parts == 1024);
    if (!report) {
      EXPECT_EQ(report.begin()->fault, utility_fault::out_of_range);
    }
    EXPECT_EQ(evaluate(w.problem(), *w.type.find(names::plan(1)), atoms_t{at(1)}).has_value(), parts == 1024);
  }
}

TEST(validity, a_plan_outside_the_type_and_an_unknown_plan) {
  one_task_world const w(description([](auto, auto, auto) { return 1.0; }));
  auto d = description([](auto, auto, auto) { return 1.0; });
  d.plan = names::plan(4);
  auto const stray = plan_t::make(d).value();
  EXPECT_TRUE(validate(w.problem(), stray, atoms_t{}).violates(clause::one_plan));
  auto const unknown = validate(w.problem(), atoms_t{at(1, 1, 4), at(2, 1, 5)});
  EXPECT_EQ(unknown.size(), 2u);
  EXPECT_FALSE(unknown.plan());
}

TEST(fixed_point, nearest_unit_halves_away_from_zero) {
  constexpr double unit = 1.0 / 1048576.0;
  static_assert(rota::quantise(1.0).value().units == 1048576);
  EXPECT_EQ(rota::quantise(0.5 * unit).value().units, 1);
  EXPECT_EQ(rota::quantise(-0.5 * unit).value().units, -1);
  EXPECT_EQ(rota::quantise(0.49 * unit).value().units, 0);
  EXPECT_EQ(rota::quantise(rota::max_utility).value().units, std::int64_t{1} << 50);
  EXPECT_EQ(rota::quantise(std::nextafter(rota::max_utility, 1e300)).error(), utility_fault::out_of_range);
  EXPECT_EQ(rota::quantise(-rota::max_utility).value().units, -(std::int64_t{1} << 50));
}

RC_GTEST_PROP(fixed_point, sums_do_not_depend_on_their_order, (std::uint64_t seed)) {
  dice d(seed);
  std::vector<double> terms;
  for (int i = 0; i < 12; ++i) terms.push_back(std::ldexp(d.below(1000) - 500.0, d.below(40) - 25));
  auto sum = [&] {
    rota::fixed_utility total;
    for (double t : terms) RC_ASSERT(rota::checked_add(total, rota::quantise(t).value()));
    return total;
  };
  auto const before = sum();
  d.shuffle(terms);
  RC_ASSERT(sum() == before);
}

TEST(fixed_point, a_sum_beyond_64_bits_is_refused_and_changes_nothing) {
  rota::fixed_utility total{std::numeric_limits<std::int64_t>::max() - 1};
  EXPECT_TRUE(rota::checked_add(total, {1}));
  EXPECT_FALSE(rota::checked_add(total, {1}));
  EXPECT_EQ(total.units, std::numeric_limits<std::int64_t>::max());
}

TEST(hysteresis, the_margin_is_exact_and_never_overflows) {
  auto fixed = [](double u) { return rota::quantise(u).value(); };
  EXPECT_FALSE(rota::detail::beats(fixed(1.5), fixed(1), rota::detail::margin_of(0.5)));
  EXPECT_TRUE(rota::detail::beats({fixed(1.5).units + 1}, fixed(1), rota::detail::margin_of(0.5)));
  EXPECT_FALSE(rota::detail::beats(fixed(1), fixed(1), rota::detail::margin_of(0)));
  EXPECT_FALSE(rota::detail::beats(fixed(rota::max_utility), fixed(0), rota::detail::margin_of(1e300)));
}

}  // namespace
