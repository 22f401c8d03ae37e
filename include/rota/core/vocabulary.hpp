#pragma once

#include <rota/core/identifier.hpp>

namespace rota {

/// The five kinds of names a team speaks in: agents a, plan types pt, plans p, tasks τ and states z.
///
/// Usually a struct of scoped enumerations. Finite sorts come from the team and the plans, never from enumerating these.
template <class V>
concept vocabulary = identifier<typename V::agent> && identifier<typename V::plan_type> &&
                     identifier<typename V::plan> && identifier<typename V::task> && identifier<typename V::state>;

/// The vocabulary whose names are known at run time only: plan files, configuration, messages.
struct runtime_vocabulary {
  using agent = strong_id<struct agent_tag>;
  using plan_type = strong_id<struct plan_type_tag>;
  using plan = strong_id<struct plan_tag>;
  using task = strong_id<struct task_tag>;
  using state = strong_id<struct state_tag>;
};

static_assert(vocabulary<runtime_vocabulary>);
static_assert(!identifier<double>);

}  // namespace rota
