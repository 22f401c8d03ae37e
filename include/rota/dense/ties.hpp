#pragma once

#include <rota/dense/instance.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace rota::dense {

/// Makes ties rare, or impossible: the utility u of a pair becomes the key u·2^shift + preference(agent, slot).
///
/// All preferences together stay below 2^shift, so an assignment with the greatest total of keys has a greatest total of
/// utilities. Among several of these, keys decide:
/// - if s^n fits into the spare bits, preferences are the digits of a number: the lexicographically smallest wins, and no two
///   totals of keys are equal (`unique`);
/// - otherwise preferences are a fixed hash of (agent, slot): ties are rare, and of those that remain a solver takes the
///   lexicographically smallest. Without this, every interchangeable agent would cost a search.
/// A rule depends on three numbers only: agents, slots, and the bits of the greatest utility.
class tie_rule {
public:
  /// For no agents and no slots.
  tie_rule() = default;
  /// For n agents and s slots with utilities of at most `magnitude`. @pre fits(n, s, magnitude)
  tie_rule(std::size_t agents, std::size_t slot_count, std::uint64_t magnitude) noexcept
      : agents_(static_cast<unsigned>(agents)), slots_(slot_count) {
    auto const bits = [](std::uint64_t n) { return static_cast<unsigned>(std::bit_width(n)); };
    auto const size = bits(magnitude);  // utilities are below 2^size
    auto const reach = (std::max)(bits(slot_count + 2), (std::max)(bits(agents), 5u) - 5);
    unsigned const spare =
        size + reach >= 55 ? 0 : 55 - size - reach;  // 55: max_reach, and max_total is 2^5 times that
    std::uint64_t all = 1;
    unsigned digits = 0;
    for (; digits < agents && all <= std::uint64_t{1} << 54; ++digits) all *= std::max<std::size_t>(slot_count, 1);
    if (digits == agents && bits(all - 1) <= spare) {
      shift_ = bits(all - 1);
      unique_ = true;
    } else if (auto const sum = bits(agents); spare >= sum + 4) {
      noise_ = (std::min)(spare - sum, 20u);
      shift_ = noise_ + sum;
    }
  }

  /// u·2^shift + preference. @pre u is present
  [[nodiscard]] std::int64_t key(std::int64_t utility, std::size_t agent, std::size_t s) const noexcept {
    return utility * (std::int64_t{1} << shift_) + preference(agent, s);
  }
  /// Turns a row of utilities into a row of keys; `absent` stays `absent`.
  void keys(std::size_t agent, std::int64_t const* utility, std::int64_t* key) const noexcept {
    auto const weight = unique_ ? digit(agent) : 0;
    for (std::size_t s = 0; s < slots_; ++s) {
      auto const more = unique_ ? weight * static_cast<std::int64_t>(slots_ - 1 - s) : noise(agent, s);
      key[s] = utility[s] == absent ? absent : utility[s] * (std::int64_t{1} << shift_) + more;
    }
  }
  /// Turns a total of keys into the total of utilities, and a bound on keys into a bound on utilities.
  [[nodiscard]] std::int64_t utility(std::int64_t total) const noexcept { return total >> shift_; }
  /// Whether no two assignments have the same total of keys.
  [[nodiscard]] bool unique() const noexcept { return unique_; }

  friend bool operator==(tie_rule const&, tie_rule const&) = default;

private:
  [[nodiscard]] std::int64_t preference(std::size_t agent, std::size_t s) const noexcept {
    return unique_ ? digit(agent) * static_cast<std::int64_t>(slots_ - 1 - s) : noise(agent, s);
  }
  /// s^(n−1−a): the preference of agent a for a slot over the next one.
  [[nodiscard]] std::int64_t digit(std::size_t agent) const noexcept {
    std::int64_t weight = 1;
    for (auto a = agent + 1; a < agents_; ++a) weight *= static_cast<std::int64_t>(slots_);
    return weight;
  }
  [[nodiscard]] std::int64_t noise(std::size_t agent, std::size_t s) const noexcept {
    std::uint64_t x = (std::uint64_t{agent} << 32 | s) * 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 32) * 0xd6e8feb86659fd93u;
    return noise_ == 0 ? 0 : static_cast<std::int64_t>(x >> (64 - noise_));
  }

  unsigned agents_ = 0;
  std::size_t slots_ = 0;
  unsigned shift_ = 0;
  unsigned noise_ = 0;  // bits of a preference that is a hash
  bool unique_ = false;
};

}  // namespace rota::dense
