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

private:
  bool (*asks_)(void const*) = nullptr;
  void const* callable_ = nullptr;
};

namespace dense {

/// When a solver gives up proving: after so many steps (each says what a step is), or when asked to stop.
struct work_limit {
  std::uint64_t steps = std::numeric_limits<std::uint64_t>::max();
  stop_request stop{};
};

}  // namespace dense
}  // namespace rota
