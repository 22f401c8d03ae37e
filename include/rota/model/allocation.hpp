#pragma once

#include <rota/algebra/allocation_event.hpp>
#include <rota/algebra/atom_set.hpp>
#include <rota/core/atom.hpp>

#include <algorithm>
#include <span>

namespace rota {

/// The atoms In(a, p, τ) of a task allocation.
template <vocabulary V = runtime_vocabulary>
using allocation_atoms = atom_set<in<V>>;

/// A task allocation for a plan type (Def. 1): the type, and a finite set of atoms.
///
/// It may be invalid, mix plans, or give an agent two tasks: `validate` judges it. It carries its type because allocations of
/// different types never conflict.
template <vocabulary V = runtime_vocabulary>
struct allocation {
  typename V::plan_type type{};
  allocation_atoms<V> atoms;

  friend bool operator==(allocation const&, allocation const&) = default;
};

/// The atoms In(b, ·, ·) of agent b in C. They are contiguous, because atoms are ordered by agent first. O(log |C|).
template <vocabulary V>
[[nodiscard]] constexpr std::span<in<V> const> part_of(allocation_atoms<V> const& c, typename V::agent b) {
  auto const* first =
      std::lower_bound(c.begin(), c.end(), b, [](in<V> const& x, typename V::agent key) { return x.agent < key; });
  auto const* last =
      std::upper_bound(first, c.end(), b, [](typename V::agent key, in<V> const& x) { return key < x.agent; });
  return {first, last};
}

/// Whether e adds or subtracts an atom In(b, ·, ·) of agent b. O(log |e|).
template <vocabulary V>
[[nodiscard]] constexpr bool mentions(event<in<V>> const& e, typename V::agent b) {
  auto const* first = std::lower_bound(
      e.begin(), e.end(), b, [](signed_atom<in<V>> const& x, typename V::agent key) { return x.atom.agent < key; });
  return first != e.end() && first->atom.agent == b;
}
/// The same for other storages of events, which it converts with `to_sparse` first.
template <allocation_event E>
[[nodiscard]] constexpr bool mentions(E const& e, typename E::atom_type::vocabulary_type::agent b) {
  return mentions(to_sparse(e), b);
}

}  // namespace rota
