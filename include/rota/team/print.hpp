#pragma once
/// @file
/// Text for messages, beliefs and decisions, in the paper's notation. A header of its own, since deciding needs no strings.
/// `name(id)` turns agents, plan types, plans, tasks and states into strings; see `default_names`.

#include <rota/algebra/print.hpp>
#include <rota/core/print.hpp>
#include <rota/search/print.hpp>
#include <rota/team/conflict.hpp>
#include <rota/team/decision.hpp>
#include <rota/team/reception_counts.hpp>
#include <rota/team/wire.hpp>

#include <cstddef>
#include <string>
#include <variant>

namespace rota {

[[nodiscard]] inline std::string to_string(message_case c) {
  switch (c) {
  case message_case::agreement: return "agreement";
  case message_case::joined: return "joined";
  case message_case::moved: return "moved";
  case message_case::left: return "left";
  }
  return "?";
}
[[nodiscard]] inline std::string to_string(conflict_partner p) {
  return p == conflict_partner::first ? "first" : "second";
}
[[nodiscard]] inline std::string to_string(verdict v) {
  switch (v) {
  case verdict::accepted: return "accepted";
  case verdict::stale: return "stale";
  case verdict::refused: return "refused";
  }
  return "?";
}
[[nodiscard]] inline std::string to_string(refusal r) {
  switch (r) {
  case refusal::none: return "nothing is wrong";
  case refusal::own_id: return "it says that the receiver sent it: an echo, or two robots with one id";
  case refusal::own_former_life: return "it says that the receiver sent it in an earlier life: an echo";
  case refusal::own_later_life:
    return "it says that the receiver sent it in a later life: the receiver's incarnation is too small";
  case refusal::stranger: return "its sender, or an agent that it is about, is not in the roster";
  case refusal::too_many_types: return "it lists more plan types than a message may have";
  case refusal::number_out_of_reach: return "it has a number that no genuine message can have by now";
  case refusal::types_not_ascending: return "its plan types repeat or are out of order";
  case refusal::unknown_task: return "the plan type has no such plan or task";
  case refusal::not_executed: return "it claims a plan type that the receiver does not execute";
  case refusal::malformed_allocation: return "its allocation gives an agent two tasks, mixes plans, or lacks ages";
  case refusal::foreign_stamp: return "its stamp is not its leader's, or not the one the claim had before";
  case refusal::foreign_claim: return "its sender leads with a claim that it has not made";
  case refusal::remaining_time: return "its remaining time is not positive or too long";
  case refusal::resolution_off: return "the receiver takes no part in conflict resolution";
  }
  return "?";
}
[[nodiscard]] inline std::string to_string(claim_outcome o) {
  switch (o) {
  case claim_outcome::adopted: return "the claim is obeyed from now on";
  case claim_outcome::revised: return "the claim has a newer version";
  case claim_outcome::repeated: return "the claim says nothing new";
  case claim_outcome::expired: return "the claim has already ended here";
  case claim_outcome::outranked: return "a greater stamp is in force";
  case claim_outcome::challenged: return "the receiver's stamp is greater, so it claims";
  }
  return "?";
}
[[nodiscard]] inline std::string to_string(wire_fault f) {
  switch (f) {
  case wire_fault::no_room: return "the buffer is too small";
  case wire_fault::too_many: return "it has more types or atoms than a message may have";
  case wire_fault::unequal_ages: return "the claim has not one age for each atom";
  case wire_fault::mixed_plans: return "the claim's atoms are of two plans";
  case wire_fault::negative_time: return "a remaining time or an age is negative";
  case wire_fault::foreign: return "it does not begin as a message of rota does";
  case wire_fault::version: return "it is of another version of the form";
  case wire_fault::cut_short: return "it ends too early";
  case wire_fault::too_long: return "it goes on after its end";
  case wire_fault::checksum: return "its checksum does not fit: a bit was flipped";
  case wire_fault::not_canonical: return "a number, a flag or the order of its atoms is not as it would be written";
  case wire_fault::out_of_range: return "a number is beyond what its field can hold";
  }
  return "?";
}
[[nodiscard]] inline std::string to_string(decision_reason r) {
  switch (r) {
  case decision_reason::not_executing: return "the plan type is not executed";
  case decision_reason::reallocated: return "another allocation was adopted";
  case decision_reason::kept: return "the allocation stays";
  case decision_reason::no_valid_allocation: return "no valid allocation was found";
  case decision_reason::obeyed: return "a leader decides";
  }
  return "?";
}

/// `12 accepted, 3 stale, 2 refused: 1 because …, 1 because …`.
[[nodiscard]] inline std::string to_string(reception_counts const& c) {
  std::string out = std::to_string(c.accepted()) + " accepted, " + std::to_string(c.stale()) + " stale, " +
                    std::to_string(c.refused()) + " refused";
  auto separator = ": ";
  auto const say = [&](std::uint64_t n, auto why) {
    if (n == 0) return;
    out += separator + std::to_string(n) + " because " + to_string(why);
    separator = ", ";
  };
  for (std::size_t i = 0; i < reception_counts::wire_faults; ++i)
    say(c.of(static_cast<wire_fault>(i)), static_cast<wire_fault>(i));
  for (std::size_t i = 0; i < reception_counts::refusals; ++i)
    say(c.of(static_cast<refusal>(i)), static_cast<refusal>(i));
  return out;
}

[[nodiscard]] inline std::string to_string(stance s) {
  switch (s) {
  case stance::none: return "has nothing to say";
  case stance::abstains: return "abstains";
  case stance::dissents: return "dissents";
  }
  return "?";
}
/// Its number.
[[nodiscard]] inline std::string to_string(incarnation i) { return std::to_string(i.value); }
/// `incarnation:sequence`.
[[nodiscard]] inline std::string to_string(message_number const& n) {
  return to_string(n.incarnation) + ":" + std::to_string(n.sequence);
}
/// `(confidence, a)`.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string to_string(claim_stamp<V> const& s, Names const& name = {}) {
  return '(' + std::to_string(s.confidence) + ", " + name(s.id) + ")";
}
/// The triple `(p, t, z)`.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string to_string(placement<V> const& p, Names const& name = {}) {
  return '(' + name(p.plan) + ", " + name(p.task) + ", " + name(p.state) + ")";
}
/// `pt: (p, t, z)`, or `pt: no task`, and its stance if it has one: `pt: no task, abstains`.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string to_string(participation<V> const& p, Names const& name = {}) {
  return name(p.type) + ": " + (p.place ? to_string(*p.place, name) : "no task") +
         (p.stance != stance::none ? ", " + to_string(p.stance) : "");
}
/// `agent a, message 1:7: pt: (p, t, z), pt: no task`.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string to_string(plan_message<V> const& m, Names const& name = {}) {
  std::string out = "agent " + name(m.sender) + ", message " + to_string(m.number) + ": ";
  if (m.types.empty()) return out + "executes no plan type";
  for (auto const* p = m.types.begin(); p != m.types.end(); ++p)
    out += (p == m.types.begin() ? "" : ", ") + to_string(*p, name);
  return out;
}
/// `agent a, claim 1:3, version 2: pt: {In(a, p, t)}, stamp (0, a), 1.5 s left`.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string to_string(claim<V> const& c, Names const& name = {}) {
  return "agent " + name(c.leader) + ", claim " + to_string(message_number{c.incarnation, c.number}) + ", version " +
         std::to_string(c.version) + ": " + name(c.type) + ": " + to_string(c.atoms, name) + ", stamp " +
         to_string(c.stamp, name) + ", " + to_string(c.remaining) + " left";
}
/// The plan message or the claim.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string to_string(std::variant<plan_message<V>, claim<V>> const& m, Names const& name = {}) {
  if (auto const* plan = std::get_if<plan_message<V>>(&m)) return to_string(*plan, name);
  if (auto const* bid = std::get_if<claim<V>>(&m)) return to_string(*bid, name);
  return "?";
}

