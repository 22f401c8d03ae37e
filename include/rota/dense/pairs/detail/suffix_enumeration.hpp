#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/limits.hpp>
#include <rota/dense/pairs/detail/count_states.hpp>
#include <rota/dense/pairs/detail/lane_kernels.hpp>
#include <rota/dense/pairs/detail/model.hpp>
#include <rota/dense/pairs/detail/suffix_table.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rota::dense::detail {

/// Bounds the last few agents by trying every way to place them.
///
/// The last two agents are not placed one by one. A column stands for two slots x ≤ y of theirs; each way to place the
/// agents before them is tried on all columns side by side, a column per lane. A column has two losses: with the last
/// agent but one in x and the last in y, and the other way round. Both have the same counts, so the smaller loss counts.
///
/// A loss says how far a sum falls short of the sum of its greatest entries. It is at most 0 and counted in units of
/// 2^unit_shift quanta, so that it fits into a lane.
///
/// Why the results are bounds: every assignment is tried; and a loss is rounded towards 0, and raised to a floor where it
/// is below, which both make an assignment look better only. Otherwise the results are exact.
/// Time O(m^longest), 16 at a time with AVX2.
class suffix_enumeration {
public:
  /// Fills the table for suffixes of 1 to `longest` agents. @return the longest that is done: less only if stop() said so
  /// @pre 1 ≤ longest ≤ states.longest()
  std::size_t fill(pair_model const& model, count_states const& states, suffix_table& table, std::size_t longest,
                   stop_request const& stop) {
    model_ = &model;
    states_ = &states;
    table_ = &table;
    agents_ = model.agents();
    slots_ = model.slot_count();
    longest_ = longest;
    for (std::size_t k = 1; k <= longest; ++k) table.fill(k, states, suffix_table::impossible);
    place_last();
    if (longest < 2) return longest;
    find_greatest();
    list_columns();
    place_last_two();
    set_added_losses();
    kernel_ = choose_columns_kernel();
    std::int32_t greatest = greatest_last_two_;
    for (std::size_t k = 3; k <= longest; ++k) {
      if (stop()) return k - 1;
      std::size_t const first = agents_ - k;
      greatest += greatest_share_[first];
      for (std::size_t j = first + 1; j < agents_; ++j) greatest += greatest_pair(first, j);
      place_all(k);
      read_back(k, greatest);
    }
    return longest;
  }

private:
  // The loss of a column, the loss that another agent adds to it, and that of the agents before: their sum fits in a lane.
  static constexpr lane column_floor = -14000;
  static constexpr lane added_floor = -4000;
  static constexpr lane prefix_floor = -14000;
  static constexpr lane untried = (std::numeric_limits<lane>::min)();

  [[nodiscard]] std::int32_t greatest_pair(std::size_t i, std::size_t j) const {
    return greatest_pair_[i * agents_ + j];
  }
  /// What the last two agents are worth.
  [[nodiscard]] std::int32_t last_two(std::size_t x, std::size_t y) const {
    return model_->pair(agents_ - 2, x, agents_ - 1, y) + model_->share(agents_ - 2, x) + model_->share(agents_ - 1, y);
  }
  [[nodiscard]] lane loss(std::int32_t value, std::int32_t greatest, lane floor) const {
    return rounded_loss(value - greatest, floor, unit_shift_);
  }
  /// [either way round][column]: of the last two with those placed.
  [[nodiscard]] lane* column_losses(std::size_t placed) { return &column_losses_[placed * 2 * columns_]; }
  /// [slot][either way round][column]: added by the first of so many agents.
  [[nodiscard]] lane* added_losses(std::size_t agents) { return &added_losses_[agents * slots_ * 2 * columns_]; }
  /// [agent][slot]: of each agent not placed, but the last two: its own, and with those placed.
  [[nodiscard]] std::int32_t* own_losses(std::size_t placed) { return &own_losses_[placed * longest_ * slots_]; }

  void place_last() {
    std::uint32_t const* const state = states_->next(0, 0);
    for (std::size_t x = 0; x < slots_; ++x)
      if (state[x] != count_states::none)
        table_->by_slot(1)[state[x] * table_->width() + x] = static_cast<float>(model_->share(agents_ - 1, x));
    table_->close(1, *states_);
  }

