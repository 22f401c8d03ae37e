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
  ball_fight,    ///< two robots are very close to the ball, and each perceives itself as the closer one
  phantom_two,   ///< a robot far from the ball sees another ball near itself, so two robots pursue a ball
  phantom_none,  ///< the robot nearest to the ball sees another ball near a team mate, so nobody pursues the ball
  mislocalised,  ///< a robot near the ball believes that it is metres away from where it is
  hour           ///< play: the ball moves, and now and then one of the above happens
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
/// How long a scenario is played by default.
[[nodiscard]] constexpr duration default_length(scenario s) noexcept {
  return s == scenario::hour ? seconds(3600) : seconds(300);
}
/// Whether the cause of conflict lasts all the time; in `hour` causes come and go.
[[nodiscard]] constexpr bool is_persistent(scenario s) noexcept { return s != scenario::hour; }

/// A range to draw from, uniformly.
struct extent {
  micrometres low = 0;
  micrometres high = 0;
};

/// Every number of the scripted worlds. They are chosen to be plausible and are not fitted to what the paper counted.
///
/// The four scenarios with a lasting cause are played in rounds, ten in five minutes. In each round the ball lies elsewhere
/// and the next robot is the one in trouble, so that no part belongs to one id.
struct world_options {
  duration tick = milliseconds(10);

  // Rounds.
  duration round = seconds(30);
  extent fight{metres(0.5), metres(0.7)};      ///< distances to the ball of two that fight for it; 120° to 180° apart
  extent near_ball{metres(0.6), metres(1.5)};  ///< distance of the rightful attacker to the ball in the other scenarios
  extent phantom{metres(1.0), metres(2.0)};    ///< distance of a phantom ball to the robot that it lies near
  extent pose_error{metres(2.5), metres(5.0)};  ///< how wrong a mislocalised robot is about its place
  micrometres clearance = metres(3.0);          ///< everybody else keeps this far from the ball
  micrometres sway = metres(0.05);              ///< how far a robot that stands still moves about its place

  // Play.
  double kicks_per_minute = 12;  ///< after every second kick on average the other team has the ball
  double kick_speed = 4.0;       ///< in metres per second, like all speeds
  double dribble_speed = 1.0;
  double robot_speed = 3.0;
  micrometres keep_own = metres(0.55);    ///< distance of our nearest robot to the ball while we have it
  micrometres keep_theirs = metres(0.9);  ///< distance of our nearest robot to the ball while they have it
  double formation_shift = 0.3;           ///< the formation shifts towards the ball by this fraction of the way
  micrometres roam = metres(0.5);         ///< how far a robot moves about its place in the formation

  // Incidents of play: they arrive at random (Poisson, in discrete time) and end at random (geometric, with these means).
  double fights_per_hour = 20;
  duration fight_length = seconds(5);
  double phantoms_per_hour = 6;
  duration phantom_length = seconds(8);
  double mislocalisations_per_hour = 6;
  duration mislocalisation_length = seconds(20);
};

}  // namespace rota::sim
