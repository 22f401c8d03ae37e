#pragma once

#include "pairwise.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace peers {

/// Whether every agent has a slot, and every slot as many agents as it must and can take.
inline bool keeps(cardinalities const& c, std::size_t agents, assignment const& slots) {
  std::vector<std::uint32_t> count(c.slots());
  for (auto const s : slots) {
    if (s >= count.size()) return false;
    ++count[s];
  }
  for (std::size_t s = 0; s < count.size(); ++s)
    if (count[s] < c.lower[s] || count[s] > c.upper[s]) return false;
  return slots.size() == agents;
}

/// What an assignment is worth, or nothing if it is not valid.
inline std::optional<std::int64_t> value(additive_instance const& in, assignment const& slots) {
  if (!keeps(in.bounds, in.agents, slots)) return std::nullopt;
  std::int64_t sum = 0;
  for (std::size_t a = 0; a < in.agents; ++a) {
    if (!in.present(a, slots[a])) return std::nullopt;
    sum += in.at(a, slots[a]);
  }
  return sum;
}

/// What an assignment is worth, or nothing if it is not valid.
inline std::optional<std::int64_t> value(pairwise_instance const& in, assignment const& slots) {
  if (!keeps(in.bounds, in.agents, slots)) return std::nullopt;
  std::int64_t sum = 0;
  for (std::size_t a = 0; a < in.agents; ++a) {
    sum += in.at(a, slots[a]);
    for (std::size_t b = 0; b < a; ++b) sum += in.pair(a, slots[a], b, slots[b]);
  }
  return sum;
}

/// The optimum by one solver: solves twice, since the second time must not lean on the first.
///
/// @return nothing if it says there is none, or contradicts itself
template <class Instance>
std::optional<std::int64_t> optimum(Instance const& in, peer& solver) {
  bool const first = solver.solve();
  auto const once = first ? value(in, solver.answer()) : std::nullopt;
  solver.rewind();
  bool const second = solver.solve();
  auto const again = second ? value(in, solver.answer()) : std::nullopt;
  solver.rewind();
  return first == second && once == again ? once : std::nullopt;
}

}  // namespace peers
