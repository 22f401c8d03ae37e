#pragma once
/// @file
/// Words for violations. A header of its own, since judging needs no strings.

#include <rota/allocation/validate.hpp>
#include <rota/core/print.hpp>

#include <string>

namespace rota {

[[nodiscard]] inline std::string to_string(cardinality c) {
  return std::to_string(c.lower()) + ".." + (c.is_bounded() ? std::to_string(c.upper()) : "*");
}

[[nodiscard]] inline std::string to_string(utility_fault f) {
  switch (f) {
  case utility_fault::none: return "nothing is wrong";
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
    if (v.fault == utility_fault::negative) return "the utility of " + plan() + " is " + std::to_string(v.value);
    if (!v.about_atom) return "the utility of " + plan() + " " + to_string(v.fault);
    if (v.about_pair)
      return "the utility of " + agent() + " on " + task() + " together with agent " + name(v.other.agent) +
             " on task " + name(v.other.task) + " " + to_string(v.fault);
    return "the utility of " + agent() + " on " + task() + " " + to_string(v.fault);
  case clause::forbidden_pair: return agent() + " must not take on " + task();
  case clause::team_size:
    return plan() + " has " + std::to_string(v.count) + " agents instead of " + to_string(v.bounds);
  case clause::idle_forbidden: return agent() + " has no task";
  }
  return "?";
}

}  // namespace rota