namespace detail {

/// `1, 2, 3`.
template <class Ids, class Names>
[[nodiscard]] std::string listing(Ids const& ids, Names const& name) {
  std::string out;
  for (auto const& id : ids) out += (out.empty() ? "" : ", ") + name(id);
  return out;
}

}  // namespace detail

/// The event e of the change.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string to_string(part_change<V> const& c, Names const& name = {}) {
  return to_string(c.event(), name);
}
/// The allocation, and who takes part without a task.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string to_string(belief<V> const& b, Names const& name = {}) {
  small_vector<typename V::agent, 8> idle;
  for (auto const& a : b.participants())
    if (!b.part(a)) idle.push_back(a);
  return to_string(b.atoms(), name) + (idle.empty() ? "" : ", without a task: " + detail::listing(idle, name));
}

/// Who rules, as a sentence without a full stop.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(authority<V> const& a, Names const& name = {}) {
  if (!a.active()) return "nobody rules";
  return (a.leading() ? "leads until " : "obeys agent " + name(a.current().leader) + " until ") + to_string(a.expiry());
}

/// What a message did, as a sentence without a full stop.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(reception<V> const& r, Names const& name = {}) {
  std::string out = to_string(r.verdict);
  if (r.verdict == verdict::refused) out += ": " + to_string(r.reason);
  if (r.claim) out += ": " + to_string(*r.claim);
  for (auto const& c : r.changes)
    out += "; in " + name(c.type) + " agent " + name(c.part.agent) + " " + to_string(c.part.what()) + ": " +
           to_string(c.part, name);
  for (auto const& type : r.disagreements) out += "; its sender believes otherwise of " + name(type);
  if (!r.imposed.empty()) out += "; imposed: " + to_string(r.imposed, name);
  return out;
}

