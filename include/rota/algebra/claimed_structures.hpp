#pragma once
/// @file
/// Which structure each type of the algebra claims to have.

#include <rota/algebra/dense_event.hpp>
#include <rota/algebra/fingerprint.hpp>
#include <rota/algebra/structures.hpp>
#include <rota/algebra/transition.hpp>

namespace rota {

/// The structure of allocation events in any storage: under Def. 4 a commutative unital magma with inverses, not
/// associative, hence not a group; and how an event acts on the sets at which it is applicable.
///
/// If a type of your own is an `allocation_event`, derive its `structure` from this one.
template <allocation_event E>
struct event_structure {
  using set_type = typename E::set_type;

  // Calls the library's functions, or those that stand beside a type of your own.
  static constexpr E combine(E const& e, E const& f) { return compose(e, f); }
  static constexpr E identity() { return {}; }
  static constexpr E inverse(E const& e) {
    using rota::inverse;
    return inverse(e);
  }
  static constexpr bool commutative = true;

  static constexpr E difference(set_type const& before, set_type const& after) {
    using rota::difference;
    return difference(before, after);
  }
  static constexpr bool applicable(E const& e, set_type const& c) {
    using rota::applicable;
    return applicable(e, c);
  }
  static constexpr auto apply(E const& e, set_type const& c) {
    using rota::apply;
    return apply(e, c);
  }
};

template <ordered_atom Atom>
struct structure<event<Atom>> : event_structure<event<Atom>> {};

/// Only if the type determines the universe. Otherwise the type is not a magma, because events of two universes do not
/// compose.
template <fixed_universe U>
struct structure<dense_event<U>> : event_structure<dense_event<U>> {};

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
template <allocation_set Set>
struct structure<transition<Set>> {
  using type = transition<Set>;
  static constexpr Set source(type const& t) { return t.source(); }
  static constexpr Set target(type const& t) { return t.target(); }
  static constexpr type identity(Set const& c) { return type::identity(c); }
  static constexpr type compose(type const& t, type const& u) { return rota::compose(t, u); }
  static constexpr type inverse(type const& t) { return rota::inverse(t); }
};

/// Deltas act on fingerprints: δ·a = h(δ) + a. So a fingerprint is kept up to date without its allocation.
template <encodable_atom Atom, std::signed_integral Coefficient>
struct action<delta<Atom, Coefficient>, fingerprint> {
  static constexpr fingerprint act(delta<Atom, Coefficient> const& d, fingerprint a) { return fingerprint_of(d) + a; }
};

}  // namespace rota
