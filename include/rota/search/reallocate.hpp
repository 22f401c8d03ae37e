#pragma once

#include <rota/algebra/apply.hpp>
#include <rota/allocation/hysteresis.hpp>
#include <rota/allocation/validate.hpp>
#include <rota/search/best_allocation.hpp>

#include <optional>

namespace rota {

/// Why a reallocation ended as it did.
enum class reallocation_reason : unsigned char {
  first,                ///< there was no allocation (C = ∅); the best is adopted
  adopted_better,       ///< the best beats the current one by more than the margin
  current_invalid,      ///< the current one is not valid (any more); the best is adopted
  kept_optimal,         ///< nothing is better than the current one, proved
  kept_hysteresis,      ///< something is better, by no more than the margin and what the changes cost
  kept_unproved,        ///< nothing found beats the current one, but not all was searched: see `solution::optimal`
  no_valid_allocation,  ///< proved; the allocation becomes ∅
  search_incomplete     ///< the current one is not valid, and none was found, but not all was searched; becomes ∅
};

/// What to do now: `event` leads from the current allocation to `atoms`.
template <vocabulary V = runtime_vocabulary>
struct reallocation {
  rota::event<in<V>> event;
  allocation_atoms<V> atoms;
  std::optional<typename V::plan> plan{};  ///< of `atoms`; none if there is no valid allocation
  double utility = 0;                      ///< of `atoms`
  reallocation_reason reason{};
  std::optional<double> gain{};  ///< U(best) less change costs − U(current), if both are valid
  std::size_t changes = 0;       ///< participants who do something else from now on
  bool optimal = false;          ///< no valid allocation is better than the best one found
  double gap = 0;                ///< no valid allocation is better than the best one found by more than this
  search_work work{};
  std::optional<utility_refusal<V>> ignored{};  ///< see `solution`; of all plans if there is no valid allocation
  std::optional<bound_lie<V>> lie{};            ///< likewise

  friend bool operator==(reallocation const&, reallocation const&) = default;
};

namespace detail {

/// A valid current allocation: its plan and utility.
template <vocabulary V>
struct standing {
  typename V::plan plan{};
  fixed_utility utility{};
  double hysteresis = 0;
};

/// What C is worth if it is valid for p; without a report.
template <vocabulary V, class Beliefs>
[[nodiscard]] std::optional<fixed_utility> worth(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p,
                                                 allocation_atoms<V> const& atoms, plan_phase phase) {
  bool valid = true;
  auto const value = judge(problem, p, atoms.atoms(), phase, [&](violation<V> const&) { valid = false; });
  return valid ? value : std::nullopt;
}

template <vocabulary V, class Beliefs>
[[nodiscard]] std::optional<standing<V>> standing_of(problem<V, Beliefs> const& problem,
                                                     allocation_atoms<V> const& current) {
  if (!current.empty()) {
    auto const* p = problem.type.find(current.begin()->plan);
    if (p == nullptr) return std::nullopt;
    auto const value = worth(problem, *p, current, plan_phase::running);
    if (!value) return std::nullopt;
    return standing<V>{p->id(), *value, p->hysteresis()};
  }
  std::optional<standing<V>> best;
  for (plan<V, Beliefs> const& p : problem.type.plans()) {
    auto const value = worth(problem, p, current, plan_phase::entering);
    if (value && (!best || *value > best->utility)) best = standing<V>{p.id(), *value, 0};
  }
  return best;
}

}  // namespace detail

/// As `reallocate` below, where the best is known: what `best_allocation` found with `current` as `problem::current`.
template <vocabulary V, class Beliefs>
[[nodiscard]] reallocation<V> reallocate(problem<V, Beliefs> const& problem, allocation_atoms<V> const& current,
                                         hysteresis h, result<solution<V>, no_allocation<V>> best) {
  reallocation<V> next;
  auto here = problem;
  here.current = current.atoms();
  auto const now = detail::standing_of(here, current);
  next.optimal = best ? best->optimal : best.error().proved();
  next.gap = best ? best->gap : 0;
  next.work = best ? best->work : best.error().work;
  next.ignored = best ? best->ignored : best.error().ignored;
  next.lie = best ? std::move(best->lie) : best.error().lie;
  if (now && best) next.gain = to_double({best->objective.units - now->utility.units});

  if (now &&
      (!best || !detail::beats(best->objective, now->utility, detail::margin_of(h, now->hysteresis, now->utility)))) {
    next.atoms = current;
    next.plan = now->plan;
    next.utility = to_double(now->utility);
    next.reason = best && best->exact > now->utility ? reallocation_reason::kept_hysteresis
                  : next.optimal                     ? reallocation_reason::kept_optimal
                                                     : reallocation_reason::kept_unproved;
    return next;
  }
  if (best) {
    next.atoms = std::move(best->atoms);
    next.plan = best->plan;
    next.utility = best->utility;
    next.changes = best->changes;
    next.reason = current.empty() ? reallocation_reason::first
                  : now           ? reallocation_reason::adopted_better
                                  : reallocation_reason::current_invalid;
  } else {
    next.reason = next.optimal ? reallocation_reason::no_valid_allocation : reallocation_reason::search_incomplete;
  }
  next.event = difference(current, next.atoms);
  return next;
}

/// Decides whether to keep the current allocation, and if not, which one to adopt; under one's own beliefs only.
///
/// What is best is judged with `current` in the place of `problem::current`: less `problem::change_cost` for each participant
/// that would do something else, and with a bonus for staying where U_p has a part `similarity`. The current one is kept
/// iff it is valid and nothing beats it by more than h (see `hysteresis`); among equals nothing changes. C = ∅ names no
/// plan, so none is running: it counts as the best plan for which it is valid, preconditions are asked as on entry, and the
/// plan's own hysteresis is 0. Otherwise every plan that occurs in C is running, and `precondition_scope::entry_only` is not
/// asked of it.
/// Where no valid allocation exists the team has none: the event subtracts every atom. That is honest (each atom would
/// claim a validity the agent does not believe in), and the next call with a satisfiable problem starts as `first`.
///
/// Laws: event = difference(current, atoms), so it is applicable at `current`. Calling again with `atoms` and unchanged
/// beliefs gives the empty event, unless `atoms` entered a plan whose precondition is `entry_only`: then it may move on to
/// an allocation that could not have been entered.
/// Complexity: `best_allocation`, and one evaluation of the current allocation.
template <vocabulary V, class Beliefs>
[[nodiscard]] reallocation<V> reallocate(problem<V, Beliefs> const& problem, allocation_atoms<V> const& current,
                                         hysteresis h, workspace& work, search_budget budget = {}) {
  auto here = problem;
  here.current = current.atoms();
  return reallocate(here, current, h, best_allocation(here, work, budget));
}

}  // namespace rota
