#pragma once

#include <rota/core/assert.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

/// Solvers on numbers: agents are rows, slots are columns. They know no plans and no vocabulary.
namespace rota::dense {

/// The number of a column: a place for agents, such as a task. Of equal assignments, ties prefer lower slots first.
using slot = std::uint32_t;

/// The number of a row: an agent.
using row_index = std::uint32_t;

/// The slot of an agent that takes no part.
inline constexpr slot no_slot = (std::numeric_limits<slot>::max)();

/// The utility of a pair (agent, slot) that is forbidden: further below 0 than any sum of utilities reaches.
inline constexpr std::int64_t absent = -(std::int64_t{1} << 62);

/// The greatest (s + 2)·max|u| that solvers accept, for s slots: no sum along a path through all slots reaches `absent`.
inline constexpr std::int64_t max_reach = std::int64_t{1} << 55;

/// The greatest n·max|u| that solvers accept, for n agents.
inline constexpr std::int64_t max_total = std::int64_t{1} << 60;

/// Whether every sum fits into 64 bits, for n agents and s slots with utilities of at most `magnitude`.
[[nodiscard]] constexpr bool fits(std::size_t agents, std::size_t slot_count, std::uint64_t magnitude) noexcept {
  auto const within = [&](std::uint64_t n, std::int64_t limit) {
    return n == 0 || magnitude <= static_cast<std::uint64_t>(limit) / n;
  };
  return within(agents, max_total) && within(slot_count + 2, max_reach);
}

/// The fewest and the most agents that a slot takes.
struct slot_bounds {
  std::uint32_t lower = 0;
  std::uint32_t upper = 0;

  friend bool operator==(slot_bounds, slot_bounds) = default;
};

/// The question: put each of n agents into one slot. A view.
///
/// @pre utility.size() == agents·slot_count(), a row per agent, `absent` if forbidden; `fits(agents, slot_count(), max|u|)`
/// over all other entries; taking_part is empty (all do) or has an entry per agent
struct instance {
  std::size_t agents = 0;
  std::span<std::int64_t const> utility;
  std::span<slot_bounds const> bounds;
  std::span<unsigned char const> taking_part{};  ///< 0: the row stays, but its agent is put nowhere
  bool unique = false;  ///< no two assignments have the same total, so the solver need not look for ties

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

/// The total utility of an assignment; nothing if it breaks a bound or uses a forbidden pair. O(n·s)
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
