#pragma once

#include <rota/allocation/utility.hpp>

#include <concepts>
#include <optional>
#include <type_traits>
#include <variant>

namespace rota::detail {

/// What U_p says of one atom: the sum of the parts that read agents one by one.
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_fault> rate(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p,
                                                        in<V> const& x) {
  if (auto const* const only =
          std::get_if<additive_utility<V, Beliefs>>(&p.utility().form()))  // at once: the usual case
    return term_of<V, Beliefs>(problem, 1, *only, x);
  fixed_utility total;
  auto fault = utility_fault::none;
  for_each_part<V, Beliefs>(p.utility(), [&](double weight, auto const& part) {
    if (fault == utility_fault::none) fault = add(total, term_of<V, Beliefs>(problem, weight, part, x));
  });
  if (fault != utility_fault::none) return refused{fault};
  return total;
}

/// What U_p says of two atoms together: the sum of the parts that read two agents at a time. @pre x.agent < y.agent
template <vocabulary V, class Beliefs>
[[nodiscard]] result<fixed_utility, utility_fault> rate(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p,
                                                        in<V> const& x, in<V> const& y) {
  fixed_utility total;
  auto fault = utility_fault::none;
  for_each_part<V, Beliefs>(p.utility(), [&](double weight, auto const& part) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(part)>, pairwise_utility<V, Beliefs>>)
      if (fault == utility_fault::none) fault = add(total, term_of<V, Beliefs>(problem, weight, part, x, y));
  });
  if (fault != utility_fault::none) return refused{fault};
  return total;
}

/// total ← total + what the parts that read the whole allocation say and, if `pairs`, those that read two agents.
/// `refusal` ← the first term that is no utility, if there is one. @pre none yet
template <vocabulary V, class Beliefs>
void add_coupled(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p, allocation_view<V> atoms, bool pairs,
                 fixed_utility& total, std::optional<utility_refusal<V>>& refusal) {
  for_each_part<V, Beliefs>(p.utility(), [&](double weight, auto const& part) {
    using part_type = std::remove_cvref_t<decltype(part)>;
    if constexpr (std::same_as<part_type, general_utility<V, Beliefs>>) {
      if (refusal) return;
      auto const fault = add(total, value_of<V, Beliefs>(problem, weight, part, atoms));
      if (fault != utility_fault::none) refusal = utility_refusal<V>{fault, std::nullopt, std::nullopt};
    } else if constexpr (std::same_as<part_type, pairwise_utility<V, Beliefs>>) {
      for (std::size_t i = 0; i < atoms.size() && pairs; ++i)
        for (std::size_t j = i + 1; j < atoms.size() && !refusal; ++j) {
          auto const fault = add(total, term_of<V, Beliefs>(problem, weight, part, atoms[i], atoms[j]));
          if (fault != utility_fault::none) refusal = utility_refusal<V>{fault, atoms[i], atoms[j]};
        }
    }
  });
}

}  // namespace rota::detail
