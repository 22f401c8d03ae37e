#pragma once

#include <rota/search/additive.hpp>
#include <rota/search/general.hpp>

#include <compare>
#include <cstdint>
#include <vector>

namespace rota {

/// How much a search may do. Time is not part of it: equal inputs give equal answers on every machine.
struct search_budget {
  /// Placements tried in tree search, over all plans of a type. Additive utilities without a precondition need none.
  std::uint64_t nodes = std::uint64_t{1} << 20;

  friend bool operator==(search_budget, search_budget) = default;
};

/// What a search did.
struct search_work {
  std::uint64_t nodes = 0;          ///< placements tried in tree search
  std::uint64_t augmentations = 0;  ///< paths pushed by the additive solver
  std::uint64_t relaxations = 0;    ///< arcs the additive solver looked at

  friend bool operator==(search_work, search_work) = default;
};

/// Buffers that searches reuse, so that a steady loop allocates nothing. It holds no result and influences none.
///
/// Grows to O(n·t + t²) integers for the largest problem it met, n agents and t tasks. One per thread.
class workspace {
public:
  dense::additive_solver additive;
  dense::tree_solver tree;
  std::vector<std::int64_t> utility;       ///< the matrix, row per agent, idle last
  std::vector<dense::slot_bounds> bounds;  ///< of the tasks, idle last
  std::vector<std::int64_t> suffix;        ///< additive bound of the agents from one on
  std::vector<dense::slot> candidate;      ///< the assignment found for the present plan
  std::vector<dense::slot> best;           ///< the assignment of the best plan so far
};

}  // namespace rota
