#pragma once

#include <rota/allocation/guarded.hpp>
#include <rota/search/detail/completion_bound.hpp>
#include <rota/search/detail/objective.hpp>
#include <rota/search/detail/plan_memory.hpp>
#include <rota/search/detail/plan_outcome.hpp>
#include <rota/search/detail/plan_view.hpp>
#include <rota/search/detail/twins.hpp>
#include <rota/search/limits.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace rota::detail {

/// Why assignments were not valid: of each reason what a refusal will name.
template <vocabulary V>
struct rejections {
  std::optional<utility_refusal<V>> fault{};       ///< the first
  std::optional<std::int64_t> negative_utility{};  ///< the greatest
  bool precondition_threw = false;

  void note(appraisal<V> const& a) {
    if (a.worth) return;
    if (!fault) fault = a.fault;
    if (a.negative_utility)
      negative_utility = (std::max)(negative_utility.value_or(*a.negative_utility), *a.negative_utility);
    precondition_threw |= a.precondition_threw;
  }
};

/// Answers what branch and bound asks about the assignments of one plan.
template <vocabulary V, class Beliefs>
class tree_answers final : public dense::tree_oracle {
public:
  tree_answers(plan_view<V, Beliefs>& view, objective<V, Beliefs> const& worth,
               completion_bound<V, Beliefs> const& bound, rejections<V>& rejected)
      : view_(view), worth_(worth), bound_(bound), rejected_(rejected) {}

  std::optional<std::int64_t> leaf(std::span<dense::slot const> assignment, std::int64_t sum,
                                   std::optional<std::int64_t> to_beat) override {
    if (!view_.coupled() && to_beat && sum <= *to_beat) return std::nullopt;
    auto const a = worth_(assignment, sum);
    rejected_.note(a);
    return a.worth;
  }
  std::int64_t bound(std::span<dense::slot const> prefix, std::int64_t) override { return bound_(prefix); }
  bool hopeless(std::span<dense::slot const> prefix) override {
    if (!view_.conditional() || !view_.plan.outlook()) return false;
    auto const outlook = guarded([&] {
      return view_.plan.outlook()(view_.problem.beliefs, view_.atoms(prefix), view_.undecided(prefix.size()));
    });
    return outlook && *outlook == possibility::no;
  }
  std::optional<std::int64_t> probe(std::span<dense::slot const> assignment, std::int64_t sum) override {
    return worth_(assignment, sum).worth;
  }

private:
  plan_view<V, Beliefs>& view_;
  objective<V, Beliefs> const& worth_;
  completion_bound<V, Beliefs> const& bound_;
  rejections<V>& rejected_;
};

/// A bound of the user's that was refuted, in atoms.
template <vocabulary V, class Beliefs>
[[nodiscard]] bound_lie<V> lie_of(plan_view<V, Beliefs>& view, dense::refuted_bound const& refuted) {
  auto const atoms = [&](std::span<dense::slot const> assignment) {
    auto const all = view.atoms(assignment);
    return allocation_atoms<V>(all.begin(), all.end());
  };
  bound_lie<V> lie;
  lie.plan = view.plan.id();
  lie.partial = atoms(refuted.assignment.first(refuted.depth));
  lie.complete = atoms(refuted.assignment);
  lie.undecided = view.agents() - refuted.depth;
  lie.bound = to_double({refuted.bound});
  lie.value = to_double({refuted.value});
  return lie;
}

/// Solves any plan by branch and bound. `alone` is what the flow solver found.
template <vocabulary V, class Beliefs>
[[nodiscard]] plan_outcome<V> search_tree(plan_view<V, Beliefs>& view, plan_memory const& memory, search_state& state,
                                          dense::instance const& in, dense::flow_outcome const& alone,
                                          objective<V, Beliefs> const& worth, rejections<V>& rejected,
                                          search_budget const& budget, search_work& done) {
  completion_bound<V, Beliefs> const bound(view, memory, worth, state.most);
  dense::tree_options options;
  options.limit = {budget.nodes, budget.stop};
  options.audit = budget.audit;
  options.twin = find_twins(view, in, state.twin);
  if (!view.coupled() && alone.proved() && !worth.changes_cost()) options.enough = alone.value;
  // Begin with something, so that even a search that is stopped at once has an answer: what is best for agents alone, or what
  // runs, if that is valid.
  auto const offer = [&](std::span<dense::slot const> assignment) {
    auto const sum = dense::value_of(in, assignment);
    if (!sum) return;
    auto const value = worth(assignment, *sum).worth;
    if (!value || (!options.known.empty() && *value <= options.known_value)) return;
    options.known = assignment;
    options.known_value = *value;
  };
  if (view.coupled()) offer(alone.assignment);  // otherwise it has been tried
  if (!view.problem.current.empty()) offer(view.now());

  tree_answers<V, Beliefs> answers(view, worth, bound, rejected);
  auto const tree = state.tree.solve(in, answers, options);
  done += tree.work;
  auto const id = view.plan.id();
  bool const proved = tree.proved() && !tree.lie;
  auto const most = tree.lie ? dense::no_bound : worth.in_units(tree.bound);
  auto out = nothing_found(refusal_of<V>(id, no_plan_reason::search_incomplete), most);
  auto const units = tree.found() ? worth.in_units(tree.value) : 0;
  if (tree.found() && worth.utility_of(tree.assignment, units) >= 0)
    out = worth.found(tree.assignment, units, most, proved);
  else if (proved && tree.found())
    out = nothing_valid(negative_refusal<V>(id, units));
  else if (proved)
    out = nothing_valid(rejected.negative_utility     ? negative_refusal<V>(id, *rejected.negative_utility)
                        : rejected.fault              ? refusal_of<V>(id, *rejected.fault)
                        : rejected.precondition_threw ? refusal_of<V>(id, no_plan_reason::precondition_threw)
                                                      : refusal_of<V>(id, no_plan_reason::precondition_never_holds));
  if (tree.lie && view.coupled()) out.lie = lie_of(view, *tree.lie);
  return out;
}

}  // namespace rota::detail
