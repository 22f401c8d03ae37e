// Atom sets against std::set, and events: Def. 3 and 4 to the letter, and the laws that they do not obey. The laws that
// they obey are in tests/testing/events.cpp.

#include "algebra/generators.hpp"
#include "support/allocation_counter.hpp"

#include <rota/algebra/associativity.hpp>
#include <rota/algebra/fingerprint.hpp>
#include <rota/algebra/transition.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace event_test {

namespace {

using namespace universe;
using model = std::set<atom>;
using rota::sign;

model to_model(atom_set const& c) { return {c.begin(), c.end()}; }

model minus(model const& c, model const& d) {
  model r;
  std::set_difference(c.begin(), c.end(), d.begin(), d.end(), std::inserter(r, r.end()));
  return r;
}
model either(model c, model const& d) {
  c.insert(d.begin(), d.end());
  return c;
}
model both(model const& c, model const& d) {
  model r;
  for (auto const& x : c)
    if (d.contains(x)) r.insert(x);
  return r;
}

/// Def. 4 as printed, on pairs of std::set; it shares no code with the library.
struct printed {
  model plus;
  model minus;
  friend bool operator==(printed const&, printed const&) = default;
};
printed print(event const& e) { return {to_model(e.additions()), to_model(e.subtractions())}; }
printed definition_4(printed const& e1, printed const& e2) {
  return {either(minus(e1.plus, e2.minus), minus(e2.plus, e1.minus)),
          either(minus(e1.minus, e2.plus), minus(e2.minus, e1.plus))};
}

}  // namespace

// Atom sets -----------------------------------------------------------------------------------------------------------

RC_GTEST_PROP(atom_set, is_std_set, ()) {
  auto const n = *atom_count().as("atoms");
  auto const atoms = *integers(40, 0, static_cast<int>(n) - 1).as("atoms");
  auto const moves = *integers(40, 0, 29).as("moves: 0 clears, below 13 erases, else inserts");
  atom_set c;
  model m;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    auto const x = nth(static_cast<std::size_t>(atoms[i]));
    auto const what = moves[i];
    if (what == 0) {
      c.clear();
      m.clear();
    } else if (what < 13) {
      RC_ASSERT(c.erase(x) == (m.erase(x) == 1));
    } else {
      RC_ASSERT(c.insert(x) == m.insert(x).second);
    }
    RC_ASSERT(std::equal(c.begin(), c.end(), m.begin(), m.end()));
    RC_ASSERT(c.size() == m.size());
    RC_ASSERT(c.empty() == m.empty());
    RC_ASSERT(c.atoms().size() == m.size());
    for (std::size_t k = 0; k < n; ++k) RC_ASSERT(c.contains(nth(k)) == m.contains(nth(k)));
  }
}

RC_GTEST_PROP(atom_set, set_operations_are_those_of_std_set, ()) {
  auto const n = *atom_count().as("atoms");
  auto const c = *set_over(n).as("C");
  auto const d = *set_over(n).as("D");
  auto const mc = to_model(c);
  auto const md = to_model(d);
  RC_ASSERT(to_model(unite(c, d)) == either(mc, md));
  RC_ASSERT(to_model(intersect(c, d)) == both(mc, md));
  RC_ASSERT(to_model(subtract(c, d)) == minus(mc, md));
  RC_ASSERT(is_subset(c, d) == minus(mc, md).empty());
  RC_ASSERT((c == d) == (mc == md));
  RC_ASSERT((c <=> d) == (mc <=> md));
}

RC_GTEST_PROP(atom_set, construction_forgets_order_and_repetition, ()) {
  auto const n = *atom_count().as("atoms");
  auto const picks = *integers(30, 0, static_cast<int>(n) - 1).as("picks");
  std::vector<atom> list;
  for (auto const i : picks) list.push_back(nth(static_cast<std::size_t>(i)));
  atom_set const c(list.begin(), list.end());
  RC_ASSERT(to_model(c) == model(list.begin(), list.end()));
  RC_ASSERT(c.size() == model(list.begin(), list.end()).size());
}

TEST(atom_set, subsets_and_their_order_on_every_pair) {
  auto const sets = every_set(4);
  ASSERT_EQ(sets.size(), 16u);
  for (auto const& c : sets)
    for (auto const& d : sets) {
      EXPECT_EQ(is_subset(c, d), unite(c, d) == d);
      EXPECT_EQ(is_subset(c, d), intersect(c, d) == c);
      EXPECT_EQ(unite(subtract(c, d), intersect(c, d)), c);
      EXPECT_TRUE(intersect(subtract(c, d), d).empty());
      EXPECT_EQ((c < d) + (d < c) + (c == d), 1);
    }
}

