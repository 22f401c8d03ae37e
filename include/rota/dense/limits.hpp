#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace rota {

/// A question that a search asks now and then: shall it stop? A view of a callable, which must outlive the search.
///
/// The library owns no clock, so the caller answers for a deadline. What a stopped search found depends on when it was
/// stopped; everything else in the library depends on its inputs only.
class stop_request {
public:
  /// Never asks.
  constexpr stop_request() = default;
  template <class F>
    requires(!std::same_as<F, stop_request>) && requires(F const& f) { static_cast<bool>(f()); }
  constexpr stop_request(F const& asks) noexcept
      : asks_([](void const* f) { return static_cast<bool>((*static_cast<F const*>(f))()); }), callable_(&asks) {}
  /// A temporary would be gone before the search asks: give the callable a name.
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

/// When a solver gives up proving: after so many steps (each solver says what a step is), or when asked to stop.
struct work_limit {
  std::uint64_t steps = (std::numeric_limits<std::uint64_t>::max)();
  stop_request stop{};
};

/// What a solver did. Work, unlike an answer, may depend on what the solver has seen before. Fields that a solver does not
/// count stay 0.
struct work_done {
  std::uint64_t nodes = 0;          ///< placements tried by branch and bound
  std::uint64_t leaves = 0;         ///< complete assignments evaluated
  std::uint64_t pruned = 0;         ///< subtrees left because nothing in them could be better, or valid
  std::uint64_t searches = 0;       ///< shortest-path searches
  std::uint64_t augmentations = 0;  ///< agents, or chains of agents, moved
  std::uint64_t relaxations = 0;    ///< arcs looked at
  std::uint64_t changed_rows = 0;   ///< agents whose utilities differ from the last time; all, where it began anew

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
