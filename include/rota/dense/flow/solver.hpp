#pragma once

#include <rota/core/config.hpp>
#include <rota/dense/hidden.hpp>
#include <rota/dense/outcome.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense {

/// Why no assignment is valid.
enum class flow_obstacle : unsigned char {
  none,         ///< one is
  agent_stuck,  ///< `witness` is an agent: more agents fit only into the slots it can reach than these slots take
  slot_short    ///< `witness` is a slot: its lower bound cannot be met together with those of the others
};

/// What a flow search found. Whatever the limit, it finds an assignment or proves that there is none: never `unknown`.
struct flow_outcome : outcome {
  flow_obstacle obstacle = flow_obstacle::none;
  std::size_t witness = 0;  ///< see `obstacle`
  bool warm = false;        ///< the search began with the assignment of the last one
};

namespace detail {
class flow_search;
}

/// Finds the assignment of greatest total utility, exactly and in polynomial time.
///
/// Canonical: of all optima it returns the lexicographically smallest vector (agent → slot). So the answer depends on the
/// instance only, and a warm search returns what a cold one would.
/// Certificate: `prices`. With p_k the price of slot k, every assignment x within the bounds satisfies
///   Σ u(a, x_a) ≤ Σ_a max_k (u(a, k) − p_k) + Σ_k (p_k > 0 ? p_k·upper_k : p_k·lower_k),
/// and the optimum meets it with equality. The bounds are those of `bounds`: the instance's, and what they imply for the
/// number of agents.
///
/// Memory is reused: a search that is no larger than earlier ones allocates nothing. A copy of a solver begins with no
/// memory; a move keeps it, and assignments that outcomes show stay valid.
/// Complexity: cold O(n·s) and E searches of O(s²), E at most n + the sum of the lower bounds and usually far less; warm
/// O(s) for each changed row and at most as many searches as changed rows. O(n + s²) memory.
class flow_solver {
public:
  /// Searches anew. A step of `limit` is an arc looked at. @pre the preconditions of `instance`
  flow_outcome solve(instance const& in, work_limit const& limit = {});

  /// Begins with the assignment of the last search, if there is one. Utilities and taking part may have changed in the
  /// rows `changed` only; bounds may have changed anyhow.
  /// @pre as `solve`; `changed` names each row that has changed, once
  flow_outcome resolve(instance const& in, std::span<row_index const> changed, work_limit const& limit = {});

  /// Of the last search: the price of each slot, and of the sink, which is 0. Empty before the first.
  [[nodiscard]] std::span<std::int64_t const> prices() const noexcept;
  /// Of the last search: lower and upper bound of slot k, tightened by what the other slots need and can take.
  /// @pre there was a search, and it had slot k
  [[nodiscard]] slot_bounds bounds(std::size_t k) const noexcept;
  /// What an agent with this row adds to the certificate: max_k (row[k] − p_k) at the prices of the last search.
  /// @pre there was a search; row has an entry for each of its slots, at least one
  [[nodiscard]] std::int64_t most(std::span<std::int64_t const> row) const noexcept;

private:
  hidden<detail::flow_search> search_;
};

}  // namespace rota::dense

#ifndef ROTA_COMPILED
#include <rota/dense/flow/detail/search.hpp>
#endif
