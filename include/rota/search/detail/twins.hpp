#pragma once

#include <rota/allocation/guarded.hpp>
#include <rota/search/detail/plan_view.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

namespace rota::detail {

/// Whether every part of U_p that reads the whole allocation puts both agents into one kind.
template <vocabulary V, class Beliefs>
[[nodiscard]] bool same_kind(plan_view<V, Beliefs> const& view, std::size_t a, std::size_t b) {
  bool same = true;
  for_each_part<V, Beliefs>(view.plan.utility(), [&](double, auto const& part) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(part)>, general_utility<V, Beliefs>>) {
      auto const kind = [&](std::size_t x) {
        return guarded([&] { return part.kind(view.problem.beliefs, view.problem.participants[x]); });
      };
      auto const of_a = kind(a);
      same = same && of_a && of_a == kind(b);
    }
  });
  return same;
}

/// Finds interchangeable agents: those of one kind with equal rows, unless something else could tell them apart.
/// @return `tree_options::twin`, in the buffer; empty if none are known to be interchangeable
template <vocabulary V, class Beliefs>
[[nodiscard]] std::span<dense::row_index const> find_twins(plan_view<V, Beliefs> const& view, dense::instance const& in,
                                                           dense::buffer<dense::row_index>& twin) {
  bool known = view.general() && !view.pairwise() && !view.conditional();
  for_each_part<V, Beliefs>(view.plan.utility(), [&](double, auto const& part) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(part)>, general_utility<V, Beliefs>>)
      known &= static_cast<bool>(part.kind);
  });
  if (!known) return {};
  twin.resize(in.agents);
  for (std::size_t a = 0; a < in.agents; ++a) {
    twin[a] = static_cast<dense::row_index>(a);
    for (std::size_t b = a; b-- > 0 && twin[a] == a;)
      if (std::equal(in.row(a), in.row(a) + in.slot_count(), in.row(b)) && same_kind(view, a, b))
        twin[a] = static_cast<dense::row_index>(b);
  }
  return {twin.data(), twin.size()};
}

}  // namespace rota::detail
