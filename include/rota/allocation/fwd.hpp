#pragma once

#include <rota/model/fwd.hpp>

namespace rota {

enum class idling : bool;
enum class utility_fault : unsigned char;
enum class clause : unsigned char;
enum class plan_phase : bool;
struct fixed_utility;
struct hysteresis;
template <vocabulary V, class Beliefs>
struct problem;
template <vocabulary V>
struct utility_refusal;
template <vocabulary V>
struct violation;
template <vocabulary V>
class validity_report;

}  // namespace rota
