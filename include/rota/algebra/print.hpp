#pragma once
/// @file
/// Text for the values of the algebra, in the paper's notation. A header of its own, since computing needs no strings.
///
/// Each function takes `name(id)`, which turns agents, plans and tasks into strings; see `default_names`. Atoms that
/// are not made of names are printed by their own `to_string`, or as numbers or text.

#include <rota/algebra/delta.hpp>
#include <rota/algebra/dense_event.hpp>
#include <rota/algebra/fingerprint.hpp>
#include <rota/algebra/runs.hpp>
#include <rota/algebra/transition.hpp>
#include <rota/core/print.hpp>

#include <cstdint>
#include <string>

namespace rota {

/// `+`, `-` or `0`.
[[nodiscard]] inline std::string to_string(sign s) { return s == sign::plus ? "+" : s == sign::minus ? "-" : "0"; }

/// `{In(1, 0, 1), In(2, 0, 0)}`.
template <ordered_atom Atom, class Names = default_names>
[[nodiscard]] std::string to_string(atom_set<Atom> const& c, Names const& name = {}) {
  return detail::braced(c, [&](Atom const& x) { return detail::text(x, name); });
}
template <atom_universe U, class Names = default_names>
[[nodiscard]] std::string to_string(dense_atom_set<U> const& c, Names const& name = {}) {
  return to_string(to_sparse(c), name);
}

/// `+In(1, 0, 1)`: one entry of an event.
template <ordered_atom Atom, class Names = default_names>
[[nodiscard]] std::string to_string(signed_atom<Atom> const& x, Names const& name = {}) {
  return to_string(x.value) + detail::text(x.atom, name);
}
/// `({In(1, 0, 1)}, {In(2, 0, 0)})`: the additions, then the subtractions.
template <ordered_atom Atom, class Names = default_names>
[[nodiscard]] std::string to_string(event<Atom> const& e, Names const& name = {}) {
  return '(' + to_string(e.additions(), name) + ", " + to_string(e.subtractions(), name) + ")";
}
template <atom_universe U, class Names = default_names>
[[nodiscard]] std::string to_string(dense_event<U> const& e, Names const& name = {}) {
  return to_string(to_sparse(e), name);
}

/// `In(1, 0, 1): +2`: one entry of a delta.
template <ordered_atom Atom, class Coefficient, class Names = default_names>
[[nodiscard]] std::string to_string(multiple<Atom, Coefficient> const& x, Names const& name = {}) {
  return detail::text(x.atom, name) + (x.count > Coefficient{} ? ": +" : ": ") + detail::text(x.count, name);
}
/// `{In(1, 0, 1): +2, In(2, 0, 0): -1}`: the multiplicity of each atom that has one.
template <ordered_atom Atom, integer_coefficient Coefficient, class Names = default_names>
[[nodiscard]] std::string to_string(delta<Atom, Coefficient> const& d, Names const& name = {}) {
  return detail::braced(d, [&](multiple<Atom, Coefficient> const& x) { return to_string(x, name); });
}

/// `{In(1, 0, 1)} -> {In(1, 0, 0)}`.
template <allocation_set Set, class Names = default_names>
[[nodiscard]] std::string to_string(transition<Set> const& t, Names const& name = {}) {
  return detail::text(t.source(), name) + " -> " + detail::text(t.target(), name);
}

/// Sixteen hexadecimal digits, since a fingerprint is compared and never read as a number: `0x00000000000000ff`.
[[nodiscard]] inline std::string to_string(fingerprint h) {
  std::string digits(16, '0');
  for (auto i = digits.size(); i-- > 0; h.value >>= 4) digits[i] = "0123456789abcdef"[h.value & 15];
  return "0x" + digits;
}

// Refusals, each as a sentence without a full stop.

template <ordered_atom Atom, class Names = default_names>
[[nodiscard]] std::string to_string(overlap<Atom> const& r, Names const& name = {}) {
  return detail::text(r.witness, name) + " is both added and subtracted";
}
template <ordered_atom Atom, class Names = default_names>
[[nodiscard]] std::string to_string(inapplicable<Atom> const& r, Names const& name = {}) {
  return detail::text(r.witness, name) + " is added though present, or subtracted though absent";
}
template <ordered_atom Atom, class Names = default_names>
[[nodiscard]] std::string to_string(outside_universe<Atom> const& r, Names const& name = {}) {
  return detail::text(r.witness, name) + " is not in the universe";
}
template <ordered_atom Atom, class Names = default_names>
[[nodiscard]] std::string to_string(coefficient_overflow<Atom> const& r, Names const& name = {}) {
  return "the multiplicity of " + detail::text(r.witness, name) + " is out of range";
}
template <ordered_atom Atom, class Names = default_names>
[[nodiscard]] std::string to_string(arrows_do_not_meet<Atom> const& r, Names const& name = {}) {
  return "where the first arrow ends and the second begins differs in " + detail::text(r.witness, name);
}
template <ordered_atom Atom, class Names = default_names>
[[nodiscard]] std::string to_string(no_run<Atom> const& r, Names const& name = {}) {
  return "events " + std::to_string(r.first) + " and " + std::to_string(r.second) + " both add " +
         detail::text(r.witness, name) + " or both subtract it, and no event between them mentions it";
}

}  // namespace rota
