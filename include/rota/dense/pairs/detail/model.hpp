#pragma once

#include <rota/core/assert.hpp>
#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/lanes.hpp>
#include <rota/dense/pairs/instance.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// A pairwise instance made ready to be searched: exact values by the caller's numbers, and bounds in quanta by rank.
///
/// Reparametrised: w_ij(x, y) = r_ij(x) + r_ji(y) + v_ij(x, y), where r are the means of rows and columns; v has them
/// near 0, and u'_i = u_i + Σ_j r_ij. Quanta are 2^shift units, rounded up, so that sums of them bound from above:
/// value ≤ offset + 2^shift·(Σ field_i(x_i) + Σ v_ij(x_i, x_j) + Σ share_i(x_i)), where field + share = u'.
/// Agents are ranked by how much they are coupled, the most first; interchangeable ones in the order given.
/// O(n²·m²) time and memory.
class pair_model {
public:
  /// What stands for a forbidden slot or combination in exact sums: one of it and the sum is below every valid value.
  static constexpr std::int64_t forbidden = -2 * max_pair_total;
  /// No valid assignment is worth as little.
  static constexpr std::int64_t nothing = -max_pair_total - 1;
  /// Prices of slots stay within this magnitude, so that a field less a price is a lane.
  static constexpr std::int32_t most_price = 8192;

  void prepare(pair_instance const& in, bool symmetry) {
    read(in);
    find_kinds(symmetry);
    center();
    rank_agents();
    quantise();
  }

  [[nodiscard]] std::size_t agents() const { return agents_; }
  [[nodiscard]] std::size_t slot_count() const { return slots_; }
  [[nodiscard]] std::size_t stride() const { return stride_; }
  /// The lane of the agent of that rank; the last lanes are taken.
  [[nodiscard]] std::size_t lane_of(std::size_t rank) const { return stride_ - agents_ + rank; }
  [[nodiscard]] std::size_t agent_at(std::size_t rank) const { return order_[rank]; }
  [[nodiscard]] std::size_t rank_of(std::size_t agent) const { return rank_[agent]; }
  /// The number of the agent that it can be exchanged with and that comes first.
  [[nodiscard]] std::size_t kind_of(std::size_t agent) const { return kind_[agent]; }
  /// The rank of the next interchangeable agent before, or no_slot.
  [[nodiscard]] std::uint32_t twin_before(std::size_t rank) const { return twin_[rank]; }
  [[nodiscard]] bool floored() const { return floored_; }
  [[nodiscard]] lane floor() const { return floored_ ? lowest_lane : (std::numeric_limits<lane>::min)(); }

  /// u_i(x), or `forbidden`, by the caller's numbers.
  [[nodiscard]] std::int64_t unary(std::size_t a, std::size_t x) const { return unary_[a * slots_ + x]; }
  /// u'_i(x), or `absent`.
  [[nodiscard]] std::span<std::int64_t const> centred() const { return centred_; }
  /// What a in x is worth with each agent in each slot: agents·slots values, 0 for itself.
  [[nodiscard]] std::int64_t const* pairs(std::size_t a, std::size_t x) const {
    return &pairs_[(a * slots_ + x) * agents_ * slots_];
  }
  /// The exact value, below `nothing` if something forbidden is in it.
  [[nodiscard]] std::int64_t value(std::span<slot const> assignment) const {
    std::int64_t sum = 0;
    for (std::size_t a = 0; a < agents_; ++a) {
      sum += unary(a, assignment[a]);
      std::int64_t const* const with = pairs(a, assignment[a]);
      for (std::size_t b = a + 1; b < agents_; ++b) sum += with[b * slots_ + assignment[b]];
    }
    return sum;
  }

