// Deltas at each atom: sums, multiples, embedding and clamp, extension, overflow. The laws are in
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

/// An integer type that is not std::integral, like big integers; wide enough here to be exact.
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

/// Any map Atoms -> G, as a table.
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
  // Dropping the task maps two tasks of one agent to one atom, where they may cancel.
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

namespace {

constexpr bool fits_8_bits(int n) { return n >= -128 && n <= 127; }
small_delta small_at(int n) { return {nth(1), static_cast<std::int8_t>(n)}; }

/// Whether a checked operation gives the right count at the first atom, where it always fits, and n at the second; or
/// refuses the second if eight bits cannot hold n.
template <class Checked>
bool is_exact_or_refused(Checked const& r, int n, int at_the_first) {
  if (!fits_8_bits(n)) return !r.has_value() && r.error().witness == nth(1);
  return r.has_value() && (*r)(nth(1)) == n && (*r)(nth(0)) == at_the_first &&
         r->size() == std::size_t{n != 0} + std::size_t{at_the_first != 0};
}

}  // namespace

TEST(delta, checked_operations_refuse_exactly_what_eight_bits_cannot_hold) {
  // Every pair of numbers, at one atom.
  small_delta const one(nth(0), 1);
  int sums = 0, differences = 0, products = 0;
  for (int a = -128; a <= 127; ++a) {
    auto const d = small_at(a);
    ASSERT_TRUE(is_exact_or_refused(checked_negation(one + d), -a, -1)) << a;
    for (int b = -128; b <= 127; ++b) {
      auto const e = small_at(b);
      ASSERT_TRUE(is_exact_or_refused(checked_sum(d, one + e), a + b, 1)) << a << " + " << b;
      ASSERT_TRUE(is_exact_or_refused(checked_sum(one + d, e), a + b, 1)) << a << " + " << b;
      ASSERT_TRUE(is_exact_or_refused(checked_difference(d, one + e), a - b, -1)) << a << " - " << b;
      ASSERT_TRUE(is_exact_or_refused(checked_difference(one + d, e), a - b, 1)) << a << " - " << b;
      auto const n = static_cast<std::int8_t>(a);
      // At the first atom 1·a always fits.
      ASSERT_TRUE(is_exact_or_refused(checked_product(n, one + e), a * b, a)) << a << " * " << b;
      sums += !fits_8_bits(a + b);
      differences += !fits_8_bits(a - b);
      products += !fits_8_bits(a * b);
    }
  }
  EXPECT_EQ(sums, 128 * 127 / 2 + 129 * 128 / 2);
  EXPECT_EQ(differences, 2 * (129 * 128 / 2) - 128);
  EXPECT_GT(products, 60000) << "most products of two bytes are no byte";
}

TEST(delta, checked_operations_at_the_limits_of_64_bits) {
  using limits = std::numeric_limits<std::int64_t>;
  constexpr auto max = limits::max(), min = limits::min();
  auto const at = [](std::int64_t n) { return delta(nth(3), n); };
  auto const refuses = [](auto const& r) { return !r.has_value() && r.error().witness == nth(3); };
  EXPECT_EQ(*checked_sum(at(max), at(min)), at(-1));
  EXPECT_EQ(*checked_sum(at(max - 1), at(1)), at(max));
  EXPECT_EQ(*checked_sum(at(min + 1), at(-1)), at(min));
  EXPECT_TRUE(refuses(checked_sum(at(max), at(1))));
  EXPECT_TRUE(refuses(checked_sum(at(1), at(max))));
  EXPECT_TRUE(refuses(checked_sum(at(min), at(-1))));
  EXPECT_TRUE(refuses(checked_sum(at(-1), at(min))));
  EXPECT_TRUE(refuses(checked_sum(at(min), at(min))));

  EXPECT_EQ(*checked_difference(at(-1), at(min)), at(max)) << "although -e has no room";
  EXPECT_EQ(*checked_difference(at(min), at(min)), delta{});
  EXPECT_EQ(*checked_difference(at(min), at(-1)), at(min + 1));
  EXPECT_TRUE(refuses(checked_difference(delta{}, at(min))));
  EXPECT_TRUE(refuses(checked_difference(at(max), at(-1))));
  EXPECT_TRUE(refuses(checked_difference(at(min), at(1))));

  EXPECT_EQ(*checked_negation(at(max)), at(min + 1));
  EXPECT_EQ(*checked_negation(at(min + 1)), at(max));
  EXPECT_TRUE(refuses(checked_negation(at(min))));

  EXPECT_EQ(*checked_product(1, at(min)), at(min));
  EXPECT_EQ(*checked_product(min, at(1)), at(min));
  EXPECT_EQ(*checked_product(-1, at(max)), at(min + 1));
  EXPECT_EQ(*checked_product(0, at(min)), delta{});
  EXPECT_EQ(*checked_product(max / 7, at(7)), at(max / 7 * 7));
  EXPECT_TRUE(refuses(checked_product(-1, at(min))));
  EXPECT_TRUE(refuses(checked_product(min, at(-1))));
  EXPECT_TRUE(refuses(checked_product(max / 7 + 1, at(7))));
  EXPECT_TRUE(refuses(checked_product(std::int64_t{1} << 32, at(std::int64_t{1} << 31)))) << "2^63 is one too many";
}

