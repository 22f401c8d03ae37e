#pragma once

#include <rota/core/small_vector.hpp>

#include <algorithm>
#include <compare>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <utility>

namespace rota {

/// An atom: any regular value with a total order. The algebra knows no plans.
///
/// Refuses types that declare their order partial: floating point, because of NaN, and types made of it, such as
/// std::optional<double>.
template <class T>
concept ordered_atom = std::regular<T> && std::totally_ordered<T> &&
                       (!std::three_way_comparable<T> || std::three_way_comparable<T, std::weak_ordering>);

/// A finite set C of atoms, such as an allocation.
///
/// Class invariant: strictly ascending. Sets of up to eight atoms allocate nothing.
template <ordered_atom Atom>
class atom_set {
public:
  using value_type = Atom;
  using const_iterator = Atom const*;
  using iterator = const_iterator;

  constexpr atom_set() = default;
  /// The set of the listed atoms, in any order and repeated or not. O(n log n).
  constexpr atom_set(std::initializer_list<Atom> atoms) : atom_set(atoms.begin(), atoms.end()) {}
  template <std::input_iterator I, std::sentinel_for<I> S>
  constexpr atom_set(I first, S last) : atoms_(first, last) {
    std::sort(atoms_.begin(), atoms_.end());
    atoms_.erase(std::unique(atoms_.begin(), atoms_.end()), atoms_.end());
  }

  [[nodiscard]] constexpr const_iterator begin() const noexcept { return atoms_.begin(); }
  [[nodiscard]] constexpr const_iterator end() const noexcept { return atoms_.end(); }
  [[nodiscard]] constexpr std::size_t size() const noexcept { return atoms_.size(); }
  [[nodiscard]] constexpr bool empty() const noexcept { return atoms_.empty(); }
  /// The atoms, ascending.
  [[nodiscard]] constexpr std::span<Atom const> atoms() const noexcept { return {begin(), size()}; }

  /// x ∈ C. O(log n).
  [[nodiscard]] constexpr bool contains(Atom const& x) const { return std::binary_search(begin(), end(), x); }

  /// C ← C ∪ {x}; whether x was new. O(n).
  constexpr bool insert(Atom const& x) {
    auto const* where = std::lower_bound(begin(), end(), x);
    if (where != end() && *where == x) return false;
    atoms_.insert(where, x);
    return true;
  }
  /// C ← C ∖ {x}; whether x was there. O(n).
  constexpr bool erase(Atom const& x) {
    auto const* where = std::lower_bound(begin(), end(), x);
    if (where == end() || !(*where == x)) return false;
    atoms_.erase(where);
    return true;
  }
  constexpr void clear() noexcept { atoms_.clear(); }

  friend bool operator==(atom_set const&, atom_set const&) = default;
  /// A total order of sets, so that sets can be atoms and keys. It is lexicographic, not inclusion.
  friend auto operator<=>(atom_set const&, atom_set const&) = default;

  /// The set of these atoms. @pre strictly ascending
  [[nodiscard]] static constexpr atom_set from_ascending(small_vector<Atom, 8> atoms) {
    for (std::size_t i = 1; i < atoms.size(); ++i) ROTA_ASSERT(atoms[i - 1] < atoms[i]);
    atom_set c;
    c.atoms_ = std::move(atoms);
    return c;
  }

private:
  small_vector<Atom, 8> atoms_;
};

/// C ∪ D. O(|C| + |D|), like the three below.
template <ordered_atom Atom>
[[nodiscard]] constexpr atom_set<Atom> unite(atom_set<Atom> const& c, atom_set<Atom> const& d) {
  small_vector<Atom, 8> atoms;
  auto x = c.begin();  // not std::set_union, which needs room for |C| + |D|: similar sets leave far fewer
  for (Atom const& y : d) {
    while (x != c.end() && *x < y) atoms.push_back(*x++);
    if (x != c.end() && !(y < *x)) ++x;
    atoms.push_back(y);
  }
  while (x != c.end()) atoms.push_back(*x++);
  return atom_set<Atom>::from_ascending(std::move(atoms));
}
/// C ∩ D.
template <ordered_atom Atom>
[[nodiscard]] constexpr atom_set<Atom> intersect(atom_set<Atom> const& c, atom_set<Atom> const& d) {
  small_vector<Atom, 8> atoms;
  atoms.append((std::min)(c.size(), d.size()),
               [&](Atom* out) { return std::set_intersection(c.begin(), c.end(), d.begin(), d.end(), out); });
  return atom_set<Atom>::from_ascending(std::move(atoms));
}
/// C ∖ D.
template <ordered_atom Atom>
[[nodiscard]] constexpr atom_set<Atom> subtract(atom_set<Atom> const& c, atom_set<Atom> const& d) {
  small_vector<Atom, 8> atoms;
  atoms.append(c.size(), [&](Atom* out) { return std::set_difference(c.begin(), c.end(), d.begin(), d.end(), out); });
  return atom_set<Atom>::from_ascending(std::move(atoms));
}
/// C ⊆ D.
template <ordered_atom Atom>
[[nodiscard]] constexpr bool is_subset(atom_set<Atom> const& c, atom_set<Atom> const& d) {
  return std::includes(d.begin(), d.end(), c.begin(), c.end());
}

}  // namespace rota
