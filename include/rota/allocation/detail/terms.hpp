#pragma once

#include <rota/allocation/fixed_point.hpp>
#include <rota/allocation/guarded.hpp>
#include <rota/allocation/problem.hpp>
#include <rota/model/parts.hpp>

#include <algorithm>
#include <concepts>
#include <type_traits>

namespace rota::detail {

/// weight·value in fixed point, or why it cannot be counted.
[[nodiscard]] constexpr result<fixed_utility, utility_fault> weigh(double weight, double const& value) noexcept {
  if (!is_finite(value)) return quantise(value);
  return quantise(weight * value);
}

/// total ← total + term; or why it cannot be added, and `total` stays as it is.
[[nodiscard]] constexpr utility_fault add(fixed_utility& total,
                                          result<fixed_utility, utility_fault> const& term) noexcept {
  if (!term) return term.error();
  return checked_add(total, term.value()) ? utility_fault::none : utility_fault::out_of_range;
}

/// weight·f(…) in fixed point, where f is a function of the user's.
template <class R, class... Parameters>
[[nodiscard]] result<fixed_utility, utility_fault> ask(double weight, function<R(Parameters...)> const& f,
                                                       std::type_identity_t<Parameters>... p) {
  R value{};
  if (!guarded([&] { return f.answer(value, p...), true; })) return refused{utility_fault::threw};
  if constexpr (std::is_floating_point_v<R>) {
    return weigh(weight, value);
  } else {
    if (!value) return refused{utility_fault::forbidden_pair};
    return weigh(weight, *value);
  }
}

/// How much one agent on one task adds to U_p by this part. 0 for a part that does not look at agents one by one.
template <vocabulary V, class Beliefs, class Part>
[[nodiscard]] result<fixed_utility, utility_fault> term_of(problem<V, Beliefs> const& problem, double weight,
                                                           Part const& part, in<V> const& x) {
  if constexpr (std::same_as<Part, role_priorities>) {
    auto const* const role = problem.members.role_of(x.agent);
    return weigh(weight, role != nullptr ? role->priority(x.task) : 0);
  } else if constexpr (std::same_as<Part, similarity>) {
    bool const stays = std::binary_search(problem.current.begin(), problem.current.end(), x);
    return weigh(weight, stays ? 1 : 0);
  } else if constexpr (std::same_as<Part, additive_utility<V, Beliefs>>) {
    return ask(weight, part, x.agent, x.task, problem.beliefs);
  } else if constexpr (std::same_as<Part, pairwise_utility<V, Beliefs>>) {
    if (!part.alone) return fixed_utility{};
    return ask(weight, part.alone, x.agent, x.task, problem.beliefs);
  } else {
    return fixed_utility{};
  }
}

/// How much two agents on their tasks add to U_p by a pairwise part. @pre x.agent < y.agent
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_fault> term_of(problem<V, Beliefs> const& problem, double weight,
                                                           pairwise_utility<V, Beliefs> const& part, in<V> const& x,
                                                           in<V> const& y) {
  return ask(weight, part.together, x.agent, x.task, y.agent, y.task, problem.beliefs);
}

/// How much a general part adds to U_p.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_fault> value_of(problem<V, Beliefs> const& problem, double weight,
                                                            general_utility<V, Beliefs> const& part,
                                                            allocation_view<V> atoms) {
  return ask(weight, part.value, problem.beliefs, atoms);
}

}  // namespace rota::detail
