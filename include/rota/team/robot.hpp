#pragma once

#include <rota/model/outline.hpp>
#include <rota/team/authority.hpp>
#include <rota/team/belief.hpp>
#include <rota/team/decision.hpp>
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

/// One member of a team: what it believes about each plan type it executes, and what it does about conflicts.
///
/// A regular value: it owns no thread, clock, socket or pointer into the model, and may be copied, compared and restored.
/// Time is a parameter and must not run backwards. Nothing from outside is trusted: `receive` refuses whole, never throws
/// of itself, and keeps memory bounded by the roster and the plan types entered.
///
/// Usage, every 30 ms: `receive` what the radio brought, `deliberate` per plan type, send all of `next_message`.
template <vocabulary V = runtime_vocabulary, class Monitor = cycle_monitor<V>>
class robot {
public:
  using agent_id = typename V::agent;
  using type_id = typename V::plan_type;

  /// `roster`: every agent that may ever be heard of; messages of others are refused. One's own id may be left out.
  /// @pre periods are positive; 0 < reign ≤ max_reign, or nobody would obey
  robot(agent_id self, std::span<agent_id const> roster, robot_options const& options = {})
      : self_(self), options_(options), next_plan_message_(options.first_message) {
    ROTA_ASSERT(options.message_period > duration{} && options.claim_period > duration{});
    ROTA_ASSERT(options.reign > duration{} && options.reign <= options.max_reign);
    std::vector<agent_id> sorted(roster.begin(), roster.end());
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    for (agent_id b : sorted)
      if (!(b == self)) peers_.push_back({b, {}});
  }

  [[nodiscard]] agent_id self() const noexcept { return self_; }
  [[nodiscard]] robot_options const& options() const noexcept { return options_; }
  /// For the stamp of claims made from now on; those in force keep theirs.
  void set_confidence(std::uint32_t confidence) noexcept { options_.confidence = confidence; }

