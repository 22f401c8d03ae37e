#pragma once

#include <rota/core/assert.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

/// Solvers on dense indices: instantiated once, whatever the vocabulary.
namespace rota::dense {

/// A place an agent can be put: a task of one plan, or idle. Slots are numbered in the order that ties prefer.
using slot = std::uint32_t;

inline constexpr slot no_slot = std::numeric_limits<slot>::max();

/// Marks a pair that does not exist. A marker, never an operand: forbidden is not expensive.
inline constexpr std::int64_t absent = std::numeric_limits<std::int64_t>::min();

/// The greatest n·max|u| the solvers accept; keeps every sum and difference of sums inside 64 bits.
inline constexpr std::int64_t max_total = std::int64_t{1} << 59;

/// How many agents a slot must and can take, both ends included.
struct slot_bounds {
  std::uint32_t lower = 0;
  std::uint32_t upper = 0;
};

/// n agents to be put into slots, one each. A view.
///
/// @pre utility.size() == agents·bounds.size(), row per agent; agents·max|u| ≤ max_total over present pairs
struct instance {
  std::size_t agents = 0;
  std::span<std::int64_t const> utility;
  std::span<slot_bounds const> bounds;

  [[nodiscard]] std::size_t slots() const noexcept { return bounds.size(); }
  [[nodiscard]] std::int64_t at(std::size_t agent, std::size_t s) const noexcept {
    return utility[agent * bounds.size() + s];
  }
  [[nodiscard]] bool present(std::size_t agent, std::size_t s) const noexcept { return at(agent, s) != absent; }
};

}  // namespace rota::dense
