#pragma once

#include <rota/model/allocation.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace rota {

/// What a precondition or a utility may read of an allocation: its atoms, ascending by agent.
template <vocabulary V = runtime_vocabulary>
using allocation_view = std::span<in<V> const>;

/// U_p as a sum over agents: the utility of one agent on one task; an idle agent counts 0. `nullopt` forbids the pair.
///
/// Must return finite numbers of magnitude at most `max_utility`; what it returns for a pair must not depend on the
/// allocation. The optimum is found in polynomial time.
template <vocabulary V, class Beliefs>
using additive_utility = std::function<std::optional<double>(typename V::agent, typename V::task, Beliefs const&)>;

/// U_p as a sum over agents and over pairs of agents: Σ_a alone(a, τ_a) + Σ_{a<b} together(a, τ_a, b, τ_b).
///
/// Idle agents count 0, and so do pairs with one. An empty `alone` counts 0. `together` is asked with a < b. The optimum is
/// found by branch and bound, with bounds that need no help.
template <vocabulary V, class Beliefs>
struct pairwise_utility {
  additive_utility<V, Beliefs> alone;
  std::function<double(typename V::agent, typename V::task, typename V::agent, typename V::task, Beliefs const&)>
      together;
};

/// U_p as any function of the beliefs and a complete allocation: a black box, which a search can only try out.
///
/// `bound`, if given, must be at least the value of every complete allocation that extends the given partial one by
/// tasks for the undecided agents (the others are decided, idle if they have no atom); it lets the search prune. A bound
/// that was seen to be too low is reported (`solution::lie`).
/// `kind`, if given: agents of one kind that may do the same tasks are interchangeable. No value changes when two of them
/// swap what they do; of such allocations one is tried.
template <vocabulary V, class Beliefs>
struct general_utility {
  std::function<double(Beliefs const&, allocation_view<V>)> value;
  std::function<double(Beliefs const&, allocation_view<V>, std::span<typename V::agent const> undecided)> bound{};
  std::function<std::uint64_t(Beliefs const&, typename V::agent)> kind{};
};

/// A part of U_p: the priorities that the roles of the agents give to their tasks, summed up.
struct role_priorities {
  friend bool operator==(role_priorities, role_priorities) = default;
};

/// A part of U_p: how many atoms the allocation shares with the current one. Weighted, a bonus for staying.
struct similarity {
  friend bool operator==(similarity, similarity) = default;
};

template <vocabulary V, class Beliefs>
using utility_part = std::variant<additive_utility<V, Beliefs>, pairwise_utility<V, Beliefs>,
                                  general_utility<V, Beliefs>, role_priorities, similarity>;

/// One part of a weighted sum. Each number that the part returns is multiplied by the weight before it is counted.
template <vocabulary V, class Beliefs>
struct weighted_part {
  double weight = 1;
  utility_part<V, Beliefs> part;
};

/// U_p = Σ weight·part. It is as hard to optimise as its hardest part.
template <vocabulary V, class Beliefs>
using weighted_sum = std::vector<weighted_part<V, Beliefs>>;

template <vocabulary V, class Beliefs>
using utility = std::variant<additive_utility<V, Beliefs>, pairwise_utility<V, Beliefs>, general_utility<V, Beliefs>,
                             weighted_sum<V, Beliefs>>;

/// Calls f(weight, part) for each part of U_p; what is no sum has one part of weight 1.
template <vocabulary V, class Beliefs, class F>
void for_each_part(utility<V, Beliefs> const& u, F&& f) {
  std::visit(
      [&](auto const& whole) {
        if constexpr (requires { whole.begin()->weight; }) {
          for (auto const& [weight, part] : whole) std::visit([&, w = weight](auto const& x) { f(w, x); }, part);
        } else {
          f(1.0, whole);
        }
      },
      u);
}

/// Whether there is anything to call in every part, and something at all.
template <vocabulary V, class Beliefs>
[[nodiscard]] bool callable(utility<V, Beliefs> const& u) {
  bool any = false;
  bool all = true;
  for_each_part<V, Beliefs>(u, [&](double, auto const& part) {
    any = true;
    if constexpr (requires { part.value; }) {
      all &= static_cast<bool>(part.value);
    } else if constexpr (requires { part.together; }) {
      all &= static_cast<bool>(part.together);
    } else if constexpr (requires { static_cast<bool>(part); }) {
      all &= static_cast<bool>(part);
    }
  });
  return any && all;
}

/// Neither NaN nor infinite. (The standard's is in `<cmath>`, which costs two thirds of `<vector>` to include.)
[[nodiscard]] constexpr bool is_finite(double x) noexcept { return x - x == 0; }

/// Whether every weight is a finite number.
template <vocabulary V, class Beliefs>
[[nodiscard]] bool weights_are_finite(utility<V, Beliefs> const& u) {
  bool all = true;
  for_each_part<V, Beliefs>(u, [&](double weight, auto const&) { all &= is_finite(weight); });
  return all;
}

}  // namespace rota
