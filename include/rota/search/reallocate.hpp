#pragma once

#include <rota/algebra/apply.hpp>
#include <rota/allocation/hysteresis.hpp>
#include <rota/search/best_allocation.hpp>
#include <rota/search/detail/standing.hpp>

#include <optional>
#include <utility>

namespace rota {

/// Why a reallocation ended as it did.
enum class reallocation_reason : unsigned char {
  first,                ///< nothing was running; the best allocation is adopted
  adopted_better,       ///< the best allocation beats the running one by more than the hysteresis
  current_invalid,      ///< the running allocation is not valid any more; the best one is adopted
  kept_optimal,         ///< the running allocation stays; proved: nothing is better
  kept_hysteresis,      ///< the running allocation stays; another is better, but not by more than the hysteresis
  kept_unproved,        ///< the running allocation stays; nothing better was found, but something better may exist
  no_valid_allocation,  ///< proved: no allocation is valid; the allocation becomes ∅
  search_incomplete     ///< the running allocation is not valid and no other was found, but one may exist; it becomes ∅
};

/// What to do now: `event` leads from the running allocation, `problem::current`, to `atoms`.
template <vocabulary V = runtime_vocabulary>
struct reallocation {
  rota::event<in<V>> event;
  allocation_atoms<V> atoms;
  std::optional<typename V::plan> plan{};  ///< of `atoms`; none if there is no valid allocation
  double utility = 0;                      ///< of `atoms`
  reallocation_reason reason{};
  std::optional<double> gain{};  ///< U(best) less change costs − U(running), if both are valid
  std::size_t changes = 0;       ///< how many participants do something else from now on
  bool proved = false;           ///< as `solution::proved`, of the best allocation found
  double gap = 0;                ///< proved: no valid allocation is better than the best one found by more than this
  search_work work{};
  std::optional<violation<V>> violated{};       ///< the first violation of the running allocation, if it is not valid
  small_vector<plan_refusal<V>, 2> refusals;    ///< if no valid allocation was found: why, one per plan
  std::optional<utility_refusal<V>> ignored{};  ///< as in `solution` or `no_allocation`
  std::optional<bound_lie<V>> lie{};            ///< likewise

  friend bool operator==(reallocation const&, reallocation const&) = default;
};

namespace detail {

/// As `reallocate` below, where `best` is what `best_allocation` found, and `now` the running allocation.
template <vocabulary V, class Beliefs>
[[nodiscard]] reallocation<V> reallocate(problem<V, Beliefs> const& problem, hysteresis h,
                                         result<solution<V>, no_allocation<V>> best, standing<V> now) {
  reallocation<V> next;
  auto running = allocation_atoms<V>::from_ascending({problem.current.begin(), problem.current.end()});
  next.proved = best ? best->proved : best.error().proved();
  next.gap = best ? best->gap : 0;
  next.work = best ? best->work : best.error().work;
  next.ignored = best ? best->ignored : best.error().ignored;
  next.lie = best ? std::move(best->lie) : best.error().lie;
  next.violated = std::move(now.violated);
  if (!best) next.refusals = best.error().plans;
  if (now.valid && best) next.gain = to_double({best->objective.units - now.utility.units});

  bool const stays =
      now.valid && (!best || !beats(best->objective, now.utility, margin_of(h, now.hysteresis, now.utility)));
  if (stays) {
    next.atoms = std::move(running);
    next.plan = now.plan;
    next.utility = to_double(now.utility);
    next.reason = best && best->exact > now.utility ? reallocation_reason::kept_hysteresis
                  : next.proved                     ? reallocation_reason::kept_optimal
                                                    : reallocation_reason::kept_unproved;
    return next;
  }
  if (best) {
    next.atoms = std::move(best->atoms);
    next.plan = best->plan;
    next.utility = best->utility;
    next.changes = best->changes;
    next.reason = running.empty() ? reallocation_reason::first
                  : now.valid     ? reallocation_reason::adopted_better
                                  : reallocation_reason::current_invalid;
  } else {
    next.reason = next.proved ? reallocation_reason::no_valid_allocation : reallocation_reason::search_incomplete;
  }
  next.event = difference(running, next.atoms);
  return next;
}

}  // namespace detail

/// As `reallocate` below, where `best` is what `best_allocation` found for the same problem.
template <vocabulary V, class Beliefs>
[[nodiscard]] reallocation<V> reallocate(problem<V, Beliefs> const& problem, hysteresis h,
                                         result<solution<V>, no_allocation<V>> best) {
  return detail::reallocate(problem, h, std::move(best), detail::standing_of(problem));
}

/// Decides whether the running allocation, `problem::current`, stays, and if not, which one follows it. Reads one's own
/// beliefs only.
///
/// It stays iff it is valid and no valid allocation beats it by more than h (see `hysteresis`), change costs deducted; so
/// of equally good allocations the running one stays. With `problem::current` = ∅ nothing runs: ∅ counts as the best plan
/// for which it is valid, preconditions are asked as on entry, and the plan's own hysteresis is 0. Otherwise every plan
/// that occurs there is running, and `precondition_scope::entry_only` preconditions are not asked of it.
/// Where no allocation is valid the team has none: the event subtracts every atom. (Each atom would claim a validity that
/// the robot does not believe in.) The next call with a satisfiable problem starts as `first`.
///
/// Laws: event = difference(current, atoms), so it is applicable to the running allocation. Calling again with `atoms` as
/// the running allocation and unchanged beliefs gives the empty event, unless `atoms` entered a plan whose precondition is
/// `entry_only`: that one may move on to an allocation that could not have been entered.
/// Complexity: that of `best_allocation`, and one evaluation of the running allocation, unless U_p is a sum over agents: then
/// the search has asked for all its terms.
template <vocabulary V, class Beliefs>
[[nodiscard]] reallocation<V> reallocate(problem<V, Beliefs> const& problem, hysteresis h, workspace& work,
                                         search_budget budget = {}) {
  auto best = best_allocation(problem, work, budget);
  auto now = detail::standing_of(problem, detail::workspace_access::open(work));
  return detail::reallocate(problem, h, std::move(best), std::move(now));
}

}  // namespace rota
