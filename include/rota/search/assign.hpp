#pragma once
/// @file
/// Numbers in, assignment and proof out: for those who have a matrix and no plan.

#include <rota/allocation/problem.hpp>
#include <rota/core/finite.hpp>
#include <rota/core/result.hpp>
#include <rota/dense/flow/solver.hpp>
#include <rota/dense/ties.hpp>
#include <rota/model/cardinality.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace rota {

/// How `assign` reads its matrix.
struct assign_options {
  /// False: entries are utilities, the total is to be greatest, and an idle agent counts 0.
  /// True: entries are costs, written as they are and not negated. First as many agents as possible get a task; among these
  /// assignments the total cost is to be least. (With idle agents at 0, nobody would work for a cost.)
  bool minimise = false;
  idling idle = idling::allowed;
  std::optional<double> forbidden{};  ///< the entry that forbids a pair, such as NaN or infinity; unset: none does
};

/// An optimal assignment, with the proof that no other is better.
///
/// Canonical: of all optimal ones the one that `dense::tie_rule` prefers; in small questions the lexicographically smallest
/// vector of tasks, idle last. So it depends on the matrix and the bounds only.
struct assignment {
  static constexpr std::size_t idle = (std::numeric_limits<std::size_t>::max)();

  /// Prices for the tasks and, last, for being idle. They prove the assignment by weak duality, see `proven_bound`.
  struct certificate {
    std::vector<double> prices;
    std::vector<cardinality> bounds;  ///< as given, narrowed to what the number of agents implies
    double idle_counts = 0;           ///< what an idle agent counts: 0, or a cost that nobody pays who can have a task
    double step =
        1;  ///< entries count as multiples of this power of two, rounded where they are none; all sums are exact
    friend bool operator==(certificate const&, certificate const&) = default;
  };

  std::vector<std::size_t> tasks;  ///< the task of each agent, or `idle`
  double total = 0;                ///< of the entries of all agents that have a task
  certificate proof;

  friend bool operator==(assignment const&, assignment const&) = default;
};

/// Why there is no assignment.
enum class assign_fault : unsigned char {
  sizes_differ,  ///< the matrix does not have a whole number of rows with one entry per task
  empty_bounds,  ///< the bounds of `task` have min > max
  not_a_number,  ///< the entry of `agent` and `task` is NaN, and NaN is not the number that forbids
  infinite,      ///< likewise ±∞
  too_large,  ///< max(agents, tasks + 3)·|entry| is beyond 2^31, and fractions would be lost, or beyond 2^51: see the entry
              ///< of `agent` and `task`
  task_short,  ///< `task` cannot get as many agents as its bounds ask for, given the bounds of the others
  agent_stuck  ///< idling is forbidden, and `agent` finds no room in the tasks that it may have
};

/// Refusal: why there is no assignment, and where.
struct assign_refusal {
  assign_fault reason{};
  std::size_t agent = 0;
  std::size_t task = 0;

  friend bool operator==(assign_refusal const&, assign_refusal const&) = default;
};

/// The refusal in words, without its place: `result` prints it where a refused assignment is taken for an assignment.
[[nodiscard]] constexpr char const* reason_of(assign_refusal const& r) noexcept {
  switch (r.reason) {
  case assign_fault::sizes_differ: return "sizes_differ: the matrix does not have one entry per task in every row";
  case assign_fault::empty_bounds: return "empty_bounds: the bounds of a task admit no number of agents";
  case assign_fault::not_a_number: return "not_a_number: an entry is NaN";
  case assign_fault::infinite: return "infinite: an entry is infinite";
  case assign_fault::too_large: return "too_large: an entry is too large for exact sums";
  case assign_fault::task_short: return "task_short: a task cannot get as many agents as its bounds ask for";
  case assign_fault::agent_stuck: return "agent_stuck: an agent finds no room in a task, and idling is forbidden";
  }
  return "?";
}

