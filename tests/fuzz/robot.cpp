// One robot, and whatever its radio, its clock and its program may do to it. What holds of it after each step is `check`.
//
// Messages are composed field by field, near to what a genuine sender would say next, so that they are believed as often as
// refused; others are raw bytes, or copies of earlier ones.
#include "input.hpp"
#include "pitch.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace {

using fuzz::pitch;
using fuzz::require;
using rota::duration;
using rota::instant;
using robot = rota::robot<pitch>;
using message = rota::message<pitch>;
using claim = rota::claim<pitch>;
using plan_message = rota::plan_message<pitch>;

constexpr int self = 4;
constexpr int team_size = 6;  // robots 1 to 6; 0 and 7 are strangers
constexpr std::array types = {pitch::plan_type::play, pitch::plan_type::defence};
constexpr pitch::agent agent(unsigned n) { return static_cast<pitch::agent>(n); }

/// The world around one robot.
class world {
public:
  explicit world(fuzz::input& in) : in_(in), mind_(agent(self), everybody(), {5}, some_options(in)) {}

  void run() {
    (void)mind_.enter(types_[0], now_);
    for (int step = 0; step < 200 && !in_.empty(); ++step) {
      act();
      check();
      if (step % 8 == 0) check_value();
    }
    check_value();
    heal();
  }

private:
  // ------------------------------------------------------------------------------------------------ what happens
  void act() {
    switch (in_.below(16)) {
    case 0: go(duration{in_.byte() * 1'000'000LL}); break;
    case 1:  // whoever asks what is due need not have deliberated
      go(duration{in_.byte() * 1'000'000LL});
      speak();
      break;
    case 2: go(duration{in_.byte() * 1'000'000'000LL}); break;
    case 3: go(duration{-in_.byte() * 100'000'000LL}); break;
    case 4: now_ = instant{static_cast<std::int64_t>(in_.word()) >> 10}; break;  // 104 days to either side
    case 5:
      (void)mind_.enter(types_[in_.below(2)], now_);
      latest_ = now_;  // it has seen this time, too
      break;
    case 6: (void)mind_.leave(types[in_.below(2)]); break;
    case 7: look(); break;
    case 8: (void)mind_.set_state(types[in_.below(2)], static_cast<pitch::state>(in_.byte())); break;
    case 9: mind_.set_confidence(in_.below(3)); break;
    case 10: hear_raw(); break;
    case 11:
    case 12: hear(compose_plan_message()); break;
    case 13: hear(compose_claim()); break;
    case 14: again(); break;
    case 15: think_and_speak(); break;
    }
  }
  /// It sees one robot attack best; or, as often, that nobody can.
  void look() {
    auto const best = in_.below(16);
    sight_.attack.fill(best < 8 ? 0 : -100);
    if (best < 8) sight_.attack[best] = 9;
  }
  void go(duration d) {
    auto const to = now_ + d;
    if (to.ns > -(std::int64_t{1} << 53) && to.ns < std::int64_t{1} << 53) now_ = to;
  }

  void hear_raw() {
    auto const body = in_.bytes(in_.byte());
    std::vector<std::byte> bytes(body.size());
    std::transform(body.begin(), body.end(), bytes.begin(), [](std::uint8_t x) { return std::byte{x}; });
    auto const sum = rota::detail::crc32(bytes);
    for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<std::byte>(sum >> (8 * k)));
    if (auto const m = rota::decode<pitch>(bytes)) hear(*m);
  }
  void again() {
    auto const k = in_.byte();
    if (!heard_.empty()) hear(message(heard_[k % heard_.size()]));
  }

  void hear(message const& m) {
    if (heard_.size() < 16) heard_.push_back(m);
    other_ = mind_;
    std::array<std::optional<std::pair<pitch::agent, rota::claim_stamp<pitch>>>, types.size()> ruled;
    for (auto const t : types) {
      auto const* const rule = mind_.rule(t);
      if (rule && rule->obeying() && now_ < rule->expiry() && now_ >= latest_)
        ruled[static_cast<std::size_t>(t)].emplace(rule->current().leader, rule->current().stamp);
    }
    auto const r = mind_.receive(m, now_);
    if (r.verdict != rota::verdict::accepted) {
      require(mind_ == other_, "a message that is refused or stale changes nothing");
      require((r.verdict == rota::verdict::refused) == (r.reason != rota::refusal::none), "a refusal gives a reason");
      require(r.changes.empty() && !r.claim && r.imposed.empty() && !r.relay, "and reports no change, and no news");
      return;
    }
    latest_ = now_;
    auto const* const c = std::get_if<claim>(&m);
    require((c != nullptr) == r.claim.has_value(), "an accepted claim has an outcome, and nothing else has");
    if (!c) return;
    auto const* const rule = mind_.rule(c->type);
    auto const& held = ruled[static_cast<std::size_t>(c->type)];
    // A leader may claim anew with a smaller stamp: then its former claim has ended.
    if (held && rule->obeying() && held->first != rule->current().leader)
      require(!(rule->current().stamp < held->second), "no turn to a smaller stamp");
    if (*r.claim == rota::claim_outcome::adopted) {
      require(rule->obeying() && rule->current().leader == c->leader, "who adopts a claim obeys its leader");
    }
    if (*r.claim == rota::claim_outcome::challenged) {
      require(rule->leading() && c->stamp < rule->current().stamp, "who answers leads, and has the greater stamp");
      require(rule->expiry() <= now_ + c->remaining, "an answer ends with what it answers, at the latest");
    }
  }

  void think_and_speak() {
    for (std::size_t k = 0; k < types.size(); ++k) {
      auto const d = mind_.deliberate(types_[k], members(), sight_, now_, space_);
      latest_ = now_;
      auto const* const believed = mind_.believes(types[k]);
      require((d.reason == rota::decision_reason::not_executing) == !believed, "the decision says what is executed");
      if (!believed) continue;
      require(d.own == believed->part(agent(self)), "the decision says what the robot does");
      for (auto const a : believed->participants()) {
        require(believed->heard(a) <= now_, "nobody was heard in the future");
        require(a == agent(self) || now_ - believed->heard(a) <= mind_.options().silence, "the silent are gone");
      }
      auto const* const rule = mind_.rule(types[k]);
      require(d.leader.has_value() == rule->active(), "the decision says who rules");
      if (d.reason == rota::decision_reason::no_valid_allocation)
        require(!d.own && !d.reign_began && !rule->leading(), "who sees nothing valid has no task, and does not lead");
    }
    speak();
  }
  void speak() {
    latest_ = now_;
    unsigned said = 0;
    while (auto const m = mind_.next_message(now_)) {
      require(++said <= types.size() + 1, "a robot says each thing once");
      speak(*m);
    }
    require(mind_.next_due() > now_, "then nothing is due");
    auto& waiting = other_ = mind_;
    auto const due = mind_.next_due();
    require(!waiting.next_message(due - rota::nanoseconds(1)), "nothing is said before it is due");
    bool reign_ends = false;
    for (auto const t : types)
      if (auto const* const rule = mind_.rule(t); rule && rule->active()) reign_ends |= rule->expiry() <= due;
    require(reign_ends || waiting.next_message(due).has_value(), "what is due is said");
  }
  void speak(message const& m) {
    std::array<std::byte, 1024> buffer{};
    auto const size = rota::encode(m, buffer);
    require(bool(size), "what a robot says can be encoded");
    auto const bytes = std::span(buffer).first(*size);
    auto const there = rota::decode<pitch>(bytes);
    require(bool(there), "and decoded");
    std::array<std::byte, 1024> second{};
    auto const size_again = rota::encode(*there, second);
    require(size_again && std::equal(bytes.begin(), bytes.end(), second.begin(), second.begin() + *size_again),
            "to the same bytes");
    if (auto const* const c = std::get_if<claim>(&m)) {
      require(c->leader == agent(self) && c->stamp.id == agent(self), "a robot claims in its own name");
      require(c->incarnation == mind_.incarnation() && c->number > 0, "and in this life");
      require(c->remaining > duration{} && c->remaining <= mind_.options().reign, "for a reign at most");
      for (auto const age : c->ages) require(age >= duration{}, "nobody was heard in the future");
      auto fellow = newcomer();
      require(fellow.receive(*there, now_).claim == rota::claim_outcome::adopted, "who hears a claim first obeys it");
    } else {
      auto const& p = std::get<plan_message>(m);
      require(m == *there, "a plan message loses nothing on the way");
      require(p.sender == agent(self), "a robot speaks in its own name");
      require(spoke_ < p.number, "numbers grow");
      spoke_ = p.number;
    }
    // Its own words come back as an echo, or as those of a stranger with its id: refused.
    hear(m);
  }

  // ------------------------------------------------------------------------------------------------ what is said
  struct sender {
    std::uint64_t life = 1, sequence = 0, claims = 0, version = 1;
  };

  /// A number near x. A hostile message has one that no genuine sender says.
  std::uint64_t near(std::uint64_t x, bool grows) {
    switch (hostile_ ? in_.below(16) : 0) {
    case 10: return x + rota::most_jump;
    case 11: return x + rota::most_jump + 2;
    case 12: return std::uint64_t{1} << 62;
    case 13: return (std::numeric_limits<std::uint64_t>::max)();
    case 14: return 0;
    case 15: return x == 0 ? 0 : x - 1;
    default: return grows ? x + 1 : x;
    }
  }
  /// Whom a message is from: usually one of the team.
  unsigned somebody() {
    auto const n = in_.below(32);
    return n >= 30 ? n - 30 : n >= 28 ? 7 : n % team_size + 1;
  }
  duration some_time(duration usual) {
    switch (hostile_ ? in_.below(16) : 7) {
    case 0: return duration{};
    case 1: return duration{1};
    case 2: return duration{-1};
    case 3: return duration{(std::numeric_limits<std::int64_t>::max)()};
    case 4: return duration{(std::numeric_limits<std::int64_t>::min)()};
    case 5: return usual + duration{1};
    case 6: return usual;
    default: return duration{usual.ns / 256 * in_.byte()};
    }
  }

  plan_message compose_plan_message() {
    auto const who = somebody();
    hostile_ = in_.below(4) == 0;
    auto& s = senders_[who];
    plan_message m{agent(who), {{near(s.life, false)}, near(s.sequence, true)}, near(s.claims, false), {}};
    auto const count = hostile_ ? in_.below(70) : 1 + in_.below(2);
    for (unsigned k = 0; k < count; ++k) {
      rota::participation<pitch> p;
      auto const what = in_.byte();
      p.type = static_cast<pitch::plan_type>(what < 240 ? k : what % 4);
      if ((what & 1) != 0)
        p.place = rota::placement<pitch>{static_cast<pitch::plan>(hostile_ ? what >> 1 & 1 : 0),
                                         static_cast<pitch::task>(what >> 2 & (hostile_ ? 3 : 1)),
                                         static_cast<pitch::state>(what >> 4 & 1)};
      if ((what & 32) != 0) p.leads = near(s.claims, false);
      if ((what & 64) != 0) p.fingerprint = in_.byte();
      m.types.push_back(p);
    }
    s.life = m.number.incarnation.value;
    s.sequence = m.number.sequence;
    s.claims = m.claims;
    return m;
  }
  claim compose_claim() {
    auto const who = somebody();
    hostile_ = in_.below(4) == 0;
    auto& s = senders_[who];
    auto const what = in_.byte();
    claim c;
    c.type = types[what & 1];
    c.leader = agent(who);
    c.stamp = {static_cast<std::uint32_t>(what >> 1 & 1), agent(hostile_ ? in_.byte() : who)};
    c.incarnation = {near(s.life, false)};
    c.number = near(s.claims, (what & 64) != 0);
    c.version = near(s.version, (what & 128) != 0);
    c.remaining = some_time(mind_.options().max_reign);
    auto const count = in_.below(8);
    for (unsigned k = 0; k < count; ++k) {
      auto const x = in_.byte();
      c.atoms.insert({agent(hostile_ ? x & 7 : k % team_size + 1), static_cast<pitch::plan>(hostile_ ? x >> 3 & 1 : 0),
                      static_cast<pitch::task>(hostile_ ? x >> 4 & 3 : x >> 4 & 1)});
      c.ages.push_back(some_time(mind_.options().silence));
    }
    while (c.ages.size() > c.atoms.size() && in_.below(16) != 15) c.ages.pop_back();
    s.life = c.incarnation.value;
    s.claims = c.number;
    s.version = c.version;
    return c;
  }

  // ------------------------------------------------------------------------------------------------ what must hold
  void check() const {
    for (auto const t : types) {
      auto const* const believed = mind_.believes(t);
      require((believed != nullptr) == mind_.executes(t) && (mind_.rule(t) != nullptr) == mind_.executes(t),
              "a robot believes something of exactly what it executes");
      if (!believed) continue;
      auto const who = believed->participants();
      require(believed->takes_part(agent(self)), "the robot takes part");
      for (std::size_t i = 0; i < who.size(); ++i) {
        require(i == 0 || who[i - 1] < who[i], "participants ascend");
        require(who[i] >= agent(1) && who[i] <= agent(team_size), "participants are of the team");
      }
      auto const& atoms = believed->atoms();
      for (auto const* x = atoms.begin(); x != atoms.end(); ++x) {
        require(believed->takes_part(x->agent), "atoms are about participants");
        require(x == atoms.begin() || (x - 1)->agent < x->agent, "an agent has one task");
        require(known(t, x->plan, x->task), "tasks are those of the plan type");
      }
      for (auto const& x : believed->told(agent(self)))
        require(believed->takes_part(x.agent), "the absent say nothing");
      auto const* const rule = mind_.rule(t);
      if (!rule->active()) continue;
      auto const& c = rule->current();
      require(c.type == t, "a claim rules its own type");
      require(c.stamp.id == c.leader, "a claim has its leader's stamp");
      require(rule->leading() == (c.leader == agent(self)), "a robot obeys another, or leads itself");
      if (now_ >= latest_) require(rule->expiry() <= latest_ + mind_.options().max_reign, "a reign is bounded");
      require(!rule->obeying() || mind_.options().resolution, "nobody obeys if resolution is off");
    }
  }
  void check_value() {
    other_ = mind_;
    require(other_ == mind_ && other_.digest(now_) == mind_.digest(now_), "a robot is a regular value");
  }
  static bool known(pitch::plan_type t, pitch::plan p, pitch::task k) {
    if (p == pitch::plan::normal) return k == pitch::task::attack || k == pitch::task::defend;
    return t == pitch::plan_type::play && p == pitch::plan::kickoff &&
           (k == pitch::task::attack || k == pitch::task::support);
  }

  /// Whatever was heard, after a long silence a newcomer with small numbers is heard, and its claim counts.
  void heal() {
    now_ = (std::max)(now_, latest_) + mind_.options().forget + mind_.options().max_reign + mind_.options().max_delay +
           duration{1};
    think_and_speak();
    plan_message m{agent(2), {{1}, 1}, 0, {}};
    for (auto const t : types) m.types.push_back({t, {}, 0, {}});
    require(mind_.receive(m, now_).verdict == rota::verdict::accepted, "after a long silence a newcomer is heard");
    if (!mind_.options().resolution || !mind_.executes(types[0])) return;
    claim const c{types[0], {}, {9, agent(2)}, agent(2), {1}, 1, 1, mind_.options().max_reign, {}};
    auto const r = mind_.receive(c, now_);
    require(r.claim == rota::claim_outcome::adopted, "and its claim, which is the greatest, obeyed");
    now_ = now_ + mind_.options().max_reign;
    think_and_speak();
    auto const* const rule = mind_.rule(types[0]);
    require(!rule->obeying(), "until it ends");
  }

  static constexpr std::array<pitch::agent, team_size> everybody() {
    return {agent(1), agent(2), agent(3), agent(4), agent(5), agent(6)};
  }
  static rota::team<pitch> const& members() {
    static rota::team<pitch> const all = [] {
      rota::team<pitch> t;
      for (auto const a : everybody()) t.add(a);
      return t;
    }();
    return all;
  }
  static rota::robot_options some_options(fuzz::input& in) {
    rota::robot_options o;
    auto const what = in.byte();
    o.cycles = 1 + (what & 1);
    o.resolution = (what & 14) != 14;
    o.fingerprints = (what & 16) != 0;
    o.change_period = rota::milliseconds((what & 32) != 0 ? 20 : 0);
    o.hysteresis.absolute = (what & 64) != 0 ? 0.5 : 0;
    o.first_message = instant{(what & 128) != 0 ? -7'000'003 : 13'000'001};
    auto const more = in.byte();
    o.reign = rota::milliseconds((more & 1) != 0 ? 400 : 2000);
    o.forget = (more & 2) != 0 ? rota::seconds(3) : rota::seconds(30);
    o.max_delay = rota::milliseconds((more & 4) != 0 ? 0 : 500);
    o.silence = rota::milliseconds((more & 8) != 0 ? 300 : 2000);
    return o;
  }

  /// A robot that has heard nothing yet, and has the smallest stamp.
  robot newcomer() const {
    robot r(agent(0), everybody(), {1});
    for (auto const& t : types_) (void)r.enter(t, now_);
    return r;
  }

  fuzz::input& in_;
  inline static std::array const types_{fuzz::make_type(types[0]), fuzz::make_type(types[1])};
  robot mind_;
  robot other_ = mind_;  // a copy to compare with: assigning allocates less than making one
  fuzz::view sight_{{1, 2, 3, 4, 5, 6, 7, 8}};
  rota::workspace space_;
  instant now_{};
  instant latest_{(std::numeric_limits<std::int64_t>::min)() / 2};
  std::array<sender, 8> senders_{};
  bool hostile_ = false;  // the message that is being composed
  std::vector<message> heard_;
  rota::message_number spoke_{};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  fuzz::input in(data, size);
  world(in).run();
  return 0;
}
