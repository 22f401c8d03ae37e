// Def. 3 and 4, at one atom by the compiler and then for all events over three atoms.

#include "theory/every_case.hpp"

#include <rota/algebra/associativity.hpp>
#include <rota/algebra/event.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace events_theory {
namespace {

using namespace theory;

using rota::clamped_sum;
using rota::sign;
constexpr std::array carrier{sign::minus, sign::zero, sign::plus};

constexpr event one_atom_event(sign s) {
  return s == sign::plus ? event::addition(nth(0)) : s == sign::minus ? event::subtraction(nth(0)) : event{};
}
constexpr bool pairs_are_clamped_sums_with_all_laws_but_associativity() {
  for (sign const s : carrier) {
    if (clamped_sum(s, sign::zero) != s || clamped_sum(s, s) != s) return false;
    for (sign const t : carrier) {
      if (to_int(clamped_sum(s, t)) != std::clamp(to_int(s) + to_int(t), -1, 1)) return false;
      if (clamped_sum(s, t) != clamped_sum(t, s)) return false;
      if (compose(one_atom_event(s), one_atom_event(t)) != one_atom_event(clamped_sum(s, t))) return false;
      if ((clamped_sum(s, t) == sign::zero) != (to_int(s) == -to_int(t))) return false;  // one inverse each
    }
  }
  return true;
}
static_assert(pairs_are_clamped_sums_with_all_laws_but_associativity(), "carrier.pairs");

constexpr int failing_triples() {
  int failing = 0;
  for (sign const s : carrier)
    for (sign const t : carrier)
      for (sign const u : carrier) {
        bool const fails = clamped_sum(clamped_sum(s, t), u) != clamped_sum(s, clamped_sum(t, u));
        if (fails != rota::brackets_matter(s, t, u)) return -1;
        auto const e = one_atom_event(s);
        auto const f = one_atom_event(t);
        auto const g = one_atom_event(u);
        if (fails == (compose(compose(e, f), g) == compose(e, compose(f, g)))) return -1;
        failing += fails;
      }
  return failing;
}
static_assert(failing_triples() == 4, "carrier.exactly_four_of_27_triples_fail");

TEST(compose, is_definition_4) {
  law pointwise("(e∘f)(x) = clamp(e(x) + f(x))");
  law to_the_letter("e∘f = ((e⁺∖f⁻) ∪ (f⁺∖e⁻), (e⁻∖f⁺) ∪ (f⁻∖e⁺))");
  for (auto const& e : events(three_atoms))
    for (auto const& f : events(three_atoms)) {
      auto const r = compose(e, f);
      pointwise(values_of(r) == clamped(plus(values_of(e), values_of(f))));
      to_the_letter(
          r == event::make(unite(subtract(e.additions(), f.subtractions()), subtract(f.additions(), e.subtractions())),
                           unite(subtract(e.subtractions(), f.additions()), subtract(f.subtractions(), e.additions())))
                   .value());
    }
}
TEST(compose, is_a_commutative_unital_magma_of_idempotents) {
  law commutative("e∘f = f∘e");
  law identity("e∘∅ = e");
  law idempotent("e∘e = e");
  for (auto const& e : events(three_atoms)) {
    identity(compose(e, event{}) == e && compose(event{}, e) == e);
    idempotent(compose(e, e) == e);
    for (auto const& f : events(three_atoms)) commutative(compose(e, f) == compose(f, e));
  }
}
TEST(compose, associates_exactly_where_the_criterion_says) {
  law criterion("(e∘f)∘g = e∘(f∘g) ⇔ no bad sign triple");
  law witness("the witnesses are the atoms at which they differ");
  auto const all = events(three_atoms);
  for (auto const& e : all)
    for (auto const& f : all)
      for (auto const& g : all) {
        auto const left = values_of(compose(compose(e, f), g));
        auto const right = values_of(compose(e, compose(f, g)));
        criterion(associates(e, f, g) == (left == right));
        atom_set differ;
        for (auto const& [x, n] : plus(left, right, -1)) differ.insert(x);
        witness(non_associating_atoms(e, f, g) == differ);
      }
}
TEST(inverse, is_the_only_one) {
  law inverts("e∘f = ∅ ⇔ f = e⁻¹");
  law involution("(e⁻¹)⁻¹ = e");
  law swaps("e⁻¹(x) = −e(x)");
  for (auto const& e : events(three_atoms)) {
    involution(inverse(inverse(e)) == e);
    swaps(values_of(inverse(e)) == plus({}, values_of(e), -1));
    for (auto const& f : events(three_atoms)) inverts(compose(e, f).empty() == (f == inverse(e)));
  }
}

}  // namespace
}  // namespace events_theory