/// What a deliberation came to and why, as a sentence without a full stop.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string describe(decision<V> const& d, Names const& name = {}) {
  if (d.reason == decision_reason::not_executing)
    return "plan type " + name(d.type) + " is not executed: " +
           (d.executed.empty() ? "no plan type was entered" : "entered were " + detail::listing(d.executed, name));
  bool const obeys = d.reason == decision_reason::obeyed;
  bool const leads = !obeys && d.leader.has_value();
  std::string out = d.search && !obeys ? describe(*d.search, name) : to_string(d.reason);
  if (d.search && d.reason == decision_reason::no_valid_allocation)
    out = (d.search->proved ? "no allocation is valid" : "no valid allocation was found") +
          detail::reasons(d.search->refusals, d.search->ignored, d.search->lie, name) +
          "; the robot believes what the others say";
  if (obeys && d.leader) out += ": agent " + name(*d.leader);
  out += d.own ? "; own task: " + to_string(*d.own, name) : std::string("; no task of its own");
  if (!d.left_out.empty() && !obeys) out += "; left out, since they abstain: " + detail::listing(d.left_out, name);
  if (d.dissents) out += "; by itself it would take " + to_string(d.search->atoms, name);
  if (!d.deleted.empty()) out += "; silent agents were deleted: " + to_string(d.deleted, name);
  if (d.reign_ended) out += "; a reign has ended";
  if (d.clock_set_back > duration{}) out += "; the clock was set back by " + to_string(d.clock_set_back);
  if (d.cycles > 0) out += "; cycles completed: " + std::to_string(d.cycles);
  if (d.detected) out += "; a loop with agent " + name(*d.detected) + " was detected";
  if (leads)
    out += d.reign_began     ? "; the robot claims authority"
           : d.reign_renewed ? "; the robot renews its reign, since others would do otherwise"
                             : "; the robot leads";
  return out;
}

}  // namespace rota
