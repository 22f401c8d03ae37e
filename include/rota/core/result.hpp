#pragma once

#include <rota/core/assert.hpp>
#include <rota/core/detail/either.hpp>

#include <concepts>
#include <cstdlib>
#include <utility>

namespace rota {

/// Marks the refusal branch while building a `result`: `return refused{overlap{x}};`.
template <class Refusal>
struct refused {
  Refusal reason;
};

template <class Refusal>
refused(Refusal) -> refused<Refusal>;

namespace detail {

/// The name of T, within a sentence of the compiler's.
template <class T>
[[nodiscard]] constexpr char const* type_name() noexcept {
#if defined(__GNUC__)
  return __PRETTY_FUNCTION__;
#else
  return "?";
#endif
}

/// Ends the program and says which refusal was taken for a value. Also without assertions: nothing right could follow.
template <class Refusal>
[[noreturn]] void no_value(Refusal const& reason) noexcept {
  ROTA_REPORT("rota: there is no value, the result was refused: ");
  if constexpr (requires { static_cast<char const*>(reason_of(reason)); })
    ROTA_REPORT(static_cast<char const*>(reason_of(reason)));
  else
    ROTA_REPORT(type_name<Refusal>());
  ROTA_REPORT("\n");
  [[maybe_unused]] constexpr bool has_value = false;
  ROTA_ASSERT(has_value);
  std::abort();
}

[[noreturn]] inline void no_refusal() noexcept {
  ROTA_REPORT("rota: there is no refusal, the result has a value\n");
  [[maybe_unused]] constexpr bool has_value = true;
  ROTA_ASSERT(!has_value);
  std::abort();
}

}  // namespace detail

/// A value, or a typed refusal that says why there is none.
///
/// The set T + Refusal. C++20 has no `std::expected`; this is the part of it that the library needs. It throws nothing
/// of its own. Taking the value of a refused one ends the program and names the refusal: by the text of
/// `reason_of(refusal)`, where a `char const* reason_of(Refusal const&)` stands beside its type, else by the name of
/// the type.
template <class T, class Refusal>
class [[nodiscard]] result {
public:
  using value_type = T;
  using refusal_type = Refusal;

  constexpr result(T value) : state_(detail::as_value{}, std::move(value)) {}
  constexpr result(refused<Refusal> r) : state_(detail::as_refusal{}, std::move(r.reason)) {}

  [[nodiscard]] constexpr bool has_value() const noexcept { return state_.has_value; }
  constexpr explicit operator bool() const noexcept { return has_value(); }

  /// @pre `has_value()`
  [[nodiscard]] constexpr T const& value() const& noexcept {
    if (!state_.has_value) detail::no_value(state_.held.refusal);
    return state_.held.value;
  }
  [[nodiscard]] constexpr T& value() & noexcept {
    if (!state_.has_value) detail::no_value(state_.held.refusal);
    return state_.held.value;
  }
  [[nodiscard]] constexpr T&& value() && noexcept { return std::move(value()); }

  constexpr T const& operator*() const& noexcept { return value(); }
  constexpr T& operator*() & noexcept { return value(); }
  constexpr T&& operator*() && noexcept { return std::move(*this).value(); }
  constexpr T const* operator->() const noexcept { return &value(); }
  constexpr T* operator->() noexcept { return &value(); }

  /// @pre `!has_value()`
  [[nodiscard]] constexpr Refusal const& error() const noexcept {
    if (state_.has_value) detail::no_refusal();
    return state_.held.refusal;
  }

  friend constexpr bool operator==(result const& a, result const& b)
    requires std::equality_comparable<T> && std::equality_comparable<Refusal>
  {
    if (a.has_value() != b.has_value()) return false;
    return a.has_value() ? a.state_.held.value == b.state_.held.value : a.error() == b.error();
  }

private:
  detail::either<T, Refusal> state_;
};

}  // namespace rota
