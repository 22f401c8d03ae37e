#pragma once

#include <rota/team/decision.hpp>
#include <rota/team/wire.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace rota {

/// How many messages were accepted, stale or refused, and why: what a log or a display says about the radio.
///
/// A regular value of fixed size; a robot needs none. Count what `decode` refuses, and what `robot::receive` says of the rest.
/// `to_string` of team/print.hpp names each reason.
class reception_counts {
public:
  /// So many reasons there are.
  static constexpr std::size_t refusals = static_cast<std::size_t>(refusal::resolution_off) + 1;
  static constexpr std::size_t wire_faults = static_cast<std::size_t>(wire_fault::out_of_range) + 1;

  template <vocabulary V>
  constexpr void count(reception<V> const& r) noexcept {
    switch (r.verdict) {
    case verdict::accepted: ++accepted_; break;
    case verdict::stale: ++stale_; break;
    case verdict::refused: ++refused_[static_cast<std::size_t>(r.reason)]; break;
    }
  }
  constexpr void count(wire_fault f) noexcept { ++undecodable_[static_cast<std::size_t>(f)]; }

  [[nodiscard]] constexpr std::uint64_t accepted() const noexcept { return accepted_; }
  [[nodiscard]] constexpr std::uint64_t stale() const noexcept { return stale_; }
  [[nodiscard]] constexpr std::uint64_t of(refusal r) const noexcept { return refused_[static_cast<std::size_t>(r)]; }
  [[nodiscard]] constexpr std::uint64_t of(wire_fault f) const noexcept {
    return undecodable_[static_cast<std::size_t>(f)];
  }
  /// For whatever reason, as bytes or as a message.
  [[nodiscard]] constexpr std::uint64_t refused() const noexcept {
    std::uint64_t sum = 0;
    for (auto const n : refused_) sum += n;
    for (auto const n : undecodable_) sum += n;
    return sum;
  }

  friend bool operator==(reception_counts const&, reception_counts const&) = default;

private:
  std::uint64_t accepted_ = 0;
  std::uint64_t stale_ = 0;
  std::array<std::uint64_t, refusals> refused_{};
  std::array<std::uint64_t, wire_faults> undecodable_{};
};

}  // namespace rota
