#pragma once

#include <rota/testing/structure_laws.hpp>

#include <functional>

namespace rota::testing {

/// preserves_product, preserves_identity and, if there are inverses, preserves_inverse; for a function f from the
/// structure S on T to the structure R on U. Between groups, the first implies the others.
template <class T, class U, class S = structure<T>, class R = structure<U>>
[[nodiscard]] bundle homomorphism_laws(std::function<U(T const&)> f) {
  bundle laws("homomorphism");
  laws.add_closure("preserves_product", "f(x·y) = f(x)·f(y)",
                   [f] {
                     auto const x = draw<T>("x");
                     auto const y = draw<T>("y");
                     detail::count_nontrivial<S>(x, y);
                     same("f(x·y)", f(S::combine(x, y)), "f(x)·f(y)", R::combine(f(x), f(y)));
                   },
                   {detail::without_identity});
  laws.add_closure("preserves_identity", "f(1) = 1", [f] {
    (void)draw<T>("x");
    same("f(1)", f(S::identity()), "1", R::identity());
  });
  if constexpr (requires(T const& x, U const& y) { S::inverse(x), R::inverse(y); })
    laws.add_closure("preserves_inverse", "f(x⁻¹) = f(x)⁻¹",
                     [f] {
                       auto const x = draw<T>("x");
                       detail::count_nontrivial<S>(x);
                       same("f(x⁻¹)", f(S::inverse(x)), "f(x)⁻¹", R::inverse(f(x)));
                     },
                     {detail::without_identity});
  return laws;
}

}  // namespace rota::testing
