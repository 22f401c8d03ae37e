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

/// For slots that can hold many agents: for each other slot the greatest gain of moving a member there, and whose it is.
///
/// An upper bound, since nobody looks for members who have left until their entry is about to be used. Members that were
/// content with their slot by a margin, when prices were known well, *rest*: prices then say how little they can gain, and
/// nobody asks them unless it comes to that.
///
/// Complexity: O(s) for each member that comes; a repair asks the members that do not rest. O(s²) memory.
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

  /// Forgets everything; nothing is written until `open`.
  void close() {
    open_ = false;
    std::fill(gain_.begin(), gain_.end(), no_gain);
    std::fill(mover_.begin(), mover_.end(), membership::nobody);
  }
  /// Begins to write, with what members there are. O(n·s)
  void open(instance const& in, membership const& who) {
    open_ = true;
    for (row_index a = 0; a < who.homes().size(); ++a)
      if (who.home(a) != no_slot) write(in, who, a);
  }
  /// Notes what agent a, who has just come, would gain elsewhere.
  void write(instance const& in, membership const& who, row_index a) {
    auto const j = who.home(a);
    if (open_ && has(j))
      kernel::raise(in.row(a), who.worth(a), a, gain_.data() + at(j, 0), mover_.data() + at(j, 0), slots_);
  }
  /// From now on agents can rest who prefer their slot by `margin` at least, at these prices.
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
  /// Whether a member is named for k, with what it gains now.
  [[nodiscard]] bool current(instance const& in, membership const& who, std::size_t j, std::size_t k) const {
    auto const a = mover(j, k);
    return a != membership::nobody && who.home(a) == j && gain_[at(j, k)] == in.at(a, k) - who.worth(a);
  }
  /// Looks for who gains most by moving from j to k: among those who do not rest; if that leaves it open, names nobody, and
  /// looks among all of them when it is called again. @return how many were asked
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
  /// Below five agents, asking each is as quick as keeping books.
  static constexpr bool keeps_one(slot_bounds b) noexcept { return b.upper > 4; }
  [[nodiscard]] std::size_t at(std::size_t j, std::size_t k) const noexcept { return row_of_[j] * slots_ + k; }

  std::size_t slots_ = 0;
  buffer<slot> row_of_;  // of a slot, its row in the two below
  buffer<value> gain_;   // at least what any member gains by moving
  buffer<value> mover_;  // who: as wide as gains, for the lanes
  bool open_ = false;
  buffer<value> rest_price_;
  value rest_margin_ = 0;
};

}  // namespace rota::dense::detail
