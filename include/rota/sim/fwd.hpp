#pragma once

#include <rota/team/fwd.hpp>

namespace rota::sim {

enum class scenario : unsigned char;
enum class happening : unsigned char;
struct point;
struct world_state;
struct perceived;
struct playbook;
struct log_record;
struct figures;
struct timing_figures;
class robot_clock;
class network;
class sensor;
class duel_world;
class scripted_world;

}  // namespace rota::sim
