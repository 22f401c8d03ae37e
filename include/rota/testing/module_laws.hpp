#pragma once

#include <rota/testing/structure_laws.hpp>
#include <rota/testing/values.hpp>

namespace rota::testing {

/// The structure of T and its multiples by integers, written `n * x`.
template <class T>
struct multiples : structure<T> {
  [[nodiscard]] static T scale(int n, T const& x) {
    if constexpr (requires { typename T::coefficient_type; })
      return static_cast<typename T::coefficient_type>(n) * x;
    else
      return n * x;
  }
};

/// unit, adds_scalars, adds_elements: T is a ℤ-module.
template <class T, class M = multiples<T>>
[[nodiscard]] bundle module_laws() {
  bundle laws("module");
  laws.add("unit", "1 d = d",
           [] {
             auto const d = draw<T>("d");
             detail::count_nontrivial<M>(d);
             same("1 d", M::scale(1, d), "d", d);
           },
           {detail::without_identity});
  laws.add("adds_scalars", "(m + n) d = m d + n d",
           [] {
             int const m = *integer(-5, 5).as("m");
             int const n = *integer(-5, 5).as("n");
             auto const d = draw<T>("d");
             detail::count_nontrivial<M>(d);
             same("(m + n) d", M::scale(m + n, d), "m d + n d", M::combine(M::scale(m, d), M::scale(n, d)));
           },
           {detail::without_identity});
  laws.add("adds_elements", "n (d + e) = n d + n e",
           [] {
             int const n = *integer(-5, 5).as("n");
             auto const d = draw<T>("d");
             auto const e = draw<T>("e");
             detail::count_nontrivial<M>(d, e);
             same("n (d + e)", M::scale(n, M::combine(d, e)), "n d + n e", M::combine(M::scale(n, d), M::scale(n, e)));
           },
           {detail::without_identity});
  return laws;
}
/// multiplies. It follows, because n d is the n-fold sum of d.
template <class T, class M = multiples<T>>
[[nodiscard]] bundle module_theorems() {
  bundle laws("module_theorems");
  laws.add("multiplies", "(m n) d = m (n d)",
           [] {
             int const m = *integer(-5, 5).as("m");
             int const n = *integer(-5, 5).as("n");
             auto const d = draw<T>("d");
             detail::count_nontrivial<M>(d);
             same("(m n) d", M::scale(m * n, d), "m (n d)", M::scale(m, M::scale(n, d)));
           },
           {detail::without_identity});
  return laws;
}

}  // namespace rota::testing
