#pragma once

#include <rota/algebra/atom_set.hpp>

#include <cstdint>

namespace rota {

enum class sign : std::int8_t;
template <ordered_atom Atom>
class event;

}  // namespace rota
