#pragma once

#include <rota/model/plan_type.hpp>
#include <rota/model/team.hpp>

#include <span>

namespace rota {

/// Whether an agent may take part without a task.
enum class idling : bool { allowed, forbidden };

/// The task allocation problem for one plan type: which plan, and which of its tasks for whom? A view; owns nothing.
///
/// `participants` are the agents believed to execute the type, strictly ascending; others have no atom and get none.
/// `current` is what the team executes already: a plan that occurs there is not asked for its precondition if that is
/// `precondition_scope::entry_only`, and `similarity` counts what stays. `change_cost` is what each participant costs who
/// does something else than there: a search maximises U_p less that, while validity asks for U_p alone.
/// @pre everything viewed outlives the problem and does not change meanwhile; change_cost is finite and not negative
template <vocabulary V, class Beliefs>
struct problem {
  plan_type<V, Beliefs> const& type;
  team<V> const& members;
  Beliefs const& beliefs;
  std::span<typename V::agent const> participants;
  idling idle = idling::allowed;
  allocation_view<V> current{};
  double change_cost = 0;

  /// The whole team takes part.
  constexpr problem(plan_type<V, Beliefs> const& pt, team<V> const& t, Beliefs const& b, idling i = idling::allowed)
      : problem(pt, t, b, t.agents(), i) {}
  constexpr problem(plan_type<V, Beliefs> const& pt, team<V> const& t, Beliefs const& b,
                    std::span<typename V::agent const> who, idling i = idling::allowed)
      : type(pt), members(t), beliefs(b), participants(who), idle(i) {}
};

}  // namespace rota
