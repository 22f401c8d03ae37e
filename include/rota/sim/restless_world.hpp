#pragma once

#include <rota/sim/perception.hpp>
#include <rota/sim/random.hpp>
#include <rota/sim/world.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace rota::sim {

/// How often something changes in a restless world; not at all where nothing is said.
struct restless_options {
  duration jumps{};      ///< the mean time between two jumps of the ball; 0: it lies still
  duration delusions{};  ///< the mean time until a robot begins or ceases to see a ball near itself; 0: none does
  instant calm = never;  ///< from here on the ball lies still, and all see the same
};

/// Robots that stand in their formation, a ball that jumps, and robots that see a ball of their own near themselves, so that
/// several are sure to be closest. Through exact sensors everybody else sees the same. O(1) per change.
class restless_world {
public:
  /// @pre 2 ≤ robots ≤ max_robots
  restless_world(std::size_t robots, std::uint64_t seed, restless_options const& options)
      : options_(options), engine_(engine_for(seed, stream::world, 0)) {
    ROTA_ASSERT(robots >= 2 && robots <= max_robots);
    for (std::size_t i = 0; i < robots; ++i) state_.robots.push_back({formation_spot(i), {}, {}});
    jump();
    next_jump_ = after({}, options_.jumps);
    next_delusion_ = after({}, options_.delusions);
  }

  void advance(instant t) {
    for (instant next = due(); next <= t && next < options_.calm; next = due()) {
      if (next_jump_ <= next_delusion_) {
        jump();
        next_jump_ = after(next, options_.jumps);
      } else {
        auto const last = static_cast<std::int64_t>(state_.robots.size()) - 1;
        robot_state& r = state_.robots[static_cast<std::size_t>(uniform(engine_, 0, last))];
        set_deluded(r, !r.phantom);
        next_delusion_ = after(next, options_.delusions);
      }
    }
    if (t < options_.calm) return;
    for (robot_state& r : state_.robots) r.phantom.reset();
  }
  /// Lets a robot see a ball near itself from now on, or see what all see.
  void delude(std::size_t robot, bool deluded = true) { set_deluded(state_.robots[robot], deluded); }
  [[nodiscard]] world_state const& state() const noexcept { return state_; }

private:
  [[nodiscard]] instant due() const { return (std::min)(next_jump_, next_delusion_); }
  [[nodiscard]] instant after(instant t, duration mean) {
    return mean == duration{} ? never : t + nanoseconds(uniform(engine_, 1, 2 * mean.ns));
  }
  void jump() {
    state_.ball.x = uniform(engine_, -metres(8), metres(8));
    state_.ball.y = uniform(engine_, -metres(5), metres(5));
  }
  static void set_deluded(robot_state& r, bool deluded) {
    r.phantom.reset();
    if (deluded) r.phantom = r.position + point{metres(0.3), 0};
  }

  restless_options options_;
  random_engine engine_;
  world_state state_;
  instant next_jump_{};
  instant next_delusion_{};
};

static_assert(world<restless_world>);

/// Eyes without error.
[[nodiscard]] constexpr sensor_options exact_sensor() noexcept {
  sensor_options s;
  s.bias_permille = s.ball_noise = s.ball_noise_permille = s.mate_noise = 0;
  return s;
}

}  // namespace rota::sim
