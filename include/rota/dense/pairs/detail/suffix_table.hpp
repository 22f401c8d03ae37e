#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/count_states.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace rota::dense::detail {

/// Bounds on what the last k agents are worth among themselves, for each state of their counts: in all, and with the
/// first of them in a given slot.
///
/// Whole numbers of quanta in floats, all below 2^24, so that sums are exact.
class suffix_table {
public:
  /// No assignment has these counts. A sum of it and whatever else is in it stays below `feasible`.
  static constexpr float impossible = -1e9F;
  static constexpr float feasible = -1e8F;

  void prepare(count_states const& states, std::size_t slot_count) {
    states_ = states.largest();
    slots_ = slot_count;
    width_ = (slot_count + 7) / 8 * 8;
    best_.resize((states.longest() + 1) * states_);
    by_slot_.resize((states.longest() + 1) * states_ * width_);
    best_[0] = 0;  // nobody, worth nothing
  }

  /// How far the rows of `by_slot` are apart.
  [[nodiscard]] std::size_t width() const { return width_; }
  /// [state]
  [[nodiscard]] float const* best(std::size_t k) const { return &best_[k * states_]; }
  /// [state·width + slot of the first agent]
  [[nodiscard]] float const* by_slot(std::size_t k) const { return &by_slot_[k * states_ * width_]; }
  [[nodiscard]] float* by_slot(std::size_t k) { return &by_slot_[k * states_ * width_]; }

  void fill(std::size_t k, count_states const& states, float bound) {
    std::fill_n(by_slot(k), states.size(k) * width_, bound);
  }
  /// Makes `best` of `by_slot`.
  void close(std::size_t k, count_states const& states) {
    float const* row = by_slot(k);
    float* const best = &best_[k * states_];
    for (std::size_t i = 0; i < states.size(k); ++i, row += width_) best[i] = *std::max_element(row, row + slots_);
  }
  /// The greatest over all states.
  [[nodiscard]] float greatest(std::size_t k, count_states const& states) const {
    float bound = impossible;
    for (std::size_t i = 0; i < states.size(k); ++i) bound = (std::max)(bound, best(k)[i]);
    return bound;
  }

private:
  std::size_t states_ = 0;  // room for so many per k
  std::size_t slots_ = 0;
  std::size_t width_ = 0;
  buffer<float> best_;     // [k, state]
  buffer<float> by_slot_;  // [k, state, slot]
};

}  // namespace rota::dense::detail
