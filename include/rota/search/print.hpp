#pragma once
/// @file
/// Words for what a search found or did not. A header of its own, since searching needs no strings.
///
/// Sentences have no full stop. `name(id)` turns agents, plans and tasks into strings; see `default_names`.

#include <rota/allocation/print.hpp>
#include <rota/core/print.hpp>
#include <rota/dense/print.hpp>
#include <rota/search/assign.hpp>
#include <rota/search/reallocate.hpp>

#include <optional>
#include <string>

namespace rota {

[[nodiscard]] inline std::string to_string(no_plan_reason r) {
  switch (r) {
  case no_plan_reason::contradictory_cardinalities: return "contradictory cardinalities";
  case no_plan_reason::too_few_agents: return "too few agents";
  case no_plan_reason::too_many_agents: return "too many agents";
  case no_plan_reason::task_short: return "a task lacks agents";
  case no_plan_reason::agent_without_task: return "an agent can do nothing";
  case no_plan_reason::pairs_contradict: return "forbidden pairs contradict the cardinalities";
  case no_plan_reason::utility_refused: return "a utility is not valid";
  case no_plan_reason::precondition_never_holds: return "the precondition never holds";
  case no_plan_reason::precondition_threw: return "the precondition threw";
  case no_plan_reason::negative_utility: return "negative utility";
  case no_plan_reason::search_incomplete: return "the search ended early";
  case no_plan_reason::utilities_too_great: return "utilities too great";
  case no_plan_reason::change_cost_refused: return "the change cost is not valid";
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

[[nodiscard]] inline std::string to_string(assign_fault f) {
  switch (f) {
  case assign_fault::sizes_differ: return "the sizes differ";
  case assign_fault::empty_bounds: return "empty bounds";
  case assign_fault::not_a_number: return "not a number";
  case assign_fault::infinite: return "infinite";
  case assign_fault::too_large: return "too large";
  case assign_fault::task_short: return "a task lacks agents";
  case assign_fault::agent_stuck: return "an agent finds no task";
  }
  return "?";
}

/// Why `assign` refused. Agents and tasks are named by their row and column, counted from 0.
[[nodiscard]] inline std::string describe(assign_refusal const& r) {
  auto const agent = "agent " + std::to_string(r.agent);
  auto const task = "task " + std::to_string(r.task);
  switch (r.reason) {
  case assign_fault::sizes_differ: return "the matrix does not have one entry per task in every row";
  case assign_fault::empty_bounds: return "the bounds of " + task + " admit no number of agents";
  case assign_fault::not_a_number: return "the entry of " + agent + " and " + task + " is not a number";
  case assign_fault::infinite: return "the entry of " + agent + " and " + task + " is infinite";
  case assign_fault::too_large:
    return "the entry of " + agent + " and " + task + " is too large for exact sums over so many agents and tasks";
  case assign_fault::task_short: return task + " cannot get as many agents as its bounds ask for";
  case assign_fault::agent_stuck: return agent + " finds no room in a task, and idling is forbidden";
  }
  return "?";
}

namespace detail {

/// How far the best may be from an allocation that is not proved to be it.
[[nodiscard]] inline std::string words_of_gap(double gap) {
  if (!is_finite(gap)) return "another may be better, by an unknown amount";
  if (gap > 0) return "another may be better, by at most " + number(gap);
  return "nothing is better, but another may be as good and preferred";
}

/// What a search left out, and the bound that it found to be wrong, each with "; " before it.
template <vocabulary V, class Names>
[[nodiscard]] std::string complaints(std::optional<utility_refusal<V>> const& ignored,
                                     std::optional<bound_lie<V>> const& lie, Names const& name) {
  std::string out;
  if (ignored) out += "; left out: " + describe(*ignored, name);
  if (lie)
    out += "; nothing is proved, for the bound of plan " + name(lie->plan) + " is wrong: it says at most " +
           number(lie->bound) + " where " + number(lie->value) + " is possible";
  return out;
}

}  // namespace detail

/// Why one plan yields nothing.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(plan_refusal<V> const& r, Names const& name = {}) {
  auto const count = std::to_string(r.count);
  switch (r.reason) {
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
  case no_plan_reason::utility_refused: {
    utility_refusal<V> u{r.fault, {}, {}};
    if (r.about_atom) u.atom = in<V>{r.agent, r.plan, r.task};
    if (r.about_pair) u.other = r.other;
    return describe(u, name);
  }
  case no_plan_reason::precondition_never_holds: return "the precondition holds on no allocation";
  case no_plan_reason::precondition_threw: return "the precondition threw";
  case no_plan_reason::negative_utility: return "the best utility is " + detail::number(r.value) + ", below 0";
  case no_plan_reason::utilities_too_great:
    return "the utilities of agent " + name(r.agent) + " are too great to be summed exactly";
  case no_plan_reason::change_cost_refused: return "the change cost " + to_string(r.fault);
  case no_plan_reason::search_incomplete: return "the search ended before a valid allocation was found";
  }
  return "?";
}

namespace detail {

/// ": plan p: why; plan q: why", and what the search complains of unless that has been said.
template <vocabulary V, class Names>
[[nodiscard]] std::string reasons(small_vector<plan_refusal<V>, 2> const& plans,
                                  std::optional<utility_refusal<V>> const& ignored,
                                  std::optional<bound_lie<V>> const& lie, Names const& name) {
  std::string out;
  bool said = false;
  for (auto const& r : plans) {
    out += (out.empty() ? ": plan " : "; plan ") + name(r.plan) + ": " + describe(r, name);
    said |= r.reason == no_plan_reason::utility_refused;
  }
  return out + complaints(said ? std::nullopt : ignored, lie, name);
}

}  // namespace detail

/// Why no plan has a valid allocation, or none was found.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(no_allocation<V> const& none, Names const& name = {}) {
  return (none.proved() ? "no allocation is valid" : "no valid allocation was found, but one may exist") +
         detail::reasons(none.plans, none.ignored, none.lie, name);
}

/// The plan, its utility, how far it may be from the best, and which plan comes next.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(solution<V> const& s, Names const& name = {}) {
  std::string out = "plan " + name(s.plan) + " with utility " + detail::number(s.utility) + ", ";
  out += s.proved ? "proved to be the best" : detail::words_of_gap(s.gap);
  if (s.runner_up)
    out += "; the next best is plan " + name(s.runner_up->plan) + ", worth " + detail::number(s.runner_up->distance) +
           " less";
  return out + detail::complaints(s.ignored, s.lie, name);
}

