#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/centred_values.hpp>
#include <rota/dense/pairs/detail/lanes.hpp>
#include <rota/dense/pairs/detail/pair_values.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace rota::dense::detail {

/// A pairwise instance made ready to be searched: agents by rank, and numbers in quanta that fit into lanes.
///
/// Quanta are 2^shift units. What is centred (`centred_values`) is rounded up to them, so that sums bound from above:
///   value ≤ offset + 2^shift·(Σ field_i(x_i) + Σ share_i(x_i) + Σ v_ij(x_i, x_j)),   field + share = u'.
/// A field says how much an unplaced agent gets in each slot: its own part, to which the search adds its gains from those
/// placed. A share is the part that `suffix_bounds` bounds.
/// Agents that matter more to the others come first by rank; interchangeable ones in the order given.
/// O(n²·m²) time and memory.
class pair_model {
public:
  /// No valid assignment is worth as little.
  static constexpr std::int64_t nothing = pair_values::nothing;
  /// Prices of slots stay within this magnitude, so that a field less a price is a lane.
  static constexpr std::int32_t most_price = 8192;

  void prepare(pair_instance const& in, bool symmetry) {
    values_.prepare(in, symmetry);
    agents_ = values_.agents();
    slots_ = values_.slot_count();
    stride_ = lane_stride(agents_);
    floored_ = values_.forbids_pairs();
    centred_.prepare(values_);
    rank_agents();
    find_twins();
    choose_quanta();
    set_tables();
    set_fields();
  }

  [[nodiscard]] std::size_t agents() const { return agents_; }
  [[nodiscard]] std::size_t slot_count() const { return slots_; }
  /// By the caller's numbers.
  [[nodiscard]] pair_values const& values() const { return values_; }
  /// u', row per agent, or `absent`.
  [[nodiscard]] std::span<std::int64_t const> centred() const { return centred_.unary(); }

  [[nodiscard]] std::size_t agent_at(std::size_t rank) const { return order_[rank]; }
  [[nodiscard]] std::size_t rank_of(std::size_t agent) const { return rank_[agent]; }
  /// The rank of the next interchangeable agent before, or no_slot.
  [[nodiscard]] std::uint32_t twin_before(std::size_t rank) const { return twin_[rank]; }
  /// Whether the agent of that rank may take the slot at all.
  [[nodiscard]] bool present(std::size_t rank, std::size_t x) const {
    return values_.unary(order_[rank], x) != pair_values::forbidden;
  }

  /// How far the rows of fields and tables are apart, a row per slot.
  [[nodiscard]] std::size_t stride() const { return stride_; }
  /// The lane of the agent of that rank; the last lanes are taken.
  [[nodiscard]] std::size_t lane_of(std::size_t rank) const { return stride_ - agents_ + rank; }
  /// Whether sums of fields may fall below the floor, since combinations are forbidden.
  [[nodiscard]] bool floored() const { return floored_; }
  [[nodiscard]] lane floor() const { return floored_ ? lowest_field : (std::numeric_limits<lane>::min)(); }
  /// Whether a field says that the agent cannot join those placed.
  [[nodiscard]] bool dead(std::int32_t field) const { return floored_ && field < -floored_range; }
  /// A field so low that an agent is kept out of a slot; as low as sums allow.
  [[nodiscard]] lane repellent(std::size_t rank) const {
    return floored_ ? lowest_field : static_cast<lane>(-(range - reach_[rank]));
  }

  /// The fields before anybody is placed.
  [[nodiscard]] std::span<lane const> fields() const { return fields_; }
  /// What placing the agent of that rank in x adds to the fields of those ranked after it.
  [[nodiscard]] lane const* table(std::size_t rank, std::size_t x) const {
    return &tables_[(rank * slots_ + x) * slots_ * stride_];
  }
  /// v, of agents by rank.
  [[nodiscard]] std::int32_t pair(std::size_t rank, std::size_t x, std::size_t later, std::size_t y) const {
    return table(rank, x)[y * stride_ + lane_of(later)];
  }
  [[nodiscard]] std::int32_t share(std::size_t rank, std::size_t x) const { return shares_[rank * slots_ + x]; }
  [[nodiscard]] std::int32_t const* shares(std::size_t rank) const { return &shares_[rank * slots_]; }

  /// The greatest exact value that `quanta` allow.
  [[nodiscard]] std::int64_t exact(std::int32_t quanta) const {
    return centred_.offset() + static_cast<std::int64_t>(quanta) * (std::int64_t{1} << shift_);
  }
  /// The most quanta that allow no exact value above `value`.
  [[nodiscard]] std::int32_t quanta(std::int64_t value) const {
    std::int64_t const q = (value - centred_.offset()) >> shift_;
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(q, -quanta_limit, quanta_limit));
  }

