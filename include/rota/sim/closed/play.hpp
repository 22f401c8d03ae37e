#pragma once

#include <rota/sim/closed/argue.hpp>
#include <rota/sim/closed/auction.hpp>
#include <rota/sim/closed/central.hpp>
#include <rota/sim/closed/commit.hpp>
#include <rota/sim/closed/game.hpp>
#include <rota/sim/closed/robots.hpp>

#include <array>
#include <optional>
#include <string_view>

namespace rota::sim::closed {

/// Ways of deciding who does what.
enum class way : unsigned char {
  rota,      ///< act, notice conflicts, and follow a leader for as long as need be
  silent,    ///< act, and believe what the others say of themselves: no resolution
  alica,     ///< act, Def. 5 to the letter, and the greatest id leads for two seconds: as the paper has it
  central,   ///< one decides for all, by what it sees
  majority,  ///< one decides for all, by what most see
  steam,     ///< all confirm a change before anybody acts on it
  consa,     ///< who would do otherwise argues, and all act on the strongest grounds
  cbba       ///< all bid for tasks, and agree on who bids most
};

inline constexpr std::array all_ways{way::rota,     way::silent, way::alica, way::central,
                                     way::majority, way::steam,  way::consa, way::cbba};

[[nodiscard]] constexpr std::string_view to_string(way w) noexcept {
  constexpr std::string_view words[] = {"rota", "silent", "alica", "central", "majority", "steam", "consa", "cbba"};
  return words[static_cast<std::size_t>(w)];
}
[[nodiscard]] constexpr std::optional<way> parse_way(std::string_view name) noexcept {
  for (way w : all_ways)
    if (to_string(w) == name) return w;
  return std::nullopt;
}

/// Plays a game in which all robots decide in one way. Equal options give equal figures.
/// @pre 2 ≤ robots ≤ max_robots, as many as the plans of the book can use
[[nodiscard]] inline game_figures play_game(playbook const& book, way how, game_options o) {
  switch (how) {
  case way::rota: o.rules.robot.change_period = o.rules.gap; break;
  case way::silent: o.rules.robot.resolution = false; break;
  case way::central: return game<central_coordinator<eyes::own>>(book, o).play();
  case way::majority: return game<central_coordinator<eyes::pooled>>(book, o).play();
  case way::steam: return game<commit_coordinator>(book, o).play();
  case way::consa: return game<argue_coordinator>(book, o).play();
  case way::cbba: return game<auction_coordinator>(book, o).play();
  case way::alica: {
    o.rules.robot = {};  // the paper's
    return game<robot_coordinator<literal_monitor<names>>>(book, o).play();
  }
  }
  return game<robot_coordinator<conflict_monitor<names>>>(book, o).play();
}

}  // namespace rota::sim::closed
