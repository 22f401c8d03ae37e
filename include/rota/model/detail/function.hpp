#pragma once

#include <concepts>
#include <functional>
#include <type_traits>
#include <utility>

namespace rota::detail {

/// Whether F can be stored and called as the signature says.
template <class F, class Signature>
inline constexpr bool fits = false;
template <class F, class R, class... Parameters>
inline constexpr bool fits<F, R(Parameters...)> =
    std::is_invocable_r_v<R, F&, Parameters...> && std::copy_constructible<F>;

/// Whether a callable that may be empty is: a null pointer, or an empty std::function.
template <class F>
[[nodiscard]] bool is_empty(F const& f) {
  if constexpr (std::is_function_v<F>) {
    return false;
  } else if constexpr (requires {
                         { f == nullptr } -> std::convertible_to<bool>;
                       }) {
    return f == nullptr;
  } else {
    return false;
  }
}

template <class Signature>
class function;

/// A copyable callable, or none: std::function, but it says which signature it wants when it is given something else, and
/// what is called writes its answer where the caller reads it. In two registers, as std::optional<double> is returned, it is
/// stored in two parts and loaded as one, which costs more than the call.
///
/// std::function only says that nothing converts, and a braced initialiser around it hides even that.
template <class R, class... Parameters>
class function<R(Parameters...)> {
public:
  function() = default;
  template <class F>
    requires(!std::same_as<std::remove_cvref_t<F>, function>)
  function(F&& f) {
    using callable = std::decay_t<F>;
    static_assert(fits<callable, R(Parameters...)>,
                  "this callable does not fit: the wanted signature is the `Signature` of rota::detail::function");
    if constexpr (fits<callable, R(Parameters...)>)
      if (!is_empty(f))
        call_ = [held = callable(std::forward<F>(f))](R& answer, Parameters... p) mutable {
          answer = static_cast<R>(std::invoke(held, std::forward<Parameters>(p)...));
        };
  }

  [[nodiscard]] explicit operator bool() const noexcept { return static_cast<bool>(call_); }
  /// @pre there is a callable
  R operator()(Parameters... p) const {
    R r{};
    answer(r, std::forward<Parameters>(p)...);
    return r;
  }
  /// The same, and the answer is written where it will be read. @pre there is a callable
  void answer(R& r, Parameters... p) const { call_(r, std::forward<Parameters>(p)...); }

private:
  std::function<void(R&, Parameters...)> call_;
};

}  // namespace rota::detail
