#pragma once

#include <rota/allocation/fixed_point.hpp>

#include <optional>

namespace rota {

/// The gain in utility that a running allocation must be beaten by: it stays while
/// U(best) − change costs ≤ U(current) + h, h = absolute + relative·|U(current)|.
struct hysteresis {
  std::optional<double> absolute{};  ///< unset: the running plan's own `hysteresis()`; @pre not negative, not NaN
  double relative = 0;               ///< a share of the current utility; @pre not negative, not NaN

  friend bool operator==(hysteresis const&, hysteresis const&) = default;
};

/// h as a fixed-point gain. A gain beyond `max_utility` counts as one that nothing reaches.
[[nodiscard]] constexpr fixed_utility margin_of(double h) noexcept {
  ROTA_ASSERT(h >= 0);
  auto const fixed = quantise(h);
  return fixed ? fixed.value() : fixed_utility{(std::numeric_limits<std::int64_t>::max)()};
}

/// Whether `best` beats `current` by more than the margin. Exact; never overflows.
[[nodiscard]] constexpr bool beats(fixed_utility best, fixed_utility current, fixed_utility margin) noexcept {
  return checked_add(current, margin) && best > current;
}

}  // namespace rota
