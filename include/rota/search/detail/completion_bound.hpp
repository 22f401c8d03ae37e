#pragma once

#include <rota/allocation/guarded.hpp>
#include <rota/search/detail/objective.hpp>
#include <rota/search/detail/plan_memory.hpp>
#include <rota/search/detail/plan_view.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace rota::detail {

/// A bound on what the completions of a prefix are worth: what agents add one by one is bounded by the prices of the slots,
/// pairs by their tables, and the rest by the user.
template <vocabulary V, class Beliefs>
class completion_bound {
public:
  /// `most` is a buffer to use. @pre `plan_memory::flow` has searched the numbers as they are
  completion_bound(plan_view<V, Beliefs>& view, plan_memory const& memory, objective<V, Beliefs> const& worth,
                   dense::buffer<std::int64_t>& most)
      : view_(view), memory_(memory), worth_(worth), price_(memory.flow.prices()), most_(most) {
    std::size_t const slot_count = view.slot_count();
    most.assign(view.agents() + 1, 0);
    for (std::size_t k = 0; k < slot_count; ++k) {
      auto const [lower, upper] = memory.flow.bounds(k);
      most[view.agents()] += price_[k] * static_cast<std::int64_t>(price_[k] > 0 ? upper : lower);
    }
    for (std::size_t a = view.agents(); a-- > 0;)
      most[a] = most[a + 1] + memory.flow.most({memory.keys.data() + a * slot_count, slot_count});
  }

  /// At least the worth of every valid completion, or `no_bound`.
  [[nodiscard]] std::int64_t operator()(std::span<dense::slot const> prefix) const {
    auto const alone = of_agents(prefix);
    if (!view_.coupled()) return alone;
    fixed_utility total{memory_.ties.utility(alone)};
    bool known = !view_.pairwise() || worth_.pairs_in_tables();
    bool nothing_valid = false;
    if (worth_.pairs_in_tables()) {
      auto const together = memory_.pairs.most(prefix);
      nothing_valid = !together;
      known = together && checked_add(total, {*together});
    }
    for_each_part<V, Beliefs>(view_.plan.utility(), [&](double weight, auto const& part) {
      using part_type = std::remove_cvref_t<decltype(part)>;
      if constexpr (std::same_as<part_type, general_utility<V, Beliefs>>) {
        if (!known || weight == 0) return;
        known = weight > 0 && part.bound;
        if (!known) return;
        auto const said = guarded(
            [&] { return part.bound(view_.problem.beliefs, view_.atoms(prefix), view_.undecided(prefix.size())); });
        auto const most = said ? weigh(weight, *said) : refused{utility_fault::threw};
        if (most) {
          known = checked_add(total, most.value());
        } else {  // below the range nothing is valid; above it, or for NaN, the bound says nothing
          nothing_valid |= said && *said < 0;
          known = false;
        }
      }
    });
    return nothing_valid ? dense::no_value : known ? total.units : dense::no_bound;
  }

private:
  /// In keys. Tight where the sum over agents is all there is.
  [[nodiscard]] std::int64_t of_agents(std::span<dense::slot const> prefix) const {
    auto const slot_count = view_.slot_count();
    auto most = most_[prefix.size()];
    for (std::size_t a = 0; a < prefix.size(); ++a)
      most += memory_.keys[a * slot_count + prefix[a]] - price_[prefix[a]];
    return most;
  }

  plan_view<V, Beliefs>& view_;
  plan_memory const& memory_;
  objective<V, Beliefs> const& worth_;
  std::span<std::int64_t const> price_;
  dense::buffer<std::int64_t>& most_;  // [a]: what the agents from a on add at most, at the prices of the slots
};

}  // namespace rota::detail
