#pragma once

#include <rota/algebra/allocation_event.hpp>
#include <rota/algebra/atom_set.hpp>
#include <rota/core/atom.hpp>

#include <algorithm>
#include <span>

namespace rota {

/// The atoms of a task allocation, projected to In(a, p, τ).
template <vocabulary V = runtime_vocabulary>
using allocation_atoms = atom_set<in<V>>;

/// A task allocation for a plan type (Def. 1): the type, and a finite set of atoms.
///
/// It may be invalid, mix plans, or give an agent two tasks: validity is a judgement on it (`validate`), never a
/// precondition for representing it. It carries its type because allocations of different types never conflict.
template <vocabulary V = runtime_vocabulary>
struct allocation {
  typename V::plan_type type{};
  allocation_atoms<V> atoms;

  friend bool operator==(allocation const&, allocation const&) = default;
};

/// b's part of C: its atoms In(b, ·, ·), contiguous because atoms are ordered by agent first. O(log |C|).
template <vocabulary V>
[[nodiscard]] constexpr std::span<in<V> const> part_of(allocation_atoms<V> const& c, typename V::agent b) {
  // `key > x.agent`, not `x.agent < key`: where the class template `agent` is declared, clang reads a template there.
  auto const* first =
      std::lower_bound(c.begin(), c.end(), b, [](in<V> const& x, typename V::agent key) { return key > x.agent; });
  auto const* last =
      std::upper_bound(first, c.end(), b, [](typename V::agent key, in<V> const& x) { return key < x.agent; });
  return {first, last};
}

/// Whether some In(b, ·, ·) is added or subtracted by e. O(log |e|).
template <vocabulary V>
[[nodiscard]] constexpr bool mentions(event<in<V>> const& e, typename V::agent b) {
  auto const* first = std::lower_bound(
      e.begin(), e.end(), b, [](signed_atom<in<V>> const& x, typename V::agent key) { return key > x.atom.agent; });
  return first != e.end() && first->atom.agent == b;
}
/// The same of an event that is stored otherwise. Takes as long as `to_sparse`.
template <allocation_event E>
[[nodiscard]] constexpr bool mentions(E const& e, typename E::atom_type::vocabulary_type::agent b) {
  return mentions(to_sparse(e), b);
}

}  // namespace rota
