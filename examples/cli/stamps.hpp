#pragma once

#include "sweep.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rota::cli {

/// What comes of one way to choose who leads, in one scenario.
struct stamp_cell {
  std::string stamp;
  bool possible = true;  ///< a robot can know what it takes
  std::string scenario;
  estimate right, wrong, not_one, conflict;  ///< shares of 1
  estimate reaction_ms, reaction_p95_ms;     ///< of games with a reaction
  estimate missed;                           ///< share of changes, of games with a change
};

}  // namespace rota::cli