TEST(delta, a_multiplier_is_never_cut_to_the_size_of_a_coefficient) {
  EXPECT_EQ(checked_product(257, small_at(1)).error().witness, nth(1)) << "cut to eight bits it would be 1";
  EXPECT_EQ(*checked_product(128, small_at(-1)), small_at(-128)) << "128 is no coefficient, the product is one";
  EXPECT_EQ(*checked_product(256, small_delta{}), small_delta{});
  EXPECT_FALSE(checked_product(std::uint64_t{1} << 63, delta(nth(1), 1)).has_value());
  EXPECT_EQ(*checked_product(std::uint64_t{1} << 63, delta(nth(1), -1)),
            delta(nth(1), std::numeric_limits<std::int64_t>::min()));
}

RC_GTEST_PROP(delta, checked_operations_are_exact_or_name_the_least_overflow, ()) {
  auto const n = *atom_count().as("atoms");
  auto const a = *values(n, -127, 127).as("d");
  auto const b = *values(n, -127, 127).as("e");
  auto const k = *integer(-4, 4).as("k");
  auto const d = delta_of<std::int8_t>(a);
  auto const e = delta_of<std::int8_t>(b);
  // Often the least number, the only one that cannot be negated.
  auto c = b;
  if (auto const i = static_cast<std::size_t>(*integer(0, 2 * static_cast<int>(n)).as("least at")); i < n) c[i] = -128;
  auto const f = delta_of<std::int8_t>(c);
  auto const demand = [&](auto const& r, auto expected) {
    std::size_t least = n;
    for (std::size_t i = n; i > 0; --i)
      if (!fits_8_bits(expected(i - 1))) least = i - 1;
    RC_ASSERT(r.has_value() == (least == n));
    if (!r.has_value()) RC_ASSERT(r.error().witness == nth(least));
    for (std::size_t i = 0; r.has_value() && i < n; ++i) RC_ASSERT((*r)(nth(i)) == expected(i));
    return least == n;
  };
  RC_CLASSIFY(demand(checked_sum(d, e), [&](std::size_t i) { return a[i] + b[i]; }), "the sum fits");
  RC_CLASSIFY(demand(checked_difference(d, e), [&](std::size_t i) { return a[i] - b[i]; }), "the difference fits");
  RC_CLASSIFY(demand(checked_product(static_cast<std::int8_t>(k), d), [&](std::size_t i) { return k * a[i]; }),
              "the product fits");
  RC_CLASSIFY(demand(checked_negation(f), [&](std::size_t i) { return -c[i]; }), "the opposite fits");
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
  RC_ASSERT((*checked_difference(d, big) == d + big * wide(-1)));
  RC_ASSERT((*checked_negation(big) == -big && *checked_product(huge, d) == big));
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
  EXPECT_DEATH((void)(d * std::int8_t{2}), "has_value");
  EXPECT_DEATH((void)-small_delta(nth(0), -128), "has_value");
  EXPECT_DEATH((void)(d - small_delta(nth(0), -1)), "has_value");
}
TEST(delta_death, entries_out_of_order_or_zero_are_asserted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  using numbers = rota::delta<int>;
  using entries = rota::small_vector<numbers::entry, 8>;
  EXPECT_DEATH((void)numbers::from_entries(entries{{2, 1}, {1, 1}}), "atom");
  EXPECT_DEATH((void)numbers::from_entries(entries{{1, 0}}), "count");
}
#endif

namespace {

static_assert(rota::integer_coefficient<std::int64_t> && rota::integer_coefficient<wide>);
static_assert(!rota::integer_coefficient<unsigned> && !rota::integer_coefficient<bool>, "they hold no -1");
static_assert(!rota::integer_coefficient<double>, "its sums depend on the brackets");
template <class D>
concept has_fractions = requires(D const& d) { 0.5 * d; } || requires(D const& d) { d * 0.5f; };
static_assert(!has_fractions<delta> && !has_fractions<rota::delta<atom, wide>>, "half an atom is none");
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

constexpr bool refusals_at_compile_time() {
  using d = rota::delta<int, std::int8_t>;
  d const most(4, 127), least(4, -128);
  return checked_sum(most, d(4, 1)).error().witness == 4 && *checked_sum(most, least) == d(4, -1) &&
         checked_negation(least).error().witness == 4 && *checked_negation(most) == d(4, -127) &&
         checked_difference(d{}, least).error().witness == 4 && *checked_difference(d(4, -1), least) == most &&
         checked_product(2, most).error().witness == 4 && checked_product(-1, least).error().witness == 4 &&
         *checked_product(-1, most) == d(4, -127) && *checked_product(0, least) == d{};
}
static_assert(refusals_at_compile_time());

}  // namespace

}  // namespace delta_test
