// Deltas at each atom: sums, multiples, embedding and clamp, extension, overflow. The laws by name are in
// tests/testing/deltas.cpp.

#include "algebra/generators.hpp"

#include <concepts>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace delta_test {

namespace {

using namespace universe;
using model = std::map<atom, std::int64_t>;
using small_delta = rota::delta<atom, std::int8_t>;

/// Pointwise sum on maps that keep no zero: Z^(Atoms) without the library's merge.
model pointwise_sum(model d, model const& e) {
  for (auto const& [x, n] : e)
    if ((d[x] += n) == 0) d.erase(x);
  return d;
}
model to_model(delta const& d) {
  model m;
  for (auto const& x : d) m[x.atom] = x.count;
  return m;
}
model pointwise(std::vector<int> const& counts) {
  model m;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] != 0) m[nth(i)] = counts[i];
  return m;
}

/// An integer type that is no std::integral, as big integers are: wide enough here to be exact.
__extension__ using int128 = __int128;
struct wide {
  int128 value = 0;
  constexpr wide() = default;
  constexpr wide(int v) : value(v) {}
  constexpr explicit wide(int128 v) : value(v) {}
  friend constexpr auto operator<=>(wide, wide) = default;
  friend constexpr wide operator+(wide a, wide b) { return wide(a.value + b.value); }
  friend constexpr wide operator*(wide a, wide b) { return wide(a.value * b.value); }
};

auto scalar() { return integer(-9, 9); }

/// An abelian group that is neither free nor cyclic: (Z/5) x (Z/12). Sums of random elements vanish often.
struct residues {
  int five = 0;
  int twelve = 0;
  friend bool operator==(residues, residues) = default;
  friend residues operator+(residues a, residues b) { return {(a.five + b.five) % 5, (a.twelve + b.twelve) % 12}; }
  friend residues operator*(std::int64_t n, residues a) {
    auto const times = [n](int r, int modulus) { return static_cast<int>(((n * r) % modulus + modulus) % modulus); };
    return {times(a.five, 5), times(a.twelve, 12)};
  }
};

/// An arbitrary map Atoms -> G, as a table.
struct table {
  std::vector<int> fives;
  std::vector<int> twelves;
  residues operator()(atom const& x) const {
    for (std::size_t i = 0; i < fives.size(); ++i)
      if (nth(i) == x) return {fives[i], twelves[i]};
    return {};
  }
};
table map_into_residues(std::size_t atoms) {
  return {*integers(atoms, 0, 4).as("f mod 5"), *integers(atoms, 0, 11).as("f mod 12")};
}

}  // namespace

// Z^(Atoms) -----------------------------------------------------------------------------------------------------------

RC_GTEST_PROP(delta, is_the_function_it_was_built_from, ()) {
  auto const n = *atom_count().as("atoms");
  auto const counts = *values(n, -4, 4).as("counts");
  auto const d = delta_of(counts);
  RC_ASSERT(to_model(d) == pointwise(counts));
  for (std::size_t i = 0; i < n; ++i) RC_ASSERT(d(nth(i)) == counts[i]);
  RC_ASSERT(d(nth(n)) == 0);
  RC_ASSERT(d.size() == pointwise(counts).size());
  RC_ASSERT(d.empty() == (d == delta{}));
}

RC_GTEST_PROP(delta, sums_and_multiples_are_pointwise, ()) {
  auto const n = *atom_count().as("atoms");
  auto const a = *values(n, -4, 4).as("d");
  auto const b = *values(n, -4, 4).as("e");
  auto const k = *scalar().as("k");
  auto const d = delta_of(a);
  auto const e = delta_of(b);
  RC_ASSERT(to_model(d + e) == pointwise_sum(pointwise(a), pointwise(b)));
  for (std::size_t i = 0; i < n; ++i) {
    RC_ASSERT((d - e)(nth(i)) == a[i] - b[i]);
    RC_ASSERT((-d)(nth(i)) == -a[i]);
    RC_ASSERT((k * d)(nth(i)) == k * a[i]);
  }
  auto in_place = d;
  in_place += e;
  RC_ASSERT(in_place == d + e);
  in_place -= e;
  RC_ASSERT(in_place == d);
  in_place += in_place;
  RC_ASSERT(in_place == 2 * d);
  in_place -= in_place;
  RC_ASSERT(in_place.empty());
}

RC_GTEST_PROP(delta, folds_agree_in_any_order_and_bracketing, ()) {
  auto const n = *atom_count().as("atoms");
  auto const list = *events_over(n, 6).as("events");
  delta left;
  for (auto const& e : list) left += delta(e);
  delta right;
  for (auto e = list.rbegin(); e != list.rend(); ++e) right = delta(*e) + right;
  auto const balanced =
      (delta(list[3]) + delta(list[0])) + ((delta(list[5]) + delta(list[1])) + (delta(list[4]) + delta(list[2])));
  RC_ASSERT(left == right);
  RC_ASSERT(left == balanced);
}

