#pragma once

#include <rota/search/reallocate.hpp>
#include <rota/team/authority.hpp>
#include <rota/team/belief.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace rota {

/// Why a message was refused. A refused message changes nothing.
enum class refusal : unsigned char {
  none,
  own_id,                ///< it says that the receiver sent it, in this life: an echo, or two robots with one id
  own_former_life,       ///< … in a life before this one: an echo
  own_later_life,        ///< … in a life after this one: this robot's incarnation was not obtained as it should
  stranger,              ///< its sender, or an agent that a claim is about, is not in the roster
  too_many_types,        ///< a plan message of more than `plan_message::most_types` types
  number_out_of_reach,   ///< a number that no genuine message can have by now: a flipped bit, or a forgery
  types_not_ascending,   ///< a plan message lists a type twice, or out of order
  unknown_task,          ///< the executed plan type has no such plan or task
  not_executed,          ///< a claim for a plan type that the receiver does not execute
  malformed_allocation,  ///< a claim gives one agent two tasks, mixes plans, or has no age for each atom
  foreign_stamp,         ///< the stamp of a claim is not its leader's, or not the one this claim had before
  foreign_claim,         ///< a plan message whose sender leads with a claim that it has not made
  remaining_time,        ///< the remaining time of a claim is not positive, or above `robot_options::max_reign`
  resolution_off         ///< a claim, and `robot_options::resolution` is off
};

/// What became of a message.
enum class verdict : unsigned char {
  accepted,
  stale,   ///< not newer than what is known of its sender: dropped
  refused  ///< see `refusal`
};

/// What a plan message changed in the belief about one plan type.
template <vocabulary V = runtime_vocabulary>
struct belief_change {
  typename V::plan_type type{};
  part_change<V> part;  ///< of the sender; never empty
};

/// The answer of `robot::receive`.
template <vocabulary V = runtime_vocabulary>
struct reception {
  rota::verdict verdict = verdict::accepted;
  refusal reason = refusal::none;
  small_vector<belief_change<V>, 1> changes;  ///< by a plan message: where the sender's part changed, ascending by type
  std::optional<claim_outcome> claim{};       ///< of an accepted claim
  event<in<V>> imposed;                       ///< what an accepted claim changed in the belief about its plan type
  /// By a plan message with fingerprints: types that nobody rules here, in which the sender believes something else, about
  /// whomever.
  small_vector<typename V::plan_type, 1> disagreements;
  /// Whether it is news. Where not everybody hears everybody, whoever forwards each message that is news, and no other,
  /// lets every message reach everybody and end: copies and disorder do no harm. Of types that the robot does not execute,
  /// `relay` tells.
  bool relay = false;
};

/// What a deliberation came to.
enum class decision_reason : unsigned char {
  not_executing,        ///< the robot does not execute this plan type, so nothing was decided
  reallocated,          ///< the robot adopted another allocation
  kept,                 ///< the allocation stays
  no_valid_allocation,  ///< the search found none: the robot takes no task, believes the others, and abstains
  obeyed                ///< a leader decides
};

/// The answer of `robot::deliberate`. `describe` of team/print.hpp says it in a sentence.
template <vocabulary V = runtime_vocabulary>
struct [[nodiscard]] decision {
  typename V::plan_type type{};  ///< the plan type that was asked about
  decision_reason reason = decision_reason::not_executing;
  std::optional<in<V>> own{};  ///< what the robot itself has to do now
  rota::event<in<V>> event;    ///< e_r, what the robot changed in what it believed
  rota::event<in<V>> deleted;  ///< what the deletion of silent agents took away before
  /// What was searched and found, and why; none if nothing was searched. Who obeys adopts nothing of it.
  std::optional<reallocation<V>> search{};
  std::optional<typename V::agent> leader{};    ///< who rules the plan type now: the robot itself, another, or nobody
  std::uint32_t cycles = 0;                     ///< cycles that this deliberation completed
  std::optional<typename V::agent> detected{};  ///< the sender of the n-th subsequent cycle, if the monitor fired
  bool reign_began = false;                     ///< the robot claims authority from now on
  bool reign_renewed = false;                   ///< … and claims it anew, since others would do otherwise
  bool dissents = false;                        ///< the robot obeys, and would do otherwise
  small_vector<typename V::agent, 2> left_out;  ///< were given nothing, since they abstain
  bool reign_ended = false;   ///< a reign has ended since the last deliberation, and no greater took its place
  duration clock_set_back{};  ///< by so much the robot's clock was set back since its last decision
  /// The plan types that the robot executes, ascending; filled only if the reason is `not_executing`.
  small_vector<typename V::plan_type, 4> executed;
};