TEST(atom_set, up_to_eight_atoms_allocate_nothing) {
  auto const before = rota_test::allocation_count();
  atom_set c;
  for (std::size_t i = 8; i > 0; --i) c.insert(nth(i));
  auto const d = c;
  auto const allocations = rota_test::allocation_count() - before;
  EXPECT_EQ(d.size(), 8u);
  EXPECT_EQ(allocations, 0u);
}

// Def. 3 --------------------------------------------------------------------------------------------------------------

RC_GTEST_PROP(event, make_refuses_overlapping_sets_with_the_least_witness, ()) {
  auto const n = *atom_count().as("atoms");
  auto const additions = *set_over(n).as("additions");
  auto const subtractions = *set_over(n).as("subtractions");
  auto const shared = both(to_model(additions), to_model(subtractions));
  RC_CLASSIFY(shared.empty(), "disjoint");
  RC_CLASSIFY(shared.size() > 1, "several witnesses");
  auto const e = event::make(additions, subtractions);
  RC_ASSERT(e.has_value() == shared.empty());
  if (e.has_value()) {
    RC_ASSERT(e->additions() == additions);
    RC_ASSERT(e->subtractions() == subtractions);
  } else {
    RC_ASSERT(e.error().witness == *shared.begin());
  }
}

TEST(event, disjoint_pairs_of_sets_are_sign_functions_one_to_one) {
  std::set<std::vector<int>> seen;
  int refused = 0;
  for (auto const& additions : every_set(4))
    for (auto const& subtractions : every_set(4)) {
      auto const e = event::make(additions, subtractions);
      refused += !e.has_value();
      if (!e.has_value()) continue;
      std::vector<int> signs;
      for (std::size_t i = 0; i < 4; ++i) {
        signs.push_back(to_int((*e)(nth(i))));
        EXPECT_EQ(signs.back(), int(additions.contains(nth(i))) - int(subtractions.contains(nth(i))));
      }
      EXPECT_EQ((*e)(nth(4)), sign::zero) << "finite support";
      EXPECT_TRUE(seen.insert(signs).second);
    }
  EXPECT_EQ(seen.size(), 81u) << "3 to the 4";
  EXPECT_EQ(refused, 256 - 81);
}

// Def. 4 --------------------------------------------------------------------------------------------------------------

RC_GTEST_PROP(event, compose_is_definition_4_to_the_letter, ()) {
  auto const n = *atom_count().as("atoms");
  auto const e = *event_over(n).as("e");
  auto const f = *event_over(n).as("f");
  RC_ASSERT(print(compose(e, f)) == definition_4(print(e), print(f)));
}

TEST(event, compose_is_definition_4_on_every_pair_over_three_atoms) {
  auto const all = every_event(3);
  ASSERT_EQ(all.size(), 27u);
  for (auto const& e : all)
    for (auto const& f : all) EXPECT_EQ(print(compose(e, f)), definition_4(print(e), print(f)));
}

RC_GTEST_PROP(event, compose_is_definition_4_at_any_ratio_of_sizes, ()) {
  auto const n = static_cast<std::size_t>(*integer(1, 200).as("atoms"));
  auto const e = *event_over(n).as("e");
  std::vector<int> few(n);
  for (int const i : *integers(static_cast<std::size_t>(*integer(0, 6).as("how many")), 0, int(n) - 1).as("which"))
    few[static_cast<std::size_t>(i)] = i % 2 == 0 ? 1 : -1;
  auto const f = event_of(few);
  RC_CLASSIFY(e.size() > 16 * f.size(), "lopsided");
  auto const r = compose(e, f);
  RC_ASSERT(print(r) == definition_4(print(e), print(f)));
  RC_ASSERT(compose(f, e) == r);
}

TEST(event, up_to_eight_entries_compose_without_the_heap) {
  auto const e = event_of({1, -1, 1, -1});
  auto const f = event_of({0, 0, 0, 1, 1, 1, -1});
  auto const before = rota_test::allocation_count();
  auto const r = compose(e, f);
  auto const allocations = rota_test::allocation_count() - before;
  EXPECT_EQ(r.size(), 6u);
  EXPECT_EQ(allocations, 0u);
}

