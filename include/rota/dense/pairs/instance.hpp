#pragma once

#include <rota/dense/instance.hpp>
#include <rota/dense/outcome.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense {

/// The greatest Σ_i max|u_i| + Σ_{i<j} max|w_ij| over entries that are not absent that `pair_solver` accepts: 2^29 in units
/// of 2^-20. Every sum of values and of penalties for forbidden entries then fits into 64 bits.
inline constexpr std::int64_t max_pair_total = std::int64_t{1} << 49;

/// The most agents, and the most slots, that `pair_solver` accepts.
inline constexpr std::size_t max_pair_agents = 64;
inline constexpr std::size_t max_pair_slots = 32;

/// What two agents are worth together, by the slots they take: table[x_first · slots + x_second].
///
/// An entry `absent` forbids that combination. Couplings may share a table. Tables of the same two agents are added up.
struct coupling {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::span<std::int64_t const> table;
};

/// n agents to be put into slots, one each, for the greatest Σ_i u_i[x_i] + Σ_{i<j} w_ij[x_i][x_j]. A view.
///
/// Two agents without a coupling are worth 0 together. With m slots this is a quadratic semi-assignment problem with
/// cardinalities.
/// @pre unary.size() == agents·slot_count(), row per agent, `absent` where forbidden; each table has slot_count()² entries;
/// first ≠ second, both < agents; `max_pair_agents`, `max_pair_slots` and `max_pair_total` hold
struct pair_instance {
  std::size_t agents = 0;
  std::span<std::int64_t const> unary;
  std::span<coupling const> couplings;
  std::span<slot_bounds const> bounds;

  [[nodiscard]] std::size_t slot_count() const noexcept { return bounds.size(); }
};

/// How a search of `pair_solver` divides its work. No proved answer depends on it.
struct pair_effort {
  /// As many as the size of the instance suggests.
  static constexpr std::size_t automatic = ~std::size_t{0};
  /// With at most eight agents and eight slots: so many placements are tried with simple bounds, before better ones, which
  /// take time to make, are made. 0: at once.
  std::uint64_t plain_nodes = 16384;
  /// So many agents at the end are placed in every way, for bounds: O(slots^(exact_suffix − 2)) steps. 0: no bounds by
  /// counts at all.
  std::size_t exact_suffix = automatic;
  /// So many agents before those are bounded by counts, too, less closely.
  std::size_t bounded_suffix = automatic;
  /// Whether interchangeable agents are looked for, and tried in one order only.
  bool symmetry = true;
};

/// What became of the subtrees below all prefixes of d agents that a search looked at. With m slots, each holds m^(n−d)
/// assignments.
///
/// Σ_d m^(n−d)·(sum of the fields at d) = m^n: the account of a search adds up to all assignments, so none was forgotten.
struct pair_tally {
  std::uint64_t leaves = 0;          ///< complete assignments evaluated; at d = n only
  std::uint64_t by_bound = 0;        ///< left: nothing in them can be better than the best
  std::uint64_t by_cardinality = 0;  ///< left: nothing in them is within the bounds of the slots
  std::uint64_t by_absence = 0;      ///< left: a slot or a combination is forbidden
  std::uint64_t by_symmetry = 0;     ///< left: the same with interchangeable agents exchanged is searched elsewhere
  std::uint64_t open = 0;            ///< not decided when the search was stopped
};

/// What a pairwise search found. Its nodes are placements tried, those for bounds and for ties included.
struct pair_outcome : outcome {
  std::uint64_t tie_nodes = 0;  ///< of the nodes, those that settled ties after the optimum was proved
};

/// The reason why a subtree was not searched.
enum class pair_cut : unsigned char { bound, cardinality, absence, symmetry };

/// Hears of every subtree that was not searched.
class pair_observer {
public:
  /// @param partial agent → slot, `no_slot` where not yet placed
  /// @param bound for `pair_cut::bound`: no valid completion is worth more
  virtual void operator()(std::span<slot const> partial, pair_cut reason, std::int64_t bound) = 0;

protected:
  ~pair_observer() = default;
};

}  // namespace rota::dense
