#pragma once

#include <rota/core/finite.hpp>
#include <rota/model/utility.hpp>

#include <cstddef>
#include <utility>
#include <variant>

namespace rota::detail {

/// Calls f with what the variant holds; std::visit takes longer to compile. @pre the variant holds something
template <class Variant, class F>
void with_held(Variant const& v, F&& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (void)((v.index() == I && (f(*std::get_if<I>(&v)), true)) || ...);
  }(std::make_index_sequence<std::variant_size_v<Variant>>{});
}

/// Calls f(weight, part) for each part of U_p. A utility that is not a `weighted_sum` is one part of weight 1.
template <vocabulary V, class Beliefs, class F>
void for_each_part(utility<V, Beliefs> const& u, F&& f) {
  with_held(u.form(), [&](auto const& whole) {
    if constexpr (requires { whole.begin()->weight; }) {
      for (auto const& [weight, part] : whole) with_held(part.form(), [&, w = weight](auto const& x) { f(w, x); });
    } else {
      f(1.0, whole);
    }
  });
}

/// True if there is a part and every part has a callable.
template <vocabulary V, class Beliefs>
[[nodiscard]] bool callable(utility<V, Beliefs> const& u) {
  bool any = false;
  bool all = true;
  for_each_part(u, [&](double, auto const& part) {
    any = true;
    if constexpr (requires { part.value; }) {
      all &= static_cast<bool>(part.value);
    } else if constexpr (requires { part.together; }) {
      all &= static_cast<bool>(part.together);
    } else if constexpr (requires { static_cast<bool>(part); }) {
      all &= static_cast<bool>(part);
    }
  });
  return any && all;
}

template <vocabulary V, class Beliefs>
[[nodiscard]] bool weights_are_finite(utility<V, Beliefs> const& u) {
  bool all = true;
  for_each_part(u, [&](double weight, auto const&) { all &= is_finite(weight); });
  return all;
}

}  // namespace rota::detail
