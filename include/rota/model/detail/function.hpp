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

/// A std::function that says which signature it wants when it is given something else.
///
/// std::function only says that nothing converts, and a braced initialiser around it hides even that.
template <class Signature>
class function : public std::function<Signature> {
public:
  function() = default;
  template <class F>
    requires(!std::derived_from<std::remove_cvref_t<F>, function>)
  function(F&& f) {
    static_assert(fits<std::decay_t<F>, Signature>,
                  "this callable does not fit: the wanted signature is the `Signature` of rota::detail::function");
    if constexpr (fits<std::decay_t<F>, Signature>) static_cast<std::function<Signature>&>(*this) = std::forward<F>(f);
  }
};

}  // namespace rota::detail
