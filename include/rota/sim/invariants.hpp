#pragma once

#include <rota/core/lifetime.hpp>
#include <rota/sim/promises.hpp>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rota::sim {

/// The first invariant that a run broke.
struct violation {
  invariant what{};
  instant at{};
  std::size_t robot = 0;  ///< index; its id is one more
  std::string reason;
};

/// What a run has come through, so that a quiet one is not taken for a proof.
struct sightings {
  std::uint64_t ticks = 0;    ///< deliberations of one robot
  std::uint64_t records = 0;  ///< … and everything else that was said, heard or changed
  std::uint64_t detections = 0, reigns = 0, renewals = 0, answers = 0, given_way = 0;
  std::array<std::uint64_t, 6> claims{};  ///< heard, by outcome
  std::uint64_t stale = 0, refused = 0;   ///< messages
  std::uint64_t deletions = 0, crashes = 0, restarts = 0, absences = 0;

  void add(sightings const& s) {
    ticks += s.ticks, records += s.records, detections += s.detections, reigns += s.reigns, renewals += s.renewals,
        answers += s.answers;
    given_way += s.given_way, stale += s.stale, refused += s.refused, deletions += s.deletions;
    crashes += s.crashes, restarts += s.restarts, absences += s.absences;
    for (std::size_t i = 0; i < claims.size(); ++i) claims[i] += s.claims[i];
  }
};

/// Watches a simulation at every step, and keeps the first violation. Reads only what the log says and what robots say of
/// themselves: `believes`, `rule`, `incarnation`, `options`.
template <class Simulation>
class invariant_watch {
public:
  /// `team` must outlive the watch.
  invariant_watch(Simulation const& team ROTA_LIFETIMEBOUND, promises const& p, faults const& f)
      : team_(team), promises_(p), views_(team.size(), view(team.size())), leaders_(team.size()) {
    for (std::size_t i = 0; i < team.size(); ++i) leaders_[i].orderly = f.orderly(i);
  }
  invariant_watch(Simulation const&&, promises const&, faults const&) = delete;

  void operator()(log_record const& r) {
    if (broken_) return;
    count(r);
    if (r.changed)
      fail(invariant::nothing_changed, r, "a message of " + id(r.other) + " that does not count has changed it");
    if (r.what == happening::crashed || r.what == happening::left) {
      if (r.what == happening::crashed) views_[r.robot] = view(team_.size());
      views_[r.robot].held.reset();
      return;
    }
    if (r.what == happening::said_plan || r.what == happening::said_claim) leaders_[r.robot].spoke = r.time;
    if (r.what == happening::heard_plan && r.verdict != verdict::refused) hear_plan(r);
    if (!team_.plays(r.robot)) return;
    if (r.what == happening::entered) views_[r.robot].abstains = false;
    if (r.abstains) views_[r.robot].abstains = *r.abstains;
    if (r.what == happening::reign_began) begin_reign(r);
    if (r.what == happening::reign_renewed) renew_reign(r);
    if (r.what == happening::heard_claim) hear_smaller(r);
    look_at_rule(r);
    if (r.what == happening::heard_claim) hear_claim(r);
    if (r.what == happening::deliberated) look_around(r);
    if (r.time >= promises_.settled) look_settled(r);
  }

  [[nodiscard]] std::optional<violation> const& broken() const noexcept { return broken_; }
  [[nodiscard]] sightings const& seen() const noexcept { return seen_; }

private:
  struct identity {
    std::size_t leader = 0;
    rota::incarnation incarnation{};
    std::uint64_t number = 0;
    friend auto operator<=>(identity const&, identity const&) = default;
  };
  /// What one robot has heard of another in its present life.
  struct peer {
    std::optional<message_number> last;
    bool objects = false;  // it said last that it dissents, or abstains
    instant heard{};       // on its own clock
    std::optional<identity> obeyed;
    instant end{};  // of that claim, on its own clock
    std::optional<identity> answered;
  };
  struct view {
    explicit view(std::size_t robots) : peers(robots) {}
    struct in_force {
      identity what;
      claim_stamp<names> stamp;
      instant since{};
      instant end{};
    };
    std::vector<peer> peers;
    std::optional<in_force> held;
    std::optional<identity> answers;  // what it has just been challenged by
    std::size_t participants = 0;
    bool abstains = false;
  };
  struct reign {
    identity what;
    instant end{};   // simulated time
    instant root{};  // the end of the first claim of the cascade
    std::int64_t hops = 0;
  };
  struct leader {
    std::vector<reign> reigns;
    instant spoke{};
    bool orderly = true;
  };

