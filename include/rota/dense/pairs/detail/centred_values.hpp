#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/pair_values.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace rota::dense::detail {

/// The same values in other terms, near 0: w_ij(x, y) = r_ij(x) + r_ji(y) + v_ij(x, y), and u'_i = u_i + Σ_j r_ij.
///
/// r are the means of rows and columns of the tables. Any integers would do, since they are added to u' and subtracted
/// from the tables; means leave little to the tables, where bounds are weakest. The middle of each agent's u' goes into one
/// offset: value = offset + Σ_i u'_i(x_i) + Σ_{i<j} v_ij(x_i, x_j).
/// O(n²·m²) time, O(n²·m) memory.
class centred_values {
public:
  void prepare(pair_values const& values) {
    values_ = &values;
    agents_ = values.agents();
    slots_ = values.slot_count();
    unary_.assign(values.unary().begin(), values.unary().end());
    means_.assign(agents_ * agents_ * slots_, 0);
    strength_.assign(agents_ * agents_, 0);
    reach_.assign(agents_, 0);
    unsigned const coarse =
        static_cast<unsigned>((std::max)(20, static_cast<int>(std::bit_width(values.total()))) - 20);
    for (std::size_t a = 0; a < agents_; ++a)
      for (std::size_t b = a + 1; b < agents_; ++b) {
        if (!values.coupled(a, b)) continue;
        set_means(a, b);
        move_means(a, b);
        measure(a, b, coarse);
      }
    take_out_offset();
  }

  /// u', row per agent, or `absent`.
  [[nodiscard]] std::span<std::int64_t const> unary() const { return unary_; }
  /// r_ab, by the slot of a.
  [[nodiscard]] std::int64_t const* means(std::size_t a, std::size_t b) const {
    return &means_[(a * agents_ + b) * slots_];
  }
  [[nodiscard]] std::int64_t offset() const { return offset_; }
  /// How much it matters where a and b go together: Σ v², coarsely.
  [[nodiscard]] std::uint64_t strength(std::size_t a, std::size_t b) const { return strength_[a * agents_ + b]; }
  /// Σ_j max|v_aj|.
  [[nodiscard]] std::uint64_t reach(std::size_t a) const { return reach_[a]; }
  /// max|u'_a|.
  [[nodiscard]] std::uint64_t spread(std::size_t a) const { return spread_[a]; }

private:
  [[nodiscard]] std::int64_t* mutable_means(std::size_t a, std::size_t b) {
    return &means_[(a * agents_ + b) * slots_];
  }

  void set_means(std::size_t a, std::size_t b) {
    std::int64_t* const row = mutable_means(a, b);
    std::int64_t* const column = mutable_means(b, a);
    std::int64_t const mean = values_->forbids_pairs() ? means_of_present(a, b) : means_of_all(a, b);
    for (std::size_t x = 0; x < slots_; ++x) row[x] -= mean / 2, column[x] -= mean - mean / 2;
  }

  /// Means of rows and columns. @return the mean of the table
  std::int64_t means_of_all(std::size_t a, std::size_t b) {
    std::int64_t* const row = mutable_means(a, b);
    std::int64_t* const column = mutable_means(b, a);
    std::int64_t sum = 0;
    for (std::size_t x = 0; x < slots_; ++x) {
      std::int64_t const* const w = values_->pairs(a, x) + b * slots_;
      for (std::size_t y = 0; y < slots_; ++y) row[x] += w[y], column[y] += w[y];
      sum += row[x];
    }
    double const one_of_slots = 1.0 / static_cast<double>(slots_);
    for (std::size_t x = 0; x < slots_; ++x)
      row[x] = share_of(row[x], one_of_slots), column[x] = share_of(column[x], one_of_slots);
    return sum / static_cast<std::int64_t>(slots_ * slots_);
  }

