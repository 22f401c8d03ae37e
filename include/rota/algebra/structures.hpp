#pragma once
/// @file
/// Which structure each type of the algebra has, and claims.

#include <rota/algebra/abelian_group.hpp>
#include <rota/algebra/dense_event.hpp>
#include <rota/algebra/fingerprint.hpp>
#include <rota/algebra/group_action.hpp>
#include <rota/algebra/groupoid.hpp>
#include <rota/algebra/transition.hpp>

namespace rota {

/// Def. 4: a commutative unital magma with inverses. Not associative, hence no group.
template <ordered_atom Atom>
struct structure<event<Atom>> {
  static constexpr event<Atom> combine(event<Atom> const& e, event<Atom> const& f) { return compose(e, f); }
  static constexpr event<Atom> identity() { return {}; }
  static constexpr event<Atom> inverse(event<Atom> const& e) { return rota::inverse(e); }
  static constexpr bool commutative = true;
};

/// As `event`, where the type determines the universe. Else composition is partial and the type no magma: events of two
/// universes do not compose.
template <fixed_universe U>
struct structure<dense_event<U>> {
  using type = dense_event<U>;
  static constexpr type combine(type const& e, type const& f) { return compose(e, f); }
  static constexpr type identity() { return {}; }
  static constexpr type inverse(type const& e) { return rota::inverse(e); }
  static constexpr bool commutative = true;
};

/// ℤ^(Atoms) under addition.
template <ordered_atom Atom, integer_coefficient Coefficient>
struct structure<delta<Atom, Coefficient>> {
  using type = delta<Atom, Coefficient>;
  static constexpr type combine(type const& d, type const& e) { return d + e; }
  static constexpr type identity() { return {}; }
  static constexpr type inverse(type const& d) { return -d; }
  static constexpr bool associative = true;
  static constexpr bool commutative = true;
};

/// ℤ/2⁶⁴ under addition.
template <>
struct structure<fingerprint> {
  static constexpr fingerprint combine(fingerprint a, fingerprint b) { return a + b; }
  static constexpr fingerprint identity() { return {}; }
  static constexpr fingerprint inverse(fingerprint a) { return -a; }
  static constexpr bool associative = true;
  static constexpr bool commutative = true;
};

/// The pair groupoid of atom sets.
template <ordered_atom Atom>
struct structure<transition<Atom>> {
  using type = transition<Atom>;
  static constexpr atom_set<Atom> source(type const& t) { return t.source(); }
  static constexpr atom_set<Atom> target(type const& t) { return t.target(); }
  static constexpr type identity(atom_set<Atom> const& c) { return type::identity(c); }
  static constexpr type compose(type const& t, type const& u) { return rota::compose(t, u); }
  static constexpr type inverse(type const& t) { return rota::inverse(t); }
};

/// Deltas move fingerprints: δ·a = h(δ) + a. That is how a fingerprint is kept up to date without its allocation.
template <encodable_atom Atom, std::signed_integral Coefficient>
struct action<delta<Atom, Coefficient>, fingerprint> {
  static constexpr fingerprint act(delta<Atom, Coefficient> const& d, fingerprint a) { return fingerprint_of(d) + a; }
};

}  // namespace rota
