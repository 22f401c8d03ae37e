#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/flow/detail/kernels.hpp>
#include <rota/dense/flow/detail/membership.hpp>
#include <rota/dense/instance.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// For each slot that can hold many agents, and each other slot: the greatest gain of moving a member there, and its agent.
///
/// The gain is an upper bound: an entry whose agent has left stays until it is about to be used. Members *rest* if they
/// prefer their slot by a margin at prices that are nearly right: prices then bound what they can gain, and only a repair
/// that needs more than this bound looks at them.
///
/// Complexity: O(s) for each member that comes; a repair looks at the members that do not rest. O(s²) memory.
class ledgers {
public:
  using value = std::int64_t;
  static constexpr value no_gain = -(value{1} << 61);

  /// Empty ledgers for the slots of `in` that keep one.
  void reset(instance const& in) {
    slots_ = in.slot_count();
    row_of_.assign(slots_, no_slot);
    slot rows = 0;
    for (std::size_t k = 0; k < slots_; ++k)
      if (keeps_one(in.bounds[k])) row_of_[k] = rows++;
    gain_.resize(rows * slots_);
    mover_.resize(rows * slots_);
    close();
  }
  /// Whether the same slots keep ledgers in `in`.
  [[nodiscard]] bool suit(instance const& in) const {
    for (std::size_t k = 0; k < slots_; ++k)
      if (keeps_one(in.bounds[k]) != has(k)) return false;
    return true;
  }

  /// Forgets all entries; writes nothing until `open`.
  void close() {
    open_ = false;
    std::fill(gain_.begin(), gain_.end(), no_gain);
    std::fill(mover_.begin(), mover_.end(), membership::nobody);
  }
  /// Writes an entry for each present member, and from now on for each that comes. O(n·s)
  void open(instance const& in, membership const& who) {
    open_ = true;
    for (row_index a = 0; a < who.homes().size(); ++a)
      if (who.home(a) != no_slot) write(in, who, a);
  }
  /// Notes what agent a, which has just come, would gain elsewhere.
  void write(instance const& in, membership const& who, row_index a) {
    auto const j = who.home(a);
    if (open_ && has(j))
      kernel::raise(in.row(a), who.worth(a), a, gain_.data() + at(j, 0), mover_.data() + at(j, 0), slots_);
  }
  /// From now on, agents that prefer their slot by at least `margin` at these prices can rest.
  void let_rest(std::span<value const> prices, value margin) {
    rest_price_.assign(prices.begin(), prices.end());
    rest_margin_ = margin;
  }

  [[nodiscard]] bool has(std::size_t j) const noexcept { return row_of_[j] != no_slot; }
  /// @pre has(j), here and below
  [[nodiscard]] value const* gains(std::size_t j) const noexcept { return gain_.data() + at(j, 0); }
  [[nodiscard]] row_index mover(std::size_t j, std::size_t k) const noexcept {
    return static_cast<row_index>(mover_[at(j, k)]);
  }
  /// Whether the entry of j for k names a member, with what it gains now.
  [[nodiscard]] bool current(instance const& in, membership const& who, std::size_t j, std::size_t k) const {
    auto const a = mover(j, k);
    return a != membership::nobody && who.home(a) == j && gain_[at(j, k)] == in.at(a, k) - who.worth(a);
  }
  /// Finds the member of j that gains most by moving to k, among those that do not rest. If a resting one may gain more, the
  /// entry names nobody, and the next call looks at all members. @return how many were looked at
  std::size_t repair(instance const& in, membership const& who, std::size_t j, std::size_t k) {
    auto& gain = gain_[at(j, k)];
    auto& mover = mover_[at(j, k)];
    bool const all = mover == membership::nobody;
    value best = no_gain;
    auto best_of = membership::nobody;
    std::size_t asked = 0;
    auto a = who.first(j);
    for (; a != membership::nobody && (all || !who.rests(a)); a = who.next(a), ++asked) {
      value const x = in.at(a, k) - who.worth(a);
      bool const more = x > best;
      best = more ? x : best;
      best_of = more ? a : best_of;
    }
    if (a != membership::nobody) {
      value const unseen = (std::min)(gain, rest_price_[k] - rest_price_[j] - rest_margin_);
      if (best < unseen) best = unseen, best_of = membership::nobody;
    }
    gain = best;
    mover = best_of;
    return asked;
  }

private:
  /// Below five agents, looking at each is as quick as a ledger.
  static constexpr bool keeps_one(slot_bounds b) noexcept { return b.upper > 4; }
  [[nodiscard]] std::size_t at(std::size_t j, std::size_t k) const noexcept { return row_of_[j] * slots_ + k; }

  std::size_t slots_ = 0;
  buffer<slot> row_of_;  // the row of a slot in the two below
  buffer<value> gain_;   // no member gains more by moving
  buffer<value> mover_;  // which agent; as wide as gains, for vectors
  bool open_ = false;
  buffer<value> rest_price_;
  value rest_margin_ = 0;
};

}  // namespace rota::dense::detail