  void find_greatest() {
    std::size_t const first = agents_ - longest_;
    greatest_pair_.resize(agents_ * agents_);
    greatest_share_.resize(agents_);
    for (std::size_t i = first; i < agents_; ++i) {
      greatest_share_[i] = *std::max_element(model_->shares(i), model_->shares(i) + slots_);
      for (std::size_t j = i + 1; j < agents_; ++j) {
        std::int32_t greatest = model_->pair(i, 0, j, 0);
        for (std::size_t x = 0; x < slots_; ++x)
          for (std::size_t y = 0; y < slots_; ++y) greatest = (std::max)(greatest, model_->pair(i, x, j, y));
        greatest_pair_[i * agents_ + j] = greatest;
      }
    }
    greatest_last_two_ = last_two(0, 0);
    for (std::size_t x = 0; x < slots_; ++x)
      for (std::size_t y = 0; y < slots_; ++y) greatest_last_two_ = (std::max)(greatest_last_two_, last_two(x, y));
    // Entries are 0 on average, so an assignment at random loses about the sum of the greatest. That shall be above the floor.
    std::int32_t expected = greatest_last_two_;
    for (std::size_t i = first; i + 2 < agents_; ++i) {
      expected += greatest_share_[i];
      for (std::size_t j = i + 1; j < agents_; ++j) expected += greatest_pair(i, j);
    }
    unit_shift_ = 0;
    while (expected >> unit_shift_ > -prefix_floor) ++unit_shift_;
  }

  void list_columns() {
    low_slot_.clear();
    high_slot_.clear();
    for (std::size_t x = 0; x < slots_; ++x)
      for (std::size_t y = x; y < slots_; ++y) low_slot_.push_back(x), high_slot_.push_back(y);
    columns_ = (low_slot_.size() + lane_block - 1) / lane_block * lane_block;
    column_losses_.assign((longest_ + 1) * 2 * columns_, 0);
    added_losses_.assign((longest_ + 1) * slots_ * 2 * columns_, 0);
    own_losses_.assign((longest_ + 1) * longest_ * slots_, 0);
  }

  /// The suffix of two, and the losses of columns before anybody else is placed.
  void place_last_two() {
    lane* const losses = column_losses(0);
    for (std::size_t c = 0; c < low_slot_.size(); ++c) {
      std::size_t const x = low_slot_[c];
      std::size_t const y = high_slot_[c];
      losses[c] = loss(last_two(x, y), greatest_last_two_, column_floor);
      losses[columns_ + c] = loss(last_two(y, x), greatest_last_two_, column_floor);
      std::uint32_t const state = state_with(0, 0, c);
      if (state == count_states::none) continue;
      float* const to = table_->by_slot(2) + state * table_->width();
      to[x] = (std::max)(to[x], static_cast<float>(last_two(x, y)));
      to[y] = (std::max)(to[y], static_cast<float>(last_two(y, x)));
    }
    table_->close(2, *states_);
  }

  /// The state of `agents` agents with the last two in the slots of that column, or `none`.
  [[nodiscard]] std::uint32_t state_with(std::size_t agents, std::size_t state, std::size_t column) const {
    std::uint32_t const one_more = states_->next(agents, state)[low_slot_[column]];
    if (one_more == count_states::none) return count_states::none;
    return states_->next(agents + 1, one_more)[high_slot_[column]];
  }

  void set_added_losses() {
    for (std::size_t k = 3; k <= longest_; ++k) {
      std::size_t const i = agents_ - k;
      std::int32_t const greatest = greatest_pair(i, agents_ - 2) + greatest_pair(i, agents_ - 1);
      lane* to = added_losses(k);
      for (std::size_t z = 0; z < slots_; ++z, to += 2 * columns_)
        for (std::size_t c = 0; c < low_slot_.size(); ++c) {
          std::size_t const x = low_slot_[c];
          std::size_t const y = high_slot_[c];
          auto const added = [&](std::size_t last_but_one, std::size_t last) {
            return model_->pair(i, z, agents_ - 2, last_but_one) + model_->pair(i, z, agents_ - 1, last);
          };
          to[c] = loss(added(x, y), greatest, added_floor);
          to[columns_ + c] = loss(added(y, x), greatest, added_floor);
        }
    }
  }

