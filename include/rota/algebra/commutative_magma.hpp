#pragma once

#include <rota/algebra/magma.hpp>

namespace rota {

/// A magma that claims to commute.
///
/// Laws: those of `magma`, and x·y = y·x. Refuses matrices, strings and whatever else says nothing: the claim is explicit.
template <class T>
concept commutative_magma = magma<T> && detail::claims_commutative<T>;

}  // namespace rota
