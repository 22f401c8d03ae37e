#pragma once

#include <compare>
#include <cstdint>

namespace rota {

/// Which life of a robot this is. It grows with every start, so that peers can tell a restarted robot from delayed messages
/// of its former life: they ignore what has a smaller incarnation than the greatest they heard of that robot, until they have
/// not heard it for `robot_options::forget`.
///
/// The library keeps no file and reads no clock, so the program obtains one at each start:
/// * with storage that survives a restart, a counter: read it, add one, write it back, then `incarnation{counter}`;
/// * without, a wall clock that is read once: `incarnation::started_at(seconds since 1970)`. This grows if starts are a
///   second or more apart and the clock never shows less than at an earlier start. A board whose clock begins at 1970
///   whenever it loses power needs the counter.
///
/// 0 means that none was given; `robot` does not take it.
struct incarnation {
  std::uint64_t value = 0;

  /// The incarnation of a robot that starts so many seconds after 1970, as `std::time(nullptr)` gives them; 0 before 1970.
  [[nodiscard]] static constexpr incarnation started_at(std::int64_t seconds_since_1970) noexcept {
    return {seconds_since_1970 > 0 ? static_cast<std::uint64_t>(seconds_since_1970) : 0};
  }

  /// The greatest that peers accept. Greater numbers, such as random ones of 64 bits, are taken for flipped bits.
  [[nodiscard]] static constexpr incarnation most() noexcept { return {(std::uint64_t{1} << 62) - 1}; }

  friend auto operator<=>(incarnation, incarnation) = default;
};

}  // namespace rota