/// Parameters of a robot. The defaults are the paper's; but a reign is renewed while its cause lasts, which `renewals` = 0
/// switches off.
struct robot_options {
  std::uint32_t cycles = 4;           ///< after n subsequent cycles a conflict counts as lasting
  duration pending_age = seconds(1);  ///< see `monitor_options`
  std::uint32_t yielding = 2;         ///< see `monitor_options`
  duration reign = seconds(2);        ///< how long a claim of this robot holds
  duration max_reign = seconds(2);    ///< claims with more time left are refused; the same for all, at least `reign`
  /// A leader that hears dissent shortly before its reign ends renews it, so many times since the detection. With 0 nobody
  /// renews, and who obeys does not search for what it would do otherwise: the paper's reign of fixed length. The same for all.
  std::uint32_t renewals = 400;
  duration message_period = milliseconds(100);
  /// If positive, news is said this soon after the last message, and twice: the robot enters, leaves or leads, begins to
  /// abstain or dissent, its reallocation changed anything, or (once) a message's fingerprint differs. `sparing` of
  /// team/budget.hpp sets it.
  duration change_period{};
  duration claim_period = milliseconds(100);   ///< how often a leader repeats an unchanged claim
  duration opening = milliseconds(200);        ///< for this long from its beginning, a claim is repeated
  duration opening_period = milliseconds(30);  ///< … every so often
  /// No message is expected to be under way for longer. If it is not below `silence`, claims bring nobody back.
  duration max_delay = milliseconds(500);
  duration silence = seconds(2);  ///< an agent that was not heard for longer is deleted
  duration forget =
      seconds(30);  ///< an agent that was not heard for longer may begin a new life with any number; above `max_delay`
  bool fingerprints = false;      ///< plan messages say what their sender believes of everybody, as four bytes
  instant first_message{};        ///< where the grid of plan messages lies: a slot; there are slots before it, too
  std::uint32_t confidence = 0;   ///< of this robot's claims: the greater confidence leads, then the greater id
  bool resolution = true;         ///< off: the robot detects loops, but neither claims nor obeys
  rota::hysteresis hysteresis{};  ///< see `reallocate`
  double change_cost = 0;         ///< see `problem::change_cost`

  friend bool operator==(robot_options const&, robot_options const&) = default;
};

/// Whether a robot can work with these options; else they are a mistake. Periods are positive (`change_period` may be 0, and
/// `opening_period` if `opening` is); no duration is negative or above `longest_duration`; 0 < reign ≤ max_reign, or nobody
/// would obey; max_delay ≤ forget, or what is still under way would be taken for a new life; a loop of messages is quicker than
/// the monitor forgets; and a peer that was not heard for `forget` has not sent `most_jump` messages.
[[nodiscard]] constexpr bool usable(robot_options const& o) noexcept {
  auto const within = [](duration d) { return d >= duration{} && d <= longest_duration; };
  auto const positive = [&](duration d) { return within(d) && d > duration{}; };
  duration const quickest =
      o.change_period > duration{} ? (std::min)(o.change_period, o.message_period) : o.message_period;
  return positive(o.message_period) && positive(o.claim_period) && positive(o.reign) && within(o.max_reign) &&
         o.reign <= o.max_reign && within(o.change_period) && within(o.opening) && within(o.opening_period) &&
         (o.opening == duration{} || o.opening_period > duration{}) && within(o.max_delay) && within(o.silence) &&
         within(o.forget) && o.max_delay <= o.forget && within(o.pending_age) &&
         o.message_period <= 2 * o.pending_age && o.forget.ns / quickest.ns < static_cast<std::int64_t>(most_jump) &&
         instant{} - longest_duration <= o.first_message && o.first_message <= instant{} + longest_duration;
}

}  // namespace rota
