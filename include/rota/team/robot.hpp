#pragma once

#include <rota/team/decision.hpp>
#include <rota/team/detail/admission.hpp>
#include <rota/team/detail/digest.hpp>
#include <rota/team/detail/roster.hpp>
#include <rota/team/detail/timetable.hpp>
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
/// Time is a parameter; read the clock once for all calls of a turn. If a call names an earlier instant than the one before,
/// the clock has been set back: the robot then moves all instants that it remembers back as far, as if no time had passed,
/// and the next decision says so. It cannot tell a clock that was set forward from a pause. Clocks show less than a century. A robot trusts nothing from outside: `receive` refuses a bad message as a whole
/// and never throws of itself, and its memory is bounded by the roster and the plan types entered.
///
/// Every 30 ms: `receive` what the radio brought, `deliberate` on each plan type, send every `next_message`.
template <vocabulary V = runtime_vocabulary, class Monitor = conflict_monitor<V>>
class robot {
public:
  using agent_id = typename V::agent;
  using type_id = typename V::plan_type;

  /// `everybody`: all agents that may ever be heard of; messages of others are refused. It may list the robot itself.
  /// `life`: greater at each restart; see `incarnation` for where to get it.
  /// @pre `life` is neither 0 nor above `incarnation::most`; `usable(options)`
  robot(agent_id self, std::span<agent_id const> everybody, rota::incarnation life, robot_options const& options = {})
      : self_(self), incarnation_(life), options_(options), peers_(self, everybody), timetable_(options) {
    ROTA_ASSERT(life.value > 0 && life <= rota::incarnation::most());
    ROTA_ASSERT(usable(options));
  }

  [[nodiscard]] agent_id self() const noexcept { return self_; }
  [[nodiscard]] rota::incarnation incarnation() const noexcept { return incarnation_; }
  [[nodiscard]] robot_options const& options() const& noexcept { return options_; }
  robot_options const& options() const&& = delete;
  /// For claims made from now on; claims in force keep their stamp.
  void set_confidence(std::uint32_t confidence) noexcept { options_.confidence = confidence; }

  /// Begins to execute a plan type, alone and without a task. False if the robot already executes it, or executes as many as a
  /// message may list, `plan_message::most_types`. O(plans · tasks).
  template <class Beliefs>
  bool enter(plan_type<V, Beliefs> const& pt, instant now) {
    synchronise(now);
    auto where = std::lower_bound(tracks_.begin(), tracks_.end(), pt.id(),
                                  [](track const& t, type_id key) { return t.names.type() < key; });
    bool const known = where != tracks_.end() && where->names.type() == pt.id();
    if (known && where->executing) return false;
    if (std::count_if(tracks_.begin(), tracks_.end(), [](track const& t) { return t.executing; }) ==
        static_cast<std::ptrdiff_t>(plan_message<V>::most_types))
      return false;
    if (!known) where = tracks_.insert(where, track{});
    where->names = outline<V>(pt);
    where->executing = true;
    where->monitor = Monitor(monitor_options{options_.cycles, options_.pending_age, options_.yielding});
    where->judged = false;
    where->believed = {};
    where->believed.admit(self_, now);
    timetable_.note_news();
    return true;
  }

