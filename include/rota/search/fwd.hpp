#pragma once

#include <rota/allocation/fwd.hpp>

namespace rota {

struct search_budget;
class workspace;
struct assignment;
struct assign_options;
struct assign_refusal;
enum class assign_fault : unsigned char;
enum class no_plan_reason : unsigned char;
enum class reallocation_reason : unsigned char;
template <vocabulary V>
struct runner_up;
template <vocabulary V>
struct bound_lie;
template <vocabulary V>
struct solution;
template <vocabulary V>
struct plan_refusal;
template <vocabulary V>
struct no_allocation;
template <vocabulary V>
struct reallocation;

}  // namespace rota
