#pragma once

#include <rota/model/fwd.hpp>

namespace rota {

struct incarnation;
struct robot_options;
class reception_counts;
template <vocabulary V>
struct plan_message;
template <vocabulary V>
struct claim;
template <vocabulary V>
struct part_change;
template <vocabulary V>
class belief;
template <vocabulary V>
struct reception;
template <vocabulary V>
struct decision;
template <vocabulary V>
class cycle_monitor;
template <vocabulary V>
class insistence_monitor;
template <vocabulary V>
class literal_monitor;
template <class First, class Second>
class either_monitor;
template <vocabulary V>
struct claim_stamp;
template <vocabulary V>
class authority;
template <vocabulary V>
class relay;
template <vocabulary V, class Monitor>
class robot;

}  // namespace rota
