#pragma once

#include <rota/core/assert.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

/// Solvers on dense indices: instantiated once, whatever the vocabulary.
namespace rota::dense {

/// A place an agent can be put: a task of one plan, or idle. Slots are numbered in the order that ties prefer.
using slot = std::uint32_t;

/// An agent as the number of its row.
using row_index = std::uint32_t;

inline constexpr slot no_slot = (std::numeric_limits<slot>::max)();

/// Marks a pair that does not exist. Forbidden is not expensive: it is further away than any sum of utilities reaches.
inline constexpr std::int64_t absent = -(std::int64_t{1} << 62);

/// The greatest (s + 2)·max|u| the solvers accept, s slots: no sum along a path through all slots reaches `absent`.
inline constexpr std::int64_t max_reach = std::int64_t{1} << 55;

/// The greatest n·max|u| the solvers accept, n agents.
inline constexpr std::int64_t max_total = std::int64_t{1} << 60;

/// Whether n agents and s slots of utilities up to `magnitude` keep every sum inside 64 bits.
[[nodiscard]] constexpr bool fits(std::size_t agents, std::size_t slot_count, std::uint64_t magnitude) noexcept {
  auto const within = [&](std::uint64_t n, std::int64_t limit) {
    return n == 0 || magnitude <= static_cast<std::uint64_t>(limit) / n;
  };
  return within(agents, max_total) && within(slot_count + 2, max_reach);
}

/// How many agents a slot must and can take, both ends included.
struct slot_bounds {
  std::uint32_t lower = 0;
  std::uint32_t upper = 0;

  friend bool operator==(slot_bounds, slot_bounds) = default;
};

/// n agents to be put into slots, one each. A view.
///
/// @pre utility.size() == agents·bounds.size(), row per agent; `fits(agents, slots(), max|u|)` over present pairs;
/// taking_part is empty (all do) or has an entry per agent
struct instance {
  std::size_t agents = 0;
  std::span<std::int64_t const> utility;
  std::span<slot_bounds const> bounds;
  std::span<unsigned char const> taking_part{};  ///< 0: the row is kept, but its agent is put nowhere
  bool unique = false;  ///< known: no two assignments have the same total, so ties are not sought

  [[nodiscard]] std::size_t slot_count() const noexcept { return bounds.size(); }
  [[nodiscard]] std::int64_t const* row(std::size_t agent) const noexcept {
    return utility.data() + agent * bounds.size();
  }
  [[nodiscard]] std::int64_t at(std::size_t agent, std::size_t s) const noexcept { return row(agent)[s]; }
  [[nodiscard]] bool present(std::size_t agent, std::size_t s) const noexcept { return at(agent, s) != absent; }
  [[nodiscard]] bool takes_part(std::size_t agent) const noexcept {
    return taking_part.empty() || taking_part[agent] != 0;
  }
};

/// The total utility of an assignment, or nothing if it is not within all bounds or uses a pair that does not exist. O(n·s)
/// @pre everybody takes part
[[nodiscard]] inline std::optional<std::int64_t> value_of(instance const& in, std::span<slot const> assignment) {
  std::int64_t sum = 0;
  for (std::size_t a = 0; a < assignment.size(); ++a) {
    if (assignment[a] == no_slot || !in.present(a, assignment[a])) return std::nullopt;
    sum += in.at(a, assignment[a]);
  }
  for (std::size_t s = 0; s < in.slot_count(); ++s) {
    auto const count = static_cast<std::size_t>(std::count(assignment.begin(), assignment.end(), s));
    if (count < in.bounds[s].lower || count > in.bounds[s].upper) return std::nullopt;
  }
  return sum;
}

}  // namespace rota::dense
