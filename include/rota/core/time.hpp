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

/// No clock of a robot shows more, before or after its zero.
inline constexpr duration century = seconds(3'155'760'000);

/// An instant after the clock was set by d; `never` and `long_ago` stay. Clocks that are set again and again do not carry it
/// further than 1.8 centuries, so that its distance to what a clock shows can be computed.
[[nodiscard]] constexpr instant moved(instant t, duration d) noexcept {
  constexpr std::int64_t most = century.ns / 10 * 18;
  if (t == never || t == long_ago) return t;
  if (d.ns > 0 && t.ns > most - d.ns) return {most};
  if (d.ns < 0 && t.ns < -most - d.ns) return {-most};
  return t + d;
}

}  // namespace rota