namespace detail {

/// 2^e. @pre -1022 ≤ e ≤ 1023
[[nodiscard]] constexpr double power_of_two(int e) noexcept {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + e) << 52);
}
/// The least e with |x| < 2^e, or a little more for the tiniest numbers. @pre x is finite
[[nodiscard]] constexpr int magnitude_of(double const& x) noexcept {
  return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff) - 1022;
}
/// The greatest e such that x is a multiple of 2^e. @pre x is finite and not 0
[[nodiscard]] constexpr int grain_of(double const& x) noexcept {
  auto const bits = std::bit_cast<std::uint64_t>(x);
  auto const exponent = static_cast<int>(bits >> 52 & 0x7ff);
  auto const digits = (bits & ((std::uint64_t{1} << 52) - 1)) | std::uint64_t{exponent != 0} << 52;
  return (exponent != 0 ? exponent : 1) - 1075 + std::countr_zero(digits);
}
/// The nearest integer, halves away from zero. @pre |x| < 2^62
[[nodiscard]] constexpr std::int64_t nearest(double x) noexcept {
  auto const whole = static_cast<std::int64_t>(x);
  double const rest = x - static_cast<double>(whole);
  return whole + static_cast<int>(rest >= 0.5) - static_cast<int>(rest <= -0.5);
}

[[nodiscard]] constexpr bool forbids(assign_options const& options, double const& x) noexcept {
  if (!options.forbidden) return false;
  if (is_nan(x)) return is_nan(*options.forbidden);
  return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(*options.forbidden);
}

/// One call of `assign`: the matrix as integers, row per agent, idle last.
class assigner {
public:
  assigner(std::span<double const> matrix, std::span<cardinality const> bounds, assign_options const& options)
      : matrix_(matrix), bounds_(bounds), options_(options), tasks_(bounds.size()), slots_(tasks_ + 1) {}

  [[nodiscard]] result<assignment, assign_refusal> run() {
    if (auto const fault = read()) return refused{*fault};
    if (!write(magnitude_)) return refused{greatest_};
    auto const n = static_cast<std::uint32_t>(agents_);
    if (options_.idle == idling::forbidden) return solve({0, 0}, 0);
    if (!options_.minimise) return solve({0, n}, 0);
    // First force the least number of idle agents. If forbidden pairs rule that out, charge for idling.
    std::size_t room = 0;
    for (auto const& b : slot_bounds_) room += b.upper;
    auto const must = static_cast<std::uint32_t>(room < agents_ ? agents_ - room : 0);
    if (auto some = solve({must, must}, 0)) return some;
    if (!write(magnitude_ + static_cast<int>(std::bit_width(2 * agents_ + 1)))) return refused{greatest_};
    return solve({0, n}, -static_cast<std::int64_t>(2 * agents_ + 1) * most_ - 1);
  }

private:
  std::optional<assign_refusal> read() {
    if (tasks_ == 0 ? !matrix_.empty() : matrix_.size() % tasks_ != 0)
      return assign_refusal{assign_fault::sizes_differ};
    agents_ = tasks_ == 0 ? 0 : matrix_.size() / tasks_;
    greatest_ = {assign_fault::too_large, 0, 0};
    if (agents_ >= dense::no_slot || slots_ >= dense::no_slot) return greatest_;
    for (std::size_t k = 0; k < tasks_; ++k) {
      if (bounds_[k].is_empty()) return assign_refusal{assign_fault::empty_bounds, 0, k};
      auto const upper = (std::min<std::size_t>)(bounds_[k].upper(), agents_);
      slot_bounds_.push_back({bounds_[k].lower(), static_cast<std::uint32_t>(upper)});
    }
    for (std::size_t i = 0; i < matrix_.size(); ++i) {
      double const& x = matrix_[i];
      if (forbids(options_, x)) continue;
      assign_refusal const here{{}, i / tasks_, i % tasks_};
      if (is_nan(x)) return assign_refusal{assign_fault::not_a_number, here.agent, here.task};
      if (!is_finite(x)) return assign_refusal{assign_fault::infinite, here.agent, here.task};
      if (x < 0 || x > 0) grain_ = (std::min)(grain_, grain_of(x));
      if (magnitude_of(x) <= magnitude_) continue;
      magnitude_ = magnitude_of(x);
      greatest_.agent = here.agent;
      greatest_.task = here.task;
    }
    return std::nullopt;
  }

