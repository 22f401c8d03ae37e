#pragma once

#include <rota/core/vocabulary.hpp>

#include <cstddef>

namespace rota {

struct duration;
struct instant;
template <class T, class Refusal>
class result;
template <vocabulary V>
struct in;
template <vocabulary V>
struct in_state;

}  // namespace rota
