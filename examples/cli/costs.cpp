#include "costs.hpp"

#include "command.hpp"
#include "text.hpp"

#include <rota/allocation/fixed_point.hpp>

#include <algorithm>
#include <cmath>

namespace rota::cli {

double in_steps(double cell) {
  auto const steps = quantise(cell);
  return steps ? to_double(*steps) : 0;
}

cost_scale::cost_scale(utility_table const& table, std::string const& file) {
  std::optional<double> most;
  for (auto const& row : table.cells)
    for (auto const& cell : row) {
      if (!cell) continue;
      double const cost = in_steps(*cell);
      least_ = most ? std::min(least_, cost) : cost;
      most = most ? std::max(*most, cost) : cost;
    }
  double const range = most.value_or(0) - least_;
  reward_ = static_cast<double>(table.agents.size() + 1) * range + 1;
  one_more_ = range + 1;
  if (reward_ > max_utility)
    throw input_error(file, "",
                      "costs from " + number(least_) + " to " + number(*most) + " are too far apart for " +
                          counted(table.agents.size(), "agent") +
                          ": (agents + 1) times their difference is above 2^30");
}

std::size_t cost_scale::employed(double utility) const {
  return static_cast<std::size_t>(std::ceil(utility / reward_));
}

double cost_scale::cost(double utility) const {
  auto const n = static_cast<double>(employed(utility));
  return n * reward_ - utility + n * least_;
}

}  // namespace rota::cli
