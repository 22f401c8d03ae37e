#pragma once

#include <rota/core/config.hpp>
#include <rota/dense/hidden.hpp>
#include <rota/dense/limits.hpp>
#include <rota/dense/pairs/instance.hpp>

#include <span>

namespace rota::dense {

namespace detail {
class pair_search;
}

/// Finds the best assignment where utilities come in pairs, exactly.
///
/// Canonical: of all optima it returns the lexicographically smallest vector (agent → slot), by the caller's numbers.
/// The same on every machine, compiler and run, and so is every number in the outcome.
/// Anytime: a spent budget or `stop` leaves the best valid assignment seen, and a proven bound.
///
/// How: at most eight agents and slots are mostly solved at once, by a plain search with plain bounds (`plain_search`).
/// Otherwise local search makes a first assignment (`local_search`). The values are centred and rounded up to 16 bits, an
/// agent per lane (`pair_model`). The last half of the agents, those coupled least, are solved for all counts of agents per
/// slot at once (`suffix_bounds`). Depth-first branch and bound (`pair_branch`) adds to these what the unplaced agents get
/// from the placed ones at best, where slots have prices (`price_table`). Ties are settled only where bounds do not
/// exclude them.
///
/// Memory is reused: a search that is no larger than earlier ones allocates nothing. A copy of a solver begins with no
/// memory; a move keeps it, and assignments that outcomes show stay valid.
/// Memory O(n²·m²), at most 45 MB (1 MB for n ≤ 20, m ≤ 8), and bounds by counts in tables of fixed size, at most 75 MB.
/// Recursion at most n + m deep.
class pair_solver {
public:
  /// How the work is divided. No proved answer depends on it.
  pair_effort effort;

  /// Searches until the canonical optimum is proved, about `limit.steps` placements have been tried, or `limit.stop` says
  /// so. It is asked every few hundred placements, but for those of the plain search, and now and then before there are any.
  ///
  /// @param observer hears of every subtree that is not searched, if there is one
  /// @pre the preconditions of `pair_instance`
  pair_outcome solve(pair_instance const& in, work_limit const& limit = {}, pair_observer* observer = nullptr);

  /// Of the last search: what became of all assignments, by the number of agents placed. Settling ties does not count.
  [[nodiscard]] std::span<pair_tally const> account() const noexcept;

private:
  hidden<detail::pair_search> search_;
};

}  // namespace rota::dense

#ifndef ROTA_COMPILED
#include <rota/dense/pairs/detail/search.hpp>
#endif
