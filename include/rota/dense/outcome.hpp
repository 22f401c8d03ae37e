#pragma once

#include <rota/dense/instance.hpp>
#include <rota/dense/limits.hpp>

#include <cstdint>
#include <limits>
#include <span>

namespace rota::dense {

/// How a search ended.
enum class status : unsigned char {
  optimal,     ///< the assignment is the canonical optimum, proved
  feasible,    ///< the limit was met: the assignment is valid, and no valid one is worth more than `bound`
  infeasible,  ///< proved: no assignment is valid
  unknown      ///< the limit was met before a valid assignment was found
};

/// The bound if nothing is proved.
inline constexpr std::int64_t no_bound = (std::numeric_limits<std::int64_t>::max)();

/// The bound if no assignment is valid.
inline constexpr std::int64_t no_value = (std::numeric_limits<std::int64_t>::min)();

/// What every solver returns; each may add fields.
///
/// Invariants: value ≤ bound if an assignment was found; value == bound if `optimal`; bound == `no_value` iff `infeasible`.
/// `feasible` with value == bound: no assignment is worth more, but the canonical optimum may be another one.
struct outcome {
  dense::status status = dense::status::unknown;
  /// The slot of each agent, `no_slot` for those who take no part; empty if nothing was found. A view of the solver's
  /// memory: its next search overwrites it.
  std::span<slot const> assignment{};
  std::int64_t value = 0;         ///< of the assignment; 0 if nothing was found
  std::int64_t bound = no_bound;  ///< proven: no valid assignment is worth more
  work_done work{};

  /// Whether there is a valid assignment.
  [[nodiscard]] constexpr bool found() const noexcept {
    return status == dense::status::optimal || status == dense::status::feasible;
  }
  /// Whether the answer is proved: the optimum, or that no assignment is valid.
  [[nodiscard]] constexpr bool proved() const noexcept {
    return status == dense::status::optimal || status == dense::status::infeasible;
  }
};

}  // namespace rota::dense