TEST(event, whatever_is_done_to_up_to_eight_entries_allocates_nothing) {
  atom_set c, d;
  for (std::size_t i = 0; i < 4; ++i) {
    c.insert(nth(i));
    d.insert(nth(i + 2));
  }
  auto const before = rota_test::allocation_count();
  auto const e = rota::difference(c, d);
  auto const back = inverse(e);
  bool const right = *rota::apply(e, c) == d && !rota::apply(back, c) && rota::applicable(back, d) &&
                     compose(e, back).empty() && *event::make(e.additions(), e.subtractions()) == e &&
                     associates(e, back, e) && non_associating_atoms(e, e, back).size() == 4 &&
                     (delta(e) + delta(back)).empty() && clamp(2 * delta(e)) == e && delta(c) + delta(e) == delta(d) &&
                     fingerprint_of(c) + fingerprint_of(e) == fingerprint_of(d) &&
                     compose(rota::transition{c, d}, rota::transition{d, c}).target() == c;
  auto const allocations = rota_test::allocation_count() - before;
  EXPECT_TRUE(right);
  EXPECT_EQ(allocations, 0u);
}

RC_GTEST_PROP(event, compose_and_inverse_are_pointwise, ()) {
  auto const n = *atom_count().as("atoms");
  auto const e = *event_over(n).as("e");
  auto const f = *event_over(n).as("f");
  for (std::size_t i = 0; i < n; ++i) {
    auto const x = nth(i);
    RC_ASSERT(compose(e, f)(x) == clamped_sum(e(x), f(x)));
    RC_ASSERT(to_int(inverse(e)(x)) == -to_int(e(x)));
  }
}

// What Def. 4 is not --------------------------------------------------------------------------------------------------

TEST(event, shortest_refutation_of_associativity) {
  for (auto const& e : every_event(3)) {
    auto const left = compose(compose(e, e), inverse(e));
    auto const right = compose(e, compose(e, inverse(e)));
    EXPECT_TRUE(left.empty());
    EXPECT_EQ(right, e);
    EXPECT_EQ(left == right, e.empty());
  }
}

TEST(event, cancellation_fails_at_every_event_but_the_identity) {
  for (auto const& e : every_event(3)) {
    EXPECT_EQ(compose(e, e), compose(e, event{}));
    EXPECT_EQ(e == event{}, e.empty());
  }
}

namespace {

constexpr std::array every_sign{sign::minus, sign::zero, sign::plus};

constexpr int count_bad_sign_triples() {
  int bad = 0;
  for (sign s : every_sign)
    for (sign t : every_sign)
      for (sign u : every_sign) bad += clamped_sum(clamped_sum(s, t), u) != clamped_sum(s, clamped_sum(t, u));
  return bad;
}
constexpr bool criterion_is_exact() {
  for (sign s : every_sign)
    for (sign t : every_sign)
      for (sign u : every_sign)
        if (rota::brackets_matter(s, t, u) != (clamped_sum(clamped_sum(s, t), u) != clamped_sum(s, clamped_sum(t, u))))
          return false;
  return true;
}
constexpr sign p = sign::plus;
constexpr sign m = sign::minus;
static_assert(count_bad_sign_triples() == 4, "of 27");
static_assert(criterion_is_exact());
static_assert(rota::brackets_matter(p, p, m) && rota::brackets_matter(m, p, p) && rota::brackets_matter(m, m, p) &&
              rota::brackets_matter(p, m, m));

}  // namespace

TEST(event, associativity_fails_for_most_unrestricted_triples) {
  // Independent uniform signs on 20 atoms: 1 - (23/27)^20 = 0.96. A property that "passes" here tests nothing.
  auto const signs = integers(60, -1, 1);
  constexpr int cases = 2000;
  int fail = 0;
  for (int k = 0; k < cases; ++k) {
    auto const s = sample(signs, k);
    auto const uniform = [&](int i) { return event_of({s.begin() + 20 * i, s.begin() + 20 * (i + 1)}); };
    auto const e = uniform(0), f = uniform(1), g = uniform(2);
    fail += compose(compose(e, f), g) != compose(e, compose(f, g));
  }
  EXPECT_NEAR(double(fail) / cases, 0.96, 0.02);
}

// Any ordered atom, any time ------------------------------------------------------------------------------------------

/// An order without <=>, as types had it before C++20.
struct old_style {
  int value = 0;
  friend constexpr bool operator==(old_style a, old_style b) { return a.value == b.value; }
  friend constexpr bool operator<(old_style a, old_style b) { return a.value < b.value; }
  friend constexpr bool operator>(old_style a, old_style b) { return b < a; }
  friend constexpr bool operator<=(old_style a, old_style b) { return !(b < a); }
  friend constexpr bool operator>=(old_style a, old_style b) { return !(a < b); }
};

