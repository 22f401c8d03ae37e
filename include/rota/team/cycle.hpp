#pragma once

#include <rota/model/allocation.hpp>

namespace rota {

/// Def. 5: e_m ∘ e_r mentions no In(b, ·, ·), where e_m is the non-empty event of a message from b and e_r the receiver's
/// next *reallocation*. If e_r follows e_m directly, this says that e_r restores b's part of the allocation.
///
/// An empty e_m is no event, so it begins no cycle. Takes events of any storage whose atoms are In-atoms.
/// O(|e_m| + |e_r|) for `event`.
template <allocation_event E>
[[nodiscard]] constexpr bool is_cycle(E const& e_m, E const& e_r, typename E::atom_type::vocabulary_type::agent b) {
  return !e_m.empty() && !mentions(compose(e_m, e_r), b);
}

}  // namespace rota
