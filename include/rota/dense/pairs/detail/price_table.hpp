#pragma once

#include <rota/core/size.hpp>
#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/final_counts.hpp>
#include <rota/dense/pairs/detail/lane_kernels.hpp>
#include <rota/dense/pairs/detail/model.hpp>
#include <rota/dense/pairs/detail/suffix_bounds.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// Prices of slots for the nodes of the search, by how many agents are placed in each slot.
///
/// Let a node have d agents placed, p_s of them in slot s. Whatever the prices π, it allows at most
///   value + Σ_{unplaced i} max_s (field_i(s) − π_s) + most(π),   most(π) = max_f best(d)[f − p] + π·(f − p)
/// over final counts f. This is a Lagrangian relaxation. In an assignment with final counts f, f_s − p_s unplaced agents go to slot s:
/// they pay in the first sum as much as the second term gives back. And each maximum is at least the assignment's own term.
/// Prices start from the mean of what the placed agents give to the unplaced ones, and are improved at nodes that they fail
/// to cut.
/// The table has a fixed size, and an entry is found by hash; an entry that was overwritten is made anew.
/// O(entries·(slots + final counts)) memory, of which final counts take 64 MB at most.
class price_table {
public:
  static constexpr std::size_t most_slots = 16;
  static constexpr std::int32_t impossible = -(1 << 28);
  static constexpr std::int16_t first_credit = 4;

  using price_list = std::array<lane, most_slots>;
  /// What is known about the nodes with the same counts.
  struct alignas(64) state {
    packed_counts key = 0;
    std::uint32_t stamp = 0;  ///< of the search, and the depth
    std::int32_t most = 0;    ///< most(π); `impossible` if the counts grow into no final counts
    price_list prices{};
    std::uint32_t version = 0;                            ///< of the prices; no version comes twice in a search
    bool by_slot = false;                                 ///< whether `most_by_slot` is known
    std::int16_t credit = 0;                              ///< attempts to improve that are still worth making
    std::uint32_t final = 0;                              ///< where the maximum is
    std::array<std::int32_t, most_slots> most_by_slot{};  ///< with the next agent in that slot, who pays no price
  };

  /// Whether slots and final counts are few enough for prices to be worth their while.
  static bool suits(std::span<std::uint32_t const> lower, std::span<std::uint32_t const> upper, std::size_t agents) {
    return upper.size() <= most_slots && count_space::fits(upper.size(), agents) &&
           final_counts::few(lower, upper, agents);
  }

  /// @pre suits; all suffixes that are asked for are bounded by counts
  void prepare(pair_model const& model, suffix_bounds const& suffix, std::span<std::uint32_t const> lower,
               std::span<std::uint32_t const> upper) {
    agents_ = model.agents();
    slots_ = upper.size();
    upper_ = upper;
    suffix_ = &suffix;
    space_ = &suffix.space();
    finals_.prepare(*space_, lower, upper, agents_);
    width_ = finals_.width();
    values_.resize(width_);
    wanted_.resize(slots_);
    make_room();
    sum_up(model);
  }

  /// The state of a node at depth d with these counts. A reference to it is good until the next call.
  state& at(std::size_t d, packed_counts placed) {
    std::uint64_t const mixed = (placed + d * 0x9e3779b97f4a7c15U) * 0xd1342543de82ef95U;
    state& s = states_[rota::detail::to_size(mixed >> shift_)];
    if (s.key != placed || s.stamp != (epoch_ << 7) + d) [[unlikely]]
      make(s, d, placed);
    return s;
  }

  /// Makes `most_by_slot` known.
  void bound_by_slot(state& s) {
    s.by_slot = true;
    std::size_t const d = s.stamp & 127U;
    std::size_t const reachable = finals_.list_reachable(s.key, *suffix_, agents_ - d);
    std::fill(values_.begin(), values_.end(), 0.0F);
    (void)add_products(finals_.components(), width_, s.prices.data(), slots_, values_.data());
    std::array<float, most_slots> greatest;
    greatest.fill(suffix_table::impossible);
    raise_by_rows(
        {suffix_->by_slot(d), suffix_->width(), finals_.missing(), values_.data(), finals_.reachable(), reachable},
        greatest.data());
    std::int32_t const paid = paid_by_placed(s, s.prices.data());
    for (std::size_t y = 0; y < slots_; ++y)
      s.most_by_slot[y] = greatest[y] < suffix_table::feasible
                              ? impossible
                              : static_cast<std::int32_t>(greatest[y]) - paid - s.prices[y];
  }

