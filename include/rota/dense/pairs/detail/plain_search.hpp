#pragma once

#include <rota/core/assert.hpp>
#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/instance.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

namespace rota::dense::detail {

/// Tries the assignments of a tiny instance in lexicographic order, so the first best one is the canonical one; but for
/// those that cannot be better, each agent left being in its best slot with those placed, and each pair left at its best.
///
/// What each agent would get from those placed is kept for all that are not, slot by slot: an assignment costs about one
/// addition. O(m^n) time, O(n²·m²) memory.
class plain_search {
public:
  static constexpr std::size_t most_agents = 8;
  static constexpr std::size_t most_slots = 8;

  [[nodiscard]] static constexpr bool suits(std::size_t agents, std::size_t slot_count) noexcept {
    return agents <= most_agents && slot_count <= most_slots;
  }

  /// @param limit placements after which it gives up
  /// @return whether there is a valid assignment: then `best` is the canonical optimum and `value` its value; nothing if it
  /// has given up @pre suits
  std::optional<bool> solve(pair_instance const& in, std::uint64_t limit, std::span<slot> best, std::int64_t& value,
                            std::span<pair_tally> tallies, pair_observer* observer) {
    read(in);
    best_ = nothing;
    nodes_ = 0;
    limit_ = limit;
    if (!place(in.bounds, 0, 0, best, tallies, observer)) return std::nullopt;
    value = best_;
    return best_ > nothing;
  }
  /// Placements tried.
  [[nodiscard]] std::uint64_t nodes() const noexcept { return nodes_; }

private:
  static constexpr std::int64_t forbidden = -4 * max_pair_total;
  static constexpr std::int64_t nothing = forbidden / 2;

  void read(pair_instance const& in) {
    ROTA_ASSERT(in.unary.size() == in.agents * in.slot_count());
    agents_ = in.agents;
    slots_ = in.slot_count();
    row_ = agents_ * slots_;
    pairs_.assign(row_ * row_, 0);
    for (std::size_t i = 0; i < row_; ++i) fields_[0][i] = in.unary[i] == absent ? forbidden : in.unary[i];
    for (coupling const& c : in.couplings) {
      ROTA_ASSERT(c.first < agents_ && c.second < agents_ && c.first != c.second);
      ROTA_ASSERT(c.table.size() == slots_ * slots_);
      bool const turned = c.first > c.second;
      std::int64_t* to =
          &pairs_[(turned ? c.second : c.first) * slots_ * row_ + (turned ? c.first : c.second) * slots_];
      std::int64_t const* w = c.table.data();
      std::size_t const step_x = turned ? 1 : row_;
      std::size_t const step_y = turned ? row_ : 1;
      for (std::size_t x = 0; x < slots_; ++x)
        for (std::size_t y = 0; y < slots_; ++y, ++w) {
          auto& here = to[x * step_x + y * step_y];
          here = *w == absent || here == forbidden ? forbidden : here + *w;  // forbidden once, however often it is said
        }
    }
    rest_[agents_] = 0;
    for (std::size_t a = agents_; a-- > 0;) {
      rest_[a] = rest_[a + 1];
      for (std::size_t b = a + 1; b < agents_; ++b) {
        std::int64_t most = forbidden;
        for (std::size_t x = 0; x < slots_; ++x) {
          std::int64_t const* const w = &pairs_[(a * slots_ + x) * row_ + b * slots_];
          most = (std::max)(most, *std::max_element(w, w + slots_));
        }
        rest_[a] += most;
      }
    }
    count_.fill(0);
    missing_ = 0;
    for (slot_bounds const b : in.bounds) missing_ += b.lower;
  }

  /// @return false if it has given up
  bool place(std::span<slot_bounds const> bounds, std::size_t d, std::int64_t value, std::span<slot> best,
             std::span<pair_tally> tallies, pair_observer* observer) {
    std::int64_t const* const field = fields_[d].data() + d * slots_;
    for (std::size_t x = 0; x < slots_; ++x) {
      at_[d] = static_cast<slot>(x);
      std::uint64_t const missing = missing_ - (count_[x] < bounds[x].lower ? 1 : 0);
      if (count_[x] >= bounds[x].upper || missing > agents_ - d - 1) {
        ++tallies[d + 1].by_cardinality;
        if (observer != nullptr) tell(*observer, d + 1, pair_cut::cardinality, forbidden);
        continue;
      }
      if (nodes_ == limit_) return false;
      ++nodes_;
      std::int64_t const sum = value + field[x];
      if (d + 1 == agents_) {
        ++tallies[agents_].leaves;
        if (sum <= best_) continue;
        best_ = sum;
        std::copy_n(at_.begin(), agents_, best.begin());
        continue;
      }
      std::int64_t const* const from = fields_[d].data();
      std::int64_t const* const add = &pairs_[(d * slots_ + x) * row_];
      std::int64_t* const to = fields_[d + 1].data();
      std::int64_t most = sum + rest_[d + 1];
      for (std::size_t i = (d + 1) * slots_; i < row_;) {
        std::int64_t in_best_slot = to[i] = from[i] + add[i];
        for (std::size_t const next = ++i + slots_ - 1; i < next; ++i)
          in_best_slot = (std::max)(in_best_slot, to[i] = from[i] + add[i]);
        most += in_best_slot;
      }
      if (most <= best_) {
        ++tallies[d + 1].by_bound;
        if (observer != nullptr) tell(*observer, d + 1, pair_cut::bound, most);
        continue;
      }
      std::uint64_t const before = missing_;
      missing_ = missing;
      ++count_[x];
      if (!place(bounds, d + 1, sum, best, tallies, observer)) return false;
      --count_[x];
      missing_ = before;
    }
    return true;
  }

  void tell(pair_observer& observer, std::size_t placed, pair_cut why, std::int64_t bound) {
    std::array<slot, most_agents> partial;
    partial.fill(no_slot);
    std::copy_n(at_.begin(), placed, partial.begin());
    observer(std::span<slot const>(partial.data(), agents_), why, bound);
  }

  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::size_t row_ = 0;
  std::uint64_t missing_ = 0;
  std::uint64_t nodes_ = 0;
  std::uint64_t limit_ = 0;
  std::int64_t best_ = 0;
  std::array<slot, most_agents> at_{};
  std::array<std::int64_t, most_agents + 1> rest_{};  // what the pairs from an agent on are worth at most
  std::array<std::uint32_t, most_slots> count_{};
  std::array<std::array<std::int64_t, most_agents * most_slots>, most_agents> fields_{};  // [depth][agent, slot]
  buffer<std::int64_t> pairs_;                                                            // [agent, slot][agent, slot]
};

}  // namespace rota::dense::detail