  /// Makes integers of the entries: exact ones where sums of numbers below 2^magnitude allow it, else rounded ones. Sums
  /// stay below 2^52 steps, so that they are exact as doubles too. False if fractions of 2^-20 would be lost.
  bool write(int magnitude) {
    int const finest = magnitude - 52 + static_cast<int>(std::bit_width((std::max)(agents_, slots_ + 2)));
    int e = (std::max)(grain_, -1022);
    if (e < finest || grain_ < -1022) {
      e = (std::max)({finest, (std::min)(-20, magnitude - 28), -1022});  // coarse enough to leave room for `tie_rule`
      if (e > -20) return false;
    }
    step_ = power_of_two(e);
    double const scale = power_of_two(-e);
    most_ = 0;
    utility_.assign(agents_ * slots_, dense::absent);
    for (std::size_t a = 0; a < agents_; ++a)
      for (std::size_t k = 0; k < tasks_; ++k) {
        double const& entry = matrix_[a * tasks_ + k];
        if (forbids(options_, entry)) continue;
        auto const units = nearest(options_.minimise ? -entry * scale : entry * scale);
        utility_[a * slots_ + k] = units;
        most_ = (std::max)(most_, units < 0 ? -units : units);
      }
    return true;
  }

  result<assignment, assign_refusal> solve(dense::slot_bounds idle, std::int64_t worth) {
    for (std::size_t a = 0; a < agents_; ++a) utility_[a * slots_ + tasks_] = idle.upper > 0 ? worth : dense::absent;
    slot_bounds_.resize(tasks_);  // without the idle slot of an attempt before
    slot_bounds_.push_back(idle);
    dense::tie_rule const ties(agents_, slots_, static_cast<std::uint64_t>((std::max)(most_, -worth)));
    std::vector<std::int64_t> keys(utility_.size());
    for (std::size_t a = 0; a < agents_; ++a) ties.keys(a, &utility_[a * slots_], &keys[a * slots_]);
    dense::flow_solver solver;
    auto const found = solver.solve({agents_, keys, slot_bounds_, {}, ties.unique()});
    if (!found.found())
      return refused{found.obstacle == dense::flow_obstacle::agent_stuck
                         ? assign_refusal{assign_fault::agent_stuck, found.witness, 0}
                         : assign_refusal{assign_fault::task_short, 0, found.witness}};
    assignment out;
    auto const number = [&](std::int64_t units) { return static_cast<double>(units) * step_; };
    std::int64_t total = 0;
    for (std::size_t a = 0; a < agents_; ++a) {
      auto const k = found.assignment[a];
      out.tasks.push_back(k < tasks_ ? k : assignment::idle);
      if (k < tasks_) total += utility_[a * slots_ + k];
    }
    out.total = number(options_.minimise ? -total : total);
    for (std::size_t k = 0; k < slots_; ++k)
      out.proof.bounds.emplace_back(solver.bounds(k).lower, solver.bounds(k).upper);
    for (auto const p : prices(solver, found.assignment, ties)) out.proof.prices.push_back(number(p));
    out.proof.idle_counts = number(-worth);
    out.proof.step = step_;
    return out;
  }

  /// Prices in steps, from the solver's prices of keys. Rounding these may leave a price a step off, where a preference
  /// decided; such prices are raised until nobody would gain by moving. O(n·s) a round, and mostly one round.
  std::vector<std::int64_t> prices(dense::flow_solver const& solver, std::span<dense::slot const> placed,
                                   dense::tie_rule const& ties) const {
    std::vector<std::int64_t> price(solver.prices().begin(), solver.prices().end());
    price.resize(slots_ + 1);  // the last: of no slot, which an optimum has at 0
    // Rounded down from behind the widest gap between their fractions, so that what is nearly equal stays equal.
    auto const unit = ties.key(1, 0, 0) - ties.key(0, 0, 0);
    std::vector<std::int64_t> fractions;
    for (auto const p : price) fractions.push_back(p & (unit - 1));
    std::sort(fractions.begin(), fractions.end());
    auto before = fractions.back();
    auto widest = fractions.front() + unit - before;
    for (std::size_t i = 1; i < fractions.size(); ++i)
      if (auto const gap = fractions[i] - fractions[i - 1]; gap > widest) widest = gap, before = fractions[i - 1];
    for (auto& p : price) p = ties.utility(p - before - 1);
    std::vector<std::uint32_t> count(slots_);
    for (auto const k : placed) ++count[k];
    bool again = true;
    auto const raise = [&](std::int64_t& p, std::int64_t to) {
      if (p < to) p = to, again = true;
    };
    while (again) {
      again = false;
      for (std::size_t a = 0; a < agents_; ++a) {
        auto const* const row = &utility_[a * slots_];
        auto const here = price[placed[a]] - row[placed[a]];
        for (std::size_t k = 0; k < slots_; ++k)
          if (row[k] != dense::absent) raise(price[k], row[k] + here);
      }
      for (std::size_t k = 0; k < slots_; ++k) {
        if (count[k] < solver.bounds(k).upper) raise(price[slots_], price[k]);
        if (count[k] > solver.bounds(k).lower) raise(price[k], price[slots_]);
      }
    }
    auto const zero = price.back();
    price.pop_back();
    for (auto& p : price) p -= zero;
    return price;
  }

