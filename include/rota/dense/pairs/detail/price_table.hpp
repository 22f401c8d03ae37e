#pragma once

#include <rota/core/size.hpp>
#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/lane_kernels.hpp>
#include <rota/dense/pairs/detail/suffix_bounds.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// Prices of slots for search nodes, by how many agents are placed in each slot.
///
/// Whatever the prices π, a node with d agents placed, p_s of them in slot s, allows at most
///   value + Σ_{unplaced i} max_s (field_i(s) − π_s) + most(π),   most(π) = max_f best(d)[f − p] + π·(f − p)
/// over final counts f: a Lagrangian relaxation of "as many want slot s here as take it there". Prices start from the
/// mean of what the placed give to the unplaced, and are improved on nodes that they fail to cut. They are kept in a
/// table of fixed size, by hash; a state that was overwritten is made anew. O(states·(slots + final counts)) memory, of which
/// final counts take 64 MB at most.
class price_table {
public:
  static constexpr std::size_t most_slots = 16;
  static constexpr std::size_t most_states = 16384;
  static constexpr std::size_t most_entries = std::size_t{1} << 24;  // of states, by final counts
  static constexpr std::int32_t impossible = -(1 << 28);
  static constexpr std::int16_t first_credit = 4;

  using price_list = std::array<lane, most_slots>;
  struct alignas(64) state {
    packed_counts key = 0;
    std::uint32_t stamp = 0;  ///< of the search, and the depth
    std::int32_t most = 0;
    price_list prices{};
    std::uint32_t version = 0;                            ///< of the prices; never twice the same in a search
    bool by_slot = false;                                 ///< most_by_slot is known
    std::int16_t credit = 0;                              ///< attempts to improve that are still worth making
    std::uint32_t final = 0;                              ///< where the maximum is
    std::array<std::int32_t, most_slots> most_by_slot{};  ///< with the next agent in that slot, which pays no price
  };

  /// Whether slots and final counts are few enough for prices to be worth their while.
  static bool suits(std::span<std::uint32_t const> lower, std::span<std::uint32_t const> upper, std::size_t agents) {
    return upper.size() <= most_slots && count_space::fits(upper.size(), agents) &&
           number_of_finals(lower, upper, agents) <= most_finals(agents);
  }
  void prepare(pair_model const& model, suffix_bounds const& suffix, std::span<std::uint32_t const> lower,
               std::span<std::uint32_t const> upper) {
    agents_ = model.agents();
    slots_ = upper.size();
    upper_ = upper;
    suffix_ = &suffix;
    space_ = &suffix.space();
    finals_.clear();
    space_->list(lower, upper, agents_, finals_);
    width_ = (finals_.size() + 7) / 8 * 8;
    components_.assign(slots_ * width_, 0.0F);
    for (std::size_t f = 0; f < finals_.size(); ++f)
      for (std::size_t s = 0; s < slots_; ++s)
        components_[s * width_ + f] = static_cast<float>(space_->count(finals_[f], s));
    values_.resize(width_);
    valid_.resize(width_);
    indices_.resize(width_);
    for (std::size_t f = 0; f < finals_.size(); ++f)
      indices_[f] = static_cast<std::uint32_t>(space_->index(finals_[f]));
    numbers_.resize(width_);
    wanted_.resize(slots_);
    std::size_t const most = (std::min)(most_states, std::bit_floor(most_entries / std::max<std::size_t>(width_, 8)));
    std::size_t const size = std::clamp(std::bit_ceil(2 * suffix.states()), std::size_t{64}, most);
    shift_ = static_cast<unsigned>(64 - std::countr_zero(size));
    if (states_.size() < size) states_.resize(size);
    if (rows_.size() < size * width_) rows_.resize(size * width_);
    if (++epoch_ == (std::uint32_t{1} << 24)) {
      for (state& s : states_) s.stamp = 0;
      epoch_ = 1;
    }
    average(model);
  }

  /// The state of a node at depth d with these counts. Good until the next call.
  state& at(std::size_t d, packed_counts placed) {
    std::uint64_t const mixed = (placed + d * 0x9e3779b97f4a7c15U) * 0xd1342543de82ef95U;
    state& s = states_[rota::detail::to_size(mixed >> shift_)];
    if (s.key != placed || s.stamp != (epoch_ << 7) + d) [[unlikely]]
      make(s, d, placed);
    return s;
  }

