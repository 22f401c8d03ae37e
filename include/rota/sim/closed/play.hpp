#pragma once

#include <rota/sim/closed/argue.hpp>
#include <rota/sim/closed/auction.hpp>
#include <rota/sim/closed/central.hpp>
#include <rota/sim/closed/commit.hpp>
#include <rota/sim/closed/game.hpp>
#include <rota/sim/closed/robots.hpp>
#include <rota/sim/closed/ways.hpp>

namespace rota::sim::closed {

/// Plays a game in which all robots decide in one way. Equal options give equal figures.
/// @pre 2 ≤ robots ≤ max_robots, as many as the plans of the book can use
[[nodiscard]] inline game_figures play_game(playbook const& book, way how, game_options o) {
  switch (how) {
  case way::rota: o.rules.robot.change_period = o.rules.news ? o.rules.gap : duration{}; break;
  case way::silent: o.rules.robot.resolution = false; break;
  case way::central: return game<central_coordinator<eyes::own>>(book, o).play();
  case way::majority: return game<central_coordinator<eyes::pooled>>(book, o).play();
  case way::steam: return game<commit_coordinator>(book, o).play();
  case way::consa: return game<argue_coordinator>(book, o).play();
  case way::cbba: return game<auction_coordinator>(book, o).play();
  case way::alica: {
    o.rules.robot = {};
    o.rules.stamp = {};
    o.rules.robot.renewals = 0;
    return game<robot_coordinator<literal_monitor<names>>>(book, o).play();
  }
  }
  return game<robot_coordinator<conflict_monitor<names>>>(book, o).play();
}

}  // namespace rota::sim::closed
