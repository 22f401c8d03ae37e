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

  /// @pre `has_value()`
  [[nodiscard]] constexpr T const& value() const& noexcept {
    auto const* v = std::get_if<0>(&state_);
    ROTA_ASSERT(v != nullptr);
    return *v;
  }
  [[nodiscard]] constexpr T& value() & noexcept {
    auto* v = std::get_if<0>(&state_);
    ROTA_ASSERT(v != nullptr);
    return *v;
  }
  [[nodiscard]] constexpr T&& value() && noexcept { return std::move(value()); }

  constexpr T const& operator*() const& noexcept { return value(); }
  constexpr T& operator*() & noexcept { return value(); }
  constexpr T&& operator*() && noexcept { return std::move(*this).value(); }
  constexpr T const* operator->() const noexcept { return &value(); }
  constexpr T* operator->() noexcept { return &value(); }

  /// @pre `!has_value()`
  [[nodiscard]] constexpr Refusal const& error() const noexcept {
    auto const* e = std::get_if<1>(&state_);
    ROTA_ASSERT(e != nullptr);
    return *e;
  }

  friend constexpr bool operator==(result const&, result const&) = default;

private:
  std::variant<T, Refusal> state_;
};

}  // namespace rota
