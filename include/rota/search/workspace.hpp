#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/flow/solver.hpp>
#include <rota/dense/pairs/solver.hpp>
#include <rota/dense/ties.hpp>
#include <rota/dense/tree/solver.hpp>
#include <rota/search/limits.hpp>
#include <rota/search/pair_tables.hpp>

#include <cstdint>
#include <vector>

namespace rota {

/// One plan in dense numbers, as it was when it was last searched: what has not changed need not be searched again.
struct plan_memory {
  dense::buffer<dense::slot_bounds> bounds;  ///< of the tasks, idle last
  dense::buffer<std::int64_t> units;         ///< utilities less change costs, row per agent, idle last
  dense::buffer<std::int64_t> keys;          ///< the same with ties broken
  dense::tie_rule ties;
  dense::buffer<dense::row_index> changed;  ///< rows that the solver has not seen
  bool seen = false;                        ///< whether it has seen all the others
  dense::flow_solver solver;
  dense::flow_outcome last;  ///< of the solver, on `keys` and `bounds`
  bool solved = false;       ///< whether it still holds

  dense::pair_tables pairs;           ///< what parts of U_p say of two agents, where they are not too many
  dense::pair_outcome together;       ///< of the pairwise solver, on `units`, `pairs` and `bounds`
  dense::buffer<dense::slot> placed;  ///< its assignment
  bool settled = false;               ///< whether both still hold
};

/// Buffers that searches reuse, so that solving allocates nothing in a steady loop and begins where it ended. An answer never depends
/// on it: optima are canonical.
///
/// Grows to O(n·t + t²) integers a plan for the largest problem it met, n agents and t tasks, and O(n²·t²) where utilities
/// are pairwise; for these a solver besides, with up to 120 MB (see `dense::pair_solver`). One per thread.
class workspace {
public:
  std::vector<plan_memory> plans;  ///< by their order in the plan type
  dense::tree_solver tree;
  dense::pair_solver pairwise;
  dense::buffer<std::int64_t> row;       ///< one agent's utilities
  dense::buffer<std::int64_t> most;      ///< what the agents from one on add at most, at the prices of the slots
  dense::buffer<dense::row_index> twin;  ///< see `dense::tree_options`
  dense::buffer<std::uint64_t> kind;     ///< of each agent, as the utility says
  dense::buffer<dense::slot> now;        ///< what each agent does, as a slot
  dense::buffer<dense::slot> candidate;  ///< the assignment found for the present plan
  dense::buffer<dense::slot> best;       ///< the assignment of the best plan so far
};

}  // namespace rota
