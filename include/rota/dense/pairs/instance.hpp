#pragma once

#include <rota/dense/instance.hpp>
#include <rota/dense/outcome.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense {

/// The greatest Σ_i max|u_i| + Σ_{i<j} max|w_ij| over present entries that the pairwise solver accepts: 2^29 in units of
/// 2^-20. Every sum of values and of penalties for what is forbidden then fits into 64 bits.
inline constexpr std::int64_t max_pair_total = std::int64_t{1} << 49;

/// The most agents and the most slots the pairwise solver accepts.
inline constexpr std::size_t max_pair_agents = 64;
inline constexpr std::size_t max_pair_slots = 32;

/// What two agents are worth together, by the slots they take: table[x_first · slots + x_second].
///
/// An entry `absent` forbids that combination. Tables may be shared, and are added up where a pair is named again.
struct coupling {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::span<std::int64_t const> table;
};

/// n agents to be put into slots, one each, for the greatest Σ_i u_i[x_i] + Σ_{i<j} w_ij[x_i][x_j]. A view.
///
/// Pairs without a coupling are worth 0. With m slots it is a quadratic semi-assignment problem with cardinalities.
/// @pre unary.size() == agents·slots(), row per agent, `absent` where forbidden; each table has slots()² entries;
/// first ≠ second, both < agents; `max_pair_agents`, `max_pair_slots` and `max_pair_total` hold
struct pair_instance {
  std::size_t agents = 0;
  std::span<std::int64_t const> unary;
  std::span<coupling const> couplings;
  std::span<slot_bounds const> bounds;

  [[nodiscard]] std::size_t slot_count() const noexcept { return bounds.size(); }
};

/// What became of the m^(n−d) assignments below each prefix of d agents that a search looked at, by d.
///
/// Σ_d m^(n−d)·(sum of the fields at d) = m^n: the account of a search adds up to all assignments, so nothing was
/// forgotten. `open` is what a spent budget left.
struct pair_tally {
  std::uint64_t leaves = 0;          ///< complete assignments evaluated; at d = n only
  std::uint64_t by_bound = 0;        ///< nothing below can be better than the best
  std::uint64_t by_cardinality = 0;  ///< nothing below is within the bounds of the slots
  std::uint64_t by_absence = 0;      ///< a forbidden slot or combination
  std::uint64_t by_symmetry = 0;     ///< exchanging interchangeable agents gives what is explored elsewhere
  std::uint64_t open = 0;            ///< not decided
};

/// How a pairwise search divides its work.
struct pair_effort {
  static constexpr std::size_t automatic = ~std::size_t{0};
  /// With at most eight agents and slots, the bounds that take time to make wait for so many placements with plain ones.
  std::uint64_t plain_nodes = 16384;
  /// So many agents at the end are enumerated for bounds: slots^(exact_suffix − 2) steps.
  std::size_t exact_suffix = automatic;
  /// So many agents more are bounded from there.
  std::size_t bounded_suffix = automatic;
  /// Whether interchangeable agents are looked for, and tried in one order only.
  bool symmetry = true;
};

/// What a pairwise search found. Its nodes are placements tried, those for bounds and for ties included.
struct pair_outcome : outcome {
  std::uint64_t tie_nodes = 0;  ///< of the nodes, those that settled ties after the optimum was proved
};

/// Why a subtree was not searched.
enum class pair_cut : unsigned char { bound, cardinality, absence, symmetry };

/// Hears of every subtree that was not searched.
class pair_observer {
public:
  /// `partial`: agent → slot, `no_slot` where not yet placed. For `pair_cut::bound`, no valid completion is worth more than
  /// `bound`.
  virtual void operator()(std::span<slot const> partial, pair_cut why, std::int64_t bound) = 0;

protected:
  ~pair_observer() = default;
};

}  // namespace rota::dense
