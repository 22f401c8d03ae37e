#pragma once

#include <rota/core/result.hpp>

#include <compare>
#include <cstdint>
#include <limits>

namespace rota {

/// Refusal: bounds with n₁ > n₂.
struct empty_interval {
  std::uint32_t min = 0;
  std::uint32_t max = 0;
  friend bool operator==(empty_interval const&, empty_interval const&) = default;
};

/// ξ(p, τ) = [n₁, n₂]: how many agents may take on a task, both ends included; n₂ may be `unbounded`.
///
/// Class invariant: lower() ≤ upper().
class cardinality {
public:
  static constexpr std::uint32_t unbounded = (std::numeric_limits<std::uint32_t>::max)();

  /// [0, ∞), which restricts nothing.
  constexpr cardinality() = default;
  /// @pre min ≤ max; use `make` for numbers from outside
  constexpr cardinality(std::uint32_t min, std::uint32_t max) : min_(min), max_(max) { ROTA_ASSERT(min <= max); }

  /// [min, max], refused if empty.
  [[nodiscard]] static constexpr result<cardinality, empty_interval> make(std::uint32_t min, std::uint32_t max) {
    if (min > max) return refused{empty_interval{min, max}};
    return cardinality{min, max};
  }

  [[nodiscard]] constexpr std::uint32_t lower() const noexcept { return min_; }
  [[nodiscard]] constexpr std::uint32_t upper() const noexcept { return max_; }
  [[nodiscard]] constexpr bool is_bounded() const noexcept { return max_ != unbounded; }
  /// n₁ ≤ n ≤ n₂.
  [[nodiscard]] constexpr bool admits(std::size_t n) const noexcept {
    return n >= min_ && (!is_bounded() || n <= max_);
  }

  friend auto operator<=>(cardinality const&, cardinality const&) = default;

private:
  std::uint32_t min_ = 0;
  std::uint32_t max_ = unbounded;
};

}  // namespace rota
