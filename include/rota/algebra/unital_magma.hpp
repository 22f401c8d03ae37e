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

}  // namespace rota
