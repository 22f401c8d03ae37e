#pragma once

#include <concepts>
#include <new>
#include <type_traits>
#include <utility>

/// A value or a refusal in one place, for `result`. Not std::variant, which g++ 11 and clang 16 refuse in constant
/// expressions; not two std::optional, which take the room of both and cost a sum of small deltas 6 %.

namespace rota::detail {

struct as_value {};
struct as_refusal {};

template <class T, class Refusal>
inline constexpr bool copied_as_bytes = std::is_trivially_copyable_v<T> && std::is_trivially_copyable_v<Refusal>;

/// One of the two is alive; `either` knows which.
template <class T, class Refusal, bool = copied_as_bytes<T, Refusal>>
union one_of {
  T value;
  Refusal refusal;

  template <class X>
  constexpr one_of(as_value, X&& x) : value(std::forward<X>(x)) {}
  template <class X>
  constexpr one_of(as_refusal, X&& x) : refusal(std::forward<X>(x)) {}
};
template <class T, class Refusal>
union one_of<T, Refusal, false> {
  T value;
  Refusal refusal;

  template <class X>
  constexpr one_of(as_value, X&& x) : value(std::forward<X>(x)) {}
  template <class X>
  constexpr one_of(as_refusal, X&& x) : refusal(std::forward<X>(x)) {}
  one_of(one_of const&) = delete;
  one_of& operator=(one_of const&) = delete;
  constexpr ~one_of() {}
};

/// `one_of`, and which one. Two specialisations, because clang 15 knows no destructor that is trivial under a condition.
template <class T, class Refusal, bool = copied_as_bytes<T, Refusal>>
struct either {
  one_of<T, Refusal> held;
  bool has_value;

  template <class X>
  constexpr either(as_value tag, X&& x) : held(tag, std::forward<X>(x)), has_value(true) {}
  template <class X>
  constexpr either(as_refusal tag, X&& x) : held(tag, std::forward<X>(x)), has_value(false) {}
};
template <class T, class Refusal>
struct either<T, Refusal, false> {
  one_of<T, Refusal> held;
  bool has_value;

  static constexpr bool copyable = std::copy_constructible<T> && std::copy_constructible<Refusal>;
  static constexpr bool nothrow_movable =
      std::is_nothrow_move_constructible_v<T> && std::is_nothrow_move_assignable_v<T> &&
      std::is_nothrow_move_constructible_v<Refusal> && std::is_nothrow_move_assignable_v<Refusal>;

  template <class X>
  constexpr either(as_value tag, X&& x) : held(tag, std::forward<X>(x)), has_value(true) {}
  template <class X>
  constexpr either(as_refusal tag, X&& x) : held(tag, std::forward<X>(x)), has_value(false) {}

  constexpr either(either const& other)
    requires copyable
      : held(made_from(other)), has_value(other.has_value) {}
  constexpr either(either&& other) noexcept(nothrow_movable)
      : held(made_from(std::move(other))), has_value(other.has_value) {}
  constexpr either& operator=(either const& other)
    requires copyable
  {
    return *this = either(other);
  }
  constexpr either& operator=(either&& other) noexcept(nothrow_movable) {
    if (has_value && other.has_value) {
      held.value = std::move(other.held.value);
    } else if (!has_value && !other.has_value) {
      held.refusal = std::move(other.held.refusal);
    } else {
      replace(std::move(other));
    }
    return *this;
  }
  constexpr ~either() { destroy(); }

private:
  template <class Other>
  static constexpr one_of<T, Refusal> made_from(Other&& other) {
    if (other.has_value) return one_of<T, Refusal>(as_value{}, std::forward<Other>(other).held.value);
    return one_of<T, Refusal>(as_refusal{}, std::forward<Other>(other).held.refusal);
  }
  void replace(either&& other) noexcept {  // ends the program if moving throws, since then neither would be alive
    destroy();
    ::new (static_cast<void*>(&held)) one_of<T, Refusal>(made_from(std::move(other)));
    has_value = other.has_value;
  }
  constexpr void destroy() noexcept {
    if (has_value)
      held.value.~T();
    else
      held.refusal.~Refusal();
  }
};

}  // namespace rota::detail
