#pragma once

#include <rota/core/config.hpp>

#include <bit>
#include <cstdint>

namespace rota::detail {

// By the bits, not by `x == x` or `x - x == 0`: under -ffast-math compilers fold these to true. By reference, since clang
// then assumes of a double passed by value that it is finite. Ask this before any comparison.

inline constexpr std::uint64_t exponent_bits = 0x7ff0'0000'0000'0000;

/// Neither NaN nor infinite.
[[nodiscard]] constexpr bool is_finite(double const& x) noexcept {
  return (std::bit_cast<std::uint64_t>(x) & exponent_bits) != exponent_bits;
}
[[nodiscard]] constexpr bool is_nan(double const& x) noexcept {
  return (std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63)) > exponent_bits;
}
[[nodiscard]] constexpr bool has_minus_sign(double const& x) noexcept {
  return std::bit_cast<std::uint64_t>(x) >> 63 != 0;
}

}  // namespace rota::detail
