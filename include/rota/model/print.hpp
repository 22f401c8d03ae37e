#pragma once
/// @file
/// Text for plans, cardinalities and what is wrong with their descriptions. A header of its own, since deciding needs no
/// strings.

#include <rota/algebra/print.hpp>
#include <rota/core/print.hpp>
#include <rota/model/allocation.hpp>
#include <rota/model/plan_type.hpp>

#include <string>

namespace rota {

/// `play: {In(1, 0, 1), In(2, 0, 0)}`: the plan type and the atoms. `name(id)` turns each name into a string.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string to_string(allocation<V> const& c, Names const& name = {}) {
  return name(c.type) + ": " + to_string(c.atoms, name);
}

/// `1..2`; no upper bound reads `*`.
[[nodiscard]] inline std::string to_string(cardinality c) {
  return std::to_string(c.lower()) + ".." + (c.is_bounded() ? std::to_string(c.upper()) : "*");
}

[[nodiscard]] inline std::string to_string(precondition_scope s) {
  switch (s) {
  case precondition_scope::always: return "always";
  case precondition_scope::entry_only: return "entry only";
  }
  return "?";
}

[[nodiscard]] inline std::string to_string(possibility p) {
  switch (p) {
  case possibility::no: return "no";
  case possibility::perhaps: return "perhaps";
  case possibility::certain: return "certain";
  }
  return "?";
}

[[nodiscard]] inline std::string to_string(empty_interval const& e) {
  return "the bounds " + to_string(cardinality(e.min, e.max)) + " admit no number";
}

/// What is wrong with the description of a plan, as a sentence without a full stop. `name(id)` turns tasks into strings.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(plan_defect<V> const& d, Names const& name = {}) {
  using kind = typename plan_defect<V>::kind;
  switch (d.what) {
  case kind::repeated_task: return "task " + name(d.task) + " is listed twice";
  case kind::no_task: return "the plan has no task";
  case kind::missing_utility: return "the utility, or a part of it, is missing";
  case kind::weight_not_finite: return "a weight of the utility is not a finite number";
  case kind::threshold_not_finite: return "the hysteresis is negative or not a finite number";
  case kind::empty_cardinality:
    return "task " + name(d.task) + " wants " + to_string(d.bounds) + " agents, which is impossible";
  case kind::empty_team_size: return "the plan wants " + to_string(d.bounds) + " agents in all, which is impossible";
  }
  return "?";
}

/// What is wrong with the plans of a plan type, as a sentence without a full stop.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(plan_type_defect<V> const& d, Names const& name = {}) {
  using kind = typename plan_type_defect<V>::kind;
  switch (d.what) {
  case kind::no_plan: return "the plan type has no plan";
  case kind::repeated_plan: return "plan " + name(d.plan) + " is listed twice";
  }
  return "?";
}

}  // namespace rota
