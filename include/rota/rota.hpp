#pragma once
/// @file
/// Everything from core/ to team/, but for chrono, printing, formatting and hashing, which cost who does not use them. No Boost.

#include <rota/core/config.hpp>  // first, so that it is the first to complain

#include <rota/algebra/allocation_event.hpp>
#include <rota/algebra/apply.hpp>
#include <rota/algebra/associativity.hpp>
#include <rota/algebra/atom_set.hpp>
#include <rota/algebra/claimed_structures.hpp>
#include <rota/algebra/delta.hpp>
#include <rota/algebra/dense_event.hpp>
#include <rota/algebra/event.hpp>
#include <rota/algebra/runs.hpp>
#include <rota/allocation/problem.hpp>
#include <rota/allocation/utility.hpp>
#include <rota/allocation/validate.hpp>
#include <rota/core/atom.hpp>
#include <rota/core/result.hpp>
#include <rota/core/time.hpp>
#include <rota/core/vocabulary.hpp>
#include <rota/domain.hpp>
#include <rota/model/outline.hpp>
#include <rota/model/plan_type.hpp>
#include <rota/model/team.hpp>
#include <rota/search/assign.hpp>
#include <rota/search/best_allocation.hpp>
#include <rota/search/reallocate.hpp>
#include <rota/team/budget.hpp>
#include <rota/team/confidence.hpp>
#include <rota/team/conflict.hpp>
#include <rota/team/cycle.hpp>
#include <rota/team/monitors/literal.hpp>
#include <rota/team/monitors/repetition.hpp>
#include <rota/team/reception_counts.hpp>
#include <rota/team/relay.hpp>
#include <rota/team/robot.hpp>
#include <rota/team/wire.hpp>
