#pragma once

#include <rota/core/assert.hpp>

#include <cmath>
#include <cstdint>

namespace rota::sim {

/// Lengths are whole micrometres, so that nothing in the simulation depends on how a compiler rounds.
using micrometres = std::int64_t;

/// For constants. @pre |m| at most 60
[[nodiscard]] constexpr micrometres metres(double m) noexcept {
  return static_cast<micrometres>(m * 1'000'000 + (m < 0 ? -0.5 : 0.5));
}
/// For printing.
[[nodiscard]] constexpr double to_metres(micrometres d) noexcept { return static_cast<double>(d) * 1e-6; }

/// A place on the field, or a displacement. The origin is the centre spot, x points to the opponents' goal.
struct point {
  micrometres x = 0;
  micrometres y = 0;

  friend bool operator==(point, point) = default;
  friend constexpr point operator+(point a, point b) noexcept { return {a.x + b.x, a.y + b.y}; }
  friend constexpr point operator-(point a, point b) noexcept { return {a.x - b.x, a.y - b.y}; }
};

/// |v|, rounded down. @pre |x|, |y| at most 60 m: then the square fits 53 bits and IEEE 754 rounds the root correctly, so the
/// result is the same everywhere.
[[nodiscard]] inline micrometres length(point v) {
  ROTA_ASSERT(v.x <= metres(60) && v.x >= -metres(60) && v.y <= metres(60) && v.y >= -metres(60));
  return static_cast<micrometres>(std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y)));
}
[[nodiscard]] inline micrometres distance(point a, point b) { return length(a - b); }

/// v · to / from: a vector of length `from` gets length `to`. @pre from > 0; all at most 60 m
[[nodiscard]] constexpr point rescaled(point v, micrometres to, micrometres from) noexcept {
  return {v.x * to / from, v.y * to / from};
}

/// The point at distance `d` from `centre` in the direction of `other`, or in direction x if the two coincide.
[[nodiscard]] inline point towards(point centre, point other, micrometres d) {
  point const v = other - centre;
  micrometres const norm = length(v);
  return norm == 0 ? centre + point{d, 0} : centre + rescaled(v, d, norm);
}

/// The point that is reached from `from` by a step towards `target` that is at most `step` long.
[[nodiscard]] inline point moved(point from, point target, micrometres step) {
  micrometres const left = distance(from, target);
  return left <= step ? target : from + rescaled(target - from, step, left);
}

/// The field of the Middle Size League.
inline constexpr micrometres field_length = metres(18);
inline constexpr micrometres field_width = metres(12);
inline constexpr micrometres field_diagonal = 21'633'308;  // floor of sqrt(18^2 + 12^2) m

}  // namespace rota::sim
