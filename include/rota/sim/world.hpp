#pragma once

#include <rota/core/time.hpp>
#include <rota/sim/geometry.hpp>

#include <concepts>
#include <cstddef>
#include <optional>
#include <vector>

namespace rota::sim {

/// The truth about one robot, and its errors.
struct robot_state {
  point position;
  point pose_error;              ///< it believes that it is so far from its position, and tells the others so
  std::optional<point> phantom;  ///< it sees a ball here instead of the true one
};

/// The truth about ball and robots.
struct world_state {
  point ball;
  std::vector<robot_state> robots;
};

/// A world that runs by itself: what the robots decide changes nothing in it. So robots see the same, bit for bit, in runs
/// with and without conflict resolution.
template <class W>
concept world = std::copyable<W> && requires(W w, W const& c, instant t) {
  w.advance(t);  // to simulated time t, never backwards
  { c.state() } -> std::same_as<world_state const&>;
};

inline constexpr std::size_t max_robots = 11;

/// Where a robot lines up; its own half is on the left. @pre robot < max_robots
[[nodiscard]] inline point formation_spot(std::size_t robot) {
  constexpr point spots[max_robots] = {
      {metres(-7), metres(0)},     {metres(-3), metres(2.5)}, {metres(-3), metres(-2.5)}, {metres(2.5), metres(3.5)},
      {metres(2.5), metres(-3.5)}, {metres(0), metres(0)},    {metres(-5), metres(4)},    {metres(-5), metres(-4)},
      {metres(6), metres(1.5)},    {metres(6), metres(-1.5)}, {metres(-1), metres(5)}};
  ROTA_ASSERT(robot < max_robots);
  return spots[robot];
}

/// Two robots and a still ball. Until `begin` one robot is close to the ball and both agree. From then on both are equally
/// close, on opposite sides, and each sees itself as the closer one.
class duel_world {
public:
  explicit duel_world(instant begin) : begin_(begin) {
    state_.robots = {{{-gap, 0}, {}, {}}, {{metres(6), 0}, {}, {}}};
  }
  void advance(instant t) {
    if (t >= begin_) state_.robots[1].position = {gap, 0};
  }
  [[nodiscard]] world_state const& state() const noexcept { return state_; }

private:
  static constexpr micrometres gap = metres(0.6);
  instant begin_;
  world_state state_;
};

}  // namespace rota::sim
