#pragma once

#include <rota/algebra/event.hpp>

namespace rota {

/// Whether brackets matter at one atom: 4 of the 27 triples, (s, t, u) ∈ {(+, +, −), (−, −, +), (+, −, −), (−, +, +)}.
[[nodiscard]] constexpr bool brackets_matter(sign s, sign t, sign u) noexcept {
  return s != sign::zero && t != sign::zero && to_int(u) == -to_int(s) && (t == s || t == u);
}

/// The atoms at which (e∘f)∘g and e∘(f∘g) differ; empty iff the two are equal. O(|f| (log |e| + log |g|)).
template <ordered_atom Atom>
[[nodiscard]] constexpr atom_set<Atom> non_associating_atoms(event<Atom> const& e, event<Atom> const& f,
                                                             event<Atom> const& g) {
  atom_set<Atom> witnesses;
  for (auto const& x : f)
    if (brackets_matter(e(x.atom), x.value, g(x.atom))) witnesses.insert(x.atom);
  return witnesses;
}

/// Whether (e∘f)∘g = e∘(f∘g). Decided by the signs, without composing.
template <ordered_atom Atom>
[[nodiscard]] constexpr bool associates(event<Atom> const& e, event<Atom> const& f, event<Atom> const& g) {
  return non_associating_atoms(e, f, g).empty();
}

}  // namespace rota
