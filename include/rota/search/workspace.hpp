#pragma once

#include <rota/dense/hidden.hpp>
#include <rota/search/detail/plan_memory.hpp>

namespace rota {

namespace detail {
struct workspace_access;
}

/// Memory that searches reuse: a steady loop allocates nothing, and a search begins where the last one ended. No answer
/// depends on it, since optima are canonical; only the work does.
///
/// A copy starts empty, and so does a workspace after it was moved from. Use one per thread.
/// Grows to O(n·t + t²) integers a plan for the largest problem it met, n agents and t tasks, and O(n²·t²) where utilities
/// are pairwise. These also need a solver of up to 120 MB (see `dense::pair_solver`).
class workspace {
  friend struct detail::workspace_access;
  dense::hidden<detail::search_state> state_;
};

namespace detail {

/// The library's own way into a workspace.
struct workspace_access {
  [[nodiscard]] static search_state& open(workspace& w) { return w.state_.made(); }
};

}  // namespace detail

}  // namespace rota
