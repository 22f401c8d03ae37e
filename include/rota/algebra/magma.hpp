#pragma once

#include <rota/algebra/structure.hpp>

namespace rota {

/// A set with a total binary operation.
///
/// Laws: closed (the operation keeps the class invariant), well-defined (equal operands give equal results).
/// Refuses types whose composition is partial, such as `transition`: that is a `groupoid`.
template <class T>
concept magma = std::regular<T> && requires(T const& x, T const& y) {
  { structure<T>::combine(x, y) } -> std::same_as<T>;
};

}  // namespace rota