  void fail(invariant what, log_record const& r, std::string why) {
    if (!broken_) broken_ = violation{what, r.time, r.robot, std::move(why)};
  }
  [[nodiscard]] bool genuine(log_record const& r) const { return r.time >= promises_.genuine; }
  [[nodiscard]] auto const& mind(std::size_t i) const { return team_.robot(i); }
  [[nodiscard]] auto const& rule(std::size_t i) const { return *mind(i).rule(team_.book().type.id()); }
  [[nodiscard]] auto const& belief_of(std::size_t i) const { return *mind(i).believes(team_.book().type.id()); }
  [[nodiscard]] instant local(log_record const& r) const { return team_.clock(r.robot).local(r.time); }
  static std::size_t index(names::agent a) { return static_cast<std::size_t>(a.value) - 1; }
  static std::string id(std::size_t robot) { return "robot " + std::to_string(robot + 1); }
  static std::string shown(duration d) { return std::to_string(d.ns / 1'000) + " us"; }
  static identity name(claim<names> const& c) { return {index(c.leader), c.incarnation, c.number}; }
  static std::string shown(identity const& x) {
    return std::to_string(x.leader + 1) + '#' + std::to_string(x.number) + " of life " +
           std::to_string(x.incarnation.value);
  }

  void count(log_record const& r) {
    ++seen_.records;
    switch (r.what) {
    case happening::deliberated:
      ++seen_.ticks;
      seen_.detections += r.detected ? 1 : 0;
      break;
    case happening::heard_claim:
      if (r.claim) ++seen_.claims[static_cast<std::size_t>(*r.claim)];
      [[fallthrough]];
    case happening::heard_plan:
      seen_.stale += r.verdict == verdict::stale ? 1 : 0;
      seen_.refused += r.verdict == verdict::refused ? 1 : 0;
      if (r.verdict == verdict::refused && r.genuine && genuine(r) && leaders_[r.other].orderly &&
          r.reason != refusal::not_executed)
        fail(invariant::nothing_refused, r,
             "what " + id(r.other) + " said is refused, for reason " + std::to_string(static_cast<int>(r.reason)));
      break;
    case happening::reign_began: ++seen_.reigns; break;
    case happening::reign_renewed: ++seen_.renewals; break;
    case happening::reign_ended: seen_.given_way += r.superseded ? 1 : 0; break;
    case happening::crashed: ++seen_.crashes; break;
    case happening::restarted: ++seen_.restarts; break;
    case happening::left: ++seen_.absences; break;
    case happening::entered:
    case happening::said_plan:
    case happening::said_claim: break;
    }
  }

  /// A plan message: heard just if it should be, and then no claim is obeyed that it says is over.
  void hear_plan(log_record const& r) {
    if (!r.genuine) return;
    auto const& m = *std::get_if<plan_message<names>>(r.content);
    peer& p = views_[r.robot].peers[r.other];
    instant const now = local(r);
    bool const heard = r.verdict == verdict::accepted;
    bool const due = !p.last || m.number > *p.last || now - p.heard > promises_.forget;
    if (genuine(r) && heard != due)
      fail(invariant::messages_heard, r,
           std::string(heard ? "accepts" : "drops") + " message " + std::to_string(m.number.sequence) + " of " +
               id(r.other) + ", life " + std::to_string(m.number.incarnation.value));
    if (!heard) return;
    // Sent before the claim was made, and still under way after its end: it is taken for a sign that the claim was forged.
    if (promises_.overdue && p.obeyed && m.number.incarnation == p.obeyed->incarnation && m.claims < p.obeyed->number)
      p.obeyed.reset();
    p.last = m.number;
    p.heard = now;
    p.objects = std::any_of(m.types.begin(), m.types.end(), [](auto const& t) { return t.stance != stance::none; });
    if (!genuine(r) || !team_.plays(r.robot) || !rule(r.robot).obeying()) return;
    auto const& c = rule(r.robot).current();
    if (index(c.leader) != r.other || c.incarnation > m.number.incarnation) return;
    std::uint64_t leads = 0;
    for (auto const& t : m.types)
      if (t.type == c.type) leads = t.leads;
    bool const over = c.incarnation < m.number.incarnation || (c.number <= m.claims && leads < c.number);
    if (over) fail(invariant::no_orphans, r, "still obeys " + shown(name(c)));
  }

  /// Notes a reign, with the claim that it answers.
  void begin_reign(log_record const& r) {
    view& v = views_[r.robot];
    auto const& a = rule(r.robot);
    if (!a.leading()) return;
    reign mine{name(a.current()), team_.clock(r.robot).global(a.expiry()), {}, 0};
    mine.root = mine.end;
    auto const cause = std::exchange(v.answers, std::nullopt);
    if (!r.detected && !cause) fail(invariant::answers_inherit, r, "leads without a cause");
    if (!r.detected && cause) {
      ++seen_.answers;
      if (reign const* const x = find(*cause)) {
        mine.root = x->root;
        mine.hops = x->hops + 1;
        if (genuine(r) && mine.hops >= static_cast<std::int64_t>(team_.size()))
          fail(invariant::reigns_bounded, r, "answers an answer of an answer, more than there are robots");
        if (genuine(r) && mine.end > mine.root + mine.hops * (promises_.delay + promises_.slack))
          fail(invariant::answers_inherit, r,
               "its answer ends " + shown(mine.end - mine.root) + " after the claim that began it all");
      }
    }
    leaders_[r.robot].reigns.push_back(mine);
  }
  /// Notes that a reign is renewed: somebody has said that it would do otherwise, and not too often.
  void renew_reign(log_record const& r) {
    auto const& a = rule(r.robot);
    auto const& peers = views_[r.robot].peers;
    if (genuine(r) && std::none_of(peers.begin(), peers.end(), [](peer const& p) { return p.objects; }))
      fail(invariant::answers_inherit, r, "renews its reign, and nobody has told it to do otherwise");
    if (a.current().renewals > promises_.renewals)
      fail(invariant::reigns_bounded, r,
           "renews its reign for the " + std::to_string(a.current().renewals) + "th time");
    instant const end = team_.clock(r.robot).global(a.expiry());
    leaders_[r.robot].reigns.push_back({name(a.current()), end, end, 0});
  }
  [[nodiscard]] reign const* find(identity const& x) const {
    if (x.leader >= leaders_.size()) return nullptr;
    auto const& all = leaders_[x.leader].reigns;
    for (std::size_t k = all.size(); k-- > 0;)
      if (all[k].what == x) return &all[k];
    return nullptr;
  }

  /// Who rules here, after every step.
  void look_at_rule(log_record const& r) {
    view& v = views_[r.robot];
    auto const& a = rule(r.robot);
    instant const now = local(r);
    bool const heard = r.what == happening::heard_plan || r.what == happening::heard_claim;
    if (!a.active() || (heard && r.verdict != verdict::accepted)) {
      if (!a.active()) v.held.reset();
      return;
    }
    auto const& c = a.current();
    auto const x = name(c);
    bool const own = x.leader == r.robot;
    if (own != a.leading() || c.stamp.id != c.leader || (own && c.incarnation != mind(r.robot).incarnation()))
      return fail(invariant::one_leader, r, "claim " + shown(x) + (a.leading() ? " is led with" : " is obeyed"));
    if (now >= a.expiry()) return fail(invariant::nothing_revives, r, "claim " + shown(x) + " has ended here");
    if (a.expiry() - now > promises_.longest_reign)
      return fail(invariant::reigns_bounded, r, "claim " + shown(x) + " has " + shown(a.expiry() - now) + " left");

    if (!v.held || v.held->what != x) {
      if (v.held && v.held->what.leader != x.leader && now < v.held->end && !(v.held->stamp < c.stamp) &&
          !claims_anew(r, v.held->what))
        return fail(invariant::greater_stamps, r, "turns from " + shown(v.held->what) + " to " + shown(x));
      v.held = {x, c.stamp, now, a.expiry()};
    }
    if (now - v.held->since > promises_.longest_reign)
      return fail(invariant::reigns_bounded, r, "claim " + shown(x) + " in force for " + shown(now - v.held->since));
    if (c.stamp != v.held->stamp && genuine(r))
      return fail(invariant::greater_stamps, r, "the stamp of " + shown(x) + " has changed");
    v.held->end = a.expiry();
    if (own) return;

    if (genuine(r) && leaders_[x.leader].orderly) {
      peer& p = v.peers[x.leader];
      if (p.obeyed && x < *p.obeyed)
        return fail(invariant::nothing_revives, r, "obeys " + shown(x) + " after " + shown(*p.obeyed));
      if (p.obeyed == x && (now >= p.end || a.expiry() > p.end))
        return fail(invariant::nothing_revives, r, "claim " + shown(x) + " ended at " + shown(p.end - instant{}));
      p.obeyed = x;
      p.end = a.expiry();
      if (reign const* const k = find(x)) {
        instant const end = team_.clock(r.robot).global(a.expiry());
        if (end < k->end - promises_.slack || end > k->end + promises_.delay + promises_.slack)
          return fail(invariant::ends_with_leader, r,
                      "claim " + shown(x) + " ends " + shown(end - k->end) + " after it does at its leader");
      }
    }
    for (in<names> const& atom : r.believed)
      if (!c.atoms.contains(atom))
        return fail(invariant::followers_follow, r, "believes more than claim " + shown(x) + " says");
  }

  /// Whether this is a later claim of the same leader: that ends the one in force, so it may be answered.
  [[nodiscard]] static bool claims_anew(log_record const& r, identity const& held) {
    auto const* const c = r.content ? std::get_if<claim<names>>(r.content) : nullptr;
    return r.what == happening::heard_claim && c && index(c->leader) == held.leader && held < name(*c);
  }

  /// A claim with a smaller stamp, while nobody rules here: it is answered, unless it was before. Confidences are equal, so
  /// the greater robot has the greater stamp.
  void hear_smaller(log_record const& r) {
    view& v = views_[r.robot];
    auto const& c = *std::get_if<claim<names>>(r.content);
    peer& p = v.peers[r.other];
    if (r.claim == claim_outcome::challenged) p.answered = name(c);
    if (!promises_.answers || !r.genuine || !genuine(r) || r.claim != claim_outcome::adopted) return;
    bool const ruled = v.abstains || (v.held && local(r) < v.held->end);
    if (!ruled && r.other < r.robot && p.answered != name(c))
      fail(invariant::smaller_answered, r, "obeys " + shown(name(c)) + " and has not answered it");
  }

  /// A claim: one that its leader leads with is no ghost here; and who obeys has taken in all of it.
  void hear_claim(log_record const& r) {
    view& v = views_[r.robot];
    auto const& c = *std::get_if<claim<names>>(r.content);
    v.answers.reset();
    if (r.claim == claim_outcome::challenged) v.answers = name(c);
    if (!r.claim || !r.genuine || !genuine(r)) return;
    auto const& a = rule(r.robot);
    if (*r.claim != claim_outcome::expired && (!a.active() || a.current().stamp < c.stamp))
      return fail(invariant::claims_heeded, r, "hears " + shown(name(c)) + ", and a smaller stamp rules");
    if (*r.claim == claim_outcome::expired && leaders_[r.other].orderly && team_.plays(r.other)) {
      auto const& there = rule(r.other);
      if (there.leading() && name(there.current()) == name(c) &&
          team_.clock(r.other).global(there.expiry()) - r.time > promises_.slack)
        return fail(invariant::claims_heeded, r, "claim " + shown(name(c)) + " has ended here, and not at its leader");
    }
    if (!a.obeying() || *r.claim == claim_outcome::expired || *r.claim == claim_outcome::outranked) return;
    auto const& b = belief_of(r.robot);
    for (in<names> const& x : a.current().atoms)
      if (b.takes_part(x.agent) && !r.believed.contains(x))
        return fail(invariant::followers_follow, r, "believes less than claim " + shown(name(a.current())) + " says");
  }

  /// Whom a robot believes in, once it has deliberated.
  void look_around(log_record const& r) {
    view& v = views_[r.robot];
    auto const& b = belief_of(r.robot);
    auto const who = b.participants();
    if (v.participants > who.size()) seen_.deletions += v.participants - who.size();
    v.participants = who.size();
    if (who.size() > team_.size() || r.believed.size() > who.size())
      return fail(invariant::belief_well_formed, r, "more participants than robots, or more atoms than participants");
    for (std::size_t k = 0; k < who.size(); ++k) {
      if (k > 0 && !(who[k - 1] < who[k])) return fail(invariant::belief_well_formed, r, "one takes part twice");
      auto const j = index(who[k]);
      if (j == r.robot) continue;
      if (genuine(r) && r.time - leaders_[j].spoke > promises_.silence)
        return fail(invariant::silent_forgotten, r,
                    "believes in " + id(j) + ", silent for " + shown(r.time - leaders_[j].spoke));
    }
    auto const* before = static_cast<in<names> const*>(nullptr);
    for (in<names> const& x : r.believed) {
      if ((before && before->agent == x.agent) || !b.takes_part(x.agent))
        return fail(invariant::belief_well_formed, r, "two atoms about one agent, or one about no participant");
      before = &x;
    }
    if (r.time < promises_.hearing) return;
    for (std::size_t j = 0; j < team_.size(); ++j)
      if (team_.plays(j) && !b.takes_part({j + 1})) return fail(invariant::all_hear_all, r, "misses " + id(j));
  }

  void look_settled(log_record const& r) {
    if (rule(r.robot).active())
      return fail(invariant::nobody_rules, r, shown(name(rule(r.robot).current())) + " rules");
    if (!agreed_) {
      agreed_ = r.believed;
      auto const attackers =
          std::count_if(agreed_->begin(), agreed_->end(), [&](in<names> const& x) { return team_.book().attacks(x); });
      if (attackers != 1) return fail(invariant::all_agree, r, std::to_string(attackers) + " attackers");
    }
    if (r.believed != *agreed_) fail(invariant::all_agree, r, "believes something else than others, or than before");
  }

  Simulation const& team_;
  promises promises_;
  std::vector<view> views_;
  std::vector<leader> leaders_;
  std::optional<allocation_atoms<names>> agreed_;
  std::optional<violation> broken_;
  sightings seen_;
};

}  // namespace rota::sim
