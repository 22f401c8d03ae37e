#pragma once

#include <rota/core/fwd.hpp>

namespace rota {

class cardinality;
template <vocabulary V>
class role;
template <vocabulary V>
class team;
template <vocabulary V>
struct allocation;
template <vocabulary V, class Beliefs>
class plan;
template <vocabulary V, class Beliefs>
class plan_type;

}  // namespace rota
