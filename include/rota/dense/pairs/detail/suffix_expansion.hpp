#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/count_states.hpp>
#include <rota/dense/pairs/detail/lane_kernels.hpp>
#include <rota/dense/pairs/detail/model.hpp>
#include <rota/dense/pairs/detail/suffix_table.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rota::dense::detail {

/// Bounds suffixes that are too long to be enumerated, by the bounds of shorter ones.
///
/// The first few agents of the suffix are placed in every way. A way is worth three things: the values of the
/// placed agents among themselves; the gains of the others from them; the values of the others among themselves, which the
/// shorter suffix bounds. An agent gains by its own slot only. So the most that all gain with given counts is a transport
/// problem: agents are added one at a time, and for each state the greatest sum is kept.
///
/// Why the results are bounds: an assignment places the first few in one of the ways, and with the counts of the others
/// fixed, their gains and their values are each at most their own maximum. However many are placed, that holds; so
/// the least of several such bounds holds too. Losses below a floor are raised to it, which raises bounds only.
class suffix_expansion {
public:
  /// So many agents are worth placing.
  static constexpr std::size_t most_placed = 3;

  /// Whether placing so many agents in all ways costs a few million steps at most.
  static bool affordable(count_states const& states, std::size_t slot_count, std::size_t k, std::size_t placed) {
    std::uint64_t steps = states.total_before(k - placed);
    for (std::size_t i = 0; i <= placed; ++i) steps *= slot_count;
    return steps <= most_steps;
  }

  void prepare(pair_model const& model, count_states const& states, suffix_table& table) {
    model_ = &model;
    states_ = &states;
    table_ = &table;
    slots_ = model.slot_count();
    losses_.reserve(states.largest() * batch);
    next_losses_.reserve(states.largest() * batch);
  }

  /// Lowers the bounds of suffixes of k agents by placing the first few of them. O(m^(placed+1)·states) time
  /// @pre 0 < placed < k; the table has bounds for k − placed agents
  void lower(std::size_t k, std::size_t placed) {
    k_ = k;
    placed_ = placed;
    list_ways();
    bounds_.assign(states_->size(k) * table_->width(), suffix_table::impossible);
    gain_losses_.resize((k - placed) * slots_ * batch);
    for (std::size_t first = 0; first < ways(); first += batch) {
      std::size_t const count = (std::min)(ways() - first, batch);
      std::int32_t const greatest = set_losses(first, count);
      transport();
      read_back(first, count, greatest);
    }
    float* const table = table_->by_slot(k);
    for (std::size_t i = 0; i < bounds_.size(); ++i) table[i] = (std::min)(table[i], bounds_[i]);
  }

private:
  static constexpr std::size_t batch = 64;  // ways at a time, one per lane
  static constexpr std::uint64_t most_steps = std::uint64_t{1} << 24;
  static constexpr lane floor = -16000;  // the sum of two stays in a lane

  [[nodiscard]] std::size_t ways() const { return way_counts_.size(); }
  /// The slots of the agents placed that way, the first agent's first.
  [[nodiscard]] slot const* way(std::size_t w) const { return &ways_[w * placed_]; }

  /// Lists all ways within the upper bounds. Those with equal counts stand together; of these, those with an equal first
  /// slot.
  void list_ways() {
    ways_.clear();
    way_counts_.clear();
    order_.clear();
    std::size_t total = 1;
    for (std::size_t i = 0; i < placed_; ++i) total *= slots_;
    // A way is a number in base m, its first digit the slot of the first agent.
    for (std::size_t code = 0; code < total; ++code) {
      std::size_t state = 0;
      for (std::size_t i = 0, rest = code; i < placed_ && state != count_states::none; ++i, rest /= slots_)
        state = states_->next(i, state)[rest % slots_];
      if (state != count_states::none) order_.push_back((state * slots_ + code % slots_) * total + code);
    }
    std::sort(order_.begin(), order_.end());
    for (std::size_t const key : order_) {
      way_counts_.push_back(states_->counts(placed_, key / total / slots_));
      for (std::size_t i = 0, rest = key % total; i < placed_; ++i, rest /= slots_)
        ways_.push_back(static_cast<slot>(rest % slots_));
    }
  }

  /// Sets `losses_` of the state of nobody, and `gain_losses_`, for so many ways from `first` on.
  /// @return the value against which they are losses
  std::int32_t set_losses(std::size_t first, std::size_t count) {
    std::fill(gain_losses_.begin(), gain_losses_.end(), lane{0});
    worth_.resize(count);
    std::int32_t greatest = (std::numeric_limits<std::int32_t>::min)();
    for (std::size_t l = 0; l < count; ++l) {
      worth_[l] = worth_of_placed(way(first + l)) + set_gain_losses(way(first + l), l);
      greatest = (std::max)(greatest, worth_[l]);
    }
    losses_.assign(batch, floor);
    for (std::size_t l = 0; l < count; ++l) losses_[l] = rounded_loss(worth_[l] - greatest, floor);
    return greatest;
  }

