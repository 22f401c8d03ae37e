#pragma once

#include <rota/team/decision.hpp>
#include <rota/team/detail/roster.hpp>
#include <rota/team/detail/track.hpp>
#include <rota/team/message.hpp>
#include <rota/team/monitor.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace rota {

/// One robot of a team: what it believes about each plan type that it executes, and what it does about conflicts.
///
/// A regular value: it owns no thread, clock, socket or pointer into the model, and may be copied, compared and restored.
/// Time is a parameter and must not run backwards. A robot trusts nothing from outside: `receive` refuses a bad message as a
/// whole and never throws of itself, and its memory is bounded by the roster and the plan types entered.
///
/// Every 30 ms: `receive` what the radio brought, `deliberate` on each plan type, send every `next_message`.
template <vocabulary V = runtime_vocabulary, class Monitor = cycle_monitor<V>>
class robot {
public:
  using agent_id = typename V::agent;
  using type_id = typename V::plan_type;

  /// `everybody`: all agents that may ever be heard of; messages of others are refused. It may list the robot itself.
  /// `life`: greater at each restart; see `incarnation` for where to get it.
  /// @pre `life` is not 0; periods are positive; 0 < reign ≤ max_reign, or nobody would obey
  robot(agent_id self, std::span<agent_id const> everybody, rota::incarnation life, robot_options const& options = {})
      : self_(self),
        incarnation_(life),
        options_(options),
        peers_(self, everybody),
        next_plan_message_(options.first_message) {
    ROTA_ASSERT(life.value > 0);
    ROTA_ASSERT(options.message_period > duration{} && options.claim_period > duration{});
    ROTA_ASSERT(options.reign > duration{} && options.reign <= options.max_reign);
  }

  [[nodiscard]] agent_id self() const noexcept { return self_; }
  [[nodiscard]] rota::incarnation incarnation() const noexcept { return incarnation_; }
  [[nodiscard]] robot_options const& options() const& noexcept { return options_; }
  robot_options const& options() const&& = delete;
  /// For claims made from now on; claims in force keep their stamp.
  void set_confidence(std::uint32_t confidence) noexcept { options_.confidence = confidence; }

  /// Begins to execute a plan type, alone and without a task. False if the robot already executes it. O(plans · tasks).
  template <class Beliefs>
  bool enter(plan_type<V, Beliefs> const& pt, instant now) {
    auto where = std::lower_bound(tracks_.begin(), tracks_.end(), pt.id(),
                                  [](track const& t, type_id key) { return t.names.type() < key; });
    if (where == tracks_.end() || !(where->names.type() == pt.id())) {
      where = tracks_.insert(where, track{});
    } else if (where->executing) {
      return false;
    }
    where->names = outline<V>(pt);
    where->executing = true;
    where->monitor = Monitor(monitor_options{options_.cycles, options_.pending_age});
    where->believed = {};
    where->believed.admit(self_, now);
    return true;
  }

  /// Stops executing a plan type, and leading it. False if the robot does not execute it. The others learn of it by the
  /// next plan message.
  bool leave(type_id type) {
    track* t = executed(type);
    if (!t) return false;
    t->executing = false;
    t->lapsed = false;
    t->believed = {};
    t->monitor.clear();
    t->rule.leading() ? t->rule.end() : t->rule.release();
    return true;
  }

  [[nodiscard]] bool executes(type_id type) const { return executed(type) != nullptr; }
  /// What the robot believes about a plan type, or nullptr if it does not execute it.
  [[nodiscard]] belief<V> const* believes(type_id type) const& {
    auto const* t = executed(type);
    return t ? &t->believed : nullptr;
  }
  belief<V> const* believes(type_id type) const&& = delete;
  /// Who rules a plan type in the robot's view, or nullptr if it does not execute it.
  [[nodiscard]] authority<V> const* rule(type_id type) const& {
    auto const* t = executed(type);
    return t ? &t->rule : nullptr;
  }
  authority<V> const* rule(type_id type) const&& = delete;
  /// Notes the state z that the robot itself inhabits from now on. False if it does not execute the type. A new task begins
  /// in the entry state that its plan names.
  bool set_state(type_id type, typename V::state z) {
    track* t = executed(type);
    if (!t) return false;
    t->believed.set_state(self_, z);
    return true;
  }

  /// Takes in a message. A refused or stale message changes nothing.
  reception<V> receive(message<V> const& m, instant now) {
    if (auto const* plan = std::get_if<plan_message<V>>(&m)) return receive(*plan, now);
    if (auto const* bid = std::get_if<claim<V>>(&m)) return receive(*bid, now);
    return {};
  }

