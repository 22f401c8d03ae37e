#pragma once

#include <cstdint>
#include <limits>

namespace rota {

/// A question a search asks now and then: shall it stop? A view of a callable, which must outlive the search.
///
/// The library owns no clock, so a deadline is a question the caller answers. What a stopped search found depends on when it
/// was stopped; everything else in the library depends on its inputs only.
class stop_request {
public:
  /// Never asks.
  constexpr stop_request() = default;
  template <class F>
    requires requires(F const& f) { static_cast<bool>(f()); }
  constexpr stop_request(F const& asks) noexcept
      : asks_([](void const* f) { return static_cast<bool>((*static_cast<F const*>(f))()); }), callable_(&asks) {}

  [[nodiscard]] bool operator()() const { return asks_ != nullptr && asks_(callable_); }

  friend bool operator==(stop_request const&, stop_request const&) = default;

private:
  bool (*asks_)(void const*) = nullptr;
  void const* callable_ = nullptr;
};

namespace dense {

/// When a solver gives up proving: after so many steps (each says what a step is), or when asked to stop.
struct work_limit {
  std::uint64_t steps = (std::numeric_limits<std::uint64_t>::max)();
  stop_request stop{};
};

}  // namespace dense

/// How much a search may do. Counted in steps, so that equal inputs give equal answers on every machine; who has a clock may
/// set `stop`.
struct search_budget {
  /// Placements tried by branch and bound, over all plans of a type. Additive utilities without a precondition need none.
  std::uint64_t nodes = std::uint64_t{1} << 20;
  /// Arcs looked at for additive utilities, a plan. Enough for any team that decides within a tick.
  std::uint64_t relaxations = (std::numeric_limits<std::uint64_t>::max)();
  stop_request stop{};
  /// Whether a user's bound is checked where it cuts: one of the allocations it leaves out is evaluated.
#ifdef NDEBUG
  bool audit = false;
#else
  bool audit = true;
#endif

  friend bool operator==(search_budget const&, search_budget const&) = default;
};

/// What a search did. Work, unlike an answer, may depend on what the workspace has seen before.
struct search_work {
  std::uint64_t nodes = 0;          ///< placements tried by branch and bound
  std::uint64_t leaves = 0;         ///< complete allocations evaluated
  std::uint64_t pruned = 0;         ///< subtrees left because nothing in them could be better, or valid
  std::uint64_t searches = 0;       ///< shortest-path searches of the additive solver
  std::uint64_t augmentations = 0;  ///< agents, or chains of agents, it moved
  std::uint64_t relaxations = 0;    ///< arcs it looked at
  std::uint64_t changed_rows = 0;   ///< agents whose utilities differ from the last time; all, where it began anew

  friend bool operator==(search_work const&, search_work const&) = default;
};

}  // namespace rota
