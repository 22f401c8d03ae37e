#pragma once

#include <rota/allocation/detail/terms.hpp>

#include <optional>

namespace rota {

/// Refusal: why U_p is not defined on an allocation; with the atom, or the two atoms, whose utility is at fault.
template <vocabulary V>
struct utility_refusal {
  utility_fault reason{};
  std::optional<in<V>> atom{};
  std::optional<in<V>> other{};  ///< of a pair

  friend bool operator==(utility_refusal const&, utility_refusal const&) = default;
};

namespace detail {

/// U_p of an allocation, or nothing if it is not defined; `fault` gets each reason.
template <vocabulary V, class Beliefs, class Sink>
[[nodiscard]] std::optional<fixed_utility> value(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p,
                                                 allocation_view<V> atoms, Sink&& fault) {
  fixed_utility total;
  bool defined = true;
  auto count = [&](result<fixed_utility, utility_fault> const& term, auto const&... about) {
    auto const reason = add(total, term);
    if (reason == utility_fault::none) return;
    defined = false;
    fault(utility_refusal<V>{reason, about...});
  };
  for_each_part<V, Beliefs>(p.utility(), [&](double weight, auto const& part) {
    using part_type = std::remove_cvref_t<decltype(part)>;
    if constexpr (std::same_as<part_type, general_utility<V, Beliefs>>) {
      count(value_of<V, Beliefs>(problem, weight, part, atoms));
    } else {
      for (in<V> const& x : atoms) count(term_of<V, Beliefs>(problem, weight, part, x), x);
    }
    if constexpr (std::same_as<part_type, pairwise_utility<V, Beliefs>>)
      for (in<V> const& x : atoms)
        for (in<V> const& y : atoms)
          if (x.agent < y.agent) count(term_of<V, Beliefs>(problem, weight, part, x, y), x, y);
  });
  if (defined && (total.units > most_total_units || total.units < -most_total_units)) {
    fault(utility_refusal<V>{utility_fault::out_of_range});
    return std::nullopt;
  }
  return defined ? std::optional{total} : std::nullopt;
}

}  // namespace detail

/// U_p(F ∪ C) in fixed point, or the first reason why it is not defined. It may be negative; only `validate` checks clause
/// (6).
///
/// @pre every atom names p, a task of p and a participant, because the user's functions are not called for other atoms
/// Complexity: one call per atom, or pair of atoms, or allocation, of each part.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_refusal<V>> evaluate(problem<V, Beliefs> const& problem,
                                                                 plan<V, Beliefs> const& p, allocation_view<V> atoms) {
  std::optional<utility_refusal<V>> first;
  auto const total = detail::value<V, Beliefs>(problem, p, atoms, [&](utility_refusal<V> const& reason) {
    if (!first) first = reason;
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
