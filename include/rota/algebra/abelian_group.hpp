#pragma once

#include <rota/algebra/commutative_magma.hpp>
#include <rota/algebra/group.hpp>

namespace rota {

/// A commutative group: what the paper takes allocation events to be, and what `delta` is.
///
/// Laws: those of `group`, and x·y = y·x. So sums may be taken in any order and any brackets. Refuses `event`.
template <class T>
concept abelian_group = group<T> && commutative_magma<T>;

}  // namespace rota
