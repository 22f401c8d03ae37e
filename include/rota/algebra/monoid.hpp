#pragma once

#include <rota/algebra/unital_magma.hpp>

namespace rota {

/// A unital magma that claims associativity.
///
/// Laws: (x·y)·z = x·(y·z). Refuses `event`: at the signs (+, +, −) the brackets matter.
template <class T>
concept monoid = unital_magma<T> && detail::claims_associative<T>;

}  // namespace rota
