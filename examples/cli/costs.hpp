#pragma once

#include "target.hpp"

#include <cstddef>
#include <optional>

namespace rota::cli {

/// Counts costs as utilities: an agent with a task counts a reward less its cost. The reward is so great that one more agent
/// with a task counts more than any difference in costs. So the best allocation gives tasks to as many agents as it can,
/// and of these allocations it is one of least cost.
class cost_scale {
public:
  /// Throws `input_error` if the costs of the table are too far apart for so many agents.
  cost_scale(utility_table const& table, std::string const& file);

  [[nodiscard]] double utility(double cost) const { return reward_ - (cost - least_); }
  /// How many agents have a task in an allocation of that utility.
  [[nodiscard]] std::size_t employed(double utility) const;
  /// The total cost of an allocation of that utility.
  [[nodiscard]] double cost(double utility) const;
  /// A difference of utilities below this is one of costs, between allocations with as many agents.
  [[nodiscard]] double one_more_agent() const { return one_more_; }

private:
  double least_ = 0;
  double reward_ = 1;
  double one_more_ = 1;
};

/// A cell of the table as the solver counts it, in steps of 2^-20.
[[nodiscard]] double in_steps(double cell);

}  // namespace rota::cli
