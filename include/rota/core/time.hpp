#pragma once

#include <rota/core/config.hpp>

#include <compare>
#include <cstdint>
#include <limits>

namespace rota {

/// A length of time in nanoseconds, possibly negative. Arithmetic is exact. @pre results stay within ±292 years
struct duration {
  std::int64_t ns = 0;

  friend auto operator<=>(duration, duration) = default;
  friend constexpr duration operator+(duration a, duration b) noexcept { return {a.ns + b.ns}; }
  friend constexpr duration operator-(duration a, duration b) noexcept { return {a.ns - b.ns}; }
  friend constexpr duration operator-(duration a) noexcept { return {-a.ns}; }
  friend constexpr duration operator*(duration a, std::int64_t n) noexcept { return {a.ns * n}; }
  friend constexpr duration operator*(std::int64_t n, duration a) noexcept { return {a.ns * n}; }
  constexpr duration& operator+=(duration b) noexcept { return *this = *this + b; }
  constexpr duration& operator-=(duration b) noexcept { return *this = *this - b; }
};

/// A point in time on one robot's own clock. Clocks of different robots are never compared: messages carry durations.
struct instant {
  std::int64_t ns = 0;

  friend auto operator<=>(instant, instant) = default;
  friend constexpr instant operator+(instant t, duration d) noexcept { return {t.ns + d.ns}; }
  friend constexpr instant operator-(instant t, duration d) noexcept { return {t.ns - d.ns}; }
  friend constexpr duration operator-(instant a, instant b) noexcept { return {a.ns - b.ns}; }
  constexpr instant& operator+=(duration d) noexcept { return *this = *this + d; }
  constexpr instant& operator-=(duration d) noexcept { return *this = *this - d; }
};

[[nodiscard]] constexpr duration nanoseconds(std::int64_t n) noexcept { return {n}; }
[[nodiscard]] constexpr duration microseconds(std::int64_t n) noexcept { return {n * 1'000}; }
[[nodiscard]] constexpr duration milliseconds(std::int64_t n) noexcept { return {n * 1'000'000}; }
[[nodiscard]] constexpr duration seconds(std::int64_t n) noexcept { return {n * 1'000'000'000}; }

/// The length in seconds, for statistics.
[[nodiscard]] constexpr double to_seconds(duration d) noexcept { return static_cast<double>(d.ns) * 1e-9; }
/// The length in milliseconds, for statistics.
[[nodiscard]] constexpr double to_milliseconds(duration d) noexcept { return static_cast<double>(d.ns) * 1e-6; }

/// Later than every instant that a clock shows.
inline constexpr instant never{(std::numeric_limits<std::int64_t>::max)()};
/// Earlier than every instant that a clock shows.
inline constexpr instant long_ago{(std::numeric_limits<std::int64_t>::min)()};

/// An instant after the clock was set by d; `never` and `long_ago` stay.
[[nodiscard]] constexpr instant moved(instant t, duration d) noexcept {
  return t == never || t == long_ago ? t : t + d;
}

}  // namespace rota
