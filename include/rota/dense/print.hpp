#pragma once
/// @file
/// Text for how a solver ended and why. A header of its own, since solving needs no strings.

#include <rota/dense/flow/solver.hpp>
#include <rota/dense/outcome.hpp>
#include <rota/dense/pairs/instance.hpp>

#include <string>

namespace rota::dense {

[[nodiscard]] inline std::string to_string(status s) {
  switch (s) {
  case status::optimal: return "optimal";
  case status::feasible: return "feasible";
  case status::infeasible: return "infeasible";
  case status::unknown: return "unknown";
  }
  return "?";
}

[[nodiscard]] inline std::string to_string(flow_obstacle o) {
  switch (o) {
  case flow_obstacle::none: return "none";
  case flow_obstacle::agent_stuck: return "an agent finds no slot";
  case flow_obstacle::slot_short: return "a slot lacks agents";
  }
  return "?";
}

[[nodiscard]] inline std::string to_string(pair_cut c) {
  switch (c) {
  case pair_cut::bound: return "bound";
  case pair_cut::cardinality: return "cardinality";
  case pair_cut::absence: return "absence";
  case pair_cut::symmetry: return "symmetry";
  }
  return "?";
}

}  // namespace rota::dense
