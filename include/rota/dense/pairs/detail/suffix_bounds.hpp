#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/limits.hpp>
#include <rota/dense/pairs/detail/count_states.hpp>
#include <rota/dense/pairs/detail/model.hpp>
#include <rota/dense/pairs/detail/suffix_enumeration.hpp>
#include <rota/dense/pairs/detail/suffix_expansion.hpp>
#include <rota/dense/pairs/detail/suffix_table.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace rota::dense::detail {

/// For how many agents at the end suffixes are bounded by counts.
struct suffix_plan {
  std::size_t enumerated = 0;
  std::size_t expanded = 0;  ///< so many agents more

  /// About half of the agents are enumerated: beyond that, one more costs more than it saves. At most `steps` steps.
  static suffix_plan fitting(std::size_t agents, std::size_t slot_count, std::uint64_t steps) {
    suffix_plan plan{1, agents < 10 ? 0 : agents / 5 - 1};
    std::uint64_t work = 0;
    std::uint64_t ways = 1;
    for (std::size_t k = 2; 2 * k <= agents && work + ways <= (std::min)(steps, most_work); ++k) {
      plan.enumerated = k;
      work += ways;
      ways *= slot_count;
    }
    return plan;
  }
  static constexpr std::uint64_t most_work = 500000;
};

/// What the agents from some rank d on are worth among themselves at most, by how many of them each slot takes.
///
///   best(d)[c] ≥ Σ_{i≥d} share_i(x_i) + Σ_{d≤i<j} v_ij(x_i, x_j)   for every assignment x of these agents with counts c
///
/// in quanta; by_slot(d) is the same with agent d in a given slot. A node of the search has placed the agents before d. This
/// bound, and a bound on the gains of the others from those placed, together bound its subtree: see `price_table`.
///
/// The shortest suffixes are bounded by trying every assignment (`suffix_enumeration`), longer ones by placing a few agents
/// and taking the rest from the shorter suffix (`suffix_expansion`); each gives its reason. The suffixes longer than
/// that have one bound each, whatever the counts: every term at its greatest, which bounds because terms are only added.
/// Time O(m^enumerated), and O(m^4·states) per agent more.
class suffix_bounds {
public:
  /// Where stop() says so, for fewer agents than planned.
  void prepare(pair_model const& model, std::span<std::uint32_t const> upper, suffix_plan plan,
               stop_request const& stop) {
    agents_ = model.agents();
    longest_ = 0;
    work_ = 0;
    states_.clear();
    find_greatest(model);
    if (agents_ < 3 || plan.enumerated == 0 || stop()) return;
    std::size_t enumerated = (std::min)(plan.enumerated, agents_ - 1);
    states_.prepare(upper, agents_, (std::min)(enumerated + plan.expanded, agents_ - 1));
    if (states_.longest() == 0) return;
    table_.prepare(states_, model.slot_count());
    enumerated = (std::min)(enumerated, states_.longest());
    longest_ = enumeration_.fill(model, states_, table_, enumerated, stop);
    for (std::size_t k = 2, ways = 1; k <= longest_; ++k, ways *= model.slot_count()) work_ += ways;
    if (longest_ == enumerated) expand(model, stop);
    lower_greatest();
  }

  /// Whether the suffix from d on is bounded by counts.
  [[nodiscard]] bool counted(std::size_t d) const { return longest_ != 0 && agents_ - d <= longest_; }
  /// [state] @pre counted(d)
  [[nodiscard]] float const* best(std::size_t d) const { return table_.best(agents_ - d); }
  /// [state·width + slot of the agent of rank d] @pre counted(d)
  [[nodiscard]] float const* by_slot(std::size_t d) const { return table_.by_slot(agents_ - d); }
  [[nodiscard]] std::size_t width() const { return table_.width(); }
  /// Whatever the counts.
  [[nodiscard]] std::int32_t greatest(std::size_t d) const { return greatest_[d]; }

  [[nodiscard]] count_space const& space() const { return states_.space(); }
  /// The numbers of the states of k agents, by their index.
  [[nodiscard]] std::uint16_t const* numbers(std::size_t k) const { return states_.number_by_index(k); }
  /// How many states there are, over all depths.
  [[nodiscard]] std::size_t states() const { return states_.total(); }
  /// Steps of the enumeration.
  [[nodiscard]] std::uint64_t work() const { return work_; }

private:
  /// The suffixes longer than those enumerated, as far as states are listed.
  void expand(pair_model const& model, stop_request const& stop) {
    std::size_t const enumerated = longest_;
    expansion_.prepare(model, states_, table_);
    for (std::size_t k = enumerated + 1; k <= states_.longest(); ++k) {
      if (stop()) return;
      table_.fill(k, states_, -suffix_table::impossible);
      std::size_t const most_placed = (std::min)(k - enumerated, suffix_expansion::most_placed);
      for (std::size_t placed = 1; placed <= most_placed; ++placed) {
        if (placed > 1 && (!suffix_expansion::affordable(states_, model.slot_count(), k, placed) || stop())) break;
        expansion_.lower(k, placed);
      }
      table_.close(k, states_);
      longest_ = k;
    }
  }

  /// greatest_[d] ← every term from d on at its greatest.
  void find_greatest(pair_model const& model) {
    std::size_t const slot_count = model.slot_count();
    greatest_.assign(agents_ + 1, 0);
    greatest_of_one_.resize(agents_);
    for (std::size_t d = agents_; d-- > 0;) {
      std::int32_t greatest = (std::numeric_limits<std::int32_t>::min)() / 2;
      for (std::size_t x = 0; x < slot_count; ++x) {
        std::int32_t sum = model.share(d, x);
        for (std::size_t j = d + 1; j < agents_; ++j) {
          std::int32_t pair = model.pair(d, x, j, 0);
          for (std::size_t y = 1; y < slot_count; ++y) pair = (std::max)(pair, model.pair(d, x, j, y));
          sum += pair;
        }
        greatest = (std::max)(greatest, sum);
      }
      greatest_of_one_[d] = greatest;
      greatest_[d] = greatest_[d + 1] + greatest;
    }
  }

  /// Uses the bounds by counts, which are closer, for these suffixes and for the longer ones.
  void lower_greatest() {
    for (std::size_t k = 1; k <= longest_; ++k)
      greatest_[agents_ - k] =
          (std::min)(greatest_[agents_ - k], static_cast<std::int32_t>(table_.greatest(k, states_)));
    for (std::size_t d = agents_ - longest_; d-- > 0;)
      greatest_[d] = (std::min)(greatest_[d], greatest_[d + 1] + greatest_of_one_[d]);
  }

  std::size_t agents_ = 0;
  std::size_t longest_ = 0;  // suffix that is bounded by counts
  std::uint64_t work_ = 0;
  count_states states_;
  suffix_table table_;
  suffix_enumeration enumeration_;
  suffix_expansion expansion_;
  buffer<std::int32_t> greatest_;         // [rank]
  buffer<std::int32_t> greatest_of_one_;  // [rank]: of its own terms
};

}  // namespace rota::dense::detail