/// What to do, and why.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(reallocation<V> const& r, Names const& name = {}) {
  auto const utility = [&] { return " with utility " + detail::number(r.utility); };
  auto const adopted = [&] { return "plan " + (r.plan ? name(*r.plan) : "?") + " is adopted" + utility(); };
  auto const gain = [&] { return r.gain ? detail::number(*r.gain) : std::string("?"); };
  auto const broken = [&] { return r.violated ? ": " + describe(*r.violated, name) : std::string(); };
  std::string const stays = "the running allocation stays" + utility() + ": ";
  std::string out;
  switch (r.reason) {
  case reallocation_reason::first: out = adopted() + ": nothing was running"; break;
  case reallocation_reason::adopted_better: out = adopted() + ": a gain of " + gain(); break;
  case reallocation_reason::current_invalid:
    out = adopted() + ": the running allocation is not valid" + broken();
    break;
  case reallocation_reason::kept_optimal: out = stays + "nothing is better"; break;
  case reallocation_reason::kept_hysteresis:
    out = stays + "another is better by " + gain() + ", not by more than the hysteresis";
    break;
  case reallocation_reason::kept_unproved: out = stays + "nothing better was found"; break;
  case reallocation_reason::no_valid_allocation: out = "nobody has a task: no allocation is valid"; break;
  case reallocation_reason::search_incomplete:
    out = "nobody has a task: no valid allocation was found, but one may exist";
    break;
  }
  if (!r.refusals.empty()) return out + detail::reasons(r.refusals, r.ignored, r.lie, name);
  if (!r.proved) out += "; " + detail::words_of_gap(r.gap);
  return out + detail::complaints(r.ignored, r.lie, name);
}

}  // namespace rota
