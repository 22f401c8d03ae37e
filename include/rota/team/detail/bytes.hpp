#pragma once

#include <rota/core/identifier.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

namespace rota::detail {

/// CRC-32 (ISO-HDLC, the one of Ethernet, zip and PNG): what a flipped bit on the way does not survive. Four bits at a time:
/// a table of sixteen entries, since messages are short.
[[nodiscard]] constexpr std::uint32_t crc32(std::span<std::byte const> bytes) noexcept {
  constexpr auto table = [] {
    std::array<std::uint32_t, 16> t{};
    for (std::uint32_t i = 0; i < 16; ++i) {
      std::uint32_t x = i;
      for (int k = 0; k < 4; ++k) x = (x & 1) != 0 ? 0xedb88320u ^ (x >> 1) : x >> 1;
      t[i] = x;
    }
    return t;
  }();
  std::uint32_t sum = 0xffffffffu;
  for (std::byte const b : bytes) {
    sum ^= static_cast<std::uint32_t>(b);
    sum = table[sum & 15] ^ (sum >> 4);
    sum = table[sum & 15] ^ (sum >> 4);
  }
  return ~sum;
}

/// Signed numbers as unsigned ones, small magnitudes staying small: 0, −1, 1, −2, … ↦ 0, 1, 2, 3, …
[[nodiscard]] constexpr std::uint64_t zigzag(std::int64_t x) noexcept {
  return (static_cast<std::uint64_t>(x) << 1) ^ static_cast<std::uint64_t>(x >> 63);
}
[[nodiscard]] constexpr std::int64_t unzigzag(std::uint64_t x) noexcept {
  return static_cast<std::int64_t>(x >> 1) ^ -static_cast<std::int64_t>(x & 1);
}

/// Writes into a span; what does not fit is counted and dropped.
class byte_writer {
public:
  constexpr explicit byte_writer(std::span<std::byte> out) noexcept : out_(out) {}

  constexpr void byte(std::uint8_t x) noexcept {
    if (size_ < out_.size()) out_[size_] = std::byte{x};
    ++size_;
  }
  /// Seven bits a byte, the lowest first; the top bit says that more follow. One byte below 128, ten at most.
  constexpr void number(std::uint64_t x) noexcept {
    for (; x >= 0x80; x >>= 7) byte(static_cast<std::uint8_t>(x | 0x80));
    byte(static_cast<std::uint8_t>(x));
  }
  constexpr void fixed32(std::uint32_t x) noexcept {
    for (int k = 0; k < 4; ++k, x >>= 8) byte(static_cast<std::uint8_t>(x));
  }
  [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }
  [[nodiscard]] constexpr bool fits() const noexcept { return size_ <= out_.size(); }

private:
  std::span<std::byte> out_;
  std::size_t size_ = 0;
};

/// Reads from a span. The first thing that is wrong is remembered; from then on everything reads as 0.
class byte_reader {
public:
  enum class fault : std::uint8_t { none, cut_short, not_canonical, out_of_range };

  constexpr explicit byte_reader(std::span<std::byte const> in) noexcept : in_(in) {}

  constexpr std::uint8_t byte() noexcept {
    if (at_ == in_.size()) fail(fault::cut_short);
    return fault_ == fault::none ? static_cast<std::uint8_t>(in_[at_++]) : std::uint8_t{0};
  }
  /// A number of at most `most`, in as few bytes as it needs: each number is written in one way only.
  constexpr std::uint64_t number(std::uint64_t most = (std::numeric_limits<std::uint64_t>::max)()) noexcept {
    std::uint64_t x = 0;
    for (unsigned shift = 0;; shift += 7) {
      auto const b = byte();
      if (shift == 63 && b > 1) fail(fault::out_of_range);
      if (shift != 0 && b == 0) fail(fault::not_canonical);
      if (fault_ != fault::none) return 0;
      x |= std::uint64_t{b & 0x7fu} << shift;
      if (b < 0x80) break;
    }
    if (x > most) fail(fault::out_of_range);
    return fault_ == fault::none ? x : 0;
  }
  constexpr std::uint32_t fixed32() noexcept {
    std::uint32_t x = 0;
    for (unsigned shift = 0; shift < 32; shift += 8) x |= std::uint32_t{byte()} << shift;
    return x;
  }
  constexpr void fail(fault f) noexcept {
    if (fault_ == fault::none) fault_ = f;
  }
  [[nodiscard]] constexpr fault wrong() const noexcept { return fault_; }
  [[nodiscard]] constexpr std::size_t left() const noexcept { return in_.size() - at_; }

private:
  std::span<std::byte const> in_;
  std::size_t at_ = 0;
  fault fault_ = fault::none;
};

}  // namespace rota::detail