  /// Takes in what a sender says about itself; it is trusted about nobody else. For each executed type this is one of the
  /// four cases of section 4. While somebody rules the type, the task in the message is ignored; coming and going counts.
  ///
  /// Message numbers only grow: a sender that once sent a number out of reach stays unheard until it restarts with a greater
  /// incarnation. Whether a message is genuine is for the transport to ensure.
  /// O(types of the message + types known), and for each executed type two searches for the sender.
  reception<V> receive(plan_message<V> const& m, instant now) {
    auto* const sender = peers_.find(m.sender);
    if (auto const reason = examine(m, sender != nullptr); reason != refusal::none) return dropped(reason);
    if (m.number <= sender->last) return dropped();
    sender->last = m.number;
    reception<V> r;
    auto const* said = m.types.begin();
    for (track& t : tracks_) {
      while (said != m.types.end() && said->type < t.names.type()) ++said;
      if (!t.executing) continue;
      t.expire(now);
      t.bury_former_life(m.sender, m.number.incarnation);
      part_change<V> change{m.sender};
      if (said == m.types.end() || !(said->type == t.names.type())) {
        change = t.dismiss(m.sender);
      } else if (t.rule.active()) {
        t.believed.hear_ruled(m.sender, said->place, now);
        continue;
      } else {
        change = t.believed.hear(m.sender, said->place, now);
      }
      if (!t.rule.active()) t.monitor.on_message(change, now);
      if (!change.empty()) r.changes.push_back({t.names.type(), change});
    }
    return r;
  }

  /// Obeys a greater claim, answers a smaller one with its own, and drops a claim that has ended. A claim is authoritative:
  /// each copy of the claim in force undoes what coming, going or silence has changed at this follower since.
  /// The leader judges whether its allocation is valid, under its own beliefs. O(|claim| log roster).
  reception<V> receive(claim<V> const& c, instant now) {
    auto const* const sender = peers_.find(c.leader);
    if (auto const reason = examine(c, sender != nullptr); reason != refusal::none) return dropped(reason);
    if (c.incarnation < sender->last.incarnation) return dropped();
    track& t = *executed(c.type);
    t.expire(now);
    reception<V> r;
    bool const was_active = t.rule.active();
    auto const outcome = t.rule.hear(c, my_stamp(), now);
    r.claim = outcome;
    if (outcome == claim_outcome::challenged) {
      t.admit_all(c, now);
      lead(t, now, now + options_.claim_period);  // a deliberation before that sends it at once
    } else if (t.rule.obeying() && outcome != claim_outcome::outranked && outcome != claim_outcome::expired) {
      if (!was_active) t.monitor.clear();
      auto const& current = t.rule.current();
      t.admit_all(current, now);
      r.imposed = difference(t.believed.atoms(), current.atoms);
      t.adopt(current.atoms, r.imposed);
    }
    return r;
  }

  /// One deliberation on one plan type: deletes the silent, then reallocates, or obeys. `pt` must be the plan type that was
  /// entered; if none with its id was, nothing happens, and the decision says which types the robot executes.
  ///
  /// Allocates nothing in a steady loop of up to eight robots. Complexity: that of `reallocate`.
  template <class Beliefs>
  decision<V> deliberate(plan_type<V, Beliefs> const& pt, team<V> const& members, Beliefs const& beliefs, instant now,
                         workspace& space, search_budget budget = {}, idling idle = idling::allowed) {
    decision<V> d;
    d.type = pt.id();
    track* t = executed(pt.id());
    if (!t) {
      for (track const& other : tracks_)
        if (other.executing) d.executed.push_back(other.names.type());
      return d;
    }
    t->expire(now);
    d.reign_ended = std::exchange(t->lapsed, false);
    d.deleted = t->delete_silent(self_, now, options_.silence);
    if (t->rule.obeying()) {
      d.reason = decision_reason::obeyed;
    } else {
      problem<V, Beliefs> here{pt, members, beliefs, t->believed.participants(), idle};
      here.current = t->believed.atoms().atoms();
      here.change_cost = options_.change_cost;
      auto const& next = d.search.emplace(reallocate(here, options_.hysteresis, space, budget));
      ROTA_ASSERT(t->knows(next.atoms));  // or else another plan type was entered under this id
      t->adopt(next.atoms, next.event);
      d.reason = !next.plan           ? decision_reason::no_valid_allocation
                 : next.event.empty() ? decision_reason::kept
                                      : decision_reason::reallocated;
      conclude(*t, d, now);
    }
    d.own = t->believed.part(self_);
    if (t->rule.active()) d.leader = t->rule.current().leader;
    return d;
  }