  std::span<double const> matrix_;
  std::span<cardinality const> bounds_;
  assign_options const& options_;
  std::size_t tasks_;
  std::size_t slots_;
  std::size_t agents_ = 0;
  int magnitude_ = -1022;      // all entries are below 2^magnitude
  int grain_ = 0;              // and multiples of 2^grain
  assign_refusal greatest_{};  // where the greatest is
  double step_ = 1;
  std::int64_t most_ = 0;  // the greatest of them in steps
  std::vector<std::int64_t> utility_;
  std::vector<dense::slot_bounds> slot_bounds_;
};

}  // namespace detail

/// The best assignment of agents to tasks: each agent gets one task or none, each task as many agents as its bounds say.
///
/// @param matrix row per agent, entry per task
/// @param bounds of each task
/// Errors: see `assign_fault`.
/// Complexity: that of `dense::flow_solver`, with one slot per task and one for idling; twice that at most.
[[nodiscard]] inline result<assignment, assign_refusal>
assign(std::span<double const> matrix, std::span<cardinality const> bounds, assign_options const& options = {}) {
  return detail::assigner(matrix, bounds, options).run();
}
[[nodiscard]] inline result<assignment, assign_refusal>
assign(std::span<double const> matrix, std::initializer_list<cardinality> bounds, assign_options const& options = {}) {
  return assign(matrix, std::span(bounds.begin(), bounds.size()), options);
}

/// What the prices prove: no valid assignment of as few idle agents has a better total than this. An assignment whose total
/// is this number is optimal, whoever found it.
///
/// With w(a, k) the entry, negated when minimising, and w(a, idle) what an idle agent counts, negated likewise, every
/// assignment x within the bounds has by weak duality
///   Σ_a w(a, x_a) ≤ Σ_a max_k (w(a, k) − p_k) + Σ_k (p_k > 0 ? p_k·upper_k : p_k·lower_k).
/// @pre the matrix and the options that the assignment was made from. O(agents·tasks); exact while sums stay below 2^53 steps
[[nodiscard]] inline double proven_bound(std::span<double const> matrix, assignment const& x,
                                         assign_options const& options = {}) {
  auto const& [prices, bounds, idle_counts, step] = x.proof;
  std::size_t const tasks = bounds.size() - 1;
  double most = 0;
  std::size_t idle = 0;
  for (std::size_t a = 0; a < x.tasks.size(); ++a) {
    idle += x.tasks[a] == assignment::idle;
    std::optional<double> best;
    if (bounds[tasks].upper() > 0) best = -idle_counts - prices[tasks];
    for (std::size_t k = 0; k < tasks; ++k) {
      double const& entry = matrix[a * tasks + k];
      if (detail::forbids(options, entry)) continue;
      double const rounded = static_cast<double>(detail::nearest(entry / step)) * step;
      double const gain = (options.minimise ? -rounded : rounded) - prices[k];
      if (!best || gain > *best) best = gain;
    }
    most += best.value_or(0);
  }
  for (std::size_t k = 0; k <= tasks; ++k)
    most += prices[k] * static_cast<double>(prices[k] > 0 ? bounds[k].upper() : bounds[k].lower());
  return options.minimise ? -most - idle_counts * static_cast<double>(idle) : most;
}

}  // namespace rota
