#pragma once

#include <rota/sim/random.hpp>
#include <rota/sim/world.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rota::sim {

/// How robots see. The numbers fit an omnidirectional camera whose distances are calibrated imperfectly.
struct sensor_options {
  micrometres exact_distance = metres(3);  ///< a nearer ball seems nearer than it is, a farther one farther
  std::int64_t bias_permille = 400;        ///< by less than this fraction of the distance
  micrometres ball_noise = metres(0.01);   ///< standard deviation of the seen ball in x and y, at distance 0
  std::int64_t ball_noise_permille = 20;   ///< this fraction of the distance is added to `ball_noise`
  micrometres mate_noise = metres(0.03);   ///< standard deviation of a team mate's reported place in x and y
  /// Robots track what they see: with each frame an error moves 1/tracking of the way to the error of that frame. At 1 they
  /// do not track. Then a leader that is six metres away sees the ball jump by more than a plan's hysteresis of 10 cm,
  /// changes its choice with every other frame, and keeps an episode of conflict open for up to ten seconds. The hysteresis
  /// must exceed the noise.
  std::int64_t tracking = 4;
};

/// The distance at which a robot sees a ball at distance d: d + bias · d · (d − d₀) / (d + d₀). @pre 0 ≤ d ≤ 60 m
[[nodiscard]] constexpr micrometres seen_distance(sensor_options const& s, micrometres d) noexcept {
  micrometres const d0 = s.exact_distance;
  return d + d * (d - d0) / (d + d0) * s.bias_permille / 1000;
}

/// What one robot believes of the world when it deliberates: the belief base F that the plan's utilities read.
struct perceived {
  point ball;
  std::vector<point> robots;  ///< index 0 is the robot with id 1
  bool blind = false;         ///< it sees nothing: it can judge no task
};

/// Writes the beliefs of a robot that knows the truth.
inline void know(world_state const& truth, perceived& into) {
  into.ball = truth.ball;
  into.robots.clear();
  for (robot_state const& r : truth.robots) into.robots.push_back(r.position);
}

/// The eyes of one robot, with its own random stream.
class sensor {
public:
  sensor(sensor_options const& options, std::size_t self, std::uint64_t seed)
      : options_(options), self_(self), engine_(engine_for(seed, stream::perception, self)) {
    ROTA_ASSERT(options.tracking >= 1);
  }

  /// Sees the ball relative to itself, so that a wrong pose displaces it, and hears from its mates where they believe they
  /// are. Draws equally often whatever it sees. O(robots).
  void look(world_state const& truth, perceived& into) {
    robot_state const& me = truth.robots[self_];
    point const self = me.position + me.pose_error;
    point const sight = me.phantom.value_or(truth.ball) - me.position;
    micrometres const d = length(sight);
    micrometres const spread = options_.ball_noise + d * options_.ball_noise_permille / 1000;
    point const seen = d == 0 ? sight : rescaled(sight, seen_distance(options_, d), d);
    into.ball = self + seen + track(ball_error_, spread);
    into.robots.resize(truth.robots.size());
    mate_errors_.resize(truth.robots.size());
    for (std::size_t i = 0; i < truth.robots.size(); ++i) {
      robot_state const& r = truth.robots[i];
      into.robots[i] = i == self_ ? self : r.position + r.pose_error + track(mate_errors_[i], options_.mate_noise);
      note(into.robots[i]);
    }
    note(into.ball);
  }

  /// A digest of everything seen so far.
  [[nodiscard]] std::uint64_t digest() const noexcept { return digest_; }

private:
  /// The error of a tracked position after one more frame, whose own error has the standard deviation `sigma`.
  point track(point& error, micrometres sigma) {
    error.x += part(noise(engine_, sigma) - error.x);
    error.y += part(noise(engine_, sigma) - error.y);
    return error;
  }
  [[nodiscard]] micrometres part(micrometres whole) const noexcept {
    return options_.tracking == 4 ? whole / 4 : whole / options_.tracking;  // the default takes no division
  }
  void note(point p) noexcept {
    digest_ = scatter(digest_ ^ static_cast<std::uint64_t>(p.x)) ^ static_cast<std::uint64_t>(p.y);
  }

  sensor_options options_;
  std::size_t self_;
  random_engine engine_;
  point ball_error_;
  std::vector<point> mate_errors_;
  std::uint64_t digest_ = 0;
};

}  // namespace rota::sim
