#pragma once
/// @file
/// Words for what a search found or did not. A header of its own, since searching needs no strings.

#include <rota/allocation/print.hpp>
#include <rota/search/reallocate.hpp>

#include <string>

namespace rota {

/// Why one plan yields nothing, as a sentence without a full stop. `name(id)` turns agents and tasks into strings.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(plan_refusal<V> const& r, Names const& name = {}) {
  auto const count = std::to_string(r.count);
  switch (r.why) {
  case no_plan_reason::contradictory_cardinalities:
    return "the tasks' cardinalities sum to " + count + " agents, but the plan bears " + to_string(r.bounds);
  case no_plan_reason::too_few_agents:
    return count + " agents take part, " + std::to_string(r.bounds.lower()) + " are needed";
  case no_plan_reason::too_many_agents:
    return count + " agents take part, nobody may idle, and there is room for " + std::to_string(r.bounds.upper());
  case no_plan_reason::task_short:
    return count + " agents may take on task " + name(r.task) + ", which needs " + to_string(r.bounds);
  case no_plan_reason::agent_without_task: return "agent " + name(r.agent) + " may neither take on a task nor idle";
  case no_plan_reason::pairs_contradict: return "the forbidden pairs leave no allocation within the cardinalities";
  case no_plan_reason::utility_refused: return "a utility " + to_string(r.fault);
  case no_plan_reason::precondition_never_holds: return "the precondition holds on no allocation";
  case no_plan_reason::precondition_threw: return "the precondition threw";
  case no_plan_reason::negative_utility: return "the best utility is " + std::to_string(r.value) + ", below 0";
  case no_plan_reason::utilities_too_great:
    return "the utilities of agent " + name(r.agent) + " are too great to be summed exactly";
  case no_plan_reason::search_incomplete: return "the search ended before a valid allocation was found";
  }
  return "?";
}

[[nodiscard]] inline std::string to_string(reallocation_reason r) {
  switch (r) {
  case reallocation_reason::first: return "first allocation";
  case reallocation_reason::adopted_better: return "a better one was adopted";
  case reallocation_reason::current_invalid: return "the current one is not valid";
  case reallocation_reason::kept_optimal: return "nothing is better";
  case reallocation_reason::kept_hysteresis: return "nothing is better by more than the hysteresis";
  case reallocation_reason::kept_unproved: return "nothing better was found within the budget";
  case reallocation_reason::no_valid_allocation: return "there is no valid allocation";
  case reallocation_reason::search_incomplete: return "no valid allocation was found within the budget";
  }
  return "?";
}

}  // namespace rota
