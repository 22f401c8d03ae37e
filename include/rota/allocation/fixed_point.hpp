#pragma once

#include <rota/core/finite.hpp>
#include <rota/core/result.hpp>

#include <compare>
#include <cstdint>
#include <limits>

namespace rota {

/// Why a utility cannot be counted.
enum class utility_fault : unsigned char {
  none,               ///< nothing is wrong
  not_a_number,       ///< NaN
  positive_infinity,  ///< +∞
  negative_infinity,  ///< −∞; to forbid a pair, return `nullopt`
  out_of_range,       ///< |u| > `max_utility`, or a total beyond `max_total_utility`
  forbidden_pair,     ///< the additive utility forbids this pair (`nullopt`), so U_p is not defined
  threw,              ///< the user's function threw
  negative            ///< clause (6): U_p < 0
};

/// The greatest magnitude of one utility.
inline constexpr double max_utility = 1073741824.0;  // 2^30

/// The greatest magnitude of U_p, which may be a sum of many utilities.
inline constexpr double max_total_utility = 1024 * max_utility;  // 2^40

/// A utility as an integer number of units of 2^-20.
///
/// Each number is rounded once; sums are exact. So no sum depends on its order, and agents with equal beliefs decide
/// equally. Sums of up to 4096 utilities cannot overflow.
struct fixed_utility {
  static constexpr double units_per_one = 1048576.0;  // 2^20
  std::int64_t units = 0;

  friend auto operator<=>(fixed_utility, fixed_utility) = default;
};

namespace detail {

/// `max_total_utility` in units.
inline constexpr auto most_total_units = static_cast<std::int64_t>(max_total_utility * fixed_utility::units_per_one);

}  // namespace detail

/// The nearest fixed-point value, halves away from zero in every rounding mode; or why there is none.
[[nodiscard]] constexpr result<fixed_utility, utility_fault> quantise(double const& u) noexcept {
  if (!detail::is_finite(u)) {
    if (detail::is_nan(u)) return refused{utility_fault::not_a_number};
    return refused{detail::has_minus_sign(u) ? utility_fault::negative_infinity : utility_fault::positive_infinity};
  }
  if (u < -max_utility || u > max_utility) return refused{utility_fault::out_of_range};
  double const scaled = u * fixed_utility::units_per_one;  // exact: a power of two
  auto units = static_cast<std::int64_t>(scaled);
  double const rest = scaled - static_cast<double>(units);
  units += static_cast<int>(rest >= 0.5) - static_cast<int>(rest <= -0.5);
  return fixed_utility{units};
}

/// The value as a number. Exact up to a magnitude of 2^33.
[[nodiscard]] constexpr double to_double(fixed_utility u) noexcept {
  return static_cast<double>(u.units) / fixed_utility::units_per_one;
}

/// total ← total + term. If the sum does not fit 64 bits it returns false and leaves `total` as it is.
[[nodiscard]] constexpr bool checked_add(fixed_utility& total, fixed_utility term) noexcept {
  using limits = std::numeric_limits<std::int64_t>;
  if (term.units > 0 ? total.units > (limits::max)() - term.units : total.units < (limits::min)() - term.units)
    return false;
  total.units += term.units;
  return true;
}

}  // namespace rota
