#pragma once

#include <rota/search/detail/objective.hpp>
#include <rota/search/detail/pair_search.hpp>
#include <rota/search/detail/plan_memory.hpp>
#include <rota/search/detail/plan_outcome.hpp>
#include <rota/search/detail/plan_view.hpp>
#include <rota/search/detail/slot_bounds.hpp>
#include <rota/search/detail/tree_search.hpp>
#include <rota/search/detail/utility_matrix.hpp>
#include <rota/search/limits.hpp>

#include <optional>

namespace rota::detail {

/// The search for the best allocation of one plan: greatest U_p less change costs. It chooses the solvers.
///
/// First the flow solver, on what U_p says of agents one by one. It finds the optimum if that is all of U_p, or proves that
/// no allocation is valid; otherwise its prices bound what agents add one by one. Then the pairwise solver if U_p is a sum
/// over agents and pairs of agents; and branch and bound for everything else.
template <vocabulary V, class Beliefs>
class plan_search {
public:
  plan_search(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p, search_state& state, plan_memory& memory)
      : state_(state), memory_(memory), view_(problem, p, state.now), matrix_(view_, memory) {}

  plan_outcome<V> run(search_budget const& budget, search_work& done) {
    auto out = search(budget, done);
    out.ignored = matrix_.ignored() ? matrix_.ignored() : pairs_.fault ? pairs_.fault : rejected_.fault;
    return out;
  }

private:
  plan_outcome<V> search(search_budget const& budget, search_work& done) {
    memory_.up_to_date = false;
    if (auto const reason = write_bounds(view_, memory_)) return nothing_valid(*reason);
    if (auto const reason = matrix_.write()) return reason->proved() ? nothing_valid(*reason) : nothing_found(*reason);
    dense::instance in{
        view_.agents(), {memory_.keys.data(), memory_.keys.size()}, {memory_.bounds.data(), memory_.bounds.size()}};
    in.unique = memory_.ties.unique();
    auto const& alone = solve_alone(in, budget, done);
    if (!alone.found()) return nothing_valid(matrix_.blame().value_or(left_over(alone)));
    if (view_.coupled()) {
      in.utility = {memory_.units.data(), memory_.units.size()};
      pairs_ = write_pairs(view_, memory_);
    }
    objective<V, Beliefs> const worth(view_, memory_, matrix_.change_cost(), pairs_);
    if (view_.coupled()) {
      if (auto found = search_pairs(view_, memory_, state_.pairwise, worth, pairs_, budget, done))
        return *std::move(found);
    } else {
      auto const units = worth.in_units(alone.value);
      if (alone.proved() && !worth.changes_cost() && units < 0)
        return nothing_valid(negative_refusal<V>(view_.plan.id(), units));
      if (accepts(alone, worth, units))
        return worth.found(alone.assignment, units, worth.in_units(alone.bound), alone.proved());
    }
    return search_tree(view_, memory_, state_, in, alone, worth, rejected_, budget, done);
  }

  /// The flow optimum, from the memory if it still holds.
  dense::flow_outcome const& solve_alone(dense::instance const& in, search_budget const& budget, search_work& done) {
    auto& m = memory_;
    if (m.alone_holds) return m.alone;
    m.alone = m.flow.resolve(in, {m.changed.data(), m.changed.size()}, {budget.relaxations, budget.stop});
    m.seen = true;
    m.alone_holds = m.alone.proved();
    done += m.alone.work;
    return m.alone;
  }

  /// Why the flow problem has no solution: an agent or a task is left over.
  plan_refusal<V> left_over(dense::flow_outcome const& alone) const {
    auto r = refusal_of<V>(view_.plan.id(), no_plan_reason::pairs_contradict);
    if (alone.obstacle == dense::flow_obstacle::agent_stuck)
      r.agent = view_.problem.participants[alone.witness];
    else if (alone.witness < view_.idle())
      r.task = view_.plan.tasks()[alone.witness].task;
    return r;
  }

  /// Whether the flow optimum, worth so many units, is valid, where U_p is a sum over agents.
  bool accepts(dense::flow_outcome const& alone, objective<V, Beliefs> const& worth, std::int64_t units) {
    if (worth.is_the_sum()) return units >= 0;
    auto const a = worth(alone.assignment, alone.value);
    rejected_.note(a);
    return a.worth && worth.utility_of(alone.assignment, units) >= 0;
  }

  search_state& state_;
  plan_memory& memory_;
  plan_view<V, Beliefs> view_;
  utility_matrix<V, Beliefs> matrix_;
  pair_use<V> pairs_{};
  rejections<V> rejected_{};
};

}  // namespace rota::detail
