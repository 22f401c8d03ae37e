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

namespace rota::dense::detail {

/// Tries the assignments of a tiny instance in lexicographic order, so that the first best one is the canonical one.
///
/// A subtree is left if it cannot be better with each unplaced agent in its best slot, given the agents placed, and each
/// two unplaced agents in their best slots together: every term is at its greatest, so no assignment is worth more.
/// What each unplaced agent gets from the agents placed is kept by slot, so a placement costs about one addition per
/// unplaced agent and slot. O(m^n) time, O(n²·m²) memory.
class plain_search {
public:
  static constexpr std::size_t most_agents = 8;
  static constexpr std::size_t most_slots = 8;

  [[nodiscard]] static constexpr bool suits(std::size_t agents, std::size_t slot_count) noexcept {
    return agents <= most_agents && slot_count <= most_slots;
  }

  /// Fills `best`, with the canonical optimum, and `value`, if there is a valid assignment.
  /// @param limit placements after which it gives up
  /// @return whether there is a valid assignment; nothing if it has given up @pre suits; best.size() == in.agents
  std::optional<bool> solve(pair_instance const& in, std::uint64_t limit, std::span<slot> best, std::int64_t& value,
                            std::span<pair_tally> tallies, pair_observer* observer) {
    limit_ = limit;
    nodes_ = 0;
    greatest_ = nothing;
    read(in);
    bound_pairs();
    if (!place(in.bounds, best, tallies, observer, 0, 0)) return std::nullopt;
    value = greatest_;
    return greatest_ > nothing;
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
      std::int64_t* const to =
          &pairs_[(turned ? c.second : c.first) * slots_ * row_ + (turned ? c.first : c.second) * slots_];
      std::size_t const step_x = turned ? 1 : row_;
      std::size_t const step_y = turned ? row_ : 1;
      std::int64_t const* w = c.table.data();
      for (std::size_t x = 0; x < slots_; ++x)
        for (std::size_t y = 0; y < slots_; ++y, ++w) {
          auto& here = to[x * step_x + y * step_y];
          here = *w == absent || here == forbidden ? forbidden : here + *w;  // forbidden once, however often it is said
        }
    }
    count_.fill(0);
    missing_ = 0;
    for (slot_bounds const b : in.bounds) missing_ += b.lower;
  }

  void bound_pairs() {
    rest_[agents_] = 0;
    for (std::size_t a = agents_; a-- > 0;) {
      rest_[a] = rest_[a + 1];
      for (std::size_t b = a + 1; b < agents_; ++b) {
        std::int64_t greatest = forbidden;
        for (std::size_t x = 0; x < slots_; ++x) {
          std::int64_t const* const w = &pairs_[(a * slots_ + x) * row_ + b * slots_];
          greatest = (std::max)(greatest, *std::max_element(w, w + slots_));
        }
        rest_[a] += greatest;
      }
    }
  }

  /// Places the agents from d on. @param value of those before @return false if it has given up
  bool place(std::span<slot_bounds const> bounds, std::span<slot> best, std::span<pair_tally> tallies,
             pair_observer* observer, std::size_t d, std::int64_t value) {
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
        if (sum <= greatest_) continue;
        greatest_ = sum;
        std::copy_n(at_.begin(), agents_, best.begin());
        continue;
      }
      // What the agents after d get then, and at most: each in its best slot.
      std::int64_t const* const from = fields_[d].data();
      std::int64_t const* const add = &pairs_[(d * slots_ + x) * row_];
      std::int64_t* const to = fields_[d + 1].data();
      std::int64_t allowed = sum + rest_[d + 1];
      for (std::size_t i = (d + 1) * slots_; i < row_;) {
        std::int64_t in_best_slot = to[i] = from[i] + add[i];
        for (std::size_t const next = ++i + slots_ - 1; i < next; ++i)
          in_best_slot = (std::max)(in_best_slot, to[i] = from[i] + add[i]);
        allowed += in_best_slot;
      }
      if (allowed <= greatest_) {
        ++tallies[d + 1].by_bound;
        if (observer != nullptr) tell(*observer, d + 1, pair_cut::bound, allowed);
        continue;
      }
      std::uint64_t const before = missing_;
      missing_ = missing;
      ++count_[x];
      if (!place(bounds, best, tallies, observer, d + 1, sum)) return false;
      --count_[x];
      missing_ = before;
    }
    return true;
  }

  void tell(pair_observer& observer, std::size_t placed, pair_cut reason, std::int64_t bound) {
    std::array<slot, most_agents> partial;
    partial.fill(no_slot);
    std::copy_n(at_.begin(), placed, partial.begin());
    observer(std::span<slot const>(partial.data(), agents_), reason, bound);
  }

  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::size_t row_ = 0;        // of fields: agents·slots
  std::uint64_t missing_ = 0;  // agents that lower bounds still ask for
  std::uint64_t nodes_ = 0;
  std::uint64_t limit_ = 0;
  std::int64_t greatest_ = 0;  // value so far
  std::array<slot, most_agents> at_{};
  std::array<std::int64_t, most_agents + 1> rest_{};  // [agent]: the pairs from it on, each at its best
  std::array<std::uint32_t, most_slots> count_{};
  std::array<std::array<std::int64_t, most_agents * most_slots>, most_agents> fields_{};  // [depth][agent, slot]
  buffer<std::int64_t> pairs_;                                                            // [agent, slot][agent, slot]
};

}  // namespace rota::dense::detail
