// Events acting on sets: the unique applicable event, refusals, the functor into the group, and the theorem on runs.

#include "algebra/generators.hpp"
#include "algebra/laws.hpp"
#include "algebra/models.hpp"

#include <rota/algebra/associativity.hpp>

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace universe;
using models::action;
using rota::sign;

std::size_t offending_atoms(event const& e, atom_set const& c) {
  auto const target = delta(c) + delta(e);
  return static_cast<std::size_t>(
      std::count_if(target.begin(), target.end(), [](auto const& x) { return x.count != 1; }));
}

delta sum_of(std::vector<event> const& list) {
  delta sum;
  for (auto const& e : list) sum += delta(e);
  return sum;
}

bool alternates(std::vector<event> const& list, std::size_t atoms) {
  for (std::size_t i = 0; i < atoms; ++i) {
    sign last = sign::zero;
    for (auto const& e : list) {
      sign const s = e(nth(i));
      if (s != sign::zero && s == last) return false;
      if (s != sign::zero) last = s;
    }
  }
  return true;
}

bool applies_from(atom_set c, std::vector<event> const& list) {
  for (auto const& e : list) {
    auto const next = rota::apply(e, c);
    if (!next.has_value()) return false;
    c = *next;
  }
  return true;
}

}  // namespace

// One event -----------------------------------------------------------------------------------------------------------

TEST(action, laws_on_every_set_and_event_over_two_atoms) {
  EXPECT_EQ((laws::broken_action_laws<action, delta>(every_event(2), every_set(2))), laws::law_names{});
}

TEST(action, exactly_one_applicable_event_leads_from_one_set_to_another) {
  auto const events = every_event(3);
  auto const sets = every_set(3);
  ASSERT_EQ(events.size(), 27u);
  ASSERT_EQ(sets.size(), 8u);
  for (auto const& c : sets) {
    int applicable_here = 0;
    for (auto const& e : events) applicable_here += rota::applicable(e, c);
    EXPECT_EQ(applicable_here, 8) << "one for each target";
    for (auto const& d : sets) EXPECT_TRUE(laws::unique_applicable_event<action>(events, c, d)) << c << " to " << d;
  }
}

RC_GTEST_PROP(action, difference_is_the_pair_of_set_differences, ()) {
  auto const n = *atom_count().as("atoms");
  auto const c = *set_over(n).as("C");
  auto const d = *set_over(n).as("C'");
  std::set<atom> const mc(c.begin(), c.end());
  std::set<atom> const md(d.begin(), d.end());
  auto const e = rota::difference(c, d);
  for (std::size_t i = 0; i < n; ++i)
    RC_ASSERT(to_int(e(nth(i))) == int(md.contains(nth(i))) - int(mc.contains(nth(i))));
  RC_ASSERT(models::events::valid(e));
  RC_ASSERT(rota::difference(d, c) == inverse(e));
  RC_ASSERT(rota::applicable(e, c));
  RC_ASSERT(*rota::apply(e, c) == d);
}

RC_GTEST_PROP(action, characteristic_function_of_the_result_is_the_sum, ()) {
  auto const t = *attempts().as("e at C");
  RC_ASSERT(laws::characteristic_adds<action>(t.e, t.c));
}

RC_GTEST_PROP(action, refuses_iff_the_sum_leaves_the_sets_and_names_the_least_atom, ()) {
  auto const [e, c] = *attempts().as("e at C");
  auto const before = c;
  RC_ASSERT((laws::refuses_iff_it_leaves_the_sets<action, delta>(e, c)));
  RC_ASSERT((laws::refusal_names_the_least_atom<action, delta>(e, c)));
  RC_ASSERT(c == before);
  // Applicability in the words of the definition: ϑ⁺ ∩ C = ∅ and ϑ⁻ ⊆ C.
  bool const by_definition = intersect(e.additions(), c).empty() && is_subset(e.subtractions(), c);
  RC_ASSERT(rota::applicable(e, c) == by_definition);
  if (by_definition) RC_ASSERT(*rota::apply(e, c) == unite(subtract(c, e.subtractions()), e.additions()));
}

TEST(action, attempts_are_applicable_and_not_both_often) {
  constexpr int cases = 2000;
  int applicable = 0;
  int refused = 0;
  int several = 0;
  for (int k = 0; k < cases; ++k) {
    auto const [e, c] = sample(attempts(), k);
    applicable += !e.empty() && offending_atoms(e, c) == 0;
    refused += offending_atoms(e, c) > 0;
    several += offending_atoms(e, c) > 1;
  }
  std::printf("of %d attempts %d apply and change something, %d do not apply, %d of these at several atoms\n", cases,
              applicable, refused, several);
  EXPECT_GE(applicable, cases / 5);
  EXPECT_GE(refused, cases / 5);
  EXPECT_GE(several, cases / 5);
}

// Two events ----------------------------------------------------------------------------------------------------------

RC_GTEST_PROP(action, difference_is_a_functor, ()) {
  auto const n = *atom_count().as("atoms");
  auto const c = *set_over(n).as("C");
  auto const d = *set_over(n).as("C'");
  auto const e = *set_over(n).as("C''");
  RC_ASSERT(laws::difference_is_a_functor<action>(c, d, e));
  // … and ι∘diff into the group, where no clamp helps.
  RC_ASSERT(delta(rota::difference(c, d)) + delta(rota::difference(d, e)) == delta(rota::difference(c, e)));
}

