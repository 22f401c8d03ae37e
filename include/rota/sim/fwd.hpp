#pragma once

#include <rota/team/fwd.hpp>

namespace rota::sim {

enum class scenario : unsigned char;
enum class happening : unsigned char;
enum class invariant : unsigned char;
enum class stamp_policy : unsigned char;
enum class oracle : unsigned char;
struct point;
struct world_state;
struct perceived;
struct testimony;
struct knowledge;
struct playbook;
struct log_record;
struct figures;
struct pursuit_figures;
struct timing_figures;
struct faults;
struct promises;
struct violation;
struct campaign_run;
class robot_clock;
class network;
class interference;
class sensor;
class pursuit_watch;
class duel_world;
class scripted_world;
class restless_world;

}  // namespace rota::sim