  /// Tries every way to place the last k agents. @pre k ≥ 3
  void place_all(std::size_t k) {
    first_ = agents_ - k;
    smallest_losses_.assign(slots_ * states_->size(k - 2) * columns_, untried);
    std::int32_t* own = own_losses(0);
    for (std::size_t i = first_; i + 2 < agents_; ++i)
      for (std::size_t x = 0; x < slots_; ++x) *own++ = model_->share(i, x) - greatest_share_[i];
    place(0, 0, 0, smallest_losses_.data());
  }

  /// Places the next agent, and those after it. @param state of those placed @param prefix_loss theirs
  /// @param smallest by state and column; for the first agent, of its first slot
  void place(std::size_t placed, std::size_t state, std::int32_t prefix_loss, lane* smallest) {
    std::size_t const left = agents_ - first_ - placed;
    std::size_t const per_slot = placed == 0 ? states_->size(left - 2) * columns_ : 0;
    std::uint32_t const* const next_state = states_->next(placed, state);
    lane const* added = added_losses(left);
    std::int32_t const* const own = own_losses(placed);
    if (left == 3)
      return kernel_({column_losses(placed), added, own, next_state, smallest, per_slot, columns_, slots_, prefix_loss,
                      prefix_floor, unit_shift_});
    for (std::size_t x = 0; x < slots_; ++x, added += 2 * columns_) {
      if (next_state[x] == count_states::none) continue;
      add_to_columns(placed, added);
      add_to_others(placed, x);
      place(placed + 1, next_state[x], prefix_loss + own[x], smallest + x * per_slot);
    }
  }

  void add_to_columns(std::size_t placed, lane const* added) {
    lane const* const before = column_losses(placed);
    lane* const after = column_losses(placed + 1);
    for (std::size_t c = 0; c < 2 * columns_; ++c)
      after[c] = (std::max)(static_cast<lane>(before[c] + added[c]), column_floor);
  }

  /// The agent of rank first + placed goes to x: adds to the losses of the agents after it.
  void add_to_others(std::size_t placed, std::size_t x) {
    std::size_t const i = first_ + placed;
    std::int32_t const* before = own_losses(placed) + slots_;
    std::int32_t* after = own_losses(placed + 1);
    for (std::size_t j = i + 1; j + 2 < agents_; ++j)
      for (std::size_t y = 0; y < slots_; ++y) *after++ = *before++ + model_->pair(i, x, j, y) - greatest_pair(i, j);
  }

  /// Turns losses into the bounds of the table. @param greatest the value against which they are losses
  void read_back(std::size_t k, std::int32_t greatest) {
    lane const* losses = smallest_losses_.data();
    float* const bounds = table_->by_slot(k);
    for (std::size_t x = 0; x < slots_; ++x)
      for (std::size_t i = 0; i < states_->size(k - 2); ++i, losses += columns_)
        for (std::size_t c = 0; c < low_slot_.size(); ++c) {
          if (losses[c] == untried) continue;
          std::uint32_t const state = state_with(k - 2, i, c);
          if (state == count_states::none) continue;
          float& bound = bounds[state * table_->width() + x];
          bound = (std::max)(bound, static_cast<float>(greatest + losses[c] * (1 << unit_shift_)));
        }
    table_->close(k, *states_);
  }

  pair_model const* model_ = nullptr;
  count_states const* states_ = nullptr;
  suffix_table* table_ = nullptr;
  columns_kernel kernel_ = nullptr;
  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::size_t longest_ = 0;
  std::size_t first_ = 0;    // the first rank that is being placed
  std::size_t columns_ = 0;  // a multiple of a block
  unsigned unit_shift_ = 0;
  std::int32_t greatest_last_two_ = 0;
  buffer<std::int32_t> greatest_pair_;   // [rank, rank]
  buffer<std::int32_t> greatest_share_;  // [rank]
  buffer<std::size_t> low_slot_;         // [column]
  buffer<std::size_t> high_slot_;
  buffer<lane> column_losses_;
  buffer<lane> added_losses_;
  buffer<std::int32_t> own_losses_;
  buffer<lane> smallest_losses_;  // [slot of the first, state of all but the last two, column]
};

}  // namespace rota::dense::detail
