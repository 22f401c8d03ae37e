#pragma once

#include <rota/search/reallocate.hpp>
#include <rota/team/authority.hpp>
#include <rota/team/belief.hpp>
#include <rota/team/message.hpp>

#include <cstdint>
#include <optional>

namespace rota {

/// Why a message was refused whole. Nothing changed.
enum class refusal : unsigned char {
  none,
  own_id,                ///< it claims to come from the receiver
  stranger,              ///< its sender, or an agent a claim speaks about, is not in the roster
  types_not_ascending,   ///< the types of a plan message repeat or are out of order
  unknown_task,          ///< a plan or task that the executed plan type does not have
  not_executed,          ///< a claim for a plan type that the receiver does not execute
  malformed_allocation,  ///< a claim gives one agent two tasks, or mixes plans
  foreign_stamp,         ///< a claim whose stamp is not its leader's, or not the one the claim had before
  remaining_time,        ///< a claim whose remaining time is not positive, or above the configured maximum
  resolution_off         ///< a claim, and this agent takes no part in conflict resolution
};

/// What became of a message.
enum class verdict : unsigned char {
  accepted,
  stale,   ///< older than, or equal to, what is known from its sender: dropped
  refused  ///< see `refusal`
};

/// What a message changed in the belief about one plan type.
template <vocabulary V>
struct belief_change {
  typename V::plan_type type{};
  message_case what{};       ///< which of the four cases, or imposed
  rota::event<in<V>> event;  ///< e_m; for a claim, the imposed change
};

/// The answer of `robot::receive`.
template <vocabulary V>
struct reception {
  rota::verdict verdict = verdict::accepted;
  refusal why = refusal::none;
  small_vector<belief_change<V>, 1> changes;  ///< non-empty events only, ascending by type
  std::optional<claim_outcome> claim;         ///< for an accepted claim
};

/// What a deliberation came to.
enum class decision_reason : unsigned char {
  not_executing,        ///< the agent does not execute this plan type
  reallocated,          ///< a better allocation was adopted
  kept,                 ///< the allocation stays
  no_valid_allocation,  ///< none is known; nobody has a task
  obeyed                ///< a leader decides
};

/// The answer of `robot::deliberate`.
template <vocabulary V>
struct decision {
  decision_reason reason = decision_reason::not_executing;
  rota::event<in<V>> event;                   ///< e_r; empty if nothing changed
  rota::event<in<V>> deleted;                 ///< what the deletion of silent agents took away before
  std::optional<in<V>> own;                   ///< what the agent itself has to do now
  std::optional<reallocation_reason> why;     ///< of the reallocation, if one was made
  double utility = 0;                         ///< of the allocation, if a reallocation was made
  std::uint32_t cycles = 0;                   ///< cycles that this deliberation completed
  std::optional<typename V::agent> detected;  ///< the sender of the n-th subsequent cycle, when a monitor fired
  bool reign_began = false;                   ///< the agent claims authority from now on
  bool reign_ended = false;                   ///< a reign has ended since the last deliberation
};

/// Parameters of an agent; the defaults are the paper's.
struct robot_options {
  std::uint32_t cycles = 4;           ///< n subsequent cycles are a conflict that does not heal
  duration pending_age = seconds(1);  ///< see `monitor_options`
  duration reign = seconds(2);        ///< how long authority lasts
  duration max_reign = seconds(2);    ///< claims with more time left are refused; at least `reign`
  duration message_period = milliseconds(100);
  duration claim_period = milliseconds(100);  ///< how often a leader repeats an unchanged claim
  duration silence = seconds(2);              ///< an agent not heard of for so long is deleted
  instant first_message{};                    ///< the phase of the message grid
  std::uint64_t incarnation = 1;              ///< must grow with every restart of the agent
  std::uint32_t confidence = 0;               ///< outranks the id in the stamp of claims
  bool resolution = true;                     ///< off: detect, but neither claim nor obey
  rota::hysteresis hysteresis{};              ///< see `reallocate`
  double change_cost = 0;                     ///< see `problem::change_cost`

  friend bool operator==(robot_options const&, robot_options const&) = default;
};

}  // namespace rota
