#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/count_space.hpp>
#include <rota/dense/pairs/detail/model.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace rota::dense::detail {

/// For how many agents at the end suffixes are bounded.
struct suffix_plan {
  std::size_t exact = 0;   ///< by enumeration
  std::size_t beyond = 0;  ///< so many more, by expansion

  /// About half of the agents: from there on, enumerating one more costs more than it saves. At most `effort` steps.
  static suffix_plan fitting(std::size_t agents, std::size_t slot_count, std::uint64_t effort) {
    suffix_plan plan{1, agents < 10 ? 0 : agents / 5 - 1};
    std::uint64_t work = 0;
    std::uint64_t all = 1;
    for (std::size_t k = 2; 2 * k <= agents && work + all <= (std::min)(effort, most_work); ++k) {
      plan.exact = k;
      work += all;
      all *= slot_count;
    }
    return plan;
  }
  static constexpr std::uint64_t most_work = 500000;
};

/// What the agents from some rank on are worth among themselves, at most, by how many of them each slot takes.
///
/// best(d)[rank(c)] ≥ max over assignments of ranks d… with counts c of Σ share_i(x_i) + Σ_{i<j} v_ij(x_i, x_j), in
/// quanta; best_by(d) the same with rank d in a given slot. Exact for the last `enumerated` ranks, by enumeration: all but
/// the last two agents in turn, those as pairs of slots side by side. For some ranks more: all ways to place the first
/// one, two, three agents, each bounded by the suffix below plus the most that agents there get from those placed, by
/// counts; the least of these. Whole numbers in floats, all below 2^24.
/// Time O(m^enumerated) and O(m^4·states) per rank more.
class suffix_bounds {
public:
  static constexpr float impossible = -1e9F;
  static constexpr float feasible = -1e8F;

  /// Where stop() says so, for fewer ranks than planned.
  void prepare(pair_model const& model, std::span<std::uint32_t const> upper, suffix_plan plan,
               stop_request const& stop) {
    agents_ = model.agents();
    slots_ = model.slot_count();
    upper_ = upper;
    flatten(model);
    work_ = 0;
    levels_ = 0;
    enumerated_ = 0;
    states_.clear();
    if (agents_ < 3 || plan.exact == 0 || stop()) return;
    enumerated_ = (std::min)(plan.exact, agents_ - 1);
    levels_ = (std::min)(enumerated_ + plan.beyond, agents_ - 1);
    space_.prepare(upper, agents_, levels_);
    while (levels_ > 0 &&
           (space_.size_of_largest(levels_) > most_states || space_.indices() > count_space::most_indices))
      space_.prepare(upper, agents_, --levels_);
    if (levels_ == 0) return;
    enumerated_ = (std::min)(enumerated_, levels_);
    width_ = (slots_ + 7) / 8 * 8;
    list_states();
    now_.reserve(stride_ * lanes_at_once);
    then_.reserve(stride_ * lanes_at_once);
    best_.resize((levels_ + 1) * stride_);
    by_.resize((levels_ + 1) * stride_ * width_);
    best_[0] = 0;
    enumerate(model, stop);
    for (std::size_t k = 2, all = 1; k <= enumerated_; ++k, all *= slots_) work_ += all;
    for (std::size_t k = enumerated_ + 1; k <= levels_; ++k) {
      if (stop()) {
        levels_ = k - 1;
        break;
      }
      std::fill_n(by(agents_ - k), space_.size(k) * width_, -impossible);
      for (std::size_t r = 1;
           r <= (std::min)(k - enumerated_, most_placed) && (r == 1 || (affordable(k, r) && !stop())); ++r)
        expand(model, agents_ - k, r);
      settle(k);
    }
    for (std::size_t d = agents_ - levels_; d-- > 0;) flat_[d] = (std::min)(flat_[d], flat_[d + 1] + step_[d]);
  }