// Events inside the group ---------------------------------------------------------------------------------------------

RC_GTEST_PROP(delta, embedding_and_clamp_are_pointwise, ()) {
  auto const n = *atom_count().as("atoms");
  auto const e = *event_over(n).as("e");
  auto const c = *set_over(n).as("C");
  auto const counts = *values(n, -4, 4).as("d");
  auto const d = delta_of(counts);
  for (std::size_t i = 0; i < n; ++i) {
    RC_ASSERT(delta(e)(nth(i)) == to_int(e(nth(i))));
    RC_ASSERT(delta(c)(nth(i)) == int(c.contains(nth(i))));
    RC_ASSERT(clamp(d)(nth(i)) == to_sign(counts[i]));
  }
  RC_ASSERT(delta(inverse(e)) == -delta(e));  // both maps do respect inverses
  RC_ASSERT(clamp(-d) == inverse(clamp(d)));
}

TEST(delta, neither_embedding_nor_clamp_is_a_homomorphism) {
  auto const s = event::addition(nth(0));
  EXPECT_EQ(delta(compose(s, s)), delta(nth(0), 1));
  EXPECT_EQ(delta(s) + delta(s), delta(nth(0), 2));
  EXPECT_NE(delta(compose(s, s)), delta(s) + delta(s));

  delta const two(nth(0), 2);
  delta const minus_one(nth(0), -1);
  EXPECT_EQ(clamp(two + minus_one), s);
  EXPECT_EQ(compose(clamp(two), clamp(minus_one)), event{});
  EXPECT_NE(clamp(two + minus_one), compose(clamp(two), clamp(minus_one)));
}

TEST(delta, the_group_knows_what_the_clamp_forgets) {
  // (e∘e)∘e⁻¹ against e∘(e∘e⁻¹): one delta, two events.
  for (auto const& e : every_event(2)) {
    auto const sum = delta(e) + delta(e) + delta(inverse(e));
    EXPECT_EQ(sum, delta(e));
    EXPECT_EQ(clamp(sum), e);
  }
}

// The universal property ----------------------------------------------------------------------------------------------

RC_GTEST_PROP(delta, extend_is_the_only_homomorphism_with_these_values, ()) {
  // A homomorphism is fixed by its values on the generators: walk to d in steps of ±1 and follow with f.
  auto const n = *atom_count().as("atoms");
  auto const d = *delta_over(n).as("d");
  auto const f = map_into_residues(n);
  residues walked;
  for (auto const& x : d)
    for (std::int64_t k = 0; k < (x.count < 0 ? -x.count : x.count); ++k)
      walked = walked + (x.count < 0 ? residues{(5 - f(x.atom).five) % 5, (12 - f(x.atom).twelve) % 12} : f(x.atom));
  RC_ASSERT(extend(d, f, residues{}) == walked);
}

RC_GTEST_PROP(delta, extending_the_inclusion_of_generators_is_the_identity, ()) {
  auto const d = *delta_over(*atom_count().as("atoms")).as("d");
  RC_ASSERT(extend(d, [](atom const& x) { return delta(x, 1); }, delta{}) == d);
}

RC_GTEST_PROP(delta, extend_pushes_forward_along_maps_of_atoms, ()) {
  // Forgetting the task sends rivals of one agent to one atom, where they may cancel.
  auto const n = *atom_count().as("atoms");
  auto const d = *delta_over(n).as("d");
  using by_agent = rota::delta<names::agent>;
  auto const pushed = extend(d, [](atom const& x) { return by_agent(x.agent, 1); }, by_agent{});
  std::map<names::agent, std::int64_t> sums;
  for (auto const& x : d) sums[x.atom.agent] += x.count;
  for (auto const& [a, k] : sums) RC_ASSERT(pushed(a) == k);
  for (auto const& x : pushed) RC_ASSERT(x.count != 0);
}

// Bounded and exact coefficients --------------------------------------------------------------------------------------

TEST(delta, checked_sum_refuses_exactly_what_eight_bits_cannot_hold) {
  // All 65536 pairs at one atom, a second atom before it that is always fine.
  int refused = 0;
  for (int a = -128; a <= 127; ++a)
    for (int b = -128; b <= 127; ++b) {
      auto const d = small_delta(nth(1), static_cast<std::int8_t>(a));
      auto const e = small_delta(nth(0), 1) + small_delta(nth(1), static_cast<std::int8_t>(b));
      auto const sum = checked_sum(d, e);
      bool const fits = a + b >= -128 && a + b <= 127;
      ASSERT_EQ(sum.has_value(), fits) << a << " + " << b;
      if (fits) {
        ASSERT_EQ((*sum)(nth(1)), a + b);
        ASSERT_EQ((*sum)(nth(0)), 1);
        ASSERT_EQ(sum->size(), a + b == 0 ? 1u : 2u);
      } else {
        ASSERT_EQ(sum.error().witness, nth(1));
        ++refused;
      }
    }
  EXPECT_EQ(refused, 128 * 127 / 2 + 129 * 128 / 2);
}

