#pragma once

#include <rota/core/result.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rota {

/// Refusal: bounds with n₁ > n₂.
struct empty_interval {
  std::uint32_t min = 0;
  std::uint32_t max = 0;
  friend bool operator==(empty_interval const&, empty_interval const&) = default;
};

[[nodiscard]] constexpr char const* reason_of(empty_interval const&) noexcept {
  return "empty_interval: the bounds admit no number";
}

/// ξ(p, τ) = [n₁, n₂]: how many agents may take on a task, both ends included; n₂ may be `unbounded`.
///
/// [3, 1] can be written. It is empty: it admits no number, and `plan::make` refuses it.
class cardinality {
public:
  static constexpr std::uint32_t unbounded = (std::numeric_limits<std::uint32_t>::max)();

  /// [0, ∞), which restricts nothing.
  constexpr cardinality() = default;
  /// [lower, upper], which is empty if lower > upper.
  constexpr cardinality(std::uint32_t lower, std::uint32_t upper) noexcept : lower_(lower), upper_(upper) {}

  /// [lower, upper], refused if empty: for numbers from outside.
  [[nodiscard]] static constexpr result<cardinality, empty_interval> make(std::uint32_t lower, std::uint32_t upper) {
    if (lower > upper) return refused{empty_interval{lower, upper}};
    return cardinality{lower, upper};
  }

  [[nodiscard]] constexpr std::uint32_t lower() const noexcept { return lower_; }
  [[nodiscard]] constexpr std::uint32_t upper() const noexcept { return upper_; }
  [[nodiscard]] constexpr bool is_bounded() const noexcept { return upper_ != unbounded; }
  [[nodiscard]] constexpr bool is_empty() const noexcept { return lower_ > upper_; }
  /// n₁ ≤ n ≤ n₂.
  [[nodiscard]] constexpr bool admits(std::size_t n) const noexcept {
    return n >= lower_ && (!is_bounded() || n <= upper_);
  }

  friend auto operator<=>(cardinality const&, cardinality const&) = default;

private:
  std::uint32_t lower_ = 0;
  std::uint32_t upper_ = unbounded;
};

}  // namespace rota