  /// sum / slots, without the division: a tenth of the time of a small instance would be divisions. The half keeps the
  /// product away from whole numbers by more than its error, so that it does not depend on how exact doubles are.
  [[nodiscard]] std::int64_t share_of(std::int64_t sum, double one_of_slots) const {
    constexpr std::int64_t exact = std::int64_t{1} << 49;
    if (sum <= -exact || sum >= exact) return sum / static_cast<std::int64_t>(slots_);
    return static_cast<std::int64_t>((static_cast<double>(sum) + (sum < 0 ? -0.5 : 0.5)) * one_of_slots);
  }

  /// The same without forbidden entries.
  std::int64_t means_of_present(std::size_t a, std::size_t b) {
    std::int64_t* const row = mutable_means(a, b);
    std::int64_t* const column = mutable_means(b, a);
    std::int64_t sum = 0;
    std::int64_t present = 0;
    for (std::size_t x = 0; x < slots_; ++x) {
      std::int64_t in_row = 0;
      std::int64_t in_column = 0;
      for (std::size_t y = 0; y < slots_; ++y) {
        std::int64_t const here = values_->pairs(a, x)[b * slots_ + y];
        std::int64_t const mirrored = values_->pairs(a, y)[b * slots_ + x];
        if (here != pair_values::forbidden) row[x] += here, ++in_row;
        if (mirrored != pair_values::forbidden) column[x] += mirrored, ++in_column;
      }
      sum += row[x];
      present += in_row;
      if (in_row != 0) row[x] /= in_row;
      if (in_column != 0) column[x] /= in_column;
    }
    return present == 0 ? 0 : sum / present;
  }

  /// From the table of a and b into their own utilities.
  void move_means(std::size_t a, std::size_t b) {
    for (std::size_t x = 0; x < slots_; ++x) {
      if (unary_[a * slots_ + x] != pair_values::forbidden) unary_[a * slots_ + x] += means(a, b)[x];
      if (unary_[b * slots_ + x] != pair_values::forbidden) unary_[b * slots_ + x] += means(b, a)[x];
    }
  }

  void measure(std::size_t a, std::size_t b, unsigned coarse) {
    std::int64_t const* const row = means(a, b);
    std::int64_t const* const column = means(b, a);
    std::uint64_t greatest = 0;
    std::uint64_t squares = 0;
    for (std::size_t x = 0; x < slots_; ++x) {
      std::int64_t const* const w = values_->pairs(a, x) + b * slots_;
      for (std::size_t y = 0; y < slots_; ++y) {
        if (w[y] == pair_values::forbidden) continue;
        std::uint64_t const v = magnitude(w[y] - row[x] - column[y]);
        greatest = (std::max)(greatest, v);
        squares += (v >> coarse) * (v >> coarse);
      }
    }
    reach_[a] += greatest;
    reach_[b] += greatest;
    strength_[a * agents_ + b] = strength_[b * agents_ + a] = squares;
  }

  void take_out_offset() {
    offset_ = 0;
    spread_.assign(agents_, 0);
    for (std::size_t a = 0; a < agents_; ++a) {
      std::int64_t* const u = &unary_[a * slots_];
      std::int64_t least = (std::numeric_limits<std::int64_t>::max)();
      std::int64_t greatest = (std::numeric_limits<std::int64_t>::min)();
      for (std::size_t x = 0; x < slots_; ++x)
        if (u[x] != pair_values::forbidden) least = (std::min)(least, u[x]), greatest = (std::max)(greatest, u[x]);
      std::int64_t const middle = least > greatest ? 0 : least + (greatest - least) / 2;
      offset_ += middle;
      spread_[a] = least > greatest ? 0 : static_cast<std::uint64_t>(greatest - middle) + 1;
      for (std::size_t x = 0; x < slots_; ++x) u[x] = u[x] == pair_values::forbidden ? absent : u[x] - middle;
    }
  }

  pair_values const* values_ = nullptr;
  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::int64_t offset_ = 0;
  buffer<std::int64_t> unary_;      // [agent, slot]
  buffer<std::int64_t> means_;      // [agent, agent, slot]: r
  buffer<std::uint64_t> strength_;  // [agent, agent]
  buffer<std::uint64_t> reach_;     // [agent]
  buffer<std::uint64_t> spread_;    // [agent]
};

}  // namespace rota::dense::detail