  /// Stops executing a plan type, and leading it. False if the robot does not execute it. The others learn of it by the
  /// next plan message.
  bool leave(type_id type) {
    track* t = executed(type);
    if (!t) return false;
    t->executing = false;
    t->lapsed = false;
    t->blind = false;
    t->stance = stance::none;
    t->believed = {};
    t->monitor.clear();
    t->rule.release();
    timetable_.note_news();
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
  /// Message numbers only grow, and by `most_jump` at most. A sender that was not heard for `robot_options::forget` may
  /// begin a new life with any number. Whether a message is genuine is for the transport to ensure.
  /// O(types of the message + types known), and for each executed type two searches for the sender.
  reception<V> receive(plan_message<V> const& m, instant now) {
    auto* const sender = peers_.find(m.sender);
    if (auto const reason = admission().refuses(m, sender, now); reason != refusal::none) return dropped(reason);
    ROTA_ASSERT(sender != nullptr);  // or it would have been a stranger
    bool const new_life = m.number <= sender->last;
    if (new_life && !sender->forgotten(now, options_.forget)) return dropped();
    synchronise(now);
    if (new_life)
      for (track& t : tracks_) t.rule.forget(m.sender);
    sender->last = m.number;
    sender->heard = now;
    reception<V> r;
    r.relay = true;
    auto const* said = m.types.begin();
    for (track& t : tracks_) {
      while (said != m.types.end() && said->type < t.names.type()) ++said;
      bool const listed = said != m.types.end() && said->type == t.names.type();
      if (t.rule.hear_over(m.sender, m.number.incarnation, m.claims, listed ? said->leads : 0, now, options_.max_delay))
        t.normalise();
      if (!t.executing) continue;
      t.expire(now);
      part_change<V> change{m.sender};
      if (!listed) {
        if (t.rule.obeys_after(m.sender, m.number.incarnation, m.claims)) continue;  // said before it took part
        change = t.dismiss(m.sender);
      } else if (t.rule.active()) {
        t.believed.hear_ruled(m.sender, said->place, now, said->stance);
        continue;
      } else {
        change = t.believed.hear(m.sender, said->place, now, said->stance);
      }
      if (!t.rule.active()) t.monitor.on_message(change, now);
      if (!change.empty()) {
        t.judged = false;
        r.changes.push_back({t.names.type(), change});
      }
      if (listed && said->fingerprint && *said->fingerprint != t.fingerprint())
        r.disagreements.push_back(t.names.type());
    }
    if (!r.disagreements.empty()) timetable_.note_disagreement();
    return r;
  }

  /// Obeys a greater claim, answers a smaller one with its own, and drops a claim that has ended. An answer says what a
  /// deliberation chose: the last one, if nothing was heard since that changes it, or the next. A claim is authoritative:
  /// each copy of the claim in force undoes what coming, going or silence has changed at this follower since; but it does not
  /// bring back whom its leader has not heard for `robot_options::silence`.
  /// The leader judges whether its allocation is valid, under its own beliefs. O(|claim| log roster).
  reception<V> receive(claim<V> const& c, instant now) {
    auto const* const sender = peers_.find(c.leader);
    if (auto const reason = admission().refuses(c); reason != refusal::none) return dropped(reason);
    ROTA_ASSERT(sender != nullptr);  // or it would have been a stranger
    if (c.incarnation < sender->last.incarnation) return dropped();
    synchronise(now);
    track& t = *executed(c.type);
    t.expire(now);
    reception<V> r;
    bool const was_active = t.rule.active();
    if (t.rule.renews(c)) t.thaw();
    auto const stamp =
        t.stamp_at(options_.confidence, self_, now);             // before it is frozen, also if it does not answer now
    bool const answers = !t.blind && c.answers < peers_.size();  // with the others' answers before, one of each at most
    auto const mine = answers ? std::optional{stamp} : std::nullopt;
    auto const heard = t.rule.hear(c, mine, now, options_.max_delay);
    r.claim = heard.outcome;
    if (heard.outcome == claim_outcome::expired) {
      if (was_active && !t.rule.active()) t.normalise();
      return r;
    }
    t.freeze(now + c.remaining);
    if (heard.outcome == claim_outcome::challenged) {
      (void)t.admit_all(c, now, options_.silence, options_.max_delay + heard.late);
      t.believed.forget_dissent();
      // No longer than the claim that it answers: all authority that follows from one detection ends together. What others
      // have said since the last deliberation may mix plans, and nobody has judged it: then the next one says the answer.
      lead(t, c.renewals, c.answers + 1, now, t.judged ? now : never, now + (std::min)(options_.reign, c.remaining));
    } else if (t.rule.obeying() && heard.outcome != claim_outcome::outranked) {
      if (!was_active) t.monitor.clear();
      r.relay = heard.fresh;
      auto const atoms = t.admit_all(c.version == t.rule.current().version ? c : t.rule.current(), now,
                                     options_.silence, options_.max_delay + heard.late);
      r.imposed = difference(t.believed.atoms(), atoms);
      t.obey(atoms, r.imposed);
      t.judged = false;
    }
    return r;
  }

  /// One deliberation on one plan type: deletes the silent, then reallocates, or obeys. `pt` must be the plan type that was
  /// entered; if none with its id was, nothing happens, and the decision says which types the robot executes.
  ///
  /// A reallocation begins with what the others said last and with the robot's own part. If no allocation is valid the robot
  /// takes no task, believes the others, and abstains until it sees better: it neither counts cycles, claims nor answers.
  /// Allocates nothing in a steady loop of up to eight robots. Complexity: that of `reallocate`.
  template <class Beliefs>
  decision<V> deliberate(plan_type<V, Beliefs> const& pt, team<V> const& members, Beliefs const& beliefs, instant now,
                         workspace& space, search_budget budget = {}, idling idle = idling::allowed) {
    synchronise(now);
    decision<V> d;
    d.type = pt.id();
    d.clock_set_back = std::exchange(set_back_, {});
    track* t = executed(pt.id());
    if (!t) {
      for (track const& other : tracks_)
        if (other.executing) d.executed.push_back(other.names.type());
      return d;
    }
    t->expire(now);
    d.reign_ended = std::exchange(t->lapsed, false);
    d.deleted = t->delete_silent(self_, now, options_.silence);
    bool const obeys = t->rule.obeying();
    if (obeys) d.reason = decision_reason::obeyed;
    if (!obeys || options_.renewals > 0) {
      auto const here = t->rule.active() ? t->believed.atoms() : t->believed.told(self_);
      auto& next = d.search.emplace(searched(*t, pt, members, beliefs, here, space, budget, idle, d.left_out));
      ROTA_ASSERT(t->knows(next.atoms));  // or else another plan type was entered under this id
      if (!std::exchange(t->blind, !next.plan)) t->abstains_from = now + options_.message_period;
      // Who misses a single look, and sees again, has nothing to say.
      auto const stands = t->blind && now >= t->abstains_from        ? stance::abstains
                          : obeys && !t->blind && next.atoms != here ? stance::dissents
                                                                     : stance::none;
      if (stands != t->stance && stands != stance::none) timetable_.note_news();
      t->stance = stands;
      d.dissents = t->stance == stance::dissents;
      if (!obeys) {
        auto const adopted = t->blind ? others(here) : next.atoms;
        d.event = difference(t->believed.atoms(), adopted);
        t->adopt(adopted, d.event);
        d.reason = t->blind          ? decision_reason::no_valid_allocation
                   : d.event.empty() ? decision_reason::kept
                                     : decision_reason::reallocated;
        t->judged = !t->blind;
        conclude(*t, d, now);
      }
    }
    d.own = t->believed.part(self_);
    if (!d.event.empty() && !t->rule.active()) timetable_.note_news();
    if (t->rule.active()) d.leader = t->rule.current().leader;
    return d;
  }

  /// The next message that is due, claims first; call it until it returns nothing. Plan messages keep to a grid of
  /// `message_period` from `first_message` on, however late the call; a slot that was missed is not made up for. With
  /// `change_period`, news does not wait for its slot, and is said twice.
  [[nodiscard]] std::optional<message<V>> next_message(instant now) {
    synchronise(now);
    for (track& t : tracks_) {
      if (!t.executing) continue;
      t.expire(now);
      if (auto c = t.rule.next_claim(now, options_.claim_period, options_.opening, options_.opening_period)) {
        for (in<V> const& x : c->atoms) c->ages.push_back(t.age_of(x.agent, self_, now, options_.silence));
        return message<V>{*std::move(c)};
      }
    }
    if (now < timetable_.next_due()) return std::nullopt;
    timetable_.sent(now);
    return message<V>{snapshot()};
  }

  /// When `next_message` will have something to send, unless something happens before.
  [[nodiscard]] instant next_due() const noexcept {
    instant due = timetable_.next_due();
    for (track const& t : tracks_)
      if (t.executing) due = (std::min)(due, t.rule.next_due());
    return due;
  }

  /// A digest of everything that decides what the robot does from `now` on, whatever its options. Two robots with equal
  /// options whose digests are equal, each at its own instant, behave alike from then on, but for collisions: to explore and
  /// to replay.
  [[nodiscard]] std::uint64_t digest(instant now) const {
    detail::state_digest d(now);
    d(self_, incarnation_.value, peers_).all(tracks_);
    d(sequence_, claims_, timetable_, set_back_);
    return d.value();
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

  /// Notes the time. If the clock was set back, everything remembered goes back with it.
  void synchronise(instant now) {
    ROTA_ASSERT(instant{} - century <= now && now <= instant{} + century);
    if (now < latest_) {
      duration const d = now - latest_;
      set_back_ = (std::min)(set_back_ - d, century);
      peers_.shift(d);
      for (track& t : tracks_) t.shift(d);
      timetable_.shift(now, d);
    }
    latest_ = now;
    timetable_.keep_up(now);
  }
  [[nodiscard]] detail::admission<V, Monitor> admission() const {
    return {self_, incarnation_, options_, peers_, tracks_};
  }
  /// What an allocation says of everybody else.
  allocation_atoms<V> others(allocation_atoms<V> const& atoms) const {
    auto rest = atoms;
    if (auto const own = part_of<V>(atoms, self_); !own.empty()) rest.erase(own.front());
    return rest;
  }

  /// The answer to a message that changes nothing: refused for a reason, or else stale.
  static reception<V> dropped(refusal reason = refusal::none) {
    reception<V> r;
    r.verdict = reason == refusal::none ? verdict::stale : verdict::refused;
    r.reason = reason;
    return r;
  }

  /// Reallocates among those who do not abstain; if nothing valid is found, then among all. So robots that abstain do not make
  /// others abstain.
  template <class Beliefs>
  reallocation<V> searched(track const& t, plan_type<V, Beliefs> const& pt, team<V> const& members,
                           Beliefs const& beliefs, allocation_atoms<V> const& here, workspace& space,
                           search_budget const& budget, idling idle, small_vector<agent_id, 2>& left_out) const {
    auto const everybody = t.believed.participants();
    problem<V, Beliefs> p{pt, members, beliefs, everybody, idle};
    p.change_cost = options_.change_cost;
    if (t.believed.anybody(stance::abstains)) {
      auto const willing = t.believed.willing();
      auto rest = here;
      for (agent_id const b : everybody)
        if (auto const x = part_of<V>(here, b);
            !std::binary_search(willing.begin(), willing.end(), b) && (left_out.push_back(b), !x.empty()))
          rest.erase(x.front());
      p.participants = {willing.begin(), willing.size()};
      p.current = rest.atoms();
      auto found = reallocate(p, options_.hysteresis, space, budget);
      if (found.plan) return found;
      left_out.clear();
      p.participants = everybody;
    }
    p.current = here.atoms();
    return reallocate(p, options_.hysteresis, space, budget);
  }

  void lead(track& t, std::uint32_t renewals, std::uint32_t answers, instant now, instant due, instant expiry) {
    t.monitor.clear();
    auto const stamp = t.stamp_at(options_.confidence, self_, now);
    t.freeze(expiry);
    t.rule.lead(t.names.type(), t.believed.atoms(), stamp, incarnation_, ++claims_, now, due, expiry, renewals,
                answers);
    timetable_.note_news();
  }
  /// What follows from a search: a leader says it; everybody else looks for a loop, and claims if there is one. Who sees
  /// nothing valid does neither.
  void conclude(track& t, decision<V>& d, instant now) {
    if (t.blind) {
      if (t.rule.leading()) {
        t.rule.release();
        t.normalise();
        timetable_.note_news();
      }
      t.monitor.clear();
      return;
    }
    if (t.rule.leading()) {
      t.rule.revise(t.believed.atoms(), now);
      d.reign_renewed = renew(t, now);
      return;
    }
    auto const v = t.monitor.on_deliberation(d.event, t.believed.atoms(), now);
    d.cycles = v.cycles;
    d.detected = v.detected;
    if (!v.detected || !options_.resolution) return;
    // Beside a greater leader that is still heard, though its claim has ended by this clock, there shall be no second one.
    if (now < t.rule.heard_late(t.stamp_at(options_.confidence, self_, now)) + 2 * options_.claim_period) return;
    t.believed.forget_dissent();
    lead(t, 0, 0, now, now, now + options_.reign);
    d.reign_began = true;
  }
  /// A leader whose claim ends soon claims anew if it was told that others would do otherwise. It says so early enough for
  /// everybody to hear of it before the claim ends; who leads is open again, so the stamp is computed anew.
  bool renew(track& t, instant now) {
    duration const left = t.rule.expiry() - now;
    std::uint32_t const before = t.rule.current().renewals;
    duration const early = (std::max)(options_.max_delay, 2 * options_.claim_period);
    if (left > (std::min)(early, duration{options_.reign.ns / 2})) return false;
    if (before >= options_.renewals || !t.believed.disputed(now - options_.reign)) return false;
    t.rule.release();
    t.thaw();
    lead(t, before + 1, 0, now, now, now + options_.reign);
    return true;
  }

  plan_message<V> snapshot() {
    plan_message<V> m{self_, {incarnation_, ++sequence_}, claims_, {}};
    for (track const& t : tracks_) {
      if (!t.executing) continue;
      participation<V> p;
      p.type = t.names.type();
      if (auto const own = t.believed.part(self_))
        p.place = placement<V>{own->plan, own->task, *t.believed.state(self_)};
      if (t.rule.leading()) p.leads = t.rule.current().number;
      // Nobody knows by itself what it would do whose reigns have a fixed length; and nobody dissents where nobody rules.
      bool const asked = t.rule.obeying() ? options_.renewals > 0 : t.stance == stance::abstains;
      if (asked) p.stance = t.stance;
      if (options_.fingerprints && encodable_atom<in<V>>) p.fingerprint = t.fingerprint();
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
  std::uint64_t claims_ = 0;  // made in this life
  detail::timetable timetable_;
  instant latest_ = long_ago;
  duration set_back_{};  // by so much the clock was set back since the last decision
};

}  // namespace rota
