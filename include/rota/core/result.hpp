#pragma once

#include <rota/core/assert.hpp>

#include <optional>
#include <utility>

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

  constexpr result(T value) : value_(std::move(value)) {}
  constexpr result(refused<Refusal> r) : refusal_(std::move(r.why)) {}

  [[nodiscard]] constexpr bool has_value() const noexcept { return value_.has_value(); }
  constexpr explicit operator bool() const noexcept { return has_value(); }

  /// @pre `has_value()`
  [[nodiscard]] constexpr T const& value() const& noexcept {
    ROTA_ASSERT(has_value());
    return *value_;
  }
  [[nodiscard]] constexpr T& value() & noexcept {
    ROTA_ASSERT(has_value());
    return *value_;
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
    return *refusal_;
  }

  friend bool operator==(result const&, result const&) = default;

private:
  // Exactly one holds a value. A std::variant would be smaller, but g++ 11 and clang 16 refuse it in constant expressions.
  std::optional<T> value_;
  std::optional<Refusal> refusal_;
};

}  // namespace rota
