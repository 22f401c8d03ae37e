#pragma once

#include <rota/algebra/magma.hpp>

namespace rota {

/// A magma with a two-sided identity.
///
/// Laws: identity·x = x, x·identity = x.
template <class T>
concept unital_magma = magma<T> && requires {
  { structure<T>::identity() } -> std::same_as<T>;
};

/// A unital magma in which every x has an inverse: x·inverse(x) = identity = inverse(x)·x, and inverse(inverse(x)) = x.
///
/// This is all that `event` is under Def. 4. Without associativity an inverse cancels nothing: (x·x)·inverse(x) may
/// differ from x.
template <class T>
concept invertible_magma = unital_magma<T> && requires(T const& x) {
  { structure<T>::inverse(x) } -> std::same_as<T>;
};

}  // namespace rota