TEST(delta, checked_sum_refuses_at_the_limits_of_64_bits) {
  using limits = std::numeric_limits<std::int64_t>;
  auto const at = [](std::int64_t n) { return delta(nth(3), n); };
  EXPECT_EQ(*checked_sum(at(limits::max()), at(limits::min())), at(-1));
  EXPECT_EQ(*checked_sum(at(limits::max() - 1), at(1)), at(limits::max()));
  EXPECT_EQ(*checked_sum(at(limits::min() + 1), at(-1)), at(limits::min()));
  EXPECT_EQ(checked_sum(at(limits::max()), at(1)).error().witness, nth(3));
  EXPECT_EQ(checked_sum(at(1), at(limits::max())).error().witness, nth(3));
  EXPECT_EQ(checked_sum(at(limits::min()), at(-1)).error().witness, nth(3));
  EXPECT_EQ(checked_sum(at(-1), at(limits::min())).error().witness, nth(3));
  EXPECT_EQ(checked_sum(at(limits::min()), at(limits::min())).error().witness, nth(3));
}

RC_GTEST_PROP(delta, checked_sum_is_exact_or_names_the_least_overflow, ()) {
  auto const n = *atom_count().as("atoms");
  auto const a = *values(n, -127, 127).as("d");
  auto const b = *values(n, -127, 127).as("e");
  std::size_t least = n;
  for (std::size_t i = n; i > 0; --i)
    if (a[i - 1] + b[i - 1] > 127 || a[i - 1] + b[i - 1] < -128) least = i - 1;
  RC_CLASSIFY(least == n, "fits");
  auto const sum = checked_sum(delta_of<std::int8_t>(a), delta_of<std::int8_t>(b));
  RC_ASSERT(sum.has_value() == (least == n));
  if (sum.has_value()) {
    for (std::size_t i = 0; i < n; ++i) RC_ASSERT((*sum)(nth(i)) == a[i] + b[i]);
  } else {
    RC_ASSERT(sum.error().witness == nth(least));
  }
}

RC_GTEST_PROP(delta, nothing_saturates_where_the_coefficients_are_exact, ()) {
  auto const n = *atom_count().as("atoms");
  auto const counts = *values(n, -9, 9).as("counts");
  auto const d = delta_of<wide>(counts);
  wide const huge(int128{1} << 100);
  auto const big = d * huge;
  RC_ASSERT(big.size() == d.size());
  for (std::size_t i = 0; i < n; ++i) RC_ASSERT((big(nth(i)) == huge * counts[i]));
  RC_ASSERT(checked_sum(big, big).has_value());
  RC_ASSERT(((big + big) - big == big));
  RC_ASSERT((big - big).empty());
  RC_ASSERT(clamp(big) == clamp(delta_of(counts)));
  RC_ASSERT(((big + d) - big == d));
}

#ifndef NDEBUG
TEST(delta_death, overflow_is_asserted_and_never_saturates) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  small_delta const d(nth(0), 127);
  EXPECT_DEATH((void)(d + d), "has_value");
  EXPECT_DEATH((void)(d * std::int8_t{2}), "product_fits");
  EXPECT_DEATH((void)-small_delta(nth(0), -128), "product_fits");
}
#endif

namespace {

static_assert(rota::integer_coefficient<std::int64_t> && rota::integer_coefficient<wide>);
static_assert(!rota::integer_coefficient<unsigned> && !rota::integer_coefficient<bool>, "they hold no -1");
static_assert(!rota::integer_coefficient<double>, "its sums depend on the brackets");
static_assert(!std::convertible_to<event, delta> && std::constructible_from<delta, event>,
              "the embedding is no homomorphism, so it is spelt out");

constexpr bool group_at_compile_time() {
  using d = rota::delta<int>;
  using e = rota::event<int>;
  auto const two = d(1, 2) + d(7, -1);
  return (two - two).empty() && two + two == 2 * two && d(e::addition(1)) + d(e::addition(1)) == d(1, 2) &&
         clamp(two) == compose(e::addition(1), e::subtraction(7)) && d(rota::atom_set<int>{1, 7})(7) == 1 &&
         d(3, 0).empty() &&
         extend(
             two, [](int x) { return std::int64_t{x}; }, std::int64_t{0}) == -5 &&
         !checked_sum(rota::delta<int, std::int8_t>(4, 100), rota::delta<int, std::int8_t>(4, 28)).has_value();
}
static_assert(group_at_compile_time());

}  // namespace

}  // namespace delta_test
