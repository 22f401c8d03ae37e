#pragma once

#include <rota/search/detail/best_so_far.hpp>
#include <rota/search/detail/plan_search.hpp>
#include <rota/search/workspace.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rota {

/// The best valid allocation over all plans of the type, or why there is none.
///
/// Best: the greatest U_p less change costs. Among equals the least plan; among those, as `dense::tie_rule` says, the
/// lexicographically smallest (agent → task), agents and tasks ascending by id, idle last. A team may be so large that this
/// order does not fit into the numbers; then a fixed hash prefers one. So the answer depends on the problem only: not on
/// listing order, history, compiler or machine. Valid: as `validate` judges, where the plans that occur in
/// `problem::current` are running.
/// If the utility of a pair or the total is no number, the allocations that need it are invalid; see `solution::ignored`.
///
/// If the budget runs out, the best valid allocation found and how much better the optimum may be. A general utility whose
/// bound was seen to lie proves nothing either: `solution::lie`.
/// Errors: one `plan_refusal` per plan. For n agents and t tasks, n·max|u| is at most 2^40 and (t + 3)·max|u| at most 2^35,
/// otherwise `utilities_too_great`, change costs counted in |u|.
/// Complexity, per plan: additive O(n·t) calls, and O(t²) for each of at most n + t searches, fewer where little has changed
/// since the workspace saw the plan last; otherwise branch and bound within `budget`, which the plans share equally; nodes
/// that one plan does not use go to the next. Memory O(n·t + t²), in the workspace; nothing else is allocated for up to 8
/// agents and 2 refused plans.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<solution<V>, no_allocation<V>> best_allocation(problem<V, Beliefs> const& problem, workspace& work,
                                                                    search_budget budget = {}) {
  auto& state = detail::workspace_access::open(work);
  detail::best_so_far<V> best(state.best);
  search_work done;
  auto const plans = problem.type.plans();
  for (std::size_t i = 0; i < plans.size(); ++i) {
    auto share = budget;
    share.nodes = (budget.nodes - (std::min)(budget.nodes, done.nodes)) / (plans.size() - i);
    detail::plan_search<V, Beliefs> search(problem, plans[i], state, state.of_plan(i));
    best.offer(plans[i].id(), search.run(share, done));
  }
  return std::move(best).conclude(problem, done);
}

}  // namespace rota
