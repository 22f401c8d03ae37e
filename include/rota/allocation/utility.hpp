#pragma once

#include <rota/allocation/fixed_point.hpp>
#include <rota/allocation/guarded.hpp>
#include <rota/allocation/problem.hpp>

#include <optional>
#include <variant>

namespace rota {

/// Refusal: why U_p is not defined on an allocation, and at which atom if it is an atom's fault.
template <vocabulary V>
struct utility_refusal {
  utility_fault why{};
  std::optional<in<V>> atom{};

  friend bool operator==(utility_refusal const&, utility_refusal const&) = default;
};

/// One term of an additive utility, in fixed point.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_fault> term_of(additive_utility<V, Beliefs> const& u, typename V::agent a,
                                                           typename V::task t, Beliefs const& beliefs) {
  auto const value = guarded([&] { return u(a, t, beliefs); });
  if (!value) return refused{utility_fault::threw};
  if (!*value) return refused{utility_fault::forbidden_pair};
  return quantise(**value);
}

/// A general utility of a complete allocation, in fixed point.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_fault> value_of(general_utility<V, Beliefs> const& u,
                                                            Beliefs const& beliefs, allocation_view<V> atoms) {
  auto const value = guarded([&] { return u.value(beliefs, atoms); });
  if (!value) return refused{utility_fault::threw};
  return quantise(*value);
}

/// U_p(F ∪ C) in fixed point, or why it is not defined. May be negative: clause (6) is `validate`'s business.
///
/// @pre every atom names p, a task of p and a participant: a user's function is never asked about anything else
/// Complexity: one call per atom, or one call.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_refusal<V>> evaluate(problem<V, Beliefs> const& problem,
                                                                 plan<V, Beliefs> const& p, allocation_view<V> atoms) {
  if (auto const* general = std::get_if<general_utility<V, Beliefs>>(&p.utility())) {
    auto const value = value_of<V, Beliefs>(*general, problem.beliefs, atoms);
    if (!value) return refused{utility_refusal<V>{value.error(), {}}};
    return value.value();
  }
  auto const& additive = *std::get_if<additive_utility<V, Beliefs>>(&p.utility());
  fixed_utility total;
  for (in<V> const& x : atoms) {
    auto const term = term_of<V, Beliefs>(additive, x.agent, x.task, problem.beliefs);
    if (!term) return refused{utility_refusal<V>{term.error(), x}};
    if (!checked_add(total, term.value())) return refused{utility_refusal<V>{utility_fault::out_of_range, x}};
  }
  return total;
}

/// As above, over an atom set.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_refusal<V>>
evaluate(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p, allocation_atoms<V> const& atoms) {
  return evaluate(problem, p, atoms.atoms());
}

}  // namespace rota
