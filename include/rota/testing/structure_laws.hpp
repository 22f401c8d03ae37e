#pragma once
/// @file
/// The laws of structures with one total operation. `S` is the structure that is tested: `structure<T>`, unless a test
/// names another, such as a wrong one. So one type T serves for many structures.
///
/// Bundles called `…_laws` hold axioms in their usual form. Some follow from others if the operation commutes or
/// associates, as left from right, or the involution of the inverse. Bundles called `…_theorems` hold consequences, as
/// a second look at an implementation. If a theorem fails, so does an axiom.

#include <rota/algebra/structures.hpp>
#include <rota/testing/law.hpp>

namespace rota::testing {

/// The class invariant of T, which operations must keep. Specialise it with `static bool holds(T const&)`, or give
/// `structure<T>` a `static bool valid(T const&)`.
template <class T>
struct class_invariant;

namespace detail {

template <class T, class S>
concept with_invariant =
    requires(T const& x) { S::valid(x); } || requires(T const& x) { class_invariant<T>::holds(x); };

template <class S, class T>
void demand_valid(char const* name, T const& x) {
  bool valid = false;
  if constexpr (requires { S::valid(x); })
    valid = S::valid(x);
  else
    valid = class_invariant<T>::holds(x);
  if (!valid) refute(std::string(name) + " is " + rc::toString(x) + ", which breaks the class invariant");
}

/// Cases in which an operand is the identity test little.
constexpr share without_identity{"no operand is the identity", 10};
template <class S, class... T>
void count_nontrivial(T const&... operands) {
  bool nontrivial = true;
  if constexpr (requires { S::identity(); }) nontrivial = !(... || (operands == S::identity()));
  interesting(nontrivial, without_identity.what);
}

}  // namespace detail

/// closed (if T has a class invariant), well_defined.
template <class T, class S = structure<T>>
[[nodiscard]] bundle magma_laws() {
  bundle laws("magma");
  if constexpr (detail::with_invariant<T, S>)
    laws.add("closed", "x·y, the identity and inverses are valid", [] {
      auto const x = draw<T>("x");
      auto const y = draw<T>("y");
      detail::demand_valid<S>("x", x);
      detail::demand_valid<S>("x·y", S::combine(x, y));
      if constexpr (requires { S::identity(); }) detail::demand_valid<S>("the identity", S::identity());
      if constexpr (requires { S::inverse(x); }) detail::demand_valid<S>("x⁻¹", S::inverse(x));
    });
  laws.add("well_defined", "x = x′ ⇒ x·y = x′·y and y·x = y·x′", [] {
    auto const x = draw<T>("x");
    auto const y = draw<T>("y");
    auto const demand = [&](T const& other) {
      same("x·y", S::combine(x, y), "x′·y", S::combine(other, y));
      same("y·x", S::combine(y, x), "y·x′", S::combine(y, other));
    };
    demand(T(x));
    // Equal values may be stored differently if they were made differently.
    if (auto const drawn = draw<T>("x′"); drawn == x) demand(drawn);
    if constexpr (requires { S::identity(); })
      if (auto const made = S::combine(x, S::identity()); made == x) demand(made);
  });
  return laws;
}

/// magma, left_identity, right_identity.
template <class T, class S = structure<T>>
[[nodiscard]] bundle unital_magma_laws() {
  bundle laws("unital_magma");
  laws.merge(magma_laws<T, S>());
  laws.add("left_identity", "1·x = x",
           [] {
             auto const x = draw<T>("x");
             detail::count_nontrivial<S>(x);
             same("1·x", S::combine(S::identity(), x), "x", x);
           },
           {detail::without_identity});
  laws.add("right_identity", "x·1 = x",
           [] {
             auto const x = draw<T>("x");
             detail::count_nontrivial<S>(x);
             same("x·1", S::combine(x, S::identity()), "x", x);
           },
           {detail::without_identity});
  return laws;
}

/// magma, commutative.
template <class T, class S = structure<T>>
[[nodiscard]] bundle commutative_magma_laws() {
  bundle laws("commutative_magma");
  laws.merge(magma_laws<T, S>());
  laws.add("commutative", "x·y = y·x",
           [] {
             auto const x = draw<T>("x");
             auto const y = draw<T>("y");
             detail::count_nontrivial<S>(x, y);
             same("x·y", S::combine(x, y), "y·x", S::combine(y, x));
           },
           {detail::without_identity});
  return laws;
}

/// unital_magma, left_inverse, right_inverse, inverse_involution.
template <class T, class S = structure<T>>
[[nodiscard]] bundle invertible_magma_laws() {
  bundle laws("invertible_magma");
  laws.merge(unital_magma_laws<T, S>());
  laws.add("left_inverse", "x⁻¹·x = 1",
           [] {
             auto const x = draw<T>("x");
             detail::count_nontrivial<S>(x);
             same("x⁻¹·x", S::combine(S::inverse(x), x), "1", S::identity());
           },
           {detail::without_identity});
  laws.add("right_inverse", "x·x⁻¹ = 1",
           [] {
             auto const x = draw<T>("x");
             detail::count_nontrivial<S>(x);
             same("x·x⁻¹", S::combine(x, S::inverse(x)), "1", S::identity());
           },
           {detail::without_identity});
  laws.add("inverse_involution", "(x⁻¹)⁻¹ = x",
           [] {
             auto const x = draw<T>("x");
             detail::count_nontrivial<S>(x);
             same("(x⁻¹)⁻¹", S::inverse(S::inverse(x)), "x", x);
           },
           {detail::without_identity});
  return laws;
}

/// unital_magma, associative.
template <class T, class S = structure<T>>
[[nodiscard]] bundle monoid_laws() {
  bundle laws("monoid");
  laws.merge(unital_magma_laws<T, S>());
  laws.add("associative", "(x·y)·z = x·(y·z)",
           [] {
             auto const x = draw<T>("x");
             auto const y = draw<T>("y");
             auto const z = draw<T>("z");
             detail::count_nontrivial<S>(x, y, z);
             same("(x·y)·z", S::combine(S::combine(x, y), z), "x·(y·z)", S::combine(x, S::combine(y, z)));
           },
           {detail::without_identity});
  return laws;
}

/// monoid and invertible_magma.
template <class T, class S = structure<T>>
[[nodiscard]] bundle group_laws() {
  return bundle("group").merge(monoid_laws<T, S>()).merge(invertible_magma_laws<T, S>());
}

/// group and commutative_magma.
template <class T, class S = structure<T>>
[[nodiscard]] bundle abelian_group_laws() {
  return bundle("abelian_group").merge(group_laws<T, S>()).merge(commutative_magma_laws<T, S>());
}

/// cancellative, only_identity_is_idempotent, inverse_of_product. They hold in every group.
template <class T, class S = structure<T>>
[[nodiscard]] bundle group_theorems() {
  bundle laws("group_theorems");
  laws.add("cancellative", "x·y = x·z ⇒ y = z, and y·x = z·x ⇒ y = z", [] {
    auto const x = draw<T>("x");
    auto const y = draw<T>("y");
    auto const z = draw<T>("z");
    if (S::combine(x, y) == S::combine(x, z)) same("y", y, "z", z);
    if (S::combine(y, x) == S::combine(z, x)) same("y", y, "z", z);
    // Two draws seldom agree, so cancelling is also tested directly.
    same("x⁻¹·(x·y)", S::combine(S::inverse(x), S::combine(x, y)), "y", y);
  });
  laws.add("only_identity_is_idempotent", "x·x = x ⇒ x = 1", [] {
    auto const x = draw<T>("x");
    if (S::combine(x, x) == x) same("x", x, "1", S::identity());
  });
  laws.add("inverse_of_product", "(x·y)⁻¹ = y⁻¹·x⁻¹",
           [] {
             auto const x = draw<T>("x");
             auto const y = draw<T>("y");
             detail::count_nontrivial<S>(x, y);
             same("(x·y)⁻¹", S::inverse(S::combine(x, y)), "y⁻¹·x⁻¹", S::combine(S::inverse(y), S::inverse(x)));
           },
           {detail::without_identity});
  return laws;
}

/// The laws of the strongest structure with one total operation that T claims.
template <class T>
[[nodiscard]] bundle structure_laws() {
  static_assert(magma<T>, "specialise rota::structure<T> first: no type has a structure until then");
  if constexpr (abelian_group<T>) {
    return abelian_group_laws<T>();
  } else if constexpr (group<T>) {
    return group_laws<T>();
  } else {
    std::vector<bundle> claimed;
    if constexpr (monoid<T>) claimed.push_back(monoid_laws<T>());
    if constexpr (invertible_magma<T>) claimed.push_back(invertible_magma_laws<T>());
    if constexpr (!monoid<T> && !invertible_magma<T> && unital_magma<T>) claimed.push_back(unital_magma_laws<T>());
    if constexpr (commutative_magma<T>) claimed.push_back(commutative_magma_laws<T>());
    if (claimed.size() == 1) return claimed.front();
    bundle laws("structure");
    laws.merge(magma_laws<T>());
    for (bundle const& b : claimed) laws.merge(b);
    return laws;
  }
}

}  // namespace rota::testing
