// Deltas as an abelian group that holds the events, and fingerprints as a homomorphism from it.

#include "theory/every_case.hpp"

#include <rota/algebra/apply.hpp>
#include <rota/algebra/delta.hpp>
#include <rota/algebra/fingerprint.hpp>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>

namespace deltas_theory {
namespace {

using namespace theory;

TEST(delta, is_an_abelian_group) {
  law pointwise("(d + e)(x) = d(x) + e(x)");
  law commutative("d + e = e + d");
  law associative("(d + e) + f = d + (e + f)");
  law inverse("d + −d = 0");
  law scales("(n·d)(x) = n·d(x)");
  auto const all = deltas({2, 9}, 2);
  for (auto const& d : all) {
    inverse((d + -d).empty() && (-d + d).empty() && d - d == delta{});
    for (int n = -3; n <= 3; ++n) scales(values_of(n * d) == plus({}, values_of(d), n));
    for (auto const& e : all) {
      pointwise(values_of(d + e) == plus(values_of(d), values_of(e)));
      commutative(d + e == e + d);
      for (auto const& f : all) associative((d + e) + f == d + (e + f));
    }
  }
}
TEST(delta, holds_the_events) {
  law retraction("ρ(ι(e)) = e");
  law sum("e∘f = ρ(ι(e) + ι(f))");
  for (auto const& e : events(three_atoms)) {
    retraction(clamp(delta(e)) == e && values_of(delta(e)) == values_of(e));
    for (auto const& f : events(three_atoms)) sum(compose(e, f) == clamp(delta(e) + delta(f)));
  }
}
TEST(delta, extends_maps_to_homomorphisms) {
  law values("f̂(1 x) = f(x)");
  law homomorphism("f̂(d + e) = f̂(d) + f̂(e)");
  // ℤ/2⁶⁴ is cyclic and not free, and its elements are many enough to tell all apart.
  auto const f = [](atom const& x) { return code(x) + rota::fingerprint{1}; };
  auto const all = deltas({2, 9}, 2);
  for (std::size_t i = 0; i < 3 * atoms_per_agent; ++i)
    values(extend(delta(nth(i), 1), f, rota::fingerprint{}) == f(nth(i)));
  for (auto const& d : all)
    for (auto const& e : all)
      homomorphism(extend(d + e, f, rota::fingerprint{}) ==
                   extend(d, f, rota::fingerprint{}) + extend(e, f, rota::fingerprint{}));
}
TEST(delta, refuses_what_its_coefficients_cannot_hold) {
  using small = rota::delta<atom, std::int8_t>;
  law sum("checked_sum is exact, or refused");
  law difference("checked_difference is exact, or refused");
  law product("checked_product is exact, or refused");
  law negation("checked_negation is exact, or refused");
  law multiplier("so is checked_product by what is itself no coefficient");
  auto const at = [](int n) { return small(nth(1), static_cast<std::int8_t>(n)); };
  auto const exact = [](auto const& r, int n) {
    bool const fits = n >= -128 && n <= 127;
    return r.has_value() == fits && (fits ? values_of(*r) == plus({}, {{nth(1), n}}) : r.error().witness == nth(1));
  };
  for (int m = -128; m <= 127; ++m) {
    negation(exact(checked_negation(at(m)), -m));
    for (int n = -128; n <= 127; ++n) {
      sum(exact(checked_sum(at(m), at(n)), m + n));
      difference(exact(checked_difference(at(m), at(n)), m - n));
      product(exact(checked_product(static_cast<std::int8_t>(m), at(n)), m * n));
      multiplier(exact(checked_product(4 * m, at(n)), 4 * m * n));
    }
  }
  law least("a refusal names the least atom");
  small const most = at(100) + small(nth(4), 100);
  least(checked_sum(most, most).error().witness == nth(1) && checked_product(3, most).error().witness == nth(1) &&
        checked_difference(at(-100), most).error().witness == nth(1));
  small const later = at(1) + small(nth(4), 100);
  least(checked_sum(later, later).error().witness == nth(4) && checked_product(3, later).error().witness == nth(4));
}

TEST(fingerprint, is_a_homomorphism_that_tells_all_beliefs_apart) {
  law updates("h(χ(C′)) = h(χ(C)) + h(ι(diff(C, C′)))");
  law agrees("h of a set and of an event is h of its delta");
  std::set<std::uint64_t> seen;
  auto const all = beliefs(3);
  for (auto const& c : all) {
    seen.insert(fingerprint_of(c).value);
    agrees(fingerprint_of(c) == fingerprint_of(delta(c)));
    for (auto const& d : all) {
      auto const e = difference(c, d);
      updates(fingerprint_of(d) == fingerprint_of(c) + fingerprint_of(e));
    }
  }
  EXPECT_EQ(seen.size(), all.size());
  for (auto const& e : events(three_atoms)) agrees(fingerprint_of(e) == fingerprint_of(delta(e)));

  law additive("h(d + e) = h(d) + h(e), h(n·d) = n·h(d), h(−d) = −h(d)");
  for (auto const& d : deltas({2, 9}, 2)) {
    additive(fingerprint_of(3 * d) == 3 * fingerprint_of(d) && fingerprint_of(-d) == -fingerprint_of(d));
    for (auto const& e : deltas({2, 9}, 2)) additive(fingerprint_of(d + e) == fingerprint_of(d) + fingerprint_of(e));
  }
  law visible("r(x) ≠ 0");
  for (std::size_t i = 0; i < 3 * atoms_per_agent; ++i) visible(code(nth(i)) != rota::fingerprint{});
}
TEST(fingerprint, is_the_same_on_every_machine) {
  EXPECT_EQ(fingerprint_of(atom_set{nth(0), nth(8), nth(16)}).value, 0x7f960aaf26f0ed7eu);
}

}  // namespace
}  // namespace deltas_theory
