#pragma once

#include <rota/core/assert.hpp>

#include <utility>
#include <variant>

namespace rota {

/// Marks the refusal branch while building a `result`: `return refused{overlap{x}};`.
template <class Refusal>
struct refused {
  Refusal why;
};

template <class Refusal>
refused(Refusal) -> refused<Refusal>;

/// A value, or a typed refusal that says why there is none.
///
/// The set T + Refusal. C++20 has no `std::expected`; this is the part of it the library needs. Never throws of itself.
template <class T, class Refusal>
class [[nodiscard]] result {
public:
  using value_type = T;
  using refusal_type = Refusal;

  constexpr result(T value) : state_{std::in_place_index<0>, std::move(value)} {}
  constexpr result(refused<Refusal> r) : state_{std::in_place_index<1>, std::move(r.why)} {}

  [[nodiscard]] constexpr bool has_value() const noexcept { return state_.index() == 0; }
  constexpr explicit operator bool() const noexcept { return has_value(); }

  // get, not get_if: for g++ 12 the address of a temporary is no constant, so `*f()` would be no constant expression.

  /// @pre `has_value()`
  [[nodiscard]] constexpr T const& value() const& noexcept {
    ROTA_ASSERT(has_value());
    return std::get<0>(state_);
  }
  [[nodiscard]] constexpr T& value() & noexcept {
    ROTA_ASSERT(has_value());
    return std::get<0>(state_);
  }
  [[nodiscard]] constexpr T&& value() && noexcept { return std::move(value()); }

  constexpr T const& operator*() const& noexcept { return value(); }
  constexpr T& operator*() & noexcept { return value(); }
  constexpr T&& operator*() && noexcept { return std::move(*this).value(); }
  constexpr T const* operator->() const noexcept { return &value(); }
  constexpr T* operator->() noexcept { return &value(); }

  /// @pre `!has_value()`
  [[nodiscard]] constexpr Refusal const& error() const noexcept {
    ROTA_ASSERT(!has_value());
    return std::get<1>(state_);
  }

  friend bool operator==(result const&, result const&) = default;

private:
  std::variant<T, Refusal> state_;
};

}  // namespace rota
