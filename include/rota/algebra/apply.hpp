#pragma once

#include <rota/algebra/event.hpp>

namespace rota {

/// Refusal: event e is not applicable at C, because χ(C) + e leaves {0, 1} at this atom.
template <ordered_atom Atom>
struct inapplicable {
  Atom witness{};  ///< added although in C, or subtracted although not in C
  friend bool operator==(inapplicable const&, inapplicable const&) = default;
};

/// diff(C, C′) = (C′ ∖ C, C ∖ C′): the only event that is applicable at C and turns it into C′. O(|C| + |C′|).
///
/// Laws: diff(C, C) = {}; diff(C′, C) = inverse(diff(C, C′)); compose(diff(C, C′), diff(C′, C″)) = diff(C, C″).
template <ordered_atom Atom>
[[nodiscard]] constexpr event<Atom> difference(atom_set<Atom> const& before, atom_set<Atom> const& after) {
  small_vector<signed_atom<Atom>, 8> entries;
  auto b = before.begin();
  auto a = after.begin();
  while (b != before.end() || a != after.end()) {
    if (b == before.end() || (a != after.end() && *a < *b)) {
      entries.push_back({*a++, sign::plus});
    } else if (a == after.end() || *b < *a) {
      entries.push_back({*b++, sign::minus});
    } else {
      ++a, ++b;
    }
  }
  return event<Atom>::from_entries(std::move(entries));
}

/// Whether e⁺ ∩ C = ∅ and e⁻ ⊆ C, equivalently χ(C) + ι(e) ∈ {0, 1} everywhere. O(|e| log |C|).
template <ordered_atom Atom>
[[nodiscard]] constexpr bool applicable(event<Atom> const& e, atom_set<Atom> const& c) {
  return std::all_of(e.begin(), e.end(),
                     [&](signed_atom<Atom> const& x) { return c.contains(x.atom) == (x.value == sign::minus); });
}

/// e·C = (C ∖ e⁻) ∪ e⁺ if e is applicable at C, else the least atom at which it is not.
///
/// Laws: apply(diff(C, C′), C) = C′; apply({}, C) = C; where both sides exist, f·(e·C) = compose(e, f)·C. O(|e| + |C|).
template <ordered_atom Atom>
[[nodiscard]] constexpr result<atom_set<Atom>, inapplicable<Atom>> apply(event<Atom> const& e,
                                                                         atom_set<Atom> const& c) {
  small_vector<Atom, 8> atoms;
  auto const* kept = c.begin();
  for (signed_atom<Atom> const& x : e) {
    while (kept != c.end() && *kept < x.atom) atoms.push_back(*kept++);
    bool const present = kept != c.end() && *kept == x.atom;
    if (present != (x.value == sign::minus)) return refused{inapplicable<Atom>{x.atom}};
    if (present) {
      ++kept;
    } else {
      atoms.push_back(x.atom);
    }
  }
  for (; kept != c.end(); ++kept) atoms.push_back(*kept);
  return atom_set<Atom>::from_ascending(std::move(atoms));
}

}  // namespace rota
