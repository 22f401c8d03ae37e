#pragma once

#include <rota/allocation/guarded.hpp>
#include <rota/search/detail/plan_memory.hpp>
#include <rota/search/detail/plan_outcome.hpp>
#include <rota/search/detail/plan_view.hpp>
#include <rota/search/detail/ratings.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace rota::detail {

/// What a complete assignment is worth to a search, or why it is not valid.
template <vocabulary V>
struct appraisal {
  std::optional<std::int64_t> worth{};  ///< none if the assignment is not valid: for a reason below, or for Pre(p)
  std::optional<utility_refusal<V>> fault{};       ///< U_p is not defined
  std::optional<std::int64_t> negative_utility{};  ///< U_p in units, if below 0
  bool precondition_threw = false;
};

/// Who knows what U_p says of two agents at a time.
template <vocabulary V>
struct pair_use {
  bool in_tables = false;                     ///< `plan_memory::pairs` does; otherwise U_p is asked
  std::optional<utility_refusal<V>> fault{};  ///< the first combination that is no utility, which the tables forbid
};

/// What assignments of one plan are worth: U_p less change costs.
///
/// A search counts in the numbers that it is given: in keys where U_p is a sum over agents, in units otherwise. It knows the
/// sum over agents; this adds what the other parts of U_p say, and asks Pre(p).
template <vocabulary V, class Beliefs>
class objective {
public:
  objective(plan_view<V, Beliefs>& view, plan_memory const& memory, std::int64_t change_cost, pair_use<V> pairs)
      : view_(view), memory_(memory), change_cost_(change_cost), pairs_(std::move(pairs)) {}

  /// Whether an assignment is worth its sum, and valid unless that is negative.
  [[nodiscard]] bool is_the_sum() const noexcept {
    return !view_.coupled() && !view_.conditional() && change_cost_ == 0;
  }

  /// `sum`: of the numbers of the search. If changes cost nothing, a negative utility is left to the caller: the best is
  /// negative only if all are.
  [[nodiscard]] appraisal<V> operator()(std::span<dense::slot const> assignment, std::int64_t sum) const {
    appraisal<V> a;
    if (is_the_sum()) {
      a.worth = sum;
      return a;
    }
    auto const atoms = view_.atoms(assignment);
    if (view_.conditional()) {
      auto const holds = guarded([&] { return view_.plan.precondition()(view_.problem.beliefs, atoms); });
      a.precondition_threw = !holds;
      if (!holds || !*holds) return a;
    }
    fixed_utility total{sum};
    if (view_.coupled()) add_others(total, assignment, atoms, a.fault);
    if (a.fault) return a;
    auto const utility = utility_of(assignment, in_units(total.units));
    if (utility > most_total_units || utility < -most_total_units) {
      a.fault = utility_refusal<V>{utility_fault::out_of_range, {}, {}};
    } else if (utility < 0 && change_cost_ != 0) {
      a.negative_utility = utility;
    } else {
      a.worth = total.units;
    }
    return a;
  }

  /// A worth, or a bound on one, in units.
  [[nodiscard]] std::int64_t in_units(std::int64_t worth) const noexcept {
    return view_.coupled() || worth == dense::no_bound ? worth : memory_.ties.utility(worth);
  }
  /// U_p of an assignment in units, from what it is worth in units.
  [[nodiscard]] std::int64_t utility_of(std::span<dense::slot const> assignment, std::int64_t units) const {
    if (change_cost_ == 0) return units;
    return units + change_cost_ * static_cast<std::int64_t>(view_.changes(assignment));
  }
  [[nodiscard]] bool changes_cost() const noexcept { return change_cost_ != 0; }
  [[nodiscard]] bool pairs_in_tables() const noexcept { return pairs_.in_tables; }

  /// An outcome: this assignment, worth so many units. @pre it is valid
  [[nodiscard]] plan_outcome<V> found(std::span<dense::slot const> assignment, std::int64_t units, std::int64_t bound,
                                      bool proved) const {
    plan_outcome<V> out;
    out.assignment = assignment;
    out.objective = units;
    out.bound = bound;
    out.proved = proved;
    out.changes = view_.changes(assignment);
    out.utility = fixed_utility{utility_of(assignment, units)};
    return out;
  }

private:
  /// total ← total + what U_p says beyond single agents; or `fault` ← why that is not defined.
  void add_others(fixed_utility& total, std::span<dense::slot const> assignment, allocation_view<V> atoms,
                  std::optional<utility_refusal<V>>& fault) const {
    if (pairs_.in_tables) {
      auto const together = memory_.pairs.value(assignment);
      if (!together || !checked_add(total, {*together})) {
        fault = pairs_.fault ? pairs_.fault : utility_refusal<V>{utility_fault::out_of_range, {}, {}};
        return;
      }
    }
    add_coupled<V, Beliefs>(view_.problem, view_.plan, atoms, !pairs_.in_tables, total, fault);
  }

  plan_view<V, Beliefs>& view_;
  plan_memory const& memory_;
  std::int64_t change_cost_;
  pair_use<V> pairs_;
};

}  // namespace rota::detail
