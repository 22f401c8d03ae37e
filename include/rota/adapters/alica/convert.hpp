#pragma once

#include <rota/adapters/alica/model.hpp>
#include <rota/core/result.hpp>
#include <rota/model/plan_type.hpp>
#include <rota/model/role.hpp>

#include <concepts>
#include <string>
#include <utility>
#include <vector>

namespace rota::alica {

/// Makes the utility of each plan, which plan files do not contain.
template <class F, class Beliefs>
concept utility_factory = requires(F const& f, plan const& p) {
  { f(p) } -> std::convertible_to<rota::utility<runtime_vocabulary, Beliefs>>;
};

/// The id of a task within a plan: the task's own or, if several entry points share the task, the entry point's, because
/// ALICA allocates entry points. Both are unique within a root.
[[nodiscard]] inline runtime_vocabulary::task task_key(plan const& p, entry_point const& e) {
  return {shares_task(p, e) ? e.id : e.task};
}

/// Refusal: why a plan of a file cannot become a plan of the library.
struct conversion_defect {
  identity plan = 0;
  std::string reason;
};

/// The plan, with its cardinalities, entry states, team size and hysteresis. The caller gives the precondition, because files
/// hold it as text, or not at all. O(t²).
template <class Beliefs = no_beliefs, utility_factory<Beliefs> F>
[[nodiscard]] result<rota::plan<runtime_vocabulary, Beliefs>, conversion_defect>
to_plan(plan const& p, F const& make_utility, precondition<runtime_vocabulary, Beliefs> holds = {}) {
  plan_description<runtime_vocabulary, Beliefs> d;
  d.plan = {p.id};
  for (entry_point const& e : p.entry_points) d.tasks.push_back({task_key(p, e), e.bounds, {e.state}});
  d.utility = make_utility(p);
  d.precondition = std::move(holds);
  d.team_size = p.team_size;
  d.hysteresis = p.utility_threshold;
  auto made = rota::plan<runtime_vocabulary, Beliefs>::make(std::move(d));
  if (made) return *std::move(made);
  using kind = plan_defect<runtime_vocabulary>::kind;
  auto const reason = [&]() -> std::string {
    switch (made.error().what) {
    case kind::repeated_task: return "two entry points have one id";
    case kind::no_task: return "no entry point";
    case kind::missing_utility: return "the factory gave no utility";
    case kind::weight_not_finite: return "the factory gave a weight that is not finite";
    case kind::threshold_not_finite: return "the utility threshold is negative or not finite";
    case kind::empty_cardinality: return "an entry point has a minimum cardinality above its maximum";
    case kind::empty_team_size: return "the plan has a minimum cardinality above its maximum";
    }
    return "";
  }();
  return refused{conversion_defect{p.id, reason}};
}

/// The plan type, with its activated plans.
template <class Beliefs = no_beliefs, utility_factory<Beliefs> F>
[[nodiscard]] result<rota::plan_type<runtime_vocabulary, Beliefs>, conversion_defect>
to_plan_type(model const& m, plan_type const& t, F const& make_utility) {
  std::vector<rota::plan<runtime_vocabulary, Beliefs>> plans;
  for (plan_choice const& c : t.plans) {
    if (!c.activated) continue;
    auto const* p = m.find_plan(t.root, c.plan);
    if (p == nullptr) return refused{conversion_defect{c.plan, "the model has no such plan"}};
    auto made = to_plan<Beliefs>(*p, make_utility);
    if (!made) return refused{made.error()};
    plans.push_back(*std::move(made));
  }
  auto made = rota::plan_type<runtime_vocabulary, Beliefs>::make({t.id}, std::move(plans));
  if (!made) return refused{conversion_defect{t.id, "no activated plan, or one twice"}};
  return *std::move(made);
}

/// A plan type of this one plan, with the plan's id.
template <class Beliefs = no_beliefs, utility_factory<Beliefs> F>
[[nodiscard]] result<rota::plan_type<runtime_vocabulary, Beliefs>, conversion_defect>
to_plan_type(plan const& p, F const& make_utility) {
  auto made = to_plan<Beliefs>(p, make_utility);
  if (!made) return refused{made.error()};
  std::vector<rota::plan<runtime_vocabulary, Beliefs>> plans;
  plans.push_back(*std::move(made));
  return *rota::plan_type<runtime_vocabulary, Beliefs>::make({p.id}, std::move(plans));
}

/// The role. It names tasks as `task_key` does, for the plans of its root.
[[nodiscard]] inline rota::role<runtime_vocabulary> to_role(model const& m, role const& r) {
  rota::role<runtime_vocabulary> out{r.default_priority};
  for (task_priority const& t : r.priorities) {
    out.prioritise({t.task}, t.priority);
    for (plan const& p : m.plans) {
      if (p.root != r.root) continue;
      for (entry_point const& e : p.entry_points)
        if (e.task == t.task && shares_task(p, e)) out.prioritise({e.id}, t.priority);
    }
  }
  return out;
}

}  // namespace rota::alica