private:
  static constexpr std::int32_t range = (std::numeric_limits<lane>::max)() - most_price;
  static constexpr std::int32_t floored_range = 8191 - 64;
  static constexpr lane lowest_field = -16384;
  static constexpr std::int32_t absent_share = -(1 << 18);
  static constexpr std::int64_t quanta_limit = std::int64_t{1} << 30;

  /// The last rank goes to the agent that is least coupled to the others left, and so on from the end: a suffix then holds
  /// the agents whose places matter least.
  void rank_agents() {
    std::size_t const n = agents_;
    order_.resize(n);
    for (std::size_t a = 0; a < n; ++a) order_[a] = static_cast<std::uint32_t>(a);
    left_.assign(n, 0);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) left_[a] += centred_.strength(a, b);
    for (std::size_t r = n; r-- > 1;) {
      std::size_t least = 0;
      for (std::size_t i = 1; i <= r; ++i)
        if (left_[order_[i]] <= left_[order_[least]]) least = i;
      std::uint32_t const a = order_[least];
      std::rotate(order_.begin() + least, order_.begin() + least + 1, order_.begin() + r + 1);
      for (std::size_t i = 0; i < r; ++i) left_[order_[i]] -= centred_.strength(a, order_[i]);
    }
  }

  /// Twins keep the caller's order: of the assignments that differ by exchanges, the smallest in that order is then the one
  /// whose slots do not decrease.
  void find_twins() {
    std::size_t const n = agents_;
    auto const alike = [&](std::size_t r, std::size_t s) {
      return values_.kind_of(order_[r]) == values_.kind_of(order_[s]);
    };
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t s = 0; s < r; ++s)
        if (alike(r, s) && order_[s] > order_[r]) std::swap(order_[s], order_[r]);
    rank_.resize(n);
    for (std::size_t r = 0; r < n; ++r) rank_[order_[r]] = static_cast<std::uint32_t>(r);
    twin_.assign(n, no_slot);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t s = 0; s < r; ++s)
        if (alike(r, s)) twin_[r] = static_cast<std::uint32_t>(s);
  }

  /// The finest quanta for which every sum of fields stays within a lane.
  void choose_quanta() {
    std::size_t const n = agents_;
    std::uint64_t greatest = 0;
    for (std::size_t a = 0; a < n; ++a) greatest = (std::max)(greatest, centred_.reach(a) + centred_.spread(a));
    bool const holes = std::find(centred().begin(), centred().end(), absent) != centred().end();
    std::int64_t room = range;
    if (floored_)
      room = floored_range;
    else if (holes)
      room = range / 2;
    room -= 2 * static_cast<std::int64_t>(n) + 2;  // rounding up adds at most one quantum per term
    shift_ = 0;
    while ((greatest >> shift_) > static_cast<std::uint64_t>(room)) ++shift_;
    reach_.resize(n);
    for (std::size_t r = 0; r < n; ++r)
      reach_[r] = static_cast<std::int32_t>((centred_.reach(order_[r]) >> shift_) + n + 1);
  }

  [[nodiscard]] std::int64_t rounded_up(std::int64_t v) const {
    return (v + ((std::int64_t{1} << shift_) - 1)) >> shift_;
  }

  void set_tables() {
    std::size_t const n = agents_;
    std::size_t const m = slots_;
    tables_.assign(n * m * m * stride_, 0);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t later = r + 1; later < n; ++later) {
        std::size_t const a = order_[r];
        std::size_t const b = order_[later];
        if (!values_.coupled(a, b)) continue;
        std::int64_t const* const row = centred_.means(a, b);
        std::int64_t const* const column = centred_.means(b, a);
        for (std::size_t x = 0; x < m; ++x) {
          std::int64_t const* const w = values_.pairs(a, x) + b * m;
          lane* const to = &tables_[(r * m + x) * m * stride_ + lane_of(later)];
          for (std::size_t y = 0; y < m; ++y)
            to[y * stride_] = w[y] == pair_values::forbidden ? lowest_field
                                                             : static_cast<lane>(rounded_up(w[y] - row[x] - column[y]));
        }
      }
  }

  void set_fields() {
    fields_.assign(slots_ * stride_, 0);
    shares_.resize(agents_ * slots_);
    for (std::size_t r = 0; r < agents_; ++r)
      for (std::size_t x = 0; x < slots_; ++x) {
        std::int64_t const u = centred()[order_[r] * slots_ + x];
        std::int64_t const whole = u == absent ? repellent(r) : rounded_up(u);
        // Nearly half of u' is the share: field and share then pull an agent the same way.
        std::int64_t const share = u == absent ? 0 : whole * 29 / 64;
        shares_[r * slots_ + x] = u == absent ? absent_share : static_cast<std::int32_t>(share);
        fields_[x * stride_ + lane_of(r)] = static_cast<lane>(whole - share);
      }
  }

  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::size_t stride_ = 0;
  bool floored_ = false;
  unsigned shift_ = 0;
  pair_values values_;
  centred_values centred_;
  buffer<std::uint64_t> left_;   // [agent]: how much it is coupled to those not ranked yet
  buffer<std::uint32_t> order_;  // [rank] → agent
  buffer<std::uint32_t> rank_;   // [agent]
  buffer<std::uint32_t> twin_;   // [rank]
  buffer<std::int32_t> reach_;   // [rank]: Σ_j max|v_ij| in quanta
  buffer<lane> tables_;          // [rank, slot, slot, lane]
  buffer<lane> fields_;          // [slot, lane]
  buffer<std::int32_t> shares_;  // [rank, slot]
};

}  // namespace rota::dense::detail
