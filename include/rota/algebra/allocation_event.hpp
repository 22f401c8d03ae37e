#pragma once

#include <rota/algebra/apply.hpp>

#include <concepts>
#include <cstddef>
#include <utility>

namespace rota {

namespace detail {

/// `event`, or a type that `to_sparse` turns into it.
template <class E>
concept read_as_event = std::same_as<E, event<typename E::atom_type>> || requires(E const& e) {
  { to_sparse(e) } -> std::same_as<event<typename E::atom_type>>;
};

}  // namespace detail

/// An allocation event of Def. 3, in any storage: `event` keeps one sorted sequence, `dense_event` two bit planes.
///
/// Laws: those of `commutative_magma` and, if there is an identity, of `invertible_magma`; those of `apply`,
/// `difference` and `applicable` as for `event`; e and `to_sparse(e)` are the same sign function x ↦ e(x). Refuses
/// `delta`, whose multiplicities are not signs, and atom sets.
template <class E>
concept allocation_event =
    std::regular<E> && ordered_atom<typename E::atom_type> && std::regular<typename E::set_type> &&
    detail::read_as_event<E> &&
    requires(E const& e, E const& f, typename E::atom_type const& x, typename E::set_type const& c) {
      { e(x) } -> std::same_as<sign>;
      { e.size() } -> std::same_as<std::size_t>;
      { e.empty() } -> std::same_as<bool>;
      { e.additions() } -> std::same_as<typename E::set_type>;
      { e.subtractions() } -> std::same_as<typename E::set_type>;
      { E::make(c, c) } -> std::same_as<result<E, overlap<typename E::atom_type>>>;
      { compose(e, f) } -> std::same_as<E>;
      { inverse(e) } -> std::same_as<E>;
      { difference(c, c) } -> std::same_as<E>;
      { applicable(e, c) } -> std::same_as<bool>;
      { apply(e, c) } -> std::same_as<result<typename E::set_type, inapplicable<typename E::atom_type>>>;
    };

/// A finite set of atoms that allocation events act on, in any storage: `atom_set`, `dense_atom_set`.
///
/// Refuses sets without `difference`, such as std::set.
template <class C>
concept allocation_set = std::regular<C> && requires(C const& c) {
  { difference(c, c) } -> allocation_event;
  requires std::same_as<typename decltype(difference(c, c))::set_type, C>;
};

/// The events that act on sets of this type.
template <allocation_set C>
using event_on = decltype(difference(std::declval<C const&>(), std::declval<C const&>()));

}  // namespace rota
