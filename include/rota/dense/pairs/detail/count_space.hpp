#pragma once

#include <rota/core/size.hpp>
#include <rota/dense/buffer.hpp>
#include <rota/dense/instance.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// How many agents each slot has, as one word: a field per slot, all equally wide, each with a spare top bit for comparing.
using packed_counts = std::uint64_t;

/// The vectors of counts (c_0 … c_{m−1}) with c_s ≤ upper_s and a sum of at most `most`. Those of one sum are numbered
/// 0, 1, … in lexicographic order. O(m·most²) memory.
class count_space {
public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};  ///< no vector; and the greatest number of vectors counted
  static constexpr std::size_t most_indices = 16384;        ///< weights stop growing beyond

  /// Whether the counts of n agents fit into one word.
  static bool fits(std::size_t slot_count, std::size_t agents) {
    return slot_count * (static_cast<unsigned>(std::bit_width(agents)) + 1) <= 64;
  }

  /// @pre fits(upper.size(), agents); most ≤ agents
  void prepare(std::span<std::uint32_t const> upper, std::size_t agents, std::size_t most) {
    slots_ = upper.size();
    most_ = most;
    field_ = static_cast<unsigned>(std::bit_width(agents)) + 1;
    guard_ = 0;
    for (std::size_t s = 0; s < slots_; ++s) guard_ |= unit(s) << (field_ - 1);
    std::size_t const row = most + 1;
    std::size_t const loosest = static_cast<std::size_t>(std::max_element(upper.begin(), upper.end()) - upper.begin());
    weight_.assign(slots_, 0);
    indices_ = 1;
    for (std::size_t s = 0; s < slots_; ++s) {
      if (s == loosest || indices_ > most_indices) continue;
      weight_[s] = indices_;
      indices_ *= std::min<std::size_t>(upper[s], most) + 1;
    }
    ways_.assign((slots_ + 1) * row, 0);
    ways_[slots_ * row] = 1;
    before_.assign(slots_ * row * (row + 1), 0);
    for (std::size_t s = slots_; s-- > 0;)
      for (std::size_t r = 0; r <= most; ++r) {
        std::uint64_t sum = 0;
        for (std::size_t t = 0; t <= r && t <= upper[s]; ++t) {
          before_[(s * row + r) * (row + 1) + t] = static_cast<std::uint32_t>(std::min<std::uint64_t>(sum, none));
          sum += ways_[(s + 1) * row + r - t];
        }
        ways_[s * row + r] = static_cast<std::uint32_t>(std::min<std::uint64_t>(sum, none));
      }
  }

  /// How many vectors have the sum k.
  [[nodiscard]] std::size_t size(std::size_t k) const { return ways_[k]; }
  /// The greatest size of a sum up to k.
  [[nodiscard]] std::size_t size_of_largest(std::size_t k) const {
    return *std::max_element(ways_.begin(), ways_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
  }
  [[nodiscard]] packed_counts unit(std::size_t s) const { return packed_counts{1} << (field_ * s); }
  [[nodiscard]] std::size_t count(packed_counts c, std::size_t s) const {
    return rota::detail::to_size(c >> (field_ * s)) & ((std::size_t{1} << (field_ - 1)) - 1);
  }
  /// Whether c_s ≤ d_s for every slot.
  [[nodiscard]] bool below(packed_counts c, packed_counts d) const { return (((d | guard_) - c) & guard_) == guard_; }

  /// The number of a vector among those of sum k. @pre its sum is k ≤ most, and it respects the upper bounds
  [[nodiscard]] std::size_t rank(packed_counts c, std::size_t k) const {
    std::size_t number = 0;
    std::size_t const row = most_ + 1;
    std::size_t const mask = (std::size_t{1} << (field_ - 1)) - 1;
    std::uint32_t const* table = before_.data();
    for (std::size_t s = 0; s + 1 < slots_; ++s, table += row * (row + 1), c >>= field_) {
      std::size_t const here = rota::detail::to_size(c & mask);
      number += table[k * (row + 1) + here];
      k -= here;
    }
    return number;
  }

  /// Σ_s c_s·weight_s over all slots but the one with the greatest upper bound. It is additive, and vectors of one sum differ
  /// in it.
  [[nodiscard]] std::size_t index(packed_counts c) const {
    std::size_t sum = 0;
    for (std::size_t s = 0; s < slots_; ++s) sum += count(c, s) * weight_[s];
    return sum;
  }
  /// One more than the greatest index.
  [[nodiscard]] std::size_t indices() const { return indices_; }

  /// Appends all vectors with lower_s ≤ c_s ≤ upper_s of sum k, in the order of their numbers.
  void list(std::span<std::uint32_t const> lower, std::span<std::uint32_t const> upper, std::size_t k,
            buffer<packed_counts>& out) const {
    std::size_t room = 0;
    for (std::uint32_t const u : upper) room += u;
    list(lower, upper, k, room, 0, 0, out);
  }

private:
  /// @param room how many agents the slots from s on can hold: a vector that they could not complete is not begun
  void list(std::span<std::uint32_t const> lower, std::span<std::uint32_t const> upper, std::size_t k, std::size_t room,
            std::size_t s, packed_counts c, buffer<packed_counts>& out) const {
    if (s + 1 == slots_) {
      if (k >= lower[s] && k <= upper[s]) out.push_back(c + unit(s) * k);
      return;
    }
    room -= upper[s];
    for (std::size_t t = std::max<std::size_t>(lower[s], k - (std::min)(k, room)); t <= k && t <= upper[s]; ++t)
      list(lower, upper, k - t, room, s + 1, c + unit(s) * t, out);
  }

  std::size_t slots_ = 0;
  std::size_t most_ = 0;
  unsigned field_ = 1;
  packed_counts guard_ = 0;
  std::size_t indices_ = 1;
  buffer<std::size_t> weight_;
  buffer<std::uint32_t> ways_;    // [s, r]: how many vectors of the slots from s on have the sum r
  buffer<std::uint32_t> before_;  // [s, r, t]: how many of these have c_s < t
};

}  // namespace rota::dense::detail