  /// The next message that is due, claims first; call it until it returns nothing. Plan messages keep to a grid of
  /// `message_period` from `first_message` on, however late the call; a slot that was missed is not made up for.
  [[nodiscard]] std::optional<message<V>> next_message(instant now) {
    for (track& t : tracks_) {
      if (!t.executing) continue;
      t.expire(now);
      if (auto c = t.rule.next_claim(now, options_.claim_period)) return message<V>{*std::move(c)};
    }
    if (now < next_plan_message_) return std::nullopt;
    // Unsigned, as the first slot may be further back than a duration reaches.
    auto const late = static_cast<std::uint64_t>(now.ns) - static_cast<std::uint64_t>(next_plan_message_.ns);
    auto const period = static_cast<std::uint64_t>(options_.message_period.ns);
    next_plan_message_ = now + nanoseconds(static_cast<std::int64_t>(period - late % period));
    return message<V>{snapshot()};
  }

  /// When `next_message` will have something to send, unless something happens before.
  [[nodiscard]] instant next_due() const noexcept {
    instant due = next_plan_message_;
    for (track const& t : tracks_)
      if (t.executing) due = (std::min)(due, t.rule.next_due());
    return due;
  }

  friend bool operator==(robot const&, robot const&) = default;

private:
  using track = detail::track<V, Monitor>;

  track const* executed(type_id type) const {
    for (track const& t : tracks_)
      if (t.executing && t.names.type() == type) return &t;
    return nullptr;
  }
  track* executed(type_id type) { return const_cast<track*>(std::as_const(*this).executed(type)); }

  claim_stamp<V> my_stamp() const { return {options_.confidence, self_}; }

  static reception<V> dropped(refusal reason) {
    reception<V> r;
    r.verdict = verdict::refused;
    r.reason = reason;
    return r;
  }
  static reception<V> dropped() {
    reception<V> r;
    r.verdict = verdict::stale;
    return r;
  }

  refusal examine(plan_message<V> const& m, bool known) const {
    if (m.sender == self_) return refusal::own_id;
    if (!known) return refusal::stranger;
    auto t = tracks_.begin();
    for (auto const* p = m.types.begin(); p != m.types.end(); ++p) {
      if (p != m.types.begin() && !((p - 1)->type < p->type)) return refusal::types_not_ascending;
      while (t != tracks_.end() && t->names.type() < p->type) ++t;
      if (t == tracks_.end() || !t->executing || !(t->names.type() == p->type) || !p->place) continue;
      if (!t->names.find(p->place->plan, p->place->task)) return refusal::unknown_task;
    }
    return refusal::none;
  }

  refusal examine(claim<V> const& c, bool known) const {
    if (c.leader == self_) return refusal::own_id;
    if (!known) return refusal::stranger;
    if (!(c.stamp.id == c.leader)) return refusal::foreign_stamp;
    if (!options_.resolution) return refusal::resolution_off;
    auto const* t = executed(c.type);
    if (!t) return refusal::not_executed;
    if (t->rule.contradicts(c)) return refusal::foreign_stamp;
    if (c.remaining <= duration{} || c.remaining > options_.max_reign) return refusal::remaining_time;
    for (auto const* x = c.atoms.begin(); x != c.atoms.end(); ++x) {
      if (!(x->agent == self_) && !peers_.find(x->agent)) return refusal::stranger;
      if (!t->names.find(x->plan, x->task)) return refusal::unknown_task;
      if (!(x->plan == c.atoms.begin()->plan)) return refusal::malformed_allocation;
      if (x != c.atoms.begin() && (x - 1)->agent == x->agent) return refusal::malformed_allocation;
    }
    return refusal::none;
  }

  void lead(track& t, instant now, instant due) {
    t.monitor.clear();
    t.rule.lead(t.names.type(), t.believed.atoms(), my_stamp(), incarnation_, now, due, options_.reign);
  }
  /// What follows from a search: a leader says it; everybody else looks for a loop, and claims if there is one.
  void conclude(track& t, decision<V>& d, instant now) {
    if (t.rule.leading()) {
      t.rule.revise(t.believed.atoms(), now);
      return;
    }
    auto const v = t.monitor.on_deliberation(d.event(), t.believed.atoms(), now);
    d.cycles = v.cycles;
    d.detected = v.detected;
    if (!v.detected || !options_.resolution) return;
    lead(t, now, now);
    d.reign_began = true;
  }

  plan_message<V> snapshot() {
    plan_message<V> m{self_, {incarnation_, ++sequence_}, {}};
    for (track const& t : tracks_) {
      if (!t.executing) continue;
      participation<V> p{t.names.type(), std::nullopt};
      if (auto const own = t.believed.part(self_))
        p.place = placement<V>{own->plan, own->task, *t.believed.state(self_)};
      m.types.push_back(p);
    }
    return m;
  }

  agent_id self_;
  rota::incarnation incarnation_;
  robot_options options_;
  detail::roster<V> peers_;
  std::vector<track> tracks_;  // ascending by type
  std::uint64_t sequence_ = 0;
  instant next_plan_message_;
};

}  // namespace rota
