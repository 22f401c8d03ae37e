#pragma once

#include <rota/algebra/structure.hpp>

namespace rota {

/// Arrows between objects, composed where they meet, every one invertible.
///
/// `structure<T>` gives `source(t)`, `target(t)`, `identity(object)`, `compose(t, u)` for target(t) = source(u), and
/// `inverse(t)`.
/// Laws: source and target of a composite; identities; (t·u)·v = t·(u·v) where defined; t·inverse(t) = identity(source(t)).
/// Refuses `delta`: its sum is total, which makes it a group (a groupoid with one object, and no two names for it here).
template <class T>
concept groupoid = std::regular<T> && requires(T const& t, T const& u) {
  structure<T>::source(t);
  { structure<T>::target(t) } -> std::same_as<decltype(structure<T>::source(t))>;
  { structure<T>::identity(structure<T>::source(t)) } -> std::same_as<T>;
  { structure<T>::compose(t, u) } -> std::same_as<T>;
  { structure<T>::inverse(t) } -> std::same_as<T>;
};

}  // namespace rota