RC_GTEST_PROP(action, apply_is_compatible_with_compose, ()) {
  auto const h = *histories().as("history");
  auto c = h.start;
  event composed;
  for (auto const& e : h.run) {
    RC_ASSERT(laws::apply_is_compatible_with_compose<action>(composed, e, h.start));
    c = *rota::apply(e, c);
    composed = compose(composed, e);
    RC_ASSERT(*rota::apply(composed, h.start) == c);
  }
}

TEST(action, a_composite_may_apply_where_its_parts_do_not) {
  auto const x = nth(0);
  atom_set const c{x};
  EXPECT_FALSE(rota::applicable(event::addition(x), c));
  EXPECT_TRUE(rota::applicable(compose(event::addition(x), event::subtraction(x)), c));
}

// Runs ----------------------------------------------------------------------------------------------------------------

RC_GTEST_PROP(run, every_bracketing_is_one_event_the_clamped_sum_which_needs_no_clamp, ()) {
  auto const h = *histories().as("history");
  RC_ASSERT(applies_from(h.start, h.run));
  auto const sum = sum_of(h.run);
  for (auto const& x : sum) RC_ASSERT((x.count == 1 || x.count == -1));
  RC_ASSERT(laws::brackets_do_not_matter<action>(h.run));
  RC_ASSERT(laws::left_fold_is_clamped_sum<action>(h.run));
  for (auto const& e : laws::every_bracketing<action>(h.run, 0, h.run.size())) RC_ASSERT(delta(e) == sum);
}

TEST(run, a_run_of_length_six_has_forty_two_bracketings) {
  std::vector<event> const six(6);
  EXPECT_EQ(laws::every_bracketing<action>(six, 0, 6).size(), 42u);
}

TEST(run, consecutively_applicable_from_somewhere_iff_signs_alternate) {
  auto const events = every_event(2);
  auto const sets = every_set(2);
  int runs = 0;
  for (auto const& e : events)
    for (auto const& f : events)
      for (auto const& g : events) {
        std::vector<event> const list{e, f, g};
        bool const somewhere =
            std::any_of(sets.begin(), sets.end(), [&](atom_set const& c) { return applies_from(c, list); });
        EXPECT_EQ(somewhere, alternates(list, 2)) << e << f << g;
        runs += somewhere;
        EXPECT_TRUE(!somewhere || rota::associates(e, f, g));
      }
  EXPECT_EQ(runs, 15 * 15) << "per atom 15 of the 27 sign triples alternate";
}

TEST(run, histories_alternate_often_and_unrestricted_sequences_break_the_theorem) {
  constexpr int cases = 1000;
  int alternating = 0;
  int broken = 0;
  auto const unrestricted = events_over(2, 5);
  for (int k = 0; k < cases; ++k) {
    auto const h = sample(histories(), k);
    // Some atom comes, goes and comes again (or the other way round).
    bool thrice = false;
    for (std::size_t i = 0; i < 6; ++i)
      thrice |= std::count_if(h.run.begin(), h.run.end(), [&](event const& e) { return e(nth(i)) != sign::zero; }) >= 3;
    alternating += thrice;
    broken += !laws::brackets_do_not_matter<action>(sample(unrestricted, k));
  }
  std::printf("of %d histories %d move an atom three times; of as many unrestricted sequences %d depend on brackets\n",
              cases, alternating, broken);
  EXPECT_GE(alternating, cases / 5);
  EXPECT_GE(broken, cases / 5);
}

TEST(run, brackets_may_agree_without_being_a_run) {
  auto const s = event::addition(nth(0));
  EXPECT_TRUE(laws::brackets_do_not_matter<action>(std::vector{s, s}));
  EXPECT_FALSE(alternates({s, s}, 1));
  EXPECT_EQ(sum_of({s, s})(nth(0)), 2) << "the sum does leave {-1, 0, 1}";
}

TEST(run, a_permuted_run_may_depend_on_brackets) {
  auto const s = event::addition(nth(0));
  auto const t = event::subtraction(nth(0));
  EXPECT_TRUE(applies_from({}, {s, t, s}));
  EXPECT_TRUE(laws::brackets_do_not_matter<action>(std::vector{s, t, s}));
  EXPECT_EQ(compose(compose(s, t), s), s);
  EXPECT_EQ(compose(compose(s, s), t), event{});
  EXPECT_EQ(compose(s, compose(s, t)), s);
  EXPECT_EQ(sum_of({s, t, s}), sum_of({s, s, t})) << "deltas do not care";
}

namespace {

constexpr bool action_at_compile_time() {
  using set = rota::atom_set<int>;
  set const before{1, 2};
  set const after{2, 3};
  auto const e = rota::difference(before, after);
  return e(1) == sign::minus && e(2) == sign::zero && e(3) == sign::plus && rota::applicable(e, before) &&
         !rota::applicable(e, after) && *rota::apply(e, before) == after &&
         rota::apply(e, after).error().witness == 1 && rota::difference(before, before).empty();
}
static_assert(action_at_compile_time());

}  // namespace
