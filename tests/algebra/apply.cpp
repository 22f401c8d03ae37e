// What the laws do not say: where composites apply, and which sequences are runs. The laws are in
// tests/testing/apply.cpp.

#include "algebra/universe.hpp"

#include <rota/algebra/associativity.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace action_test {

namespace {

using namespace universe;
using rota::sign;

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

TEST(action, a_composite_may_apply_where_its_parts_do_not) {
  auto const x = nth(0);
  atom_set const c{x};
  EXPECT_FALSE(rota::applicable(event::addition(x), c));
  EXPECT_TRUE(rota::applicable(compose(event::addition(x), event::subtraction(x)), c));
}

// Runs ----------------------------------------------------------------------------------------------------------------

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

TEST(run, brackets_may_agree_without_being_a_run) {
  auto const s = event::addition(nth(0));
  EXPECT_TRUE(rota::associates(s, s, s));
  EXPECT_FALSE(alternates({s, s, s}, 1));
  EXPECT_EQ(sum_of({s, s, s})(nth(0)), 3) << "the sum does leave {-1, 0, 1}";
}

TEST(run, a_permuted_run_may_depend_on_brackets) {
  auto const s = event::addition(nth(0));
  auto const t = event::subtraction(nth(0));
  EXPECT_TRUE(applies_from({}, {s, t, s}));
  EXPECT_TRUE(rota::associates(s, t, s));
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

}  // namespace action_test