  /// The fields before anybody is placed.
  [[nodiscard]] std::span<lane const> fields() const { return fields_; }
  /// What placing the agent of that rank in x adds to the fields of those ranked after it.
  [[nodiscard]] lane const* table(std::size_t rank, std::size_t x) const {
    return &tables_[(rank * slots_ + x) * slots_ * stride_];
  }
  [[nodiscard]] std::int32_t pair(std::size_t rank, std::size_t x, std::size_t later, std::size_t y) const {
    return table(rank, x)[y * stride_ + lane_of(later)];
  }
  /// The part of u' that counts within suffixes: see `suffix_bounds`.
  [[nodiscard]] std::int32_t share(std::size_t rank, std::size_t x) const { return shares_[rank * slots_ + x]; }
  [[nodiscard]] std::int32_t const* shares(std::size_t rank) const { return &shares_[rank * slots_]; }
  /// The slots that the agent of that rank may take at all.
  [[nodiscard]] bool present(std::size_t rank, std::size_t x) const { return unary(order_[rank], x) != forbidden; }
  /// A field as low as sums allow, by which an agent is kept out of a slot.
  [[nodiscard]] lane repellent(std::size_t rank) const {
    return floored_ ? lowest_lane : static_cast<lane>(-(range - reach_[rank]));
  }
  /// Whether a field says that the agent cannot join those placed.
  [[nodiscard]] bool dead(std::int32_t field) const { return floored_ && field < -floored_range; }

  /// The greatest exact value that `quanta` allow.
  [[nodiscard]] std::int64_t exact(std::int32_t quanta) const {
    return offset_ + static_cast<std::int64_t>(quanta) * (std::int64_t{1} << shift_);
  }
  /// The most quanta that allow no exact value above `value`.
  [[nodiscard]] std::int32_t quanta(std::int64_t value) const {
    std::int64_t const q = (value - offset_) >> shift_;
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(q, -quanta_limit, quanta_limit));
  }

