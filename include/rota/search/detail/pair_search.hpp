#pragma once

#include <rota/search/detail/objective.hpp>
#include <rota/search/detail/plan_memory.hpp>
#include <rota/search/detail/plan_outcome.hpp>
#include <rota/search/detail/plan_view.hpp>
#include <rota/search/detail/ratings.hpp>
#include <rota/search/limits.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace rota::detail {

/// Writes what U_p says of two agents at a time into tables. A combination that is no utility is forbidden there. The tables
/// stay unused if they would be too large or their numbers too great. @pre the utility matrix is written
template <vocabulary V, class Beliefs>
[[nodiscard]] pair_use<V> write_pairs(plan_view<V, Beliefs> const& view, plan_memory& memory) {
  pair_use<V> use;
  std::size_t const n = view.agents();
  std::size_t const slot_count = view.slot_count();
  if (!view.pairwise() || !pair_tables::suit(n, slot_count)) return use;
  auto const possible = [&](std::size_t a, std::size_t s) { return memory.units[a * slot_count + s] != dense::absent; };
  auto const worth = [&](std::size_t i, std::size_t x, std::size_t j, std::size_t y) -> std::int64_t {
    if (!possible(i, x) || !possible(j, y)) return 0;
    auto const one = view.atom(i, x);
    auto const other = view.atom(j, y);
    auto const units = rate<V, Beliefs>(view.problem, view.plan, one, other);
    if (units) return units.value().units;
    if (!use.fault) use.fault = utility_refusal<V>{units.error(), one, other};
    return dense::absent;
  };
  memory.pairs.resize(n, slot_count);
  bool changed = false;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t x = 0; x + 1 < slot_count; ++x)
        for (std::size_t y = 0; y + 1 < slot_count; ++y) changed |= memory.pairs.put(i, x, j, y, worth(i, x, j, y));
  if (changed) memory.together_holds = false;
  use.in_tables = memory.together_holds || memory.pairs.finish({memory.units.data(), memory.units.size()});
  return use;
}

/// Solves a plan whose U_p is a sum over agents and pairs of agents.
/// @return nothing where branch and bound has to do it
template <vocabulary V, class Beliefs>
[[nodiscard]] std::optional<plan_outcome<V>> search_pairs(plan_view<V, Beliefs> const& view, plan_memory& memory,
                                                          dense::pair_solver& solver,
                                                          objective<V, Beliefs> const& worth, pair_use<V> const& pairs,
                                                          search_budget const& budget, search_work& done) {
  auto& m = memory;
  std::span<std::int64_t const> const units{m.units.data(), m.units.size()};
  if (!pairs.in_tables || view.general() || view.conditional() || !m.pairs.within_range(units)) return std::nullopt;
  if (!m.together_holds) {
    m.together = solver.solve({view.agents(), units, m.pairs.couplings(), {m.bounds.data(), m.bounds.size()}},
                              {budget.nodes, budget.stop});
    m.placed.assign(m.together.assignment.begin(), m.together.assignment.end());
    m.together.assignment = {m.placed.data(), m.placed.size()};  // the solver serves other plans, too
    m.together_holds = m.together.proved();
    done += m.together.work;
  }
  auto const& best = m.together;
  auto const id = view.plan.id();
  if (best.found() && worth.utility_of(best.assignment, best.value) >= 0)
    return worth.found(best.assignment, best.value, best.bound, best.proved());
  if (best.status == dense::status::infeasible)
    return nothing_valid(pairs.fault ? refusal_of<V>(id, *pairs.fault)
                                     : refusal_of<V>(id, no_plan_reason::pairs_contradict));
  if (!worth.changes_cost() && best.bound < 0) return nothing_valid(negative_refusal<V>(id, best.bound));
  if (best.proved())
    return std::nullopt;  // the best is worth less than 0, but another may be worth more without its costs
  return nothing_found(refusal_of<V>(id, no_plan_reason::search_incomplete), best.bound);
}

}  // namespace rota::detail