  /// Looks for prices under which a node allows at most `enough`, one step from those of its state, and keeps good ones.
  /// @param node its lanes @param value of its agents placed @param allowed its bound so far
  /// @return its bound then
  std::int32_t improve(state& s, lane_node const& node, std::int32_t value, std::int32_t allowed, std::int32_t enough) {
    std::int64_t const square = set_excess(s, node);
    if (square == 0) return allowed;
    // A subgradient step of the length at which a linear function would come down to `enough`.
    price_list prices = s.prices;
    std::int64_t const gap = std::int64_t{allowed} - enough;
    for (std::size_t y = 0; y < slots_; ++y) prices[y] = limited(prices[y] - gap * wanted_[y] / square);
    std::int32_t const sum = lane_demand(node, prices.data(), wanted_.data());
    std::uint32_t final = s.final;
    std::int32_t const most = evaluate(s, prices.data(), final);
    std::int32_t const current = value + sum + most;
    // A little better for this node may be worse for others.
    if (allowed - current < gap / 2) return (std::min)(allowed, current);
    s.most = most;
    s.final = final;
    s.prices = prices;
    s.version = ++versions_;
    s.by_slot = false;
    return current;
  }

private:
  static constexpr std::size_t most_states = 16384;
  static constexpr std::size_t most_entries = std::size_t{1} << 24;  // of states, by final counts
  static constexpr std::int32_t least_gain = -8192;                  // a forbidden combination counts as no more

  void make_room() {
    std::size_t const most = (std::min)(most_states, std::bit_floor(most_entries / std::max<std::size_t>(width_, 8)));
    std::size_t const size = std::clamp(std::bit_ceil(2 * suffix_->states()), std::size_t{64}, most);
    shift_ = static_cast<unsigned>(64 - std::countr_zero(size));
    if (states_.size() < size) states_.resize(size);
    if (rows_.size() < size * width_) rows_.resize(size * width_);
    if (++epoch_ == (std::uint32_t{1} << 24)) {
      for (state& s : states_) s.stamp = 0;
      epoch_ = 1;
    }
  }

  /// The sums from which mean prices are made.
  void sum_up(pair_model const& model) {
    std::size_t const n = agents_;
    std::size_t const m = slots_;
    gains_.assign((n + 1) * m * m, 0);
    for (std::size_t d = 1; d <= n; ++d) {
      std::int64_t* const to = &gains_[d * m * m];
      std::copy_n(&gains_[(d - 1) * m * m], m * m, to);
      auto const gain = [&](std::size_t i, std::size_t z, std::size_t j, std::size_t y) {
        return (std::max)(model.pair(i, z, j, y), least_gain);
      };
      for (std::size_t z = 0; z < m; ++z)
        for (std::size_t y = 0; y < m; ++y) {
          for (std::size_t j = d; j < n; ++j) to[z * m + y] += gain(d - 1, z, j, y);
          for (std::size_t i = 0; i + 1 < d; ++i) to[z * m + y] -= gain(i, z, d - 1, y);
        }
    }
    shares_.assign((n + 1) * m, 0);
    for (std::size_t d = n; d-- > 0;)
      for (std::size_t y = 0; y < m; ++y)
        shares_[d * m + y] = shares_[(d + 1) * m + y] + (model.present(d, y) ? model.share(d, y) : 0);
  }

  void make(state& s, std::size_t d, packed_counts placed) {
    s.key = placed;
    s.stamp = (epoch_ << 7) + static_cast<std::uint32_t>(d);
    s.most = impossible;
    s.credit = first_credit;
    s.version = ++versions_;
    s.by_slot = false;
    float const* const best = suffix_->best(d);
    float* const row = row_of(s);
    std::fill_n(row, width_, suffix_table::impossible);
    std::size_t const reachable = finals_.list_reachable(placed, *suffix_, agents_ - d);
    for (std::size_t i = 0; i < reachable; ++i) row[finals_.reachable()[i]] = best[finals_.missing()[i]];
    if (reachable == 0) return;
    set_mean_prices(s, d);
    s.most = evaluate(s, s.prices.data(), s.final);
  }

