#pragma once

#include <rota/algebra/action.hpp>

#include <concepts>
#include <cstddef>

namespace rota {

/// An allocation event of Def. 3, whatever stores it: `event` keeps one sorted run, `dense_event` two bit planes.
///
/// Laws: those of `commutative_magma` and, with an identity, `invertible_magma`; e ↦ e·C, `difference` and `applicable` as
/// for `event`; and e is the sign function x ↦ e(x). Refuses `delta`, whose multiplicities are no signs, and atom sets.
template <class E>
concept allocation_event =
    std::regular<E> && ordered_atom<typename E::atom_type> && std::regular<typename E::set_type> &&
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

}  // namespace rota
