#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/instance.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace rota::detail {

/// The worth w_ij(x, y) of every two agents i < j in slots x and y: the couplings of an instance, and bounds on their sum.
///
/// Write with `resize`, `put` for all pairs, `finish`; then read. Memory O(n²·m²) for n agents and m slots.
/// It does not copy: couplings refer to the tables beside them.
class pair_tables {
public:
  pair_tables() = default;
  pair_tables(pair_tables const&) = delete;
  pair_tables& operator=(pair_tables const&) = delete;

  [[nodiscard]] static constexpr bool suit(std::size_t agents, std::size_t slot_count) noexcept {
    return agents <= dense::max_pair_agents && slot_count <= dense::max_pair_slots;
  }

  /// Sets every entry to 0, unless the tables have this size already.
  void resize(std::size_t agents, std::size_t slot_count) {
    if (agents_ == agents && slots_ == slot_count) return;
    agents_ = agents;
    slots_ = slot_count;
    worth_.assign(agents * (agents - 1) / 2 * slot_count * slot_count, 0);
  }
  /// w_ij(x, y) ← worth, or `absent` to forbid it. @return whether the entry changed @pre i < j
  bool put(std::size_t i, std::size_t x, std::size_t j, std::size_t y, std::int64_t worth) {
    auto& here = worth_[index(i, j) + x * slots_ + y];
    if (here == worth) return false;
    here = worth;
    return true;
  }

  /// Makes couplings and bounds. @return false if Σ_{i<j} max|w_ij| exceeds `max_pair_total`: then do not read
  /// @pre `unary` as in `dense::pair_instance`
  bool finish(std::span<std::int64_t const> unary) {
    if (!find_couplings()) return false;
    most_.assign(agents_ * slots_ * (agents_ + 1), 0);
    rest_.assign(agents_ + 1, 0);
    for (std::size_t i = agents_; i-- > 0;) {
      rest_[i] = rest_[i + 1];
      for (std::size_t j = agents_; j-- > i + 1;) {
        std::int64_t most = forbidden;
        for (std::size_t x = 0; x < slots_; ++x) {
          std::int64_t best = forbidden;
          for (std::size_t y = 0; y < slots_; ++y)
            if (unary[j * slots_ + y] != dense::absent) best = (std::max)(best, worth(i, x, j, y));
          auto* const with = &most_[(i * slots_ + x) * (agents_ + 1)];
          with[j] = with[j + 1] + best;
          if (unary[i * slots_ + x] != dense::absent) most = (std::max)(most, best);
        }
        rest_[i] += most;
      }
    }
    return true;
  }

  /// Whether the tables and `unary` together keep within `max_pair_total`, as the pairwise solver demands. O(n·m)
  [[nodiscard]] bool within_range(std::span<std::int64_t const> unary) const {
    auto left = static_cast<std::uint64_t>(dense::max_pair_total) - magnitude_;
    for (std::size_t i = 0; i < agents_; ++i) {
      std::uint64_t most = 0;
      for (auto const u : unary.subspan(i * slots_, slots_))
        if (u != dense::absent) most = (std::max)(most, static_cast<std::uint64_t>(u < 0 ? -u : u));
      if (most > left) return false;
      left -= most;
    }
    return true;
  }
  [[nodiscard]] std::span<dense::coupling const> couplings() const noexcept {
    return {couplings_.data(), couplings_.size()};
  }

  /// Σ_{i<j} w_ij(x_i, x_j) of a complete assignment, or nothing if it holds a forbidden combination. O(n²)
  [[nodiscard]] std::optional<std::int64_t> value(std::span<dense::slot const> assignment) const {
    return unless_forbidden(among(assignment));
  }
  /// At least the value of every completion of a prefix: each pair at its best. Nothing if all completions are forbidden.
  /// O(n²)
  [[nodiscard]] std::optional<std::int64_t> most(std::span<dense::slot const> prefix) const {
    auto const d = prefix.size();
    auto sum = among(prefix) + rest_[d];
    for (std::size_t i = 0; i < d; ++i) sum += most_[(i * slots_ + prefix[i]) * (agents_ + 1) + d];
    return unless_forbidden(sum);
  }

private:
  // A sum that holds this once is below every sum without it.
  static constexpr std::int64_t forbidden = -2 * dense::max_pair_total;

  static std::optional<std::int64_t> unless_forbidden(std::int64_t sum) {
    return sum < -dense::max_pair_total ? std::nullopt : std::optional{sum};
  }
  bool find_couplings() {
    couplings_.clear();
    magnitude_ = 0;
    for (std::size_t i = 0; i < agents_; ++i)
      for (std::size_t j = i + 1; j < agents_; ++j) {
        std::span<std::int64_t const> const table{worth_.data() + index(i, j), slots_ * slots_};
        std::uint64_t greatest = 0;
        bool forbids = false;
        for (auto const w : table) {
          forbids |= w == dense::absent;
          if (w != dense::absent) greatest = (std::max)(greatest, static_cast<std::uint64_t>(w < 0 ? -w : w));
        }
        if (greatest > static_cast<std::uint64_t>(dense::max_pair_total) - magnitude_) return false;
        magnitude_ += greatest;
        if (greatest != 0 || forbids)
          couplings_.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), table});
      }
    return true;
  }
  [[nodiscard]] std::int64_t worth(std::size_t i, std::size_t x, std::size_t j, std::size_t y) const {
    auto const w = worth_[index(i, j) + x * slots_ + y];
    return w == dense::absent ? forbidden : w;
  }
  [[nodiscard]] std::int64_t among(std::span<dense::slot const> placed) const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < placed.size(); ++i)
      for (std::size_t j = i + 1; j < placed.size(); ++j) sum += worth(i, placed[i], j, placed[j]);
    return sum;
  }
  [[nodiscard]] std::size_t index(std::size_t i, std::size_t j) const {
    return (i * (2 * agents_ - i - 1) / 2 + j - i - 1) * slots_ * slots_;
  }

  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::uint64_t magnitude_ = 0;        // Σ_{i<j} max|w_ij|
  dense::buffer<std::int64_t> worth_;  // [pair of agents, slot, slot]
  dense::buffer<std::int64_t> most_;   // [agent, slot, d]: with all agents from d on, at best
  dense::buffer<std::int64_t> rest_;   // [d]: all agents from d on among themselves, at best
  dense::buffer<dense::coupling> couplings_;
};

}  // namespace rota::detail
