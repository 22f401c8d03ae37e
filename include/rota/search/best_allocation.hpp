#pragma once

#include <rota/search/plan_search.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rota {

/// The best valid allocation over all plans of the type, or why there is none.
///
/// Best: greatest U_p; among equals the least plan; among those the lexicographically smallest (agent → task), agents
/// and tasks ascending by id, idle last. So the answer depends on the problem only: not on listing order, history,
/// compiler or machine. Valid: by `validate`, where `running` is what the team executes already: a plan that
/// occurs there is not asked for its precondition if that is `precondition_scope::entry_only`.
/// A pair or total whose utility is no number makes the allocations that need it invalid; see `solution::ignored`.
///
/// Errors: one `plan_refusal` per plan. Additive utilities: n·max|u| is at most 2^39 (512 agents at
/// `max_utility`), otherwise `utility_refused`.
/// Complexity, n agents and t tasks, per plan: additive O(n·t + E·t·(t + n)), E ≤ n + t; otherwise tree search within `budget`, which
/// the plans share equally, what one leaves going to the next. Memory O(n·t + t²), in the workspace; nothing else is
/// allocated for up to 8 agents and 2 refused plans.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<solution<V>, no_allocation<V>> best_allocation(problem<V, Beliefs> const& problem, workspace& work,
                                                                    search_budget budget = {},
                                                                    allocation_view<V> running = {}) {
  solution<V> best;
  no_allocation<V> none;
  bool found = false;
  best.optimal = true;
  plan<V, Beliefs> const* winner = nullptr;
  auto const plans = problem.type.plans();
  auto runs = [&](plan<V, Beliefs> const& p) {
    return std::any_of(running.begin(), running.end(), [&](in<V> const& x) { return x.plan == p.id(); });
  };
  for (std::size_t i = 0; i < plans.size(); ++i) {
    auto const& p = plans[i];
    search_budget const share{(budget.nodes - best.work.nodes) / (plans.size() - i)};
    detail::plan_search<V, Beliefs> search(problem, p, runs(p), work);
    auto const outcome = search.run(share, best.work);
    if (!best.ignored) best.ignored = search.ignored();
    if (!outcome.utility) {
      best.optimal &= outcome.refusal.why != no_plan_reason::search_incomplete;
      if (!found) none.plans.push_back(outcome.refusal);
      continue;
    }
    best.optimal &= outcome.optimal;
    if (found && *outcome.utility <= best.exact) {
      double const utility = to_double(*outcome.utility);
      if (!best.runner_up || utility > best.runner_up->utility) best.runner_up = runner_up<V>{p.id(), utility};
      continue;
    }
    if (found) best.runner_up = runner_up<V>{best.plan, best.utility};
    found = true;
    winner = &p;
    best.plan = p.id();
    best.exact = *outcome.utility;
    best.utility = to_double(best.exact);
    work.best.assign(work.candidate.begin(), work.candidate.end());
  }
  if (!found) {
    none.work = best.work;
    return refused{std::move(none)};
  }
  for (std::size_t a = 0; a < problem.participants.size(); ++a)
    if (work.best[a] < winner->tasks().size())
      best.atoms.insert({problem.participants[a], winner->id(), winner->tasks()[work.best[a]].task});
  return best;
}

}  // namespace rota
