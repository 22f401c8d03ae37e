#pragma once

#include <rota/allocation/fixed_point.hpp>

#include <cstdint>
#include <limits>
#include <optional>

namespace rota {

/// By how much a new allocation must beat the running one, which stays while
/// U(best) − change costs ≤ U(current) + h, h = absolute + relative·|U(current)|.
///
/// Choose it, or `problem::change_cost`, about as large as the noise in the utilities. With both at 0, agents that are equally
/// good swap tasks at almost every tick.
/// Nothing beats an h that is infinite or beyond `max_utility`.
struct hysteresis {
  std::optional<double> absolute{};  ///< unset: the running plan's own `hysteresis()`; @pre not negative, not NaN
  double relative = 0;               ///< a share of the current utility; @pre not negative, not NaN

  friend bool operator==(hysteresis const&, hysteresis const&) = default;
};

namespace detail {

/// A margin that nothing beats.
inline constexpr fixed_utility unbeatable{(std::numeric_limits<std::int64_t>::max)()};

/// h as a fixed-point gain. @pre not negative, not NaN
[[nodiscard]] constexpr fixed_utility margin_of(double const& h) noexcept {
  if (!is_finite(h)) {  // before any comparison, which -ffast-math makes void
    ROTA_ASSERT(!is_nan(h) && !has_minus_sign(h));
    return unbeatable;
  }
  ROTA_ASSERT(h >= 0);
  auto const fixed = quantise(h);
  return fixed && fixed.value().units >= 0 ? fixed.value() : unbeatable;
}

/// The h of a running allocation worth `current`, whose plan has the hysteresis `own`.
[[nodiscard]] constexpr fixed_utility margin_of(hysteresis const& h, double own, fixed_utility current) noexcept {
  if (!is_finite(h.relative)) return margin_of(h.relative);  // ∞·0 is NaN
  auto margin = margin_of(h.absolute.value_or(own));
  double const u = to_double(current);
  return checked_add(margin, margin_of(h.relative * (u < 0 ? -u : u))) ? margin : unbeatable;
}

/// Whether `best` beats `current` by more than the margin. Exact; never overflows.
[[nodiscard]] constexpr bool beats(fixed_utility best, fixed_utility current, fixed_utility margin) noexcept {
  return checked_add(current, margin) && best > current;
}

}  // namespace detail
}  // namespace rota
