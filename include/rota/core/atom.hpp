#pragma once

#include <rota/core/vocabulary.hpp>

#include <compare>

namespace rota {

/// The atom In(a, p, τ): agent a takes on task τ within plan p. (Source: section 4, after Def. 1.)
///
/// Ordered by agent first, so that one agent's part of a sorted atom set is contiguous.
template <vocabulary V = runtime_vocabulary>
struct in {
  using vocabulary_type = V;
  typename V::agent agent{};
  typename V::plan plan{};
  typename V::task task{};

  // strong_ordering, not auto: so it is made of < and == for identifiers without <=>, which `identifier` admits.
  friend std::strong_ordering operator<=>(in const&, in const&) = default;
};

/// The atom In(a, p, τ, z): as `in`, and a currently inhabits state z. (Source: section 3.)
///
/// Only clause (4) of Def. 1 needs the state. Conflicts, events and cycles are about the projection `project(x)`.
template <vocabulary V = runtime_vocabulary>
struct in_state {
  using vocabulary_type = V;
  typename V::agent agent{};
  typename V::plan plan{};
  typename V::task task{};
  typename V::state state{};

  friend std::strong_ordering operator<=>(in_state const&, in_state const&) = default;
};

/// In(a, p, τ, z) ↦ In(a, p, τ).
template <vocabulary V>
[[nodiscard]] constexpr in<V> project(in_state<V> const& x) noexcept {
  return {x.agent, x.plan, x.task};
}

}  // namespace rota
