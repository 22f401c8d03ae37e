#pragma once
/// @file
/// To and from std::chrono. Not in the umbrella, because <chrono> costs more to compile than all of core/.

#include <rota/core/time.hpp>

#include <chrono>

namespace rota {

/// Fractions of a nanosecond are dropped. @pre the value fits 64 bits of nanoseconds
template <class Rep, class Period>
[[nodiscard]] constexpr duration from_chrono(std::chrono::duration<Rep, Period> d) noexcept {
  return {std::chrono::duration_cast<std::chrono::nanoseconds>(d).count()};
}

[[nodiscard]] constexpr std::chrono::nanoseconds to_chrono(duration d) noexcept {
  return std::chrono::nanoseconds{d.ns};
}

/// The instant that `Clock` shows, counted from that clock's own epoch.
template <class Clock, class Duration>
[[nodiscard]] constexpr instant from_chrono(std::chrono::time_point<Clock, Duration> t) noexcept {
  return {std::chrono::duration_cast<std::chrono::nanoseconds>(t.time_since_epoch()).count()};
}

}  // namespace rota
