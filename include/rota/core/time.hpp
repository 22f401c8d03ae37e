#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace rota {

/// A span of time in nanoseconds, possibly negative. Arithmetic is exact; overflow (beyond ±292 years) is a precondition.
struct duration {
  std::int64_t ns = 0;

  friend auto operator<=>(duration, duration) = default;
  friend constexpr duration operator+(duration a, duration b) noexcept { return {a.ns + b.ns}; }
  friend constexpr duration operator-(duration a, duration b) noexcept { return {a.ns - b.ns}; }
  friend constexpr duration operator-(duration a) noexcept { return {-a.ns}; }
  friend constexpr duration operator*(duration a, std::int64_t n) noexcept { return {a.ns * n}; }
  friend constexpr duration operator*(std::int64_t n, duration a) noexcept { return {a.ns * n}; }
};

/// A point on one agent's own clock. Clocks of different agents are never compared: messages carry durations.
struct instant {
  std::int64_t ns = 0;

  friend auto operator<=>(instant, instant) = default;
  friend constexpr instant operator+(instant t, duration d) noexcept { return {t.ns + d.ns}; }
  friend constexpr instant operator-(instant t, duration d) noexcept { return {t.ns - d.ns}; }
  friend constexpr duration operator-(instant a, instant b) noexcept { return {a.ns - b.ns}; }
};

[[nodiscard]] constexpr duration nanoseconds(std::int64_t n) noexcept { return {n}; }
[[nodiscard]] constexpr duration microseconds(std::int64_t n) noexcept { return {n * 1'000}; }
[[nodiscard]] constexpr duration milliseconds(std::int64_t n) noexcept { return {n * 1'000'000}; }
[[nodiscard]] constexpr duration seconds(std::int64_t n) noexcept { return {n * 1'000'000'000}; }

/// Length in seconds, for printing and statistics.
[[nodiscard]] constexpr double to_seconds(duration d) noexcept { return static_cast<double>(d.ns) * 1e-9; }
/// Length in milliseconds, for printing and statistics.
[[nodiscard]] constexpr double to_milliseconds(duration d) noexcept { return static_cast<double>(d.ns) * 1e-6; }

/// Later than every instant that occurs.
inline constexpr instant never{(std::numeric_limits<std::int64_t>::max)()};

}  // namespace rota
