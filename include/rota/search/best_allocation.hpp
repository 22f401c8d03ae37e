#pragma once

#include <rota/search/plan_search.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace rota {

/// The best valid allocation over all plans of the type, or why there is none.
///
/// Best: greatest U_p less change costs; among equals the least plan; among those, as `dense::tie_rule` says, the
/// lexicographically smallest (agent → task), agents and tasks ascending by id, idle last; where a team is so large that
/// this would not fit into the numbers, the one that a fixed hash prefers. So the answer depends on the problem only: not on
/// listing order, history, compiler or machine. Valid: by `validate`, where the plans that occur in `problem::current` are
/// running.
/// A pair or total whose utility is no number makes the allocations that need it invalid; see `solution::ignored`.
///
/// If the budget runs out, the best valid allocation found, and by how much it may be worse than the optimum. A general
/// utility whose bound was seen to lie proves nothing either: `solution::lie`.
/// Errors: one `plan_refusal` per plan. For n agents and t tasks, n·max|u| is at most 2^40 and (t + 3)·max|u| at most 2^35,
/// otherwise `utilities_too_great`, change costs counted in |u|.
/// Complexity, per plan: additive O(n·t) calls, and O(t²) for each of at most n + t searches, fewer where little has changed
/// since the workspace saw the plan last; otherwise branch and bound within `budget`, which the plans share equally, what one
/// leaves going to the next. Memory O(n·t + t²), in the workspace; nothing else is allocated for up to 8 agents and 2
/// refused plans.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<solution<V>, no_allocation<V>> best_allocation(problem<V, Beliefs> const& problem, workspace& work,
                                                                    search_budget budget = {}) {
  solution<V> best;
  no_allocation<V> none;
  plan<V, Beliefs> const* winner = nullptr;
  std::int64_t bound = (std::numeric_limits<std::int64_t>::min)();
  auto const plans = problem.type.plans();
  if (work.plans.size() < plans.size()) work.plans.resize(plans.size());
  for (std::size_t i = 0; i < plans.size(); ++i) {
    auto const& p = plans[i];
    auto share = budget;
    share.nodes = (budget.nodes - (std::min)(budget.nodes, best.work.nodes)) / (plans.size() - i);
    detail::plan_search<V, Beliefs> search(problem, p, work, work.plans[i]);
    auto const outcome = search.run(share, best.work);
    if (!best.ignored) best.ignored = search.ignored();
    if (!best.lie) best.lie = search.lie();
    bound = (std::max)(bound, outcome.bound);
    if (!outcome.utility) {
      if (winner == nullptr) none.plans.push_back(outcome.refusal);
      continue;
    }
    auto const distance = [](std::int64_t more, std::int64_t less) { return to_double({more}) - to_double({less}); };
    if (winner != nullptr && outcome.objective <= best.objective.units) {
      auto const behind = distance(best.objective.units, outcome.objective);
      if (!best.runner_up || behind < best.runner_up->distance)
        best.runner_up = runner_up<V>{p.id(), to_double(*outcome.utility), behind};
      continue;
    }
    if (winner != nullptr)
      best.runner_up = runner_up<V>{best.plan, best.utility, distance(outcome.objective, best.objective.units)};
    winner = &p;
    best.objective = {outcome.objective};
    best.plan = p.id();
    best.exact = *outcome.utility;
    best.utility = to_double(best.exact);
    best.changes = outcome.changes;
    work.best.assign(work.candidate.begin(), work.candidate.end());
  }
  if (winner == nullptr) {
    none.work = best.work;
    none.ignored = best.ignored;
    none.lie = std::move(best.lie);
    return refused{std::move(none)};
  }
  best.optimal = bound <= best.objective.units;
  if (!best.optimal)
    best.gap = bound == dense::no_bound ? std::numeric_limits<double>::infinity()
                                        : to_double({bound}) - to_double(best.objective);
  small_vector<in<V>, 8> atoms;
  for (std::size_t a = 0; a < problem.participants.size(); ++a)
    if (work.best[a] < winner->tasks().size())
      atoms.push_back({problem.participants[a], winner->id(), winner->tasks()[work.best[a]].task});
  best.atoms = allocation_atoms<V>::from_ascending(std::move(atoms));
  return best;
}

}  // namespace rota
