#pragma once

#include <rota/dense/limits.hpp>

#include <cstdint>
#include <limits>

namespace rota {

/// How much a search may do. Counted in steps, so that equal inputs give equal answers on every machine. A caller who has a
/// clock may set `stop`.
struct search_budget {
  /// Placements tried by branch and bound, over all plans of a type. Additive utilities without a precondition need none.
  std::uint64_t nodes = std::uint64_t{1} << 20;
  /// Arcs looked at for additive utilities, a plan. The default is enough for any team that decides within a tick.
  std::uint64_t relaxations = (std::numeric_limits<std::uint64_t>::max)();
  stop_request stop{};
  /// Whether to check a user's bound wherever it cuts: one of the allocations left out is evaluated and compared with it.
  /// Off by default, since it calls the user's functions once more for each cut; switch it on in tests of a bound.
  bool audit = false;

  friend bool operator==(search_budget const&, search_budget const&) = default;
};

/// What a search did, over all plans of a type.
using search_work = dense::work_done;

}  // namespace rota
