#pragma once

#include <rota/allocation/validate.hpp>
#include <rota/search/detail/plan_memory.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

namespace rota::detail {

/// The running allocation: its plan and utility if it is valid, otherwise what it violates first.
template <vocabulary V>
struct standing {
  bool valid = false;
  typename V::plan plan{};
  fixed_utility utility{};
  double hysteresis = 0;  // the plan's own
  std::optional<violation<V>> violated{};
};

/// U_p of the running allocation if it is valid for p; otherwise `violated` is the first violation.
template <vocabulary V, class Beliefs>
[[nodiscard]] standing<V> standing_for(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p,
                                       plan_phase phase) {
  standing<V> s;
  s.plan = p.id();
  s.hysteresis = p.hysteresis();
  auto const total = judge(problem, p, problem.current, phase, [&](violation<V> const& v) {
    if (!s.violated) s.violated = v;
  });
  s.valid = !s.violated;
  if (s.valid) s.utility = *total;
  return s;
}

/// C = ∅ names no plan: it stands as the best plan for which it is valid, without a hysteresis, and violates nothing.
template <vocabulary V, class Beliefs>
[[nodiscard]] standing<V> standing_of(problem<V, Beliefs> const& problem) {
  if (!problem.current.empty()) {
    auto const& first = problem.current.front();
    auto const* const p = problem.type.find(first.plan);
    if (p != nullptr) return standing_for(problem, *p, plan_phase::running);
    standing<V> none;
    none.violated = at<V>(clause::one_plan, first.plan, first);
    return none;
  }
  standing<V> best;
  for (plan<V, Beliefs> const& p : problem.type.plans()) {
    auto const s = standing_for(problem, p, plan_phase::entering);
    if (s.valid && (!best.valid || s.utility > best.utility)) best = s;
  }
  best.hysteresis = 0;
  return best;
}

/// U_p of the running allocation from the numbers of the search that has just looked at the same problem. Nothing unless
/// they show that it is valid: U_p is a sum over agents, without Pre(p), and every clause of Def. 1 is met.
template <vocabulary V, class Beliefs>
[[nodiscard]] std::optional<fixed_utility> known_worth(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p,
                                                       plan_memory const& memory) {
  if (!memory.up_to_date || p.precondition() ||
      !std::holds_alternative<additive_utility<V, Beliefs>>(p.utility().form()))
    return std::nullopt;
  auto const tasks = p.tasks();
  auto const& who = problem.participants;
  small_vector<std::uint32_t, 8> count;
  count.resize(tasks.size());
  fixed_utility total;
  std::size_t a = 0;
  for (in<V> const& x : problem.current) {
    while (a < who.size() && who[a] < x.agent) ++a;
    auto const* const task = p.find(x.task);
    if (a == who.size() || !(who[a] == x.agent) || !(x.plan == p.id()) || task == nullptr) return std::nullopt;
    // The agent does this already, so no change cost is deducted. A participant's second atom finds it passed.
    auto const s = static_cast<std::size_t>(task - tasks.data());
    auto const units = memory.units[a++ * (tasks.size() + 1) + s];
    if (units == dense::absent || !checked_add(total, {units})) return std::nullopt;
    ++count[s];
  }
  for (std::size_t s = 0; s < tasks.size(); ++s)
    if (!tasks[s].bounds.admits(count[s])) return std::nullopt;
  auto const employed = problem.current.size();
  bool const valid = p.team_size().admits(employed) && (problem.idle == idling::allowed || employed == who.size()) &&
                     total.units >= 0 && total.units <= most_total_units;
  return valid ? std::optional{total} : std::nullopt;
}

/// As above, just after a search of the same problem with the memory `state`.
template <vocabulary V, class Beliefs>
[[nodiscard]] standing<V> standing_of(problem<V, Beliefs> const& problem, search_state& state) {
  auto const plans = problem.type.plans();
  auto const* const p = problem.current.empty() ? nullptr : problem.type.find(problem.current.front().plan);
  if (p != nullptr) {
    auto const& memory = state.of_plan(static_cast<std::size_t>(p - plans.data()));
    if (auto const worth = known_worth(problem, *p, memory)) {
      standing<V> s;
      s.valid = true;
      s.plan = p->id();
      s.utility = *worth;
      s.hysteresis = p->hysteresis();
      return s;
    }
  }
  return standing_of(problem);
}

}  // namespace rota::detail