private:
  static constexpr std::int32_t range = (std::numeric_limits<lane>::max)() - most_price;
  static constexpr std::int32_t floored_range = 8191 - 64;
  static constexpr lane lowest_lane = -16384;
  static constexpr std::int64_t quanta_limit = std::int64_t{1} << 30;

  [[nodiscard]] std::int64_t& pair_at(std::size_t a, std::size_t x, std::size_t b, std::size_t y) {
    return pairs_[((a * slots_ + x) * agents_ + b) * slots_ + y];
  }
  static std::uint64_t magnitude(std::int64_t v) {
    return v < 0 ? 0 - static_cast<std::uint64_t>(v) : static_cast<std::uint64_t>(v);
  }

  void read(pair_instance const& in) {
    ROTA_ASSERT(in.agents <= max_pair_agents && in.slot_count() <= max_pair_slots);
    ROTA_ASSERT(in.unary.size() == in.agents * in.slot_count());
    agents_ = in.agents;
    slots_ = in.slot_count();
    stride_ = lane_stride(agents_);
    floored_ = false;
    std::uint64_t total = 0;
    unary_.resize(agents_ * slots_);
    for (std::size_t a = 0; a < agents_; ++a) {
      std::uint64_t most = 0;
      for (std::size_t x = 0; x < slots_; ++x) {
        std::int64_t const u = in.unary[a * slots_ + x];
        unary_[a * slots_ + x] = u == absent ? forbidden : u;
        if (u != absent) most = (std::max)(most, magnitude(u));
      }
      total += std::min<std::uint64_t>(most, max_pair_total + 1);
    }
    pairs_.assign(agents_ * slots_ * agents_ * slots_, 0);
    coupled_.assign(agents_ * agents_, 0);
    for (coupling const& c : in.couplings) {
      ROTA_ASSERT(c.first < agents_ && c.second < agents_ && c.first != c.second);
      ROTA_ASSERT(c.table.size() == slots_ * slots_);
      coupled_[c.first * agents_ + c.second] = coupled_[c.second * agents_ + c.first] = 1;
      std::uint64_t most = 0;
      std::int64_t const* w = c.table.data();
      for (std::size_t x = 0; x < slots_; ++x)
        for (std::size_t y = 0; y < slots_; ++y, ++w) {
          std::int64_t& here = pair_at(c.first, x, c.second, y);
          if (*w == absent) {
            here = forbidden;
            floored_ = true;
          } else if (here != forbidden) {
            here += *w;
            most = (std::max)(most, magnitude(*w));
          }
          pair_at(c.second, y, c.first, x) = here;
        }
      total += std::min<std::uint64_t>(most, max_pair_total + 1);
    }
    ROTA_ASSERT(total <= static_cast<std::uint64_t>(max_pair_total));
    total_ = total;
  }

  [[nodiscard]] bool interchangeable(std::size_t a, std::size_t b) const {
    // A constant more in a whole row is had in any slot.
    std::int64_t more = 0;
    bool seen = false;
    for (std::size_t x = 0; x < slots_; ++x) {
      std::int64_t const u = unary(a, x);
      std::int64_t const v = unary(b, x);
      if ((u == forbidden) != (v == forbidden)) return false;
      if (u == forbidden) continue;
      if (seen && v - u != more) return false;
      more = v - u;
      seen = true;
    }
    for (std::size_t x = 0; x < slots_; ++x) {
      std::int64_t const* const p = pairs(a, x);
      std::int64_t const* const q = pairs(b, x);
      if (!std::equal(p + b * slots_, p + (b + 1) * slots_, q + a * slots_)) return false;
      for (std::size_t c = 0; c < agents_; ++c)
        if (c != a && c != b && !std::equal(p + c * slots_, p + (c + 1) * slots_, q + c * slots_)) return false;
    }
    return true;
  }

  /// kind_[a] ← the first agent that a can be exchanged with, which is an equivalence.
  void find_kinds(bool symmetry) {
    kind_.resize(agents_);
    for (std::size_t a = 0; a < agents_; ++a) {
      kind_[a] = static_cast<std::uint32_t>(a);
      for (std::size_t b = 0; b < a && symmetry; ++b)
        if (kind_[b] == b && interchangeable(b, a)) {
          kind_[a] = static_cast<std::uint32_t>(b);
          break;
        }
    }
  }

  /// Splits off the means of rows and columns. Any integers would do: what is added to u' is subtracted from the pair.
  void center() {
    std::size_t const n = agents_;
    std::size_t const m = slots_;
    centred_.assign(unary_.begin(), unary_.end());
    means_.assign(n * n * m, 0);
    strength_.assign(n * n, 0);
    reach64_.assign(n, 0);
    unsigned const fine = static_cast<unsigned>((std::max)(20, static_cast<int>(std::bit_width(total_))) - 20);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 1; b < n; ++b) {
        if (!coupled_[a * n + b]) continue;
        std::int64_t* const row = &means_[(a * n + b) * m];
        std::int64_t* const column = &means_[(b * n + a) * m];
        split(a, b, row, column);
        std::uint64_t most = 0;
        std::uint64_t squares = 0;
        for (std::size_t x = 0; x < m; ++x) {
          std::int64_t const* const w = pairs(a, x) + b * m;
          for (std::size_t y = 0; y < m; ++y) {
            if (w[y] == forbidden) continue;
            std::uint64_t const v = magnitude(w[y] - row[x] - column[y]);
            most = (std::max)(most, v);
            squares += (v >> fine) * (v >> fine);
          }
        }
        reach64_[a] += most;
        reach64_[b] += most;
        strength_[a * n + b] = strength_[b * n + a] = squares;
        for (std::size_t x = 0; x < m; ++x) {
          if (centred_[a * m + x] != forbidden) centred_[a * m + x] += row[x];
          if (centred_[b * m + x] != forbidden) centred_[b * m + x] += column[x];
        }
      }
    // What every slot of an agent gives anyway belongs to nobody.
    offset_ = 0;
    spread64_.assign(n, 0);
    for (std::size_t a = 0; a < n; ++a) {
      std::int64_t* const u = &centred_[a * m];
      std::int64_t least = (std::numeric_limits<std::int64_t>::max)();
      std::int64_t most = (std::numeric_limits<std::int64_t>::min)();
      for (std::size_t x = 0; x < m; ++x)
        if (u[x] != forbidden) least = (std::min)(least, u[x]), most = (std::max)(most, u[x]);
      std::int64_t const middle = least > most ? 0 : least + (most - least) / 2;
      offset_ += middle;
      spread64_[a] = least > most ? 0 : static_cast<std::uint64_t>(most - middle) + 1;
      for (std::size_t x = 0; x < m; ++x) u[x] = u[x] == forbidden ? absent : u[x] - middle;
    }
  }

  /// sum / slots, without the division: a tenth of the time of a small instance would be divisions. The half keeps the
  /// product away from whole numbers by more than its error, so that it does not depend on how exact doubles are.
  [[nodiscard]] std::int64_t share_of(std::int64_t sum, double one_of_slots) const {
    constexpr std::int64_t exact = std::int64_t{1} << 49;
    if (sum <= -exact || sum >= exact) return sum / static_cast<std::int64_t>(slots_);
    return static_cast<std::int64_t>((static_cast<double>(sum) + (sum < 0 ? -0.5 : 0.5)) * one_of_slots);
  }

  void split(std::size_t a, std::size_t b, std::int64_t* row, std::int64_t* column) {
    std::size_t const m = slots_;
    std::int64_t sum = 0;
    std::int64_t seen = 0;
    if (!floored_) {
      for (std::size_t x = 0; x < m; ++x) {
        std::int64_t const* const w = pairs(a, x) + b * m;
        for (std::size_t y = 0; y < m; ++y) row[x] += w[y], column[y] += w[y];
        sum += row[x];
      }
      double const one_of_slots = 1.0 / static_cast<double>(m);
      for (std::size_t x = 0; x < m; ++x)
        row[x] = share_of(row[x], one_of_slots), column[x] = share_of(column[x], one_of_slots);
      seen = static_cast<std::int64_t>(m * m);
    } else {
      for (std::size_t x = 0; x < m; ++x) {
        std::int64_t in_row = 0;
        std::int64_t in_column = 0;
        for (std::size_t y = 0; y < m; ++y) {
          if (std::int64_t const w = pairs(a, x)[b * m + y]; w != forbidden) row[x] += w, ++in_row, sum += w, ++seen;
          if (std::int64_t const w = pairs(a, y)[b * m + x]; w != forbidden) column[x] += w, ++in_column;
        }
        if (in_row != 0) row[x] /= in_row;
        if (in_column != 0) column[x] /= in_column;
      }
    }
    std::int64_t const mean = seen == 0 ? 0 : sum / seen;
    for (std::size_t x = 0; x < m; ++x) row[x] -= mean / 2, column[x] -= mean - mean / 2;
  }

  /// The last rank goes to the agent that is least coupled to the others left; so suffixes are loose and prefixes tell.
  void rank_agents() {
    std::size_t const n = agents_;
    order_.resize(n);
    for (std::size_t a = 0; a < n; ++a) order_[a] = static_cast<std::uint32_t>(a);
    left_.assign(n, 0);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) left_[a] += strength_[a * n + b];
    for (std::size_t r = n; r-- > 1;) {
      std::size_t least = 0;
      for (std::size_t i = 1; i <= r; ++i)
        if (left_[order_[i]] <= left_[order_[least]]) least = i;
      std::uint32_t const a = order_[least];
      std::rotate(order_.begin() + least, order_.begin() + least + 1, order_.begin() + r + 1);
      for (std::size_t i = 0; i < r; ++i) left_[order_[i]] -= strength_[a * n + order_[i]];
    }
    // Twins keep the caller's order: then the smallest assignment in it is the one with non-decreasing slots.
    twin_.assign(n, no_slot);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t s = 0; s < r; ++s)
        if (kind_[order_[s]] == kind_[order_[r]] && order_[s] > order_[r]) std::swap(order_[s], order_[r]);
    rank_.resize(n);
    for (std::size_t r = 0; r < n; ++r) rank_[order_[r]] = static_cast<std::uint32_t>(r);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t s = 0; s < r; ++s)
        if (kind_[order_[s]] == kind_[order_[r]]) twin_[r] = static_cast<std::uint32_t>(s);
  }

  /// Rounds up to quanta, the finest for which every sum of fields stays within a lane.
  void quantise() {
    std::size_t const n = agents_;
    std::size_t const m = slots_;
    bool holes = false;
    std::uint64_t most = 0;
    for (std::size_t a = 0; a < n; ++a) most = (std::max)(most, reach64_[a] + spread64_[a]);
    for (std::int64_t const u : centred_) holes |= u == absent;
    // Rounding up adds at most one quantum per term.
    std::int64_t const room = (floored_ ? floored_range
                               : holes  ? range / 2
                                        : range) -
                              2 * static_cast<std::int64_t>(n) - 2;
    shift_ = 0;
    while ((most >> shift_) > static_cast<std::uint64_t>(room)) ++shift_;
    std::int64_t const up = (std::int64_t{1} << shift_) - 1;
    reach_.resize(n);
    for (std::size_t r = 0; r < n; ++r) reach_[r] = static_cast<std::int32_t>((reach64_[order_[r]] >> shift_) + n + 1);
    tables_.assign(n * m * m * stride_, 0);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t later = r + 1; later < n; ++later) {
        std::size_t const a = order_[r];
        std::size_t const b = order_[later];
        if (!coupled_[a * n + b]) continue;
        std::int64_t const* const row = &means_[(a * n + b) * m];
        std::int64_t const* const column = &means_[(b * n + a) * m];
        for (std::size_t x = 0; x < m; ++x) {
          std::int64_t const* const w = pairs(a, x) + b * m;
          lane* const to = &tables_[(r * m + x) * m * stride_ + lane_of(later)];
          for (std::size_t y = 0; y < m; ++y)
            to[y * stride_] =
                w[y] == forbidden ? lowest_lane : static_cast<lane>((w[y] - row[x] - column[y] + up) >> shift_);
        }
      }
    fields_.assign(m * stride_, 0);
    shares_.resize(n * m);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t x = 0; x < m; ++x) {
        std::int64_t const u = centred_[order_[r] * m + x];
        std::int64_t const q = u == absent ? repellent(r) : (u + up) >> shift_;
        // Nearly half of u' on either side: both then pull an agent the same way.
        std::int64_t const part = u == absent ? 0 : q * 29 / 64;
        shares_[r * m + x] = u == absent ? -(1 << 18) : static_cast<std::int32_t>(part);
        fields_[x * stride_ + lane_of(r)] = static_cast<lane>(q - part);
      }
  }

  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::size_t stride_ = 0;
  bool floored_ = false;
  unsigned shift_ = 0;
  std::int64_t offset_ = 0;
  std::uint64_t total_ = 0;
  buffer<std::int64_t> unary_;      // [agent, slot]
  buffer<std::int64_t> pairs_;      // [agent, slot, agent, slot]
  buffer<char> coupled_;            // [agent, agent]
  buffer<std::uint32_t> kind_;      // [agent]
  buffer<std::int64_t> centred_;    // [agent, slot]: u'
  buffer<std::int64_t> means_;      // [agent, agent, slot]: r
  buffer<std::uint64_t> strength_;  // [agent, agent]: Σ v², coarsely
  buffer<std::uint64_t> reach64_;   // [agent]: Σ_j max|v|
  buffer<std::uint64_t> spread64_;  // [agent]: max|u'|
  buffer<std::uint64_t> left_;
  buffer<std::uint32_t> order_;  // [rank] → agent
  buffer<std::uint32_t> rank_;   // [agent]
  buffer<std::uint32_t> twin_;   // [rank]
  buffer<std::int32_t> reach_;   // [rank]: in quanta
  buffer<lane> tables_;          // [rank, slot, slot, lane]
  buffer<lane> fields_;          // [slot, lane]
  buffer<std::int32_t> shares_;  // [rank, slot]
};

}  // namespace rota::dense::detail
