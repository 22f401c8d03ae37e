#pragma once

#include <rota/model/allocation.hpp>

namespace rota {

/// The causes of the conflict of C₁ with C₂ (Def. 2): C₁ ∖ C₂ if both are for one plan type, otherwise ∅. Directed.
template <vocabulary V>
[[nodiscard]] constexpr allocation_atoms<V> causes(allocation<V> const& c1, allocation<V> const& c2) {
  return c1.type == c2.type ? subtract(c1.atoms, c2.atoms) : allocation_atoms<V>{};
}

/// Whether C₁ conflicts with C₂, Def. 2 to the letter: both are for one plan type, and some In(a, p, τ) ∈ C₁ is not in C₂.
/// Directed. O(|C₁| + |C₂|).
template <vocabulary V>
[[nodiscard]] constexpr bool conflicts_with(allocation<V> const& c1, allocation<V> const& c2) {
  return c1.type == c2.type && !is_subset(c1.atoms, c2.atoms);
}

/// Whether two agents that believe in C₁ and C₂ are in conflict, in either direction: C₁ ≠ C₂ within one plan type.
template <vocabulary V>
[[nodiscard]] constexpr bool in_conflict(allocation<V> const& c1, allocation<V> const& c2) {
  return c1.type == c2.type && c1.atoms != c2.atoms;
}

/// Which of two conflicting agents is in conflict with the agent b that the cause is about.
enum class conflict_partner : unsigned char {
  first,  ///< a₁, because C₁ holds the cause and b's own allocation does not
  second  ///< a₂, because b's own allocation holds the cause and C₂ does not
};

/// The witness of Proposition 1: b is in conflict with one of the two agents, and the cause is the same.
template <vocabulary V>
struct conflict_witness {
  conflict_partner partner{};
  in<V> cause{};

  friend bool operator==(conflict_witness const&, conflict_witness const&) = default;
};

/// The construction in Prop. 1. Let x = In(b, p, τ) ∈ C₁ ∖ C₂ be a cause and C_b what b itself believes about that type.
/// If x ∈ C_b, then C_b conflicts with C₂; otherwise C₁ conflicts with C_b. The cause is x either way.
///
/// Where b does not execute the type, pass C_b = ∅. (The paper says that b has "no allocation"; read literally, the
/// proposition would fail.)
/// @pre `cause` ∈ `causes(c1, c2)`; `cb` is for the same plan type. O(log |C_b|).
template <vocabulary V>
[[nodiscard]] constexpr conflict_witness<V> proposition_1([[maybe_unused]] allocation<V> const& c1,
                                                          [[maybe_unused]] allocation<V> const& c2,
                                                          allocation<V> const& cb, in<V> const& cause) {
  ROTA_ASSERT(c1.type == c2.type && cb.type == c1.type);
  ROTA_ASSERT(c1.atoms.contains(cause) && !c2.atoms.contains(cause));
  return {cb.atoms.contains(cause) ? conflict_partner::second : conflict_partner::first, cause};
}

}  // namespace rota
