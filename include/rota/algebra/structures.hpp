#pragma once
/// @file
/// The algebraic structures, from the weakest up. Each says its laws, which no compiler can check and `rota/testing/`
/// can, and which neighbour it refuses.
///
///     magma ── commutative_magma ─────────────────────────┐
///       └── unital_magma ── monoid ───────────┬── group ──┴── abelian_group
///                 └──────── invertible_magma ─┘
///     groupoid: composition is partial.   group_action: a group moves the points of a set.

#include <concepts>

namespace rota {

/// Says how T is an algebraic structure: its operations, and the laws it claims. No type has a structure until this is
/// specialised for it, because no compiler sees a law in a signature.
///
/// The members of a specialisation, those that T has:
/// * `static T combine(T const&, T const&)`: the operation, written x·y below;
/// * `static T identity()`;
/// * `static T inverse(T const&)`;
/// * `static constexpr bool associative`, `commutative`: claims, for `rota/testing/` to test.
template <class T>
struct structure;

namespace detail {

template <class T>
concept claims_associative = requires { requires structure<T>::associative; };
template <class T>
concept claims_commutative = requires { requires structure<T>::commutative; };

}  // namespace detail

/// A set with a total binary operation.
///
/// Laws: closed (the operation keeps the class invariant), well-defined (equal operands give equal results).
/// Refuses types whose composition is partial, such as `transition`: that is a `groupoid`.
template <class T>
concept magma = std::regular<T> && requires(T const& x, T const& y) {
  { structure<T>::combine(x, y) } -> std::same_as<T>;
};

/// A magma that claims to commute.
///
/// Laws: those of `magma`, and x·y = y·x. Refuses whatever does not claim it, such as strings and matrices.
template <class T>
concept commutative_magma = magma<T> && detail::claims_commutative<T>;

/// A magma with a two-sided identity.
///
/// Laws: those of `magma`, and identity·x = x = x·identity. Refuses the maximum of two integers, since there is no
/// least integer to start from.
template <class T>
concept unital_magma = magma<T> && requires {
  { structure<T>::identity() } -> std::same_as<T>;
};

/// A unital magma in which every x has an inverse. With commutativity, this is what `event` is under Def. 4.
///
/// Laws: those of `unital_magma`, x·inverse(x) = identity = inverse(x)·x, inverse(inverse(x)) = x. Without
/// associativity an inverse cancels nothing: (x·x)·inverse(x) may differ from x.
/// Refuses sets under union, which have an identity and no way back.
template <class T>
concept invertible_magma = unital_magma<T> && requires(T const& x) {
  { structure<T>::inverse(x) } -> std::same_as<T>;
};

/// A unital magma that claims associativity.
///
/// Laws: those of `unital_magma`, and (x·y)·z = x·(y·z). Refuses `event`: at the signs (+, +, −) the brackets matter.
template <class T>
concept monoid = unital_magma<T> && detail::claims_associative<T>;

/// A monoid with inverses.
///
/// Laws: those of `monoid` and `invertible_magma`; hence cancellation, x·y = x·z ⇒ y = z, and only the identity is
/// idempotent. Refuses `event`, in which every element is idempotent.
template <class T>
concept group = monoid<T> && invertible_magma<T>;

/// A commutative group: what the paper takes allocation events to be, and what `delta` is.
///
/// Laws: those of `group`, and x·y = y·x; hence sums may be taken in any order and any brackets. Refuses `event`.
template <class T>
concept abelian_group = group<T> && commutative_magma<T>;

/// Arrows between objects, composed where they meet, each invertible.
///
/// Its `structure<T>` has `source(t)`, `target(t)`, `identity(object)`, `compose(t, u)` for target(t) = source(u), and
/// `inverse(t)`.
/// Laws: source and target of a composite; identities; (t·u)·v = t·(u·v) where defined; t·inverse(t) =
/// identity(source(t)).
/// Refuses `delta`, whose sum is total. That is a group: a groupoid with one object, which has one name here, not two.
template <class T>
concept groupoid = std::regular<T> && requires(T const& t, T const& u) {
  structure<T>::source(t);
  { structure<T>::target(t) } -> std::same_as<decltype(structure<T>::source(t))>;
  { structure<T>::identity(structure<T>::source(t)) } -> std::same_as<T>;
  { structure<T>::compose(t, u) } -> std::same_as<T>;
  { structure<T>::inverse(t) } -> std::same_as<T>;
};

/// Says how G acts on X, from the left and totally. To opt in, specialise it with `static X act(G const&, X const&)`.
template <class G, class X>
struct action;

/// A group that moves the points of a set.
///
/// Laws: identity·x = x, (g·h)·x = g·(h·x); hence each g is a bijection of X, undone by inverse(g).
/// Refuses `event` on allocations: not every event is applicable, and events are no group. `apply` obeys these laws
/// where both sides exist.
template <class G, class X>
concept group_action = group<G> && std::regular<X> && requires(G const& g, X const& x) {
  { action<G, X>::act(g, x) } -> std::same_as<X>;
};

}  // namespace rota