  /// Prices from the mean of the gains of an unplaced agent in each slot.
  void set_mean_prices(state& s, std::size_t d) {
    std::size_t const left = agents_ - d;
    std::array<std::int64_t, most_slots> price{};
    std::int64_t sum = 0;
    for (std::size_t y = 0; y < slots_ && left != 0; ++y) {
      std::int64_t total = static_cast<std::int64_t>(d) * shares_[d * slots_ + y];
      for (std::size_t z = 0; z < slots_; ++z)
        total += static_cast<std::int64_t>(space_->count(s.key, z)) * gains_[(d * slots_ + z) * slots_ + y];
      price[y] = total / static_cast<std::int64_t>(d * left);
      sum += price[y];
    }
    // Only differences matter, and lanes are narrow. A full slot costs the most: nobody pays it.
    for (std::size_t y = 0; y < slots_; ++y)
      s.prices[y] = space_->count(s.key, y) == upper_[y] ? pair_model::most_price - 1
                                                         : limited(price[y] - sum / static_cast<std::int64_t>(slots_));
  }

  /// wanted_[y] ← how many agents the final counts of the maximum put into y, less how many want to go there.
  /// @return the sum of squares
  std::int64_t set_excess(state const& s, lane_node const& node) {
    (void)lane_demand(node, s.prices.data(), wanted_.data());
    std::int64_t square = 0;
    for (std::size_t y = 0; y < slots_; ++y) {
      auto const here = static_cast<std::int32_t>(space_->count(s.key, y));
      bool const full = here == static_cast<std::int32_t>(upper_[y]);
      wanted_[y] = full ? 0 : finals_.count(s.final, y) - here - wanted_[y];
      square += static_cast<std::int64_t>(wanted_[y]) * wanted_[y];
    }
    return square;
  }

  static lane limited(std::int64_t price) {
    return static_cast<lane>(std::clamp<std::int64_t>(price, -pair_model::most_price + 1, pair_model::most_price - 1));
  }

  [[nodiscard]] float* row_of(state const& s) { return &rows_[static_cast<std::size_t>(&s - states_.data()) * width_]; }

  /// π·p.
  [[nodiscard]] std::int32_t paid_by_placed(state const& s, lane const* price) const {
    std::int32_t paid = 0;
    for (std::size_t y = 0; y < slots_; ++y) paid += price[y] * static_cast<std::int32_t>(space_->count(s.key, y));
    return paid;
  }

  /// most(π), and the final counts where it is. Whole numbers below 2^24, so floats are exact.
  std::int32_t evaluate(state const& s, lane const* price, std::uint32_t& final) {
    std::copy_n(row_of(s), width_, values_.begin());
    float const most = add_products(finals_.components(), width_, price, slots_, values_.data());
    if (most < suffix_table::feasible) return impossible;
    final = static_cast<std::uint32_t>(std::find(values_.begin(), values_.end(), most) - values_.begin());
    return static_cast<std::int32_t>(most) - paid_by_placed(s, price);
  }

  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::size_t width_ = 0;    // of a row
  unsigned shift_ = 0;       // from a hash to a state
  std::uint32_t epoch_ = 0;  // of the search
  std::uint32_t versions_ = 0;
  std::span<std::uint32_t const> upper_;
  suffix_bounds const* suffix_ = nullptr;
  count_space const* space_ = nullptr;
  final_counts finals_;
  buffer<state> states_;
  buffer<float> rows_;           // [state, final]: best(d)[f − p]
  buffer<float> values_;         // [final]
  buffer<std::int32_t> wanted_;  // [slot]
  buffer<std::int64_t> gains_;   // [depth, z, y]: of all unplaced agents in y from all placed ones in z
  buffer<std::int64_t> shares_;  // [depth, y]: of the unplaced agents
};

}  // namespace rota::dense::detail
