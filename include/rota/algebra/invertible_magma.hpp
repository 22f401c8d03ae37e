#pragma once

#include <rota/algebra/unital_magma.hpp>

namespace rota {

/// A unital magma in which every x has an inverse.
///
/// Laws: those of `unital_magma`, x·inverse(x) = identity = inverse(x)·x, inverse(inverse(x)) = x. This is what `event` is
/// under Def. 4, beside commutative. Without associativity an inverse cancels nothing: (x·x)·inverse(x) may differ from x.
/// Refuses sets under union, which have an identity and no way back.
template <class T>
concept invertible_magma = unital_magma<T> && requires(T const& x) {
  { structure<T>::inverse(x) } -> std::same_as<T>;
};

}  // namespace rota