  /// Whether the ranks from d on are bounded by counts.
  [[nodiscard]] bool counted(std::size_t d) const { return levels_ != 0 && agents_ - d <= levels_; }
  [[nodiscard]] float const* best(std::size_t d) const { return &best_[(agents_ - d) * stride_]; }
  /// [rank(c)·width + slot]
  [[nodiscard]] float const* best_by(std::size_t d) const { return &by_[(agents_ - d) * stride_ * width_]; }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] count_space const& space() const { return space_; }
  /// The greatest over all counts.
  [[nodiscard]] std::int32_t flat(std::size_t d) const { return flat_[d]; }
  /// The numbers of the counts of sum k, by their index.
  [[nodiscard]] std::uint16_t const* numbers(std::size_t k) const { return &numbers_[k * space_.indices()]; }
  /// How many count vectors there are, over all depths.
  [[nodiscard]] std::size_t states() const { return states_.size(); }
  /// Assignments looked at.
  [[nodiscard]] std::uint64_t work() const { return work_; }

private:
  static constexpr std::size_t most_states = 4096;
  static constexpr std::size_t most_placed = 3;
  static constexpr std::uint64_t most_steps = std::uint64_t{1} << 24;
  static constexpr std::size_t lanes_at_once = 64;
  // Sums of losses stay within lanes: of a column, what an agent adds, and a value; or twice the transport floor.
  static constexpr lane column_floor = -14000;
  static constexpr lane add_floor = -4000;
  static constexpr lane value_floor = -14000;
  static constexpr lane transport_floor = -16000;

  float* by(std::size_t d) { return &by_[(agents_ - d) * stride_ * width_]; }

  void flatten(pair_model const& model) {
    flat_.assign(agents_ + 1, 0);
    step_.assign(agents_, 0);
    for (std::size_t d = agents_; d-- > 0;) {
      std::int32_t most = (std::numeric_limits<std::int32_t>::min)() / 2;
      for (std::size_t x = 0; x < slots_; ++x) {
        std::int32_t sum = model.share(d, x);
        for (std::size_t j = d + 1; j < agents_; ++j) {
          std::int32_t pair = model.pair(d, x, j, 0);
          for (std::size_t y = 1; y < slots_; ++y) pair = (std::max)(pair, model.pair(d, x, j, y));
          sum += pair;
        }
        most = (std::max)(most, sum);
      }
      step_[d] = most;
      flat_[d] = flat_[d + 1] + most;
    }
  }

  /// Whether placing r agents in all ways costs a few million steps at most.
  [[nodiscard]] bool affordable(std::size_t k, std::size_t r) const {
    std::uint64_t steps = first_state_[k - r];
    for (std::size_t i = 0; i <= r; ++i) steps *= slots_;
    return steps <= most_steps;
  }

  void list_states() {
    first_state_.assign(levels_ + 2, 0);
    stride_ = 1;
    zero_.assign(slots_, 0);
    for (std::size_t k = 0; k <= levels_; ++k) {
      first_state_[k] = states_.size();
      space_.list(zero_, upper_, k, states_);
      stride_ = (std::max)(stride_, states_.size() - first_state_[k]);
    }
    first_state_[levels_ + 1] = states_.size();
    state_index_.resize(states_.size());
    for (std::size_t i = 0; i < states_.size(); ++i)
      state_index_[i] = static_cast<std::uint32_t>(space_.index(states_[i]));
    numbers_.resize((levels_ + 1) * space_.indices());
    for (std::size_t k = 0; k <= levels_; ++k)
      for (std::size_t i = first_state_[k]; i < first_state_[k + 1]; ++i)
        numbers_[k * space_.indices() + space_.index(states_[i])] = static_cast<std::uint16_t>(i - first_state_[k]);
    more_.assign(states_.size() * slots_, count_space::none);
    for (std::size_t k = 0; k < levels_; ++k)
      for (std::size_t i = first_state_[k]; i < first_state_[k + 1]; ++i)
        for (std::size_t s = 0; s < slots_; ++s)
          if (space_.count(states_[i], s) < upper_[s])
            more_[i * slots_ + s] = static_cast<std::uint32_t>(space_.rank(states_[i] + space_.unit(s), k + 1));
  }
  /// The number of the counts with one agent more in s.
  [[nodiscard]] std::uint32_t more(std::size_t k, std::size_t number, std::size_t s) const {
    return more_[(first_state_[k] + number) * slots_ + s];
  }

  /// best ← the greatest over slots.
  void settle(std::size_t k) {
    float const* from = by(agents_ - k);
    float* const to = &best_[k * stride_];
    float all = impossible;
    for (std::size_t i = 0; i < space_.size(k); ++i, from += width_) {
      to[i] = *std::max_element(from, from + slots_);
      all = (std::max)(all, to[i]);
    }
    flat_[agents_ - k] = (std::min)(flat_[agents_ - k], static_cast<std::int32_t>(all));
  }

  // Enumeration. A column is a pair of slots x ≤ y: once with the last agent but one in x, once with it in y. Lanes hold
  // what is lost against the greatest entries; what is lost beyond the floors counts as the floor, which is more.
  void enumerate(pair_model const& model, stop_request const& stop) {
    std::size_t const n = agents_;
    std::size_t const levels = enumerated_;
    for (std::size_t k = 1; k <= levels; ++k) std::fill_n(by(n - k), space_.size(k) * width_, impossible);
    for (std::size_t x = 0; x < slots_; ++x)
      if (std::uint32_t const i = more(0, 0, x); i != count_space::none)
        by(n - 1)[i * width_ + x] = static_cast<float>(model.share(n - 1, x));
    settle(1);
    if (levels < 2) return;
    find_maxima(model, n - levels);
    low_.clear();
    high_.clear();
    for (std::size_t x = 0; x < slots_; ++x)
      for (std::size_t y = x; y < slots_; ++y) low_.push_back(x), high_.push_back(y);
    columns_ = (low_.size() + lane_block - 1) / lane_block * lane_block;
    sums_.assign((levels + 1) * 2 * columns_, 0);
    adds_.assign((levels + 1) * slots_ * 2 * columns_, 0);
    inner_.assign((levels + 1) * levels * slots_, 0);
    for (std::size_t c = 0; c < low_.size(); ++c) {
      std::size_t const x = low_[c];
      std::size_t const y = high_[c];
      sums_[c] = lost(last_pair(model, x, y) - last_pair_, column_floor);
      sums_[columns_ + c] = lost(last_pair(model, y, x) - last_pair_, column_floor);
      if (std::uint32_t const i = more(0, 0, x); i != count_space::none)
        if (std::uint32_t const j = more(1, i, y); j != count_space::none) {
          float* const to = by(n - 2) + j * width_;
          to[x] = (std::max)(to[x], static_cast<float>(last_pair(model, x, y)));
          to[y] = (std::max)(to[y], static_cast<float>(last_pair(model, y, x)));
        }
      for (std::size_t k = 3; k <= levels; ++k)
        for (std::size_t z = 0; z < slots_; ++z) {
          lane* const add = &adds_[(k * slots_ + z) * 2 * columns_ + c];
          std::int32_t const most = pair_most(n - k, n - 2) + pair_most(n - k, n - 1);
          add[0] = lost(model.pair(n - k, z, n - 2, x) + model.pair(n - k, z, n - 1, y) - most, add_floor);
          add[columns_] = lost(model.pair(n - k, z, n - 2, y) + model.pair(n - k, z, n - 1, x) - most, add_floor);
        }
    }
    settle(2);
    columns_kernel_ = choose_columns_kernel();
    std::int32_t most = last_pair_;
    for (std::size_t k = 3; k <= levels; ++k) {
      if (stop()) {
        levels_ = enumerated_ = k - 1;
        return;
      }
      std::size_t const d = n - k;
      for (std::size_t j = d + 1; j < n; ++j) most += pair_most(d, j);
      most += share_most_[d];
      std::size_t const prefixes = space_.size(k - 2);
      pairs_.assign(slots_ * prefixes * columns_, (std::numeric_limits<lane>::min)());
      for (std::size_t i = d; i + 2 < n; ++i)
        for (std::size_t x = 0; x < slots_; ++x) inner_[(i - d) * slots_ + x] = model.share(i, x) - share_most_[i];
      place_pairs(model, d, d, 0, 0, pairs_.data(), &sums_[0], &inner_[0]);
      for (std::size_t x = 0; x < slots_; ++x)
        for (std::size_t i = 0; i < prefixes; ++i)
          for (std::size_t c = 0; c < low_.size(); ++c) {
            lane const v = pairs_[(x * prefixes + i) * columns_ + c];
            std::uint32_t const one = more(k - 2, i, low_[c]);
            if (v == (std::numeric_limits<lane>::min)() || one == count_space::none) continue;
            std::uint32_t const two = more(k - 1, one, high_[c]);
            if (two == count_space::none) continue;
            float& to = by(d)[two * width_ + x];
            to = (std::max)(to, static_cast<float>(most + v * (1 << coarse_)));
          }
      settle(k);
    }
  }

  /// A loss in units of 2^coarse_ quanta, rounded up, or the floor.
  [[nodiscard]] lane lost(std::int32_t v, std::int32_t floor) const {
    return static_cast<lane>((std::max)(-(-v >> coarse_), floor));
  }
  [[nodiscard]] std::int32_t pair_most(std::size_t i, std::size_t j) const { return pair_most_[i * agents_ + j]; }
  [[nodiscard]] std::int32_t last_pair(pair_model const& model, std::size_t x, std::size_t y) const {
    return model.pair(agents_ - 2, x, agents_ - 1, y) + model.share(agents_ - 2, x) + model.share(agents_ - 1, y);
  }

  void find_maxima(pair_model const& model, std::size_t d) {
    pair_most_.resize(agents_ * agents_);
    share_most_.resize(agents_);
    for (std::size_t i = d; i < agents_; ++i) {
      share_most_[i] = *std::max_element(model.shares(i), model.shares(i) + slots_);
      for (std::size_t j = i + 1; j < agents_; ++j) {
        std::int32_t most = model.pair(i, 0, j, 0);
        for (std::size_t x = 0; x < slots_; ++x)
          for (std::size_t y = 0; y < slots_; ++y) most = (std::max)(most, model.pair(i, x, j, y));
        pair_most_[i * agents_ + j] = most;
      }
    }
    last_pair_ = last_pair(model, 0, 0);
    for (std::size_t x = 0; x < slots_; ++x)
      for (std::size_t y = 0; y < slots_; ++y) last_pair_ = (std::max)(last_pair_, last_pair(model, x, y));
    // Entries are 0 on average, so this is about what is lost by chance. It should stay above each floor.
    std::int32_t loss = last_pair_;
    for (std::size_t i = d; i + 2 < agents_; ++i) {
      loss += share_most_[i];
      for (std::size_t j = i + 1; j < agents_; ++j) loss += pair_most(i, j);
    }
    coarse_ = 0;
    while (loss >> coarse_ > -value_floor) ++coarse_;
  }

  /// Places the agents of ranks i… but the last two, which are added side by side. `to`: by the slot of rank `first`.
  void place_pairs(pair_model const& model, std::size_t first, std::size_t i, std::size_t number, std::int32_t value,
                   lane* to, lane* sums, std::int32_t* inner) {
    std::size_t const n = agents_;
    std::size_t const width = (n - 2 - i) * slots_;
    std::size_t const apart = i == first ? space_.size(n - first - 2) * columns_ : 0;
    lane const* const adds = &adds_[(n - i) * slots_ * 2 * columns_];
    if (i + 3 == n)
      return columns_kernel_({sums, adds, inner, &more_[(first_state_[i - first] + number) * slots_], to, apart,
                              columns_, slots_, value, value_floor, coarse_});
    for (std::size_t x = 0; x < slots_; ++x) {
      std::uint32_t const next = more(i - first, number, x);
      if (next == count_space::none) continue;
      lane const* const add = adds + x * 2 * columns_;
      lane* const below = sums + 2 * columns_;
      for (std::size_t c = 0; c < 2 * columns_; ++c)
        below[c] = (std::max)(static_cast<lane>(sums[c] + add[c]), column_floor);
      std::int32_t* const rest = inner + width;
      for (std::size_t j = i + 1; j + 2 < n; ++j)
        for (std::size_t y = 0; y < slots_; ++y)
          rest[(j - i - 1) * slots_ + y] = inner[(j - i) * slots_ + y] + model.pair(i, x, j, y) - pair_most(i, j);
      place_pairs(model, first, i + 1, next, value + inner[x], to + x * apart, below, rest);
    }
  }

  // Expansion: the ways to place the first agents of a suffix, side by side, `lanes_at_once` at a time.
  void expand(pair_model const& model, std::size_t d, std::size_t placed) {
    std::size_t const n = agents_;
    std::size_t const e = d + placed;
    std::size_t const ways = list_ways(placed);
    row_.assign(space_.size(n - d) * width_, impossible);
    gains_.resize((n - e) * slots_ * lanes_at_once);
    for (std::size_t first = 0; first < ways; first += lanes_at_once) {
      std::size_t const count = (std::min)(ways - first, lanes_at_once);
      std::int32_t const most = set_gains(model, d, e, first, count);
      transport(n - e);
      gather(n - d, n - e, placed, first, count, most, best(e));
    }
    float* const to = by(d);
    for (std::size_t i = 0; i < row_.size(); ++i) to[i] = (std::min)(to[i], row_[i]);
  }

  /// now_ ← what the placed have, gains_ ← what each other agent gets from them, in each way; both as losses.
  std::int32_t set_gains(pair_model const& model, std::size_t d, std::size_t e, std::size_t first, std::size_t count) {
    std::size_t const placed = e - d;
    std::int32_t most = (std::numeric_limits<std::int32_t>::min)();
    std::fill(gains_.begin(), gains_.end(), lane{0});
    worth_.resize(count);
    got_.resize(slots_);
    for (std::size_t l = 0; l < count; ++l) {
      slot const* const at = &ways_[(first + l) * placed];
      std::int32_t value = 0;
      for (std::size_t i = 0; i < placed; ++i) {
        value += model.share(d + i, at[i]);
        for (std::size_t j = i + 1; j < placed; ++j) value += model.pair(d + i, at[i], d + j, at[j]);
      }
      for (std::size_t j = e; j < agents_; ++j) {
        for (std::size_t y = 0; y < slots_; ++y) {
          got_[y] = 0;
          for (std::size_t i = 0; i < placed; ++i) got_[y] += model.pair(d + i, at[i], j, y);
        }
        std::int32_t const best = *std::max_element(got_.begin(), got_.end());
        for (std::size_t y = 0; y < slots_; ++y)
          gains_[((j - e) * slots_ + y) * lanes_at_once + l] =
              static_cast<lane>(std::max<std::int32_t>(got_[y] - best, transport_floor));
        value += best;
      }
      worth_[l] = value;
      most = (std::max)(most, value);
    }
    now_.assign(lanes_at_once, transport_floor);
    for (std::size_t l = 0; l < count; ++l)
      now_[l] = static_cast<lane>(std::max<std::int32_t>(worth_[l] - most, transport_floor));
    return most;
  }

  /// Lists the placements of that many agents, those with equal counts and an equal first slot together.
  std::size_t list_ways(std::size_t placed) {
    ways_.clear();
    fronts_.clear();
    order_.clear();
    std::size_t total = 1;
    for (std::size_t i = 0; i < placed; ++i) total *= slots_;
    for (std::size_t w = 0; w < total; ++w) {
      std::size_t number = 0;
      for (std::size_t i = 0, rest = w; i < placed && number != count_space::none; ++i, rest /= slots_)
        number = more(i, number, rest % slots_);
      if (number != count_space::none) order_.push_back((number * slots_ + w % slots_) * total + w);
    }
    std::sort(order_.begin(), order_.end());
    for (std::size_t const o : order_) {
      fronts_.push_back(states_[first_state_[placed] + o / total / slots_]);
      for (std::size_t i = 0, rest = o % total; i < placed; ++i, rest /= slots_)
        ways_.push_back(static_cast<slot>(rest % slots_));
    }
    return order_.size();
  }

  /// now_[c] ← the most that agents gain altogether with counts c, by lane; one agent more at a time.
  void transport(std::size_t agents) {
    transport_kernel const kernel = choose_transport_kernel();
    for (std::size_t k = 0; k < agents; ++k) {
      then_.assign(space_.size(k + 1) * lanes_at_once, transport_floor);
      kernel({now_.data(), &gains_[k * slots_ * lanes_at_once], then_.data(), &more_[first_state_[k] * slots_],
              space_.size(k), slots_, lanes_at_once});
      now_.swap(then_);
    }
  }

  void gather(std::size_t k, std::size_t left, std::size_t placed, std::size_t first, std::size_t count,
              std::int32_t most, float const* below) {
    std::uint16_t const* const numbers = numbers_.data() + left * space_.indices();
    for (std::size_t l = 0; l < count;) {
      // Ways with equal counts, by their first slot.
      packed_counts const front = fronts_[first + l];
      std::size_t const index = space_.index(front);
      std::size_t end = l + 1;
      while (end < count && fronts_[first + end] == front) ++end;
      for (std::size_t i = 0; i < space_.size(k); ++i) {
        std::size_t const state = first_state_[k] + i;
        if (!space_.below(front, states_[state])) continue;
        std::size_t const number = numbers[state_index_[state] - index];
        lane const* const now = &now_[number * lanes_at_once];
        float const rest = static_cast<float>(most) + below[number];
        for (std::size_t j = l; j < end;) {
          slot const at = ways_[(first + j) * placed];
          lane best = now[j];
          for (++j; j < end && ways_[(first + j) * placed] == at; ++j) best = (std::max)(best, now[j]);
          float& to = row_[i * width_ + at];
          to = (std::max)(to, rest + static_cast<float>(best));
        }
      }
      l = end;
    }
  }

  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::size_t levels_ = 0;
  std::size_t enumerated_ = 0;
  std::size_t stride_ = 1;  // the most states of a depth
  std::size_t width_ = 8;
  std::uint64_t work_ = 0;
  std::span<std::uint32_t const> upper_;
  count_space space_;
  buffer<packed_counts> states_;
  buffer<std::size_t> first_state_;  // [sum]
  buffer<std::uint32_t> more_;       // [state, slot]
  buffer<std::uint32_t> state_index_;
  buffer<std::uint16_t> numbers_;  // [sum, index]
  buffer<std::uint32_t> zero_;
  buffer<float> best_;  // [sum, number]
  buffer<float> by_;    // [sum, number, slot]
  buffer<std::int32_t> flat_;
  buffer<std::int32_t> step_;
  buffer<std::size_t> low_;
  buffer<std::size_t> high_;
  std::size_t columns_ = 0;
  std::int32_t last_pair_ = 0;
  unsigned coarse_ = 0;
  buffer<std::int32_t> pair_most_;   // [rank, rank]
  buffer<std::int32_t> share_most_;  // [rank]
  columns_kernel columns_kernel_ = nullptr;
  buffer<lane> sums_;  // [level][either, other][column]
  buffer<lane> adds_;  // [level][slot][either, other][column]
  buffer<std::int32_t> inner_;
  buffer<lane> pairs_;            // [first slot, number, column]
  buffer<slot> ways_;             // [way, placed]
  buffer<packed_counts> fronts_;  // [way]
  buffer<std::size_t> order_;
  buffer<lane> gains_;  // [agent, slot, lane]
  buffer<lane> now_;    // [state, lane]
  buffer<lane> then_;
  buffer<std::int32_t> worth_;
  buffer<std::int32_t> got_;
  buffer<float> row_;
};

}  // namespace rota::dense::detail
