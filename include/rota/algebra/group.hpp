#pragma once

#include <rota/algebra/invertible_magma.hpp>
#include <rota/algebra/monoid.hpp>

namespace rota {

/// A monoid with inverses.
///
/// Laws: those of `monoid` and `invertible_magma`; hence cancellation, x·y = x·z ⇒ y = z, and only the identity is
/// idempotent. Refuses `event`, in which every element is.
template <class T>
concept group = monoid<T> && invertible_magma<T>;

}  // namespace rota
