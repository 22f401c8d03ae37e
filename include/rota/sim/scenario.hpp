#pragma once

#include <rota/core/time.hpp>
#include <rota/sim/geometry.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace rota::sim {

/// The situations of the paper's section 5.
enum class scenario : unsigned char {
  ball_fight,    ///< two robots very close to the ball: each perceives itself as the closer one
  phantom_two,   ///< one robot, far from the ball, sees another ball near itself: two pursue
  phantom_none,  ///< the robot nearest to the ball sees another one near a team mate: none pursues
  mislocalised,  ///< a robot near the ball believes itself metres away from where it is
  hour           ///< play: a moving ball, and now and then one of the above
};

inline constexpr std::array all_scenarios{scenario::ball_fight, scenario::phantom_two, scenario::phantom_none,
                                          scenario::mislocalised, scenario::hour};

[[nodiscard]] constexpr std::string_view to_string(scenario s) noexcept {
  constexpr std::string_view words[] = {"ball-fight", "phantom-two", "phantom-none", "mislocalised", "hour"};
  return words[static_cast<std::size_t>(s)];
}
[[nodiscard]] constexpr std::optional<scenario> parse_scenario(std::string_view name) noexcept {
  for (scenario s : all_scenarios)
    if (to_string(s) == name) return s;
  return std::nullopt;
}
/// How long a scenario is played unless told otherwise.
[[nodiscard]] constexpr duration default_length(scenario s) noexcept {
  return s == scenario::hour ? seconds(3600) : seconds(300);
}
/// Whether its cause persists: `hour` has causes that come and go.
[[nodiscard]] constexpr bool is_persistent(scenario s) noexcept { return s != scenario::hour; }

/// A range to draw from, uniformly.
struct extent {
  micrometres low = 0;
  micrometres high = 0;
};

/// Every number of the scripted worlds. Chosen for plausibility, and not fitted to what the paper counted.
///
/// The four scenarios with a persistent cause are played in rounds: in each, the ball lies elsewhere and the next robot
/// is the one in trouble, so that ids are not confounded with parts: ten rounds of five robots in five minutes.
struct world_options {
  duration tick = milliseconds(10);

  // Rounds.
  duration round = seconds(30);
  extent fight{metres(0.5), metres(0.7)};       ///< distances to the ball of two that fight for it; 120° to 180° apart
  extent near_ball{metres(0.6), metres(1.5)};   ///< of the rightful attacker in the other scenarios
  extent phantom{metres(1.0), metres(2.0)};     ///< of a phantom ball from the robot it lies near
  extent pose_error{metres(2.5), metres(5.0)};  ///< of a mislocalised robot
  micrometres clearance = metres(3.0);          ///< everybody else keeps this far from the ball
  micrometres sway = metres(0.05);              ///< nobody stands quite still

  // Play.
  double kicks_per_minute = 12;  ///< the ball is kicked somewhere, and changes hands with each second kick on average
  double kick_speed = 4.0;       ///< metres per second, as all speeds
  double dribble_speed = 1.0;
  double robot_speed = 3.0;
  micrometres keep_own = metres(0.55);    ///< how close our nearest robot stays to a ball that is ours,
  micrometres keep_theirs = metres(0.9);  ///< and to one that is theirs
  double formation_shift = 0.3;           ///< by how much the formation leans towards the ball
  micrometres roam = metres(0.5);         ///< around one's place in the formation

  // Incidents of play: arrivals (Poisson, in discrete time) and mean durations (geometric, as memoryless).
  double fights_per_hour = 20;
  duration fight_length = seconds(5);
  double phantoms_per_hour = 6;
  duration phantom_length = seconds(8);
  double mislocalisations_per_hour = 6;
  duration mislocalisation_length = seconds(20);
};

}  // namespace rota::sim
