#pragma once

#include <rota/core/identifier.hpp>

namespace rota {

namespace detail {

/// Instantiated for identifiers that have `==` and `<` but not the rest of the order. Compilers print its name first.
template <class Identifier>
struct three_way_comparison_is_missing_in {
  static_assert(std::totally_ordered<Identifier>,
                "this identifier has == and <, but not <=, >, >=: give it operator<=> (it may be defaulted)");
  static constexpr bool value = false;
};

template <class T>
concept half_ordered = std::regular<T> && !std::totally_ordered<T> && requires(T const& x) { x < x; };

/// As `identifier`, but the most frequent mistake is an error that names the type, not a concept that is not satisfied.
template <class T>
concept named_identifier = identifier<T> || (half_ordered<T> && three_way_comparison_is_missing_in<T>::value);

}  // namespace detail

/// The five sorts of names a team speaks in: agents a, plan types pt, plans p, tasks τ and states z.
///
/// Usually a struct of scoped enumerations. Which agents, plans and tasks there are is said by the team and the plans;
/// an enumeration is never enumerated.
template <class V>
concept vocabulary = detail::named_identifier<typename V::agent> && detail::named_identifier<typename V::plan_type> &&
                     detail::named_identifier<typename V::plan> && detail::named_identifier<typename V::task> &&
                     detail::named_identifier<typename V::state>;

/// The vocabulary whose names are known only at run time: plan files, configuration, messages.
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
