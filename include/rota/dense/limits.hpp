#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace rota {

/// A callable that a search asks now and then whether to stop. A view: the callable must outlive the search.
///
/// The library owns no clock, so deadlines are the caller's. The answer of a stopped search depends on when it was stopped;
/// everything else in the library depends on its inputs only.
class stop_request {
public:
  /// Asks nobody: the search is not stopped.
  constexpr stop_request() = default;
  template <class F>
    requires(!std::same_as<F, stop_request>) && requires(F const& f) { static_cast<bool>(f()); }
  constexpr stop_request(F const& asks) noexcept
      : asks_([](void const* f) { return static_cast<bool>((*static_cast<F const*>(f))()); }), callable_(&asks) {}
  /// A temporary would be gone when the search asks: give the callable a name.
  template <class F>
    requires(!std::is_lvalue_reference_v<F> && !std::same_as<std::remove_cv_t<F>, stop_request>)
  stop_request(F&& asks) = delete;

  [[nodiscard]] bool operator()() const { return asks_ != nullptr && asks_(callable_); }

  friend bool operator==(stop_request const&, stop_request const&) = default;

private:
  bool (*asks_)(void const*) = nullptr;
  void const* callable_ = nullptr;
};

namespace dense {

/// When a solver gives up proving: after about `steps` steps, or when `stop` says so.
///
/// A step is:
/// - `flow_solver`: an arc that a shortest-path search looks at (`work_done::relaxations`); finding the first prices is free.
///   It asks `stop` before each search.
/// - `tree_solver`: a placement tried (`work_done::nodes`). It asks `stop` every 1024 steps.
/// - `pair_solver`: a placement tried, for bounds and for ties included (`work_done::nodes`). It asks `stop` every few
///   hundred steps.
/// Every machine counts the same steps: so `steps`, unlike `stop`, cuts an answer short in the same place everywhere.
struct work_limit {
  std::uint64_t steps = (std::numeric_limits<std::uint64_t>::max)();
  stop_request stop{};
};

/// The work of one search. Unlike the answer, it may depend on earlier searches. What a solver does not count stays 0.
struct work_done {
  std::uint64_t nodes = 0;          ///< placements tried by branch and bound
  std::uint64_t leaves = 0;         ///< complete assignments evaluated
  std::uint64_t pruned = 0;         ///< subtrees skipped: nothing in them could be better, or valid
  std::uint64_t searches = 0;       ///< shortest-path searches
  std::uint64_t augmentations = 0;  ///< moves of an agent, or of a chain of agents
  std::uint64_t relaxations = 0;    ///< arcs looked at
  std::uint64_t changed_rows = 0;   ///< rows named as changed by the caller of a warm search

  constexpr work_done& operator+=(work_done const& more) noexcept {
    nodes += more.nodes;
    leaves += more.leaves;
    pruned += more.pruned;
    searches += more.searches;
    augmentations += more.augmentations;
    relaxations += more.relaxations;
    changed_rows += more.changed_rows;
    return *this;
  }
  friend bool operator==(work_done const&, work_done const&) = default;
};

}  // namespace dense

}  // namespace rota
