#pragma once
/// @file
/// One name for a vocabulary and its beliefs, and with it short names for everything that is made from the two.

#include <rota/algebra/delta.hpp>
#include <rota/algebra/event.hpp>
#include <rota/allocation/validate.hpp>
#include <rota/model/outline.hpp>
#include <rota/model/plan_type.hpp>
#include <rota/model/team.hpp>
#include <rota/search/reallocate.hpp>
#include <rota/team/robot.hpp>

namespace rota {

/// The pair (V, Beliefs), named once: `using game = rota::domain<soccer, beliefs>;`, then `game::plan::make(…)`.
///
/// Everything in it is an alias, so both spellings name one type. V's own plan and plan type ids are `plan_id` and
/// `plan_type_id` here; `plan` and `plan_type` are what the ids stand for.
template <vocabulary V = runtime_vocabulary, class Beliefs = no_beliefs>
struct domain {
  using vocabulary_type = V;
  using beliefs_type = Beliefs;

  using agent = typename V::agent;
  using task = typename V::task;
  using state = typename V::state;
  using plan_id = typename V::plan;
  using plan_type_id = typename V::plan_type;

  using in = rota::in<V>;
  using atom = in;
  using in_state = rota::in_state<V>;
  using atoms = allocation_atoms<V>;
  using event = rota::event<atom>;
  using delta = rota::delta<atom>;
  using allocation = rota::allocation<V>;
  using allocation_view = rota::allocation_view<V>;

  using additive_utility = rota::additive_utility<V, Beliefs>;
  using pairwise_utility = rota::pairwise_utility<V, Beliefs>;
  using general_utility = rota::general_utility<V, Beliefs>;
  using weighted_sum = rota::weighted_sum<V, Beliefs>;
  using utility = rota::utility<V, Beliefs>;
  using precondition = rota::precondition<V, Beliefs>;
  using plan_task = rota::plan_task<V>;
  using plan_description = rota::plan_description<V, Beliefs>;
  using plan = rota::plan<V, Beliefs>;
  using plan_type = rota::plan_type<V, Beliefs>;
  using role = rota::role<V>;
  using team = rota::team<V>;

  using problem = rota::problem<V, Beliefs>;
  using validity_report = rota::validity_report<V>;
  using violation = rota::violation<V>;
  using solution = rota::solution<V>;
  using no_allocation = rota::no_allocation<V>;
  using reallocation = rota::reallocation<V>;

  using robot = rota::robot<V>;
  using message = rota::message<V>;
  using decision = rota::decision<V>;
};

}  // namespace rota
