#pragma once

#include <rota/core/assert.hpp>
#include <rota/core/finite.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

/// Arguments as confidences, for `robot::set_confidence`. Any function will do: stamps are ordered by (confidence, id), so they
/// are totally ordered whatever the confidences mean. But each robot must judge alike, or the greatest is not the best.
namespace rota {

/// The confidence of an argument x: 0 for `least` and below, `greatest` for `most` and above, in proportion between them.
///
/// Not a number counts as the least. Monotone: never smaller for a greater x. @pre least < most, both finite
[[nodiscard]] constexpr std::uint32_t
confidence_of(double const& x, double const& least, double const& most,
              std::uint32_t greatest = (std::numeric_limits<std::uint32_t>::max)()) noexcept {
  ROTA_ASSERT(detail::is_finite(least) && detail::is_finite(most) && least < most);
  if (detail::is_nan(x) || x <= least) return 0;
  if (x >= most) return greatest;
  // Halves: the difference of two finite numbers may be infinite.
  double const part = (x / 2 - least / 2) / (most / 2 - least / 2);
  return (std::min)(static_cast<std::uint32_t>(part * static_cast<double>(greatest)), greatest);
}

/// The greatest second argument of `first_then`.
inline constexpr std::uint32_t greatest_second = (std::uint32_t{1} << 24) - 1;

/// One confidence of two arguments: the first decides, the second only where the first are equal. The first counts up to 255,
/// the second up to `greatest_second`; what is greater counts as that.
[[nodiscard]] constexpr std::uint32_t first_then(std::uint32_t first, std::uint32_t second) noexcept {
  return (std::min)(first, std::uint32_t{255}) << 24 | (std::min)(second, greatest_second);
}

}  // namespace rota
