#pragma once
/// @file
/// The laws of allocation events, Def. 3 and 4, for any type that stores a sign function.

#include <rota/algebra/event.hpp>
#include <rota/testing/structure_laws.hpp>

#include <algorithm>
#include <map>

namespace rota::testing {

/// e as a finite map from the atoms with a sign to −1 or +1. For a type of your own, by `S::signs(e)`, or else by
/// `additions()` and `subtractions()`.
template <class S, class E>
[[nodiscard]] auto signs_of(E const& e) {
  if constexpr (requires { S::signs(e); }) {
    return S::signs(e);
  } else if constexpr (requires { to_sparse(e); }) {
    return signs_of<S>(to_sparse(e));
  } else {
    std::map<typename E::atom_type, int> signs;
    for (auto const& x : e.additions()) signs[x] = 1;
    for (auto const& x : e.subtractions()) signs[x] = -1;
    return signs;
  }
}

namespace detail {

/// The value of a finite map at x, or 0 if it has none.
template <class Map>
[[nodiscard]] int value_at(Map const& signs, typename Map::key_type const& x) {
  auto const where = signs.find(x);
  return where == signs.end() ? 0 : static_cast<int>(where->second);
}

}  // namespace detail

/// commutative_magma, invertible_magma, idempotent, unique_inverse. Events are not a group: of the `group_laws` they
/// break `associative` and nothing else.
///
/// At one atom, Def. 4 is the only operation with this identity, these inverses, and idempotent elements.
template <class E, class S = structure<E>>
[[nodiscard]] bundle event_laws() {
  bundle laws("definition_4");
  laws.merge(commutative_magma_laws<E, S>());
  laws.merge(invertible_magma_laws<E, S>());
  laws.add("idempotent", "e∘e = e",
           [] {
             auto const e = draw<E>("e");
             detail::count_nontrivial<S>(e);
             same("e∘e", S::combine(e, e), "e", e);
           },
           {detail::without_identity});
  laws.add("unique_inverse", "e∘f = ∅ = e∘g ⇒ f = g", [] {
    auto const e = draw<E>("e");
    auto const f = draw<E>("f");
    // Two random events seldom cancel, so the inverse and an event near it are tried too.
    std::vector<E> inverses{f, S::inverse(e), S::combine(S::inverse(e), f)};
    std::erase_if(inverses, [&](E const& g) { return !(S::combine(e, g) == S::identity()); });
    for (E const& g : inverses) same("an inverse of e", g, "another", inverses.front());
  });
  return laws;
}

/// vanishes_iff_no_bad_sign_triple: when brackets do not matter.
template <class E, class S = structure<E>>
[[nodiscard]] bundle associator_laws() {
  bundle laws("associator");
  laws.add("vanishes_iff_no_bad_sign_triple", "(e∘f)∘g = e∘(f∘g) ⇔ no atom has (s, s, −s) or (−s, s, s), s = ±1",
           [] {
             auto const e = draw<E>("e");
             auto const f = draw<E>("f");
             auto const g = draw<E>("g");
             auto const signs_of_e = signs_of<S>(e);
             auto const signs_of_g = signs_of<S>(g);
             bool bad = false;
             bool meet = false;
             for (auto const& [x, t] : signs_of<S>(f)) {
               int const s = detail::value_at(signs_of_e, x);
               int const u = detail::value_at(signs_of_g, x);
               bad |= s != 0 && u == -s;  // and t is one of them
               meet |= s != 0 && u != 0;
             }
             interesting(bad, "brackets matter");
             interesting(!bad && meet, "brackets do not matter though an atom stands in all three");
             auto const left = S::combine(S::combine(e, f), g);
             auto const right = S::combine(e, S::combine(f, g));
             if (bad)
               holds(!(left == right), "(e∘f)∘g ≠ e∘(f∘g), as an atom has a bad triple of signs");
             else
               same("(e∘f)∘g", left, "e∘(f∘g)", right);
           },
           {{"brackets matter"}, {"brackets do not matter though an atom stands in all three"}});
  return laws;
}

/// Def. 3 and 4 at each atom: equality, identity, inverse, composition. They determine an event completely.
template <class E, class S = structure<E>>
[[nodiscard]] bundle sign_function_laws() {
  bundle laws("sign_function");
  laws.add("equality", "e = f ⇔ e(x) = f(x) for all x", [] {
    auto const e = draw<E>("e");
    auto const f = draw<E>("f");
    holds((e == f) == (signs_of<S>(e) == signs_of<S>(f)), "e = f iff equal at every atom");
    for (auto const& [x, s] : signs_of<S>(e)) holds(s == 1 || s == -1, "the signs of e are −1 and +1");
  });
  laws.add("identity", "∅(x) = 0", [] {
    (void)draw<E>("e");
    holds(signs_of<S>(S::identity()).empty(), "the identity has no signs");
  });
  laws.add("inverse", "e⁻¹(x) = −e(x)", [] {
    auto const e = draw<E>("e");
    auto expected = signs_of<S>(e);
    for (auto& [x, s] : expected) s = -s;
    same("the signs of e⁻¹", signs_of<S>(S::inverse(e)), "those of e, swapped", expected);
  });
  laws.add("composition", "(e∘f)(x) = clamp(e(x) + f(x))",
           [] {
             auto const e = draw<E>("e");
             auto const f = draw<E>("f");
             auto expected = signs_of<S>(e);
             bool cancel = false;
             bool agree = false;
             for (auto const& [x, t] : signs_of<S>(f)) {
               int const s = detail::value_at(expected, x);
               cancel |= s == -t;
               agree |= s == t;
               expected[x] = std::clamp(s + t, -1, 1);
             }
             std::erase_if(expected, [](auto const& entry) { return entry.second == 0; });
             interesting(cancel, "signs cancel");
             interesting(agree, "signs agree");
             same("the signs of e∘f", signs_of<S>(S::combine(e, f)), "the clamped sums", expected);
           },
           {{"signs cancel"}, {"signs agree"}});
  return laws;
}

/// All laws above.
template <class E, class S = structure<E>>
[[nodiscard]] bundle allocation_event_laws() {
  return bundle("allocation_event")
      .merge(event_laws<E, S>())
      .merge(associator_laws<E, S>())
      .merge(sign_function_laws<E, S>());
}

}  // namespace rota::testing