  /// Begins to execute a plan type, alone and without a task; false if it already does. O(plans · tasks).
  template <class Beliefs>
  bool enter(plan_type<V, Beliefs> const& pt, instant now) {
    auto where = lower(pt.id());
    if (where == tracks_.end() || !(where->names.type() == pt.id())) {
      track fresh;
      where = tracks_.insert(where, fresh);
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

  /// Stops executing a plan type, and leading it; false if it did not. Others learn of it by the next plan message.
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
  /// What this agent believes about a plan type, or nullptr if it does not execute it.
  [[nodiscard]] belief<V> const* believes(type_id type) const {
    auto const* t = executed(type);
    return t ? &t->believed : nullptr;
  }
  /// Who rules a plan type in this agent's view, or nullptr if it does not execute it.
  [[nodiscard]] authority<V> const* rule(type_id type) const {
    auto const* t = executed(type);
    return t ? &t->rule : nullptr;
  }
  /// The state z the agent itself inhabits from now on; false if it does not execute the type. A task begins in the
  /// entry state that its plan says.
  bool set_state(type_id type, typename V::state z) {
    track* t = executed(type);
    if (!t) return false;
    t->believed.set_state(self_, z);
    return true;
  }

  /// Takes in a message. Refused or stale ones change nothing.
  reception<V> receive(message<V> const& m, instant now) {
    if (auto const* plan = std::get_if<plan_message<V>>(&m)) return receive(*plan, now);
    if (auto const* bid = std::get_if<claim<V>>(&m)) return receive(*bid, now);
    return {};
  }

  /// The sender is trusted about itself and about nobody else. Per executed type this is one of the four cases of
  /// section 4; while somebody rules the type, the task in the message is ignored and only coming and going counts.
  /// Numbers only grow: a sender that once sent a number out of reach stays unheard until it restarts with a greater
  /// incarnation. Whether a message is genuine is the transport's business.
  /// O(types of the message · types executed).
  reception<V> receive(plan_message<V> const& m, instant now) {
    if (auto const why = examine(m); why != refusal::none) return {verdict::refused, why, {}, {}};
    peer& sender = *find_peer(m.sender);
    if (m.number <= sender.last) return {verdict::stale, refusal::none, {}, {}};
    sender.last = m.number;
    reception<V> r;
    for (track& t : tracks_) {
      if (!t.executing) continue;
      expire(t, now);
      bury_former_life(t, m);
      auto const said = std::find_if(m.types.begin(), m.types.end(),
                                     [&](participation<V> const& p) { return p.type == t.names.type(); });
      bool const takes_part = said != m.types.end();
      auto const before = t.believed.part(m.sender);
      event<in<V>> e_m;
      if (!takes_part) {
        e_m = dismiss(t, m.sender);
      } else {
        t.believed.admit(m.sender, now);
        auto const told = atom_of(m.sender, said->place);
        if (!t.rule.active()) e_m = t.believed.place(m.sender, told);
        if (told && told == t.believed.part(m.sender)) t.believed.set_state(m.sender, said->place->state);
      }
      auto const after = t.believed.part(m.sender);
      if (!t.rule.active()) t.monitor.on_message(m.sender, before, after, now);
      if (!e_m.empty()) r.changes.push_back({t.names.type(), classify<V>(before, after), std::move(e_m)});
    }
    return r;
  }

  /// Obeys a greater claim, answers a smaller one with its own, and drops what has expired. What the leader says is how
  /// it is: each copy of the claim in force restores what coming, going or silence has changed at this follower since.
  /// Whether the allocation is valid is the leader's judgement, under its own beliefs. O(|claim| log roster).
  reception<V> receive(claim<V> const& c, instant now) {
    if (auto const why = examine(c); why != refusal::none) return {verdict::refused, why, {}, {}};
    if (c.incarnation < find_peer(c.leader)->last.incarnation) return {verdict::stale, refusal::none, {}, {}};
    track& t = *executed(c.type);
    expire(t, now);
    reception<V> r;
    bool const was_active = t.rule.active();
    auto const outcome = t.rule.hear(c, my_stamp(), now);
    r.claim = outcome;
    if (outcome == claim_outcome::challenged) {
      admit_all(t, c, now);
      lead(t, now, now + options_.claim_period);  // unless it deliberates before, as it should
    } else if (t.rule.obeying() && outcome != claim_outcome::outranked && outcome != claim_outcome::expired) {
      if (!was_active) t.monitor.clear();
      admit_all(t, t.rule.current(), now);
      auto e = impose(t, t.rule.current().atoms);
      if (!e.empty()) r.changes.push_back({c.type, message_case::imposed, std::move(e)});
    }
    return r;
  }

  /// One deliberation about one plan type: deletes the silent, then reallocates, or obeys. `pt` must be the plan type
  /// that was entered. Allocates nothing in a steady loop of small teams. Complexity: that of `reallocate`.
  template <class Beliefs>
  decision<V> deliberate(plan_type<V, Beliefs> const& pt, team<V> const& members, Beliefs const& beliefs, instant now,
                         workspace& space, search_budget budget = {}, idling idle = idling::allowed) {
    decision<V> d;
    track* t = executed(pt.id());
    if (!t) return d;
    expire(*t, now);
    d.reign_ended = std::exchange(t->lapsed, false);
    d.deleted = delete_silent(*t, now);
    if (t->rule.obeying()) {
      d.reason = decision_reason::obeyed;
      d.own = t->believed.part(self_);
      return d;
    }
    problem<V, Beliefs> p{pt, members, beliefs, t->believed.participants(), idle};
    p.change_cost = options_.change_cost;
    p.current = t->believed.atoms().atoms();
    auto next = reallocate(p, options_.hysteresis, space, budget);
    d.event = impose(*t, next.atoms);
    d.why = next.reason;
    d.utility = next.utility;
    d.reason = !next.plan        ? decision_reason::no_valid_allocation
               : d.event.empty() ? decision_reason::kept
                                 : decision_reason::reallocated;
    d.own = t->believed.part(self_);
    if (t->rule.leading()) {
      t->rule.revise(t->believed.atoms(), now);
      return d;
    }
    auto const v = t->monitor.on_deliberation(d.event, t->believed.atoms(), now);
    d.cycles = v.cycles;
    d.detected = v.detected;
    if (v.detected && options_.resolution) {
      lead(*t, now, now);
      d.reign_began = true;
    }
    return d;
  }

  /// The next message that is due, claims first; call until it returns nothing. Plan messages keep to a grid of
  /// `message_period` from `first_message` on, however late the call; a missed slot is skipped, not repeated.
  [[nodiscard]] std::optional<message<V>> next_message(instant now) {
    for (track& t : tracks_) {
      if (!t.executing) continue;
      expire(t, now);
      if (auto c = t.rule.next_claim(now, options_.claim_period)) return message<V>{*std::move(c)};
    }
    if (now < next_plan_message_) return std::nullopt;
    // Unsigned, as the first slot may be further back than a duration reaches.
    auto const late = static_cast<std::uint64_t>(now.ns) - static_cast<std::uint64_t>(next_plan_message_.ns);
    auto const period = static_cast<std::uint64_t>(options_.message_period.ns);
    next_plan_message_ = now + nanoseconds(static_cast<std::int64_t>(period - late % period));
    return message<V>{snapshot()};
  }

  /// When `next_message` has something to say, unless something happens before.
  [[nodiscard]] instant next_due() const noexcept {
    instant due = next_plan_message_;
    for (track const& t : tracks_)
      if (t.executing) due = (std::min)(due, t.rule.next_due());
    return due;
  }

  friend bool operator==(robot const&, robot const&) = default;

private:
  struct peer {
    agent_id who{};
    message_number last;
    friend bool operator==(peer const&, peer const&) = default;
  };
  /// One plan type. Kept after leaving it, because claim numbers must go on and expired claims must stay so.
  struct track {
    outline<V> names;
    belief<V> believed;
    Monitor monitor;
    authority<V> rule;
    bool executing = false;
    bool lapsed = false;  // a reign has ended since the last deliberation
    friend bool operator==(track const&, track const&) = default;
  };

  typename std::vector<track>::iterator lower(type_id type) {
    return std::lower_bound(tracks_.begin(), tracks_.end(), type,
                            [](track const& t, type_id key) { return t.names.type() < key; });
  }
  track const* executed(type_id type) const {
    for (track const& t : tracks_)
      if (t.executing && t.names.type() == type) return &t;
    return nullptr;
  }
  track* executed(type_id type) { return const_cast<track*>(std::as_const(*this).executed(type)); }
  peer const* find_peer(agent_id b) const {
    auto const where =
        std::lower_bound(peers_.begin(), peers_.end(), b, [](peer const& p, agent_id key) { return p.who < key; });
    return where != peers_.end() && where->who == b ? &*where : nullptr;
  }
  peer* find_peer(agent_id b) { return const_cast<peer*>(std::as_const(*this).find_peer(b)); }

  claim_stamp<V> my_stamp() const { return {options_.confidence, self_}; }
  static std::optional<in<V>> atom_of(agent_id b, std::optional<placement<V>> const& place) {
    if (!place) return std::nullopt;
    return in<V>{b, place->plan, place->task};
  }

  refusal examine(plan_message<V> const& m) const {
    if (m.sender == self_) return refusal::own_id;
    if (!find_peer(m.sender)) return refusal::stranger;
    for (std::size_t i = 0; i < m.types.size(); ++i) {
      if (i > 0 && !(m.types[i - 1].type < m.types[i].type)) return refusal::types_not_ascending;
      auto const* t = executed(m.types[i].type);
      auto const& place = m.types[i].place;
      if (t && place && !t->names.find(place->plan, place->task)) return refusal::unknown_task;
    }
    return refusal::none;
  }

  refusal examine(claim<V> const& c) const {
    if (c.leader == self_) return refusal::own_id;
    if (!find_peer(c.leader)) return refusal::stranger;
    if (!(c.stamp.id == c.leader)) return refusal::foreign_stamp;
    if (!options_.resolution) return refusal::resolution_off;
    auto const* t = executed(c.type);
    if (!t) return refusal::not_executed;
    if (t->rule.contradicts(c)) return refusal::foreign_stamp;
    if (c.remaining <= duration{} || c.remaining > options_.max_reign) return refusal::remaining_time;
    for (auto const* x = c.atoms.begin(); x != c.atoms.end(); ++x) {
      if (!(x->agent == self_) && !find_peer(x->agent)) return refusal::stranger;
      if (!t->names.find(x->plan, x->task)) return refusal::unknown_task;
      if (!(x->plan == c.atoms.begin()->plan)) return refusal::malformed_allocation;
      if (x != c.atoms.begin() && (x - 1)->agent == x->agent) return refusal::malformed_allocation;
    }
    return refusal::none;
  }

  /// Rule vi of the monitor: nothing that happened before or during authority counts afterwards.
  void expire(track& t, instant now) {
    if (t.rule.expire(now)) normalise(t);
  }
  void normalise(track& t) {
    t.monitor.clear();
    t.lapsed = true;
  }

  void lead(track& t, instant now, instant due) {
    t.monitor.clear();
    t.rule.lead(t.names.type(), t.believed.atoms(), my_stamp(), options_.incarnation, now, due, options_.reign);
  }

  /// The leader takes part, and so does whom it speaks about. Only the leader has given a sign of life.
  void admit_all(track& t, claim<V> const& c, instant now) {
    t.believed.admit(c.leader, now);
    for (in<V> const& x : c.atoms)
      if (!t.believed.takes_part(x.agent)) t.believed.admit(x.agent, now);
  }

  /// A leader that has restarted knows nothing of the reign of its former life.
  void bury_former_life(track& t, plan_message<V> const& m) {
    if (!t.rule.obeying() || !(t.rule.current().leader == m.sender)) return;
    if (t.rule.current().incarnation >= m.number.incarnation) return;
    t.rule.end();
    normalise(t);
  }

  /// b no longer takes part. A reign ends with its leader.
  event<in<V>> dismiss(track& t, agent_id b) {
    auto e = t.believed.expel(b);
    if (t.rule.obeying() && t.rule.current().leader == b) {
      t.rule.release();
      normalise(t);
    }
    return e;
  }

  event<in<V>> delete_silent(track& t, instant now) {
    event<in<V>> total;
    for (std::size_t i = 0; i < t.believed.participants().size();) {
      agent_id const b = t.believed.participants()[i];
      if (b == self_ || now - t.believed.heard(b) <= options_.silence) {
        ++i;
        continue;
      }
      total = compose(total, dismiss(t, b));
      t.monitor.forget(b);
    }
    return total;
  }

  /// Adopts an allocation; whose task changes is taken to begin in its entry state.
  event<in<V>> impose(track& t, allocation_atoms<V> const& atoms) {
    auto e = t.believed.replace(atoms);
    for (auto const& x : e) {
      if (x.value != sign::plus) continue;
      if (auto const* entry = t.names.find(x.atom.plan, x.atom.task)) t.believed.set_state(x.atom.agent, entry->state);
    }
    return e;
  }

  plan_message<V> snapshot() {
    plan_message<V> m{self_, {options_.incarnation, ++sequence_}, {}};
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
  robot_options options_;
  std::vector<peer> peers_;    // ascending by id
  std::vector<track> tracks_;  // ascending by type
  std::uint64_t sequence_ = 0;
  instant next_plan_message_;
};

}  // namespace rota
