#pragma once

#include <rota/allocation/utility.hpp>
#include <rota/core/small_vector.hpp>
#include <rota/search/limits.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace rota {

/// The second best plan of a type, at the best allocation found for it: its own best, unless the budget ran out.
template <vocabulary V>
struct runner_up {
  typename V::plan plan{};
  double utility = 0;
  double distance = 0;  ///< how much less it is worth than the best, change costs counted

  friend bool operator==(runner_up const&, runner_up const&) = default;
};

/// A user's bound that was less than the value of an allocation it should have bounded.
template <vocabulary V>
struct bound_lie {
  typename V::plan plan{};
  allocation_atoms<V> partial;   ///< what was decided
  std::size_t undecided = 0;     ///< how many participants were not, the last ones
  allocation_atoms<V> complete;  ///< an extension of it that is worth more
  double bound = 0;
  double value = 0;

  friend bool operator==(bound_lie const&, bound_lie const&) = default;
};

/// The best valid allocation over all plans of a type.
template <vocabulary V = runtime_vocabulary>
struct solution {
  typename V::plan plan{};
  allocation_atoms<V> atoms;
  double utility = 0;         ///< U_p of `atoms`, exactly the fixed-point value (up to 2^33)
  fixed_utility exact{};      ///< the same, for comparisons
  fixed_utility objective{};  ///< the same less change costs: what was maximised
  std::size_t changes = 0;    ///< participants who do something else than in `problem::current`
  /// Proved: no valid allocation of any plan is better, nor preferred among equals. False only if the budget ran out, a
  /// bound lied, or the utilities of another plan were too great.
  bool proved = false;
  /// Proved: no valid allocation is better by more than this. May be 0 without `proved`: then an equally good allocation
  /// may be preferred.
  double gap = 0;
  search_work work{};
  std::optional<rota::runner_up<V>> runner_up{};
  /// The first term or total left out because it is no utility (NaN, ±∞, out of range, threw). Allocations that need it
  /// are invalid, so the result is correct; your utility function needs fixing.
  std::optional<utility_refusal<V>> ignored{};
  /// The first bound that was seen to be too low. The allocation is valid all the same, but nothing is proved.
  std::optional<bound_lie<V>> lie{};

  friend bool operator==(solution const&, solution const&) = default;
};

/// Why a plan has no valid allocation, or none that was found.
enum class no_plan_reason : unsigned char {
  contradictory_cardinalities,  ///< the tasks' bounds sum to `count` agents, which the team size `bounds` never admits
  too_few_agents,               ///< `count` take part, `bounds.lower()` are needed
  too_many_agents,              ///< `count` take part, nobody may idle, and there is room for `bounds.upper()`
  task_short,                   ///< `count` agents may take on `task`, which needs `bounds`
  agent_without_task,           ///< `agent` may neither take on any task nor idle
  pairs_contradict,  ///< each agent and task alone could be served, but not all; one left over: `agent` or `task`
  utility_refused,   ///< every allocation needs a utility that is none: `fault`, at `agent` and `task` if it is theirs
  precondition_never_holds,  ///< Pre(p) is false on every allocation that is valid otherwise
  precondition_threw,        ///< the same, but on some allocations Pre(p) threw
  negative_utility,          ///< U_p is at most `value` < 0 on every allocation: clause (6)
  search_incomplete,         ///< the budget ran out, or a bound lied, before a valid allocation was found
  utilities_too_great,       ///< not searched: the utilities of `agent` are too great to sum so many exactly
  change_cost_refused        ///< not searched: `problem::change_cost` is negative or cannot be counted, see `fault`
};

/// Why one plan yields nothing, with its witness. Fields that a reason does not mention keep their default.
template <vocabulary V = runtime_vocabulary>
struct plan_refusal {
  typename V::plan plan{};
  no_plan_reason reason{};
  typename V::agent agent{};
  typename V::task task{};
  bool about_atom = false;  ///< utility_refused: whether the fault is that of `agent` on `task`
  bool about_pair = false;  ///< utility_refused: whether it is that of both together with `other`
  in<V> other{};
  std::uint64_t count = 0;
  cardinality bounds{};
  utility_fault fault{};
  double value = 0;

  /// Whether it is proved that the plan has no valid allocation.
  [[nodiscard]] constexpr bool proved() const noexcept {
    return reason != no_plan_reason::search_incomplete && reason != no_plan_reason::utilities_too_great &&
           reason != no_plan_reason::change_cost_refused;
  }

  friend bool operator==(plan_refusal const&, plan_refusal const&) = default;
};

/// Refusal: no plan of the type has a valid allocation, or none was found within the budget.
template <vocabulary V = runtime_vocabulary>
struct no_allocation {
  small_vector<plan_refusal<V>, 2> plans;  ///< one per plan, ascending
  search_work work{};
  std::optional<utility_refusal<V>> ignored{};  ///< as in `solution`
  std::optional<bound_lie<V>> lie{};            ///< as in `solution`: then there may be a valid allocation

  /// Whether it is proved that no allocation is valid.
  [[nodiscard]] constexpr bool proved() const noexcept {
    for (auto const& p : plans)
      if (!p.proved()) return false;
    return true;
  }

  friend bool operator==(no_allocation const&, no_allocation const&) = default;
};

}  // namespace rota
