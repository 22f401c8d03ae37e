#pragma once

#include <rota/algebra/structures.hpp>
#include <rota/testing/structure_laws.hpp>

#include <functional>

namespace rota::testing {

/// Generates arrows that start at a given object, so that composable arrows can be drawn. Specialise it with
/// `static rc::Gen<T> from(Object const&)`; without that, arrows are drawn until one fits, which is feasible for few
/// objects.
template <class T>
struct arrows {
  template <class Object>
  [[nodiscard]] static rc::Gen<T> from(Object const& object) {
    return rc::gen::suchThat(rc::gen::arbitrary<T>(),
                             [object](T const& t) { return structure<T>::source(t) == object; });
  }
};

namespace detail {

/// Arrows from an object to itself test little.
constexpr share without_standing_still{"no arrow is an identity", 10};
template <class S, class... T>
void count_moving(T const&... arrows) {
  interesting(!(... || (arrows == S::identity(S::source(arrows)))), without_standing_still.what);
}

}  // namespace detail

/// ends, identity, associative, inverse. For S, see structure_laws.hpp.
template <class T, class S = structure<T>>
[[nodiscard]] bundle groupoid_laws() {
  static constexpr auto after = [](T const& t, char const* name) -> T {
    return *arrows<T>::from(S::target(t)).as(name);
  };
  bundle laws("groupoid");
  laws.add("ends", "t·u goes from source(t) to target(u), t⁻¹ from target(t) to source(t), id(o) from o to o",
           [] {
             auto const t = draw<T>("t");
             auto const u = after(t, "u");
             detail::count_moving<S>(t, u);
             same("source(t·u)", S::source(S::compose(t, u)), "source(t)", S::source(t));
             same("target(t·u)", S::target(S::compose(t, u)), "target(u)", S::target(u));
             same("source(t⁻¹)", S::source(S::inverse(t)), "target(t)", S::target(t));
             same("target(t⁻¹)", S::target(S::inverse(t)), "source(t)", S::source(t));
             same("source(id)", S::source(S::identity(S::source(t))), "source(t)", S::source(t));
             same("target(id)", S::target(S::identity(S::source(t))), "source(t)", S::source(t));
           },
           {detail::without_standing_still});
  laws.add("identity", "id(source(t))·t = t = t·id(target(t))",
           [] {
             auto const t = draw<T>("t");
             detail::count_moving<S>(t);
             same("id(source(t))·t", S::compose(S::identity(S::source(t)), t), "t", t);
             same("t·id(target(t))", S::compose(t, S::identity(S::target(t))), "t", t);
           },
           {detail::without_standing_still});
  laws.add("associative", "(t·u)·v = t·(u·v)",
           [] {
             auto const t = draw<T>("t");
             auto const u = after(t, "u");
             auto const v = after(u, "v");
             detail::count_moving<S>(t, u, v);
             same("(t·u)·v", S::compose(S::compose(t, u), v), "t·(u·v)", S::compose(t, S::compose(u, v)));
           },
           {detail::without_standing_still});
  laws.add("inverse", "t·t⁻¹ = id(source(t)), t⁻¹·t = id(target(t))",
           [] {
             auto const t = draw<T>("t");
             detail::count_moving<S>(t);
             same("t·t⁻¹", S::compose(t, S::inverse(t)), "id(source(t))", S::identity(S::source(t)));
             same("t⁻¹·t", S::compose(S::inverse(t), t), "id(target(t))", S::identity(S::target(t)));
           },
           {detail::without_standing_still});
  return laws;
}

/// preserves_composition, for a function f from a groupoid to a group. Identities and inverses follow.
template <class T, class G, class S = structure<T>, class R = structure<G>>
[[nodiscard]] bundle functor_laws(std::function<G(T const&)> f) {
  bundle laws("functor");
  laws.add_closure("preserves_composition", "f(t·u) = f(t)·f(u) where t·u exists",
                   [f] {
                     auto const t = draw<T>("t");
                     T const u = *arrows<T>::from(S::target(t)).as("u");
                     detail::count_moving<S>(t, u);
                     same("f(t·u)", f(S::compose(t, u)), "f(t)·f(u)", R::combine(f(t), f(u)));
                   },
                   {detail::without_standing_still});
  return laws;
}

/// identity, compatible; for the action A of the structure S.
template <class G, class X, class A = action<G, X>, class S = structure<G>>
[[nodiscard]] bundle group_action_laws() {
  bundle laws("group_action");
  laws.add("identity", "1·x = x", [] {
    auto const x = draw<X>("x");
    same("1·x", A::act(S::identity(), x), "x", x);
  });
  laws.add("compatible", "(g·h)·x = g·(h·x)",
           [] {
             auto const g = draw<G>("g");
             auto const h = draw<G>("h");
             auto const x = draw<X>("x");
             detail::count_nontrivial<S>(g, h);
             same("(g·h)·x", A::act(S::combine(g, h), x), "g·(h·x)", A::act(g, A::act(h, x)));
           },
           {detail::without_identity});
  return laws;
}

/// inverse_undoes. It follows: each g is a bijection of X.
template <class G, class X, class A = action<G, X>, class S = structure<G>>
[[nodiscard]] bundle group_action_theorems() {
  bundle laws("group_action_theorems");
  laws.add("inverse_undoes", "g⁻¹·(g·x) = x",
           [] {
             auto const g = draw<G>("g");
             auto const x = draw<X>("x");
             detail::count_nontrivial<S>(g);
             same("g⁻¹·(g·x)", A::act(S::inverse(g), A::act(g, x)), "x", x);
           },
           {detail::without_identity});
  return laws;
}

}  // namespace rota::testing