  /// Makes most_by_slot known.
  void bound_by_slot(state& s) {
    s.by_slot = true;
    std::size_t const d = s.stamp & 127U;
    std::size_t const valid = list_valid(s.key, agents_ - d);
    float const* const by = suffix_->by_slot(d);
    std::size_t const width = suffix_->width();
    std::fill(values_.begin(), values_.end(), 0.0F);
    (void)add_products(components_.data(), width_, s.prices.data(), slots_, values_.data());
    std::array<float, most_slots> flat;
    flat.fill(suffix_table::impossible);
    raise_by_rows({by, width, numbers_.data(), values_.data(), valid_.data(), valid}, flat.data());
    std::int32_t const paid = payment(s, s.prices.data());
    for (std::size_t y = 0; y < slots_; ++y)
      s.most_by_slot[y] =
          flat[y] < suffix_table::feasible ? impossible : static_cast<std::int32_t>(flat[y]) - paid - s.prices[y];
  }

  /// Looks for prices under which the node allows at most `enough`, one step from those of its state; keeps good ones.
  /// @param node with the fields of that node
  /// @return what the node allows at most
  std::int32_t improve(state& s, lane_node const& node, std::int32_t value, std::int32_t allowed, std::int32_t enough) {
    price_list now = s.prices;
    std::uint32_t final = s.final;
    (void)lane_demand(node, now.data(), wanted_.data());
    // A subgradient step of the length at which a linear function would come down to `enough`.
    std::int64_t square = 0;
    for (std::size_t y = 0; y < slots_; ++y) {
      auto const here = static_cast<std::int32_t>(space_->count(s.key, y));
      wanted_[y] = here == static_cast<std::int32_t>(upper_[y])
                       ? 0
                       : static_cast<std::int32_t>(space_->count(finals_[final], y)) - here - wanted_[y];
      square += static_cast<std::int64_t>(wanted_[y]) * wanted_[y];
    }
    if (square == 0) return allowed;
    std::int64_t const gap = std::int64_t{allowed} - enough;
    for (std::size_t y = 0; y < slots_; ++y) now[y] = limited(now[y] - gap * wanted_[y] / square);
    std::int32_t const sum = lane_demand(node, now.data(), wanted_.data());
    std::int32_t const most = evaluate(s, now.data(), final);
    std::int32_t const current = value + sum + most;
    // Little for this node may be nothing for others.
    if (allowed - current < gap / 2) return (std::min)(allowed, current);
    s.most = most;
    s.final = final;
    s.prices = now;
    s.version = ++versions_;
    s.by_slot = false;
    return current;
  }

private:
  /// So many final counts are worth looking at for so few agents: nodes saved must pay for it.
  static constexpr std::size_t most_finals(std::size_t agents) { return agents < 18 ? 1024 : 8192; }
  /// How many final counts there are, or more than `most_finals(agents)`.
  static std::size_t number_of_finals(std::span<std::uint32_t const> lower, std::span<std::uint32_t const> upper,
                                      std::size_t agents) {
    std::array<std::size_t, max_pair_agents + 1> ways{};
    ways[0] = 1;
    for (std::size_t s = 0; s < upper.size(); ++s)
      for (std::size_t r = agents + 1; r-- > 0;) {
        std::size_t sum = 0;
        for (std::size_t t = lower[s]; t <= r && t <= upper[s]; ++t) sum += ways[r - t];
        ways[r] = (std::min)(sum, most_finals(agents) + 1);
      }
    return ways[agents];
  }

  static lane limited(std::int64_t price) {
    return static_cast<lane>(std::clamp<std::int64_t>(price, -pair_model::most_price + 1, pair_model::most_price - 1));
  }

  /// means_[d][z][y]: the sum of what placed agents in z give to unplaced ones in y, over all pairs split at depth d.
  void average(pair_model const& model) {
    std::size_t const n = agents_;
    std::size_t const m = slots_;
    means_.assign((n + 1) * m * m, 0);
    own_.assign((n + 1) * m, 0);
    for (std::size_t d = 1; d <= n; ++d) {
      std::int64_t* const to = &means_[d * m * m];
      std::copy_n(&means_[(d - 1) * m * m], m * m, to);
      for (std::size_t z = 0; z < m; ++z)
        for (std::size_t y = 0; y < m; ++y) {
          for (std::size_t j = d; j < n; ++j)
            to[z * m + y] += std::max<std::int32_t>(model.pair(d - 1, z, j, y), -8192);
          for (std::size_t i = 0; i + 1 < d; ++i)
            to[z * m + y] -= std::max<std::int32_t>(model.pair(i, z, d - 1, y), -8192);
        }
    }
    for (std::size_t d = n; d-- > 0;)
      for (std::size_t y = 0; y < m; ++y)
        own_[d * m + y] = own_[(d + 1) * m + y] + (model.present(d, y) ? model.share(d, y) : 0);
  }

