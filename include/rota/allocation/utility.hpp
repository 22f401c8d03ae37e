#pragma once

#include <rota/allocation/fixed_point.hpp>
#include <rota/allocation/guarded.hpp>
#include <rota/allocation/problem.hpp>

#include <algorithm>
#include <concepts>
#include <optional>
#include <type_traits>

namespace rota {

/// Refusal: why U_p is not defined on an allocation, and at which atom or two atoms if it is theirs.
template <vocabulary V>
struct utility_refusal {
  utility_fault why{};
  std::optional<in<V>> atom{};
  std::optional<in<V>> other{};  ///< of a pair

  friend bool operator==(utility_refusal const&, utility_refusal const&) = default;
};

/// weight·value as a number of units, or why it cannot be counted.
[[nodiscard]] constexpr result<fixed_utility, utility_fault> weigh(double weight, double value) noexcept {
  return quantise(is_finite(value) ? weight * value : value);
}

/// total ← total + term; or why not, and total unchanged.
[[nodiscard]] constexpr utility_fault add(fixed_utility& total,
                                          result<fixed_utility, utility_fault> const& term) noexcept {
  if (!term) return term.error();
  return checked_add(total, term.value()) ? utility_fault::none : utility_fault::out_of_range;
}

/// One number of the user's, weighed: f() is what the user's function returns.
template <class F>
[[nodiscard]] result<fixed_utility, utility_fault> ask(double weight, F&& f) {
  auto const value = guarded(f);
  if (!value) return refused{utility_fault::threw};
  if constexpr (std::is_floating_point_v<std::invoke_result_t<F&>>) {
    return weigh(weight, *value);
  } else {
    if (!*value) return refused{utility_fault::forbidden_pair};
    return weigh(weight, **value);
  }
}

/// What one agent on one task adds to U_p by a part of it: nothing for parts that do not look at agents one by one.
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
    return ask(weight, [&] { return part(x.agent, x.task, problem.beliefs); });
  } else if constexpr (std::same_as<Part, pairwise_utility<V, Beliefs>>) {
    if (!part.alone) return fixed_utility{};
    return ask(weight, [&] { return part.alone(x.agent, x.task, problem.beliefs); });
  } else {
    return fixed_utility{};
  }
}

/// What two agents on their tasks add to U_p by a pairwise part of it. @pre x.agent < y.agent
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_fault> term_of(problem<V, Beliefs> const& problem, double weight,
                                                           pairwise_utility<V, Beliefs> const& part, in<V> const& x,
                                                           in<V> const& y) {
  return ask(weight, [&] { return part.together(x.agent, x.task, y.agent, y.task, problem.beliefs); });
}

/// What a general part adds to U_p.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_fault> value_of(problem<V, Beliefs> const& problem, double weight,
                                                            general_utility<V, Beliefs> const& part,
                                                            allocation_view<V> atoms) {
  return ask(weight, [&] { return part.value(problem.beliefs, atoms); });
}

namespace detail {

/// U_p of an allocation, or nothing where it is not defined; `fault` takes each reason why it is not.
template <vocabulary V, class Beliefs, class Sink>
[[nodiscard]] std::optional<fixed_utility> value(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p,
                                                 allocation_view<V> atoms, Sink&& fault) {
  fixed_utility total;
  bool defined = true;
  auto count = [&](result<fixed_utility, utility_fault> const& term, std::optional<in<V>> x, std::optional<in<V>> y) {
    auto const why = add(total, term);
    if (why == utility_fault::none) return;
    defined = false;
    fault(utility_refusal<V>{why, x, y});
  };
  for_each_part<V, Beliefs>(p.utility(), [&](double weight, auto const& part) {
    using part_type = std::remove_cvref_t<decltype(part)>;
    if constexpr (std::same_as<part_type, general_utility<V, Beliefs>>) {
      count(value_of<V, Beliefs>(problem, weight, part, atoms), std::nullopt, std::nullopt);
    } else {
      for (in<V> const& x : atoms) count(term_of<V, Beliefs>(problem, weight, part, x), x, std::nullopt);
    }
    if constexpr (std::same_as<part_type, pairwise_utility<V, Beliefs>>)
      for (in<V> const& x : atoms)
        for (in<V> const& y : atoms)
          if (y.agent > x.agent) count(term_of<V, Beliefs>(problem, weight, part, x, y), x, y);
  });
  return defined ? std::optional{total} : std::nullopt;
}

}  // namespace detail

/// U_p(F ∪ C) in fixed point, or the first reason why it is not defined. May be negative: clause (6) is `validate`'s
/// business.
///
/// @pre every atom names p, a task of p and a participant: a user's function is never asked about anything else
/// Complexity: one call per atom, or pair of atoms, or allocation, of each part.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_refusal<V>> evaluate(problem<V, Beliefs> const& problem,
                                                                 plan<V, Beliefs> const& p, allocation_view<V> atoms) {
  std::optional<utility_refusal<V>> first;
  auto const total = detail::value<V, Beliefs>(problem, p, atoms, [&](utility_refusal<V> const& why) {
    if (!first) first = why;
  });
  if (total) return *total;
  return refused{*first};
}

/// As above, over an atom set.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_refusal<V>>
evaluate(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p, allocation_atoms<V> const& atoms) {
  return evaluate(problem, p, atoms.atoms());
}

}  // namespace rota
