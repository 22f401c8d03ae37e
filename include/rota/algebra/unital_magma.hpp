#pragma once

#include <rota/algebra/magma.hpp>

namespace rota {

/// A magma with a two-sided identity.
///
/// Laws: those of `magma`, identity·x = x, x·identity = x. Refuses the greater of two integers, which has no least one to
/// start from.
template <class T>
concept unital_magma = magma<T> && requires {
  { structure<T>::identity() } -> std::same_as<T>;
};

}  // namespace rota
