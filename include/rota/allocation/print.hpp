#pragma once
/// @file
/// Text for violations, clauses and utilities. A header of its own, since judging needs no strings.

#include <rota/allocation/validate.hpp>
#include <rota/core/print.hpp>
#include <rota/model/print.hpp>

#include <optional>
#include <string>

namespace rota {

[[nodiscard]] inline std::string to_string(idling i) {
  switch (i) {
  case idling::allowed: return "allowed";
  case idling::forbidden: return "forbidden";
  }
  return "?";
}

[[nodiscard]] inline std::string to_string(plan_phase p) {
  switch (p) {
  case plan_phase::entering: return "entering";
  case plan_phase::running: return "running";
  }
  return "?";
}

/// With the number that Def. 1 gives the clause, if it does.
[[nodiscard]] inline std::string to_string(clause c) {
  switch (c) {
  case clause::one_plan: return "(0) one plan";
  case clause::foreign_task: return "foreign task";
  case clause::stranger: return "stranger";
  case clause::role: return "role";
  case clause::cardinality: return "(1)-(3) cardinality";
  case clause::one_task: return "(4) one task";
  case clause::precondition: return "(5) precondition";
  case clause::utility: return "(6) utility";
  case clause::forbidden_pair: return "(6) forbidden pair";
  case clause::team_size: return "team size";
  case clause::idle_forbidden: return "idle forbidden";
  }
  return "?";
}

/// In units of 1: `1.5`.
[[nodiscard]] inline std::string to_string(fixed_utility u) { return detail::number(to_double(u)); }

/// The predicate of a sentence about a utility.
[[nodiscard]] inline std::string to_string(utility_fault f) {
  switch (f) {
  case utility_fault::none: return "is as it should be";
  case utility_fault::not_a_number: return "is not a number";
  case utility_fault::positive_infinity: return "is +infinity";
  case utility_fault::negative_infinity: return "is -infinity";
  case utility_fault::out_of_range: return "is out of range";
  case utility_fault::forbidden_pair: return "is undefined: the pair is forbidden";
  case utility_fault::threw: return "threw";
  case utility_fault::negative: return "is negative";
  }
  return "?";
}

/// Why U_p is not defined, as a sentence without a full stop. `name(id)` turns agents and tasks into strings.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(utility_refusal<V> const& r, Names const& name = {}) {
  if (!r.atom) return "the utility " + to_string(r.reason);
  std::string const one = "agent " + name(r.atom->agent) + " on task " + name(r.atom->task);
  if (!r.other) return "the utility of " + one + " " + to_string(r.reason);
  return "the utility of " + one + " together with agent " + name(r.other->agent) + " on task " + name(r.other->task) +
         " " + to_string(r.reason);
}

/// One violation as a sentence without a full stop. `name(id)` turns agents, plans, tasks and states into strings.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(violation<V> const& v, Names const& name = {}) {
  auto agent = [&] { return "agent " + name(v.agent); };
  auto task = [&] { return "task " + name(v.task); };
  auto plan = [&] { return "plan " + name(v.plan); };
  switch (v.what) {
  case clause::one_plan:
    if (!v.about_atom) return plan() + " does not belong to the plan type";
    if (v.atom.plan == v.plan) return agent() + " executes " + plan() + ", which does not belong to the plan type";
    return agent() + " executes plan " + name(v.atom.plan) + " instead of " + plan();
  case clause::foreign_task: return agent() + " has " + task() + ", which is none of " + plan();
  case clause::stranger: return agent() + " has " + task() + " but takes no part";
  case clause::role: return "the role of " + agent() + " forbids " + task();
  case clause::cardinality:
    return task() + " has " + std::to_string(v.count) + " agents instead of " + to_string(v.bounds);
  case clause::one_task:
    if (v.atom == v.other)
      return agent() + " is in states " + name(v.state) + " and " + name(v.other_state) + " of " + task();
    return agent() + " has tasks " + name(v.atom.task) + " and " + name(v.other.task);
  case clause::precondition:
    return "the precondition of " + plan() + (v.fault == utility_fault::threw ? " threw" : " does not hold");
  case clause::utility:
    if (v.fault == utility_fault::negative) return "the utility of " + plan() + " is " + detail::number(v.value);
    if (!v.about_atom) return "the utility of " + plan() + " " + to_string(v.fault);
    return describe(utility_refusal<V>{v.fault, v.atom, v.about_pair ? std::optional{v.other} : std::nullopt}, name);
  case clause::forbidden_pair: return agent() + " must not take on " + task();
  case clause::team_size:
    return plan() + " has " + std::to_string(v.count) + " agents instead of " + to_string(v.bounds);
  case clause::idle_forbidden: return agent() + " has no task";
  }
  return "?";
}

}  // namespace rota