namespace {

constexpr bool algebra_at_compile_time() {
  using numbers = rota::atom_set<int>;
  using signs = rota::event<int>;
  auto const e = signs::make(numbers{1, 2}, numbers{3}).value();
  auto const f = signs::make(numbers{3}, numbers{1}).value();
  return compose(e, f) == signs::addition(2) && compose(e, inverse(e)).empty() &&
         signs::make(numbers{1, 2, 3}, numbers{4, 3, 2}).error().witness == 2 &&
         rota::non_associating_atoms(e, e, inverse(e)) == numbers{1, 2, 3} && rota::associates(e, f, e) &&
         !rota::associates(e, f, f) && unite(numbers{5, 1}, numbers{1, 3}) == numbers{1, 3, 5} && e(3) == sign::minus;
}
static_assert(algebra_at_compile_time());

static_assert(rota::ordered_atom<int> && rota::ordered_atom<std::string> && rota::ordered_atom<atom>);
static_assert(rota::ordered_atom<atom_set> && rota::ordered_atom<event>, "sets and events can be atoms themselves");
static_assert(!rota::ordered_atom<double>, "NaN makes the order partial");
static_assert(!rota::ordered_atom<std::optional<double>> && !rota::ordered_atom<std::pair<int, float>>, "as here");
constexpr auto old_style_event = rota::event<old_style>::make({old_style{1}}, {old_style{2}}).value();
static_assert(compose(old_style_event, inverse(old_style_event)).empty());
static_assert(!std::convertible_to<atom_set, event> && !std::constructible_from<event, atom_set>);

template <class E>
concept has_plus = requires(E e) { e + e; };
static_assert(!has_plus<event>, "an operator would promise that brackets do not matter");

}  // namespace

TEST(event, atoms_may_own_memory) {
  using strings = rota::atom_set<std::string>;
  using on_strings = rota::event<std::string>;
  std::string const x(40, 'x');
  std::string const y(40, 'y');
  auto const e = on_strings::make(strings{x}, strings{y}).value();
  EXPECT_EQ(rota::compose(e, rota::inverse(e)), on_strings{});
  EXPECT_EQ(rota::compose(e, on_strings::addition(y)), on_strings::addition(x));
  EXPECT_EQ(rota::compose(e, e), e);
}

TEST(event, many_atoms_may_own_memory) {
  auto const name = [](int i) { return std::string(30, 'x') + std::to_string(100 + i); };
  rota::event<std::string> e, f;
  rota::event<int> on_numbers_e, on_numbers_f;
  for (int i = 0; i < 90; ++i) {
    auto const add = [&](auto& strings, auto& numbers) {
      using on_strings = rota::event<std::string>;
      using on_numbers = rota::event<int>;
      bool const plus = i % 7 < 3;
      strings = compose(strings, plus ? on_strings::addition(name(i)) : on_strings::subtraction(name(i)));
      numbers = compose(numbers, plus ? on_numbers::addition(i) : on_numbers::subtraction(i));
    };
    if (i % 2 == 0) add(e, on_numbers_e);
    if (i % 3 == 0) add(f, on_numbers_f);
  }
  f = rota::inverse(f);  // so that common atoms cancel
  auto const r = compose(e, f);
  auto const expected = compose(on_numbers_e, rota::inverse(on_numbers_f));
  ASSERT_EQ(r.size(), expected.size());
  EXPECT_EQ(r.size(), 45u);
  for (std::size_t i = 0; i < r.size(); ++i) {
    EXPECT_EQ(r.begin()[i].atom, name(expected.begin()[i].atom));
    EXPECT_EQ(r.begin()[i].value, expected.begin()[i].value);
  }
}

namespace {

constexpr bool long_events_compose_at_compile_time() {
  rota::atom_set<int> even, third;
  for (int i = 0; i < 60; ++i) {
    if (i % 2 == 0) even.insert(i);
    if (i % 3 == 0) third.insert(i);
  }
  auto const e = rota::event<int>::make(even, {}).value();
  auto const f = rota::event<int>::make({}, third).value();
  auto const one = rota::event<int>::subtraction(30);
  return compose(e, f).size() == 30 && compose(e, f)(6) == sign::zero && compose(e, one).size() == 29;
}
static_assert(long_events_compose_at_compile_time());

}  // namespace

#ifndef NDEBUG
TEST(event_death, entries_out_of_order_or_zero_are_asserted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  using entries = rota::small_vector<rota::signed_atom<int>, 8>;
  EXPECT_DEATH((void)rota::event<int>::from_entries(entries{{2, sign::plus}, {1, sign::plus}}), "atom");
  EXPECT_DEATH((void)rota::event<int>::from_entries(entries{{1, sign::plus}, {1, sign::minus}}), "atom");
  EXPECT_DEATH((void)rota::event<int>::from_entries(entries{{1, sign::zero}}), "zero");
}
#endif

}  // namespace event_test