  [[nodiscard]] std::int32_t worth_of_placed(slot const* at) const {
    std::size_t const d = model_->agents() - k_;
    std::int32_t worth = 0;
    for (std::size_t i = 0; i < placed_; ++i) {
      worth += model_->share(d + i, at[i]);
      for (std::size_t j = i + 1; j < placed_; ++j) worth += model_->pair(d + i, at[i], d + j, at[j]);
    }
    return worth;
  }

  /// What each of the others loses against its greatest gain, in that lane. @return the sum of the greatest gains
  std::int32_t set_gain_losses(slot const* at, std::size_t lane_index) {
    std::size_t const d = model_->agents() - k_;
    std::int32_t sum = 0;
    gains_.resize(slots_);
    lane* to = gain_losses_.data() + lane_index;
    for (std::size_t j = d + placed_; j < model_->agents(); ++j) {
      for (std::size_t y = 0; y < slots_; ++y) {
        gains_[y] = 0;
        for (std::size_t i = 0; i < placed_; ++i) gains_[y] += model_->pair(d + i, at[i], j, y);
      }
      std::int32_t const greatest = *std::max_element(gains_.begin(), gains_.end());
      for (std::size_t y = 0; y < slots_; ++y, to += batch) *to = rounded_loss(gains_[y] - greatest, floor);
      sum += greatest;
    }
    return sum;
  }

  /// Adds the others one at a time: `losses_` are then the smallest of each state of theirs, by lane.
  void transport() {
    transport_kernel const kernel = choose_transport_kernel();
    for (std::size_t agents = 0; agents < k_ - placed_; ++agents) {
      next_losses_.assign(states_->size(agents + 1) * batch, floor);
      kernel({losses_.data(), &gain_losses_[agents * slots_ * batch], next_losses_.data(), states_->next(agents, 0),
              states_->size(agents), slots_, batch});
      losses_.swap(next_losses_);
    }
  }

  /// Raises `bounds_` to the values of these ways.
  void read_back(std::size_t first, std::size_t count, std::int32_t greatest) {
    for (std::size_t begin = 0; begin < count;) {
      std::size_t end = begin + 1;
      while (end < count && way_counts_[first + end] == way_counts_[first + begin]) ++end;
      raise_bounds(first, begin, end, greatest);
      begin = end;
    }
  }

  /// The same for lanes with equal counts.
  void raise_bounds(std::size_t first, std::size_t begin, std::size_t end, std::int32_t greatest) {
    packed_counts const placed = way_counts_[first + begin];
    std::size_t const placed_index = states_->space().index(placed);
    std::uint16_t const* const numbers = states_->number_by_index(k_ - placed_);
    float const* const others = table_->best(k_ - placed_);
    for (std::size_t i = 0; i < states_->size(k_); ++i) {
      if (!states_->space().below(placed, states_->counts(k_, i))) continue;
      std::size_t const rest = numbers[states_->index(k_, i) - placed_index];
      lane const* const losses = &losses_[rest * batch];
      float const without_loss = static_cast<float>(greatest) + others[rest];
      for (std::size_t l = begin; l < end;) {
        slot const at = *way(first + l);
        lane smallest = losses[l];
        for (++l; l < end && *way(first + l) == at; ++l) smallest = (std::max)(smallest, losses[l]);
        float& bound = bounds_[i * table_->width() + at];
        bound = (std::max)(bound, without_loss + static_cast<float>(smallest));
      }
    }
  }

  pair_model const* model_ = nullptr;
  count_states const* states_ = nullptr;
  suffix_table* table_ = nullptr;
  std::size_t slots_ = 0;
  std::size_t k_ = 0;
  std::size_t placed_ = 0;
  buffer<slot> ways_;                 // [way, agent placed]
  buffer<packed_counts> way_counts_;  // [way]
  buffer<std::size_t> order_;
  buffer<std::int32_t> worth_;  // [lane]
  buffer<std::int32_t> gains_;  // [slot]
  buffer<lane> gain_losses_;    // [agent, slot, lane]
  buffer<lane> losses_;         // [state, lane]
  buffer<lane> next_losses_;    // of one agent more
  buffer<float> bounds_;        // [state, slot of the first agent]
};

}  // namespace rota::dense::detail
