#pragma once

#include <cstdint>

namespace rota {

class stop_request;

}  // namespace rota

namespace rota::dense {

using slot = std::uint32_t;
using row_index = std::uint32_t;

struct slot_bounds;
struct instance;
struct work_limit;
struct work_done;
struct outcome;
enum class status : unsigned char;
class tie_rule;

class flow_solver;
struct flow_outcome;
enum class flow_obstacle : unsigned char;

class tree_solver;
class tree_oracle;
struct tree_options;
struct tree_outcome;
struct tree_account;
struct refuted_bound;

class pair_solver;
class pair_observer;
struct pair_instance;
struct coupling;
struct pair_effort;
struct pair_outcome;
struct pair_tally;
enum class pair_cut : unsigned char;

}  // namespace rota::dense
