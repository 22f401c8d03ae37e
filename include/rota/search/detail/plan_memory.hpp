#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/flow/solver.hpp>
#include <rota/dense/hidden.hpp>
#include <rota/dense/pairs/solver.hpp>
#include <rota/dense/ties.hpp>
#include <rota/dense/tree/solver.hpp>
#include <rota/search/detail/pair_tables.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rota::detail {

/// One plan in numbers, as it was when it was last searched, and the optima found then: a search repeats only what has
/// changed since.
///
/// Stays where it is: outcomes and tables refer to what lies beside them.
struct plan_memory {
  dense::buffer<dense::slot_bounds> bounds;  ///< of the tasks, idle last
  dense::buffer<std::int64_t> units;         ///< utilities less change costs, a row per agent, idle last
  dense::buffer<std::int64_t> keys;          ///< the same with ties broken
  dense::tie_rule ties;
  dense::buffer<dense::row_index> changed;  ///< rows that `flow` has not seen
  bool seen = false;                        ///< whether `flow` has seen all the others
  bool up_to_date = false;                  ///< whether the last search of the plan wrote `units`

  dense::flow_solver flow;
  dense::flow_outcome alone;  ///< of `flow`, on `keys` and `bounds`
  bool alone_holds = false;   ///< whether `alone` is proved for the numbers as they are

  pair_tables pairs;                  ///< what parts of U_p say of two agents, if these are few enough for tables
  dense::pair_outcome together;       ///< of the pairwise solver, on `units`, `pairs` and `bounds`
  dense::buffer<dense::slot> placed;  ///< its assignment
  bool together_holds = false;        ///< whether `together` is proved for the numbers as they are

  plan_memory() = default;
  plan_memory(plan_memory const&) = delete;
  plan_memory& operator=(plan_memory const&) = delete;

  /// Notes that numbers have changed, so no optimum found before holds.
  void outdate() noexcept { alone_holds = together_holds = false; }
  /// As `outdate`; and `flow` begins anew.
  void forget() noexcept {
    seen = false;
    outdate();
  }
};

/// What a workspace holds: a memory for each plan of the type, and buffers that all plans share.
struct search_state {
  std::vector<dense::hidden<plan_memory>> plans;  ///< in the order of the plan type
  dense::tree_solver tree;
  dense::pair_solver pairwise;
  dense::buffer<std::int64_t> most;      ///< see `completion_bound`
  dense::buffer<dense::row_index> twin;  ///< see `dense::tree_options`
  dense::buffer<dense::slot> now;        ///< see `plan_view::now`
  dense::buffer<dense::slot> best;       ///< the assignment of the best plan so far

  /// The memory of plan number i.
  [[nodiscard]] plan_memory& of_plan(std::size_t i) {
    if (plans.size() <= i) plans.resize(i + 1);
    return plans[i].made();
  }
};

}  // namespace rota::detail