  void make(state& s, std::size_t d, packed_counts placed) {
    s.key = placed;
    s.stamp = (epoch_ << 7) + static_cast<std::uint32_t>(d);
    s.most = impossible;
    s.credit = first_credit;
    s.version = ++versions_;
    s.by_slot = false;
    std::size_t const left = agents_ - d;
    float const* const best = suffix_->best(d);
    float* const row = row_of(s);
    std::fill_n(row, width_, suffix_table::impossible);
    std::size_t const valid = list_valid(placed, left);
    for (std::size_t i = 0; i < valid; ++i) row[valid_[i]] = best[numbers_[i]];
    if (valid == 0) return;
    std::int64_t sum = 0;
    std::array<std::int64_t, most_slots> price{};
    for (std::size_t y = 0; y < slots_ && left != 0; ++y) {
      std::int64_t total = static_cast<std::int64_t>(d) * own_[d * slots_ + y];
      for (std::size_t z = 0; z < slots_; ++z)
        total += static_cast<std::int64_t>(space_->count(placed, z)) * means_[(d * slots_ + z) * slots_ + y];
      price[y] = total / static_cast<std::int64_t>(d * left);
      sum += price[y];
    }
    // Only differences matter, and lanes are narrow. What is full costs the most: nobody pays it.
    for (std::size_t y = 0; y < slots_; ++y)
      s.prices[y] = space_->count(placed, y) == upper_[y] ? pair_model::most_price - 1
                                                          : limited(price[y] - sum / static_cast<std::int64_t>(slots_));
    s.most = evaluate(s, s.prices.data(), s.final);
  }

  /// The finals that these counts can grow to, and the numbers of what is missing.
  std::size_t list_valid(packed_counts placed, std::size_t left) {
    std::size_t valid = 0;
    for (std::size_t f = 0; f < finals_.size(); ++f) {
      valid_[valid] = static_cast<std::uint32_t>(f);
      valid += space_->below(placed, finals_[f]) ? 1U : 0U;
    }
    std::uint16_t const* const numbers = suffix_->numbers(left);
    std::size_t const start = space_->index(placed);
    for (std::size_t i = 0; i < valid; ++i) numbers_[i] = numbers[indices_[valid_[i]] - start];
    return valid;
  }

  [[nodiscard]] float* row_of(state const& s) { return &rows_[static_cast<std::size_t>(&s - states_.data()) * width_]; }

  [[nodiscard]] std::int32_t payment(state const& s, lane const* price) const {
    std::int32_t paid = 0;
    for (std::size_t y = 0; y < slots_; ++y) paid += price[y] * static_cast<std::int32_t>(space_->count(s.key, y));
    return paid;
  }

  /// most(π), and the final counts where it is. Whole numbers below 2^24, so floats are exact.
  std::int32_t evaluate(state const& s, lane const* price, std::uint32_t& final) {
    std::copy_n(row_of(s), width_, values_.begin());
    float const most = add_products(components_.data(), width_, price, slots_, values_.data());
    if (most < suffix_table::feasible) return impossible;
    final = static_cast<std::uint32_t>(std::find(values_.begin(), values_.end(), most) - values_.begin());
    return static_cast<std::int32_t>(most) - payment(s, price);
  }

  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::size_t width_ = 0;  // of a row
  unsigned shift_ = 0;
  std::uint32_t epoch_ = 0;
  std::uint32_t versions_ = 0;
  std::span<std::uint32_t const> upper_;
  suffix_bounds const* suffix_ = nullptr;
  count_space const* space_ = nullptr;
  buffer<packed_counts> finals_;
  buffer<std::uint32_t> indices_;  // [final]
  buffer<float> components_;       // [slot, final]
  buffer<state> states_;
  buffer<float> rows_;  // [state, final]: best(d)[f − p]
  buffer<float> values_;
  buffer<std::uint32_t> valid_;
  buffer<std::uint32_t> numbers_;
  buffer<std::int32_t> wanted_;
  buffer<std::int64_t> means_;
  buffer<std::int64_t> own_;
};

}  // namespace rota::dense::detail
