#pragma once

#include "playground.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

/// Every interleaving of a small team: the real `robot`, a radio that loses, duplicates, delays and reorders, and robots that
/// crash, restart, leave, enter, go blind and change their mind about themselves.
namespace explorer {

enum class act : std::uint8_t {
  advance,    ///< time passes, and what was under way for too long is lost
  tick,       ///< a robot deliberates and says what is due
  deliver,    ///< a message arrives
  duplicate,  ///< … and stays under way
  lose,
  leave,
  enter,
  restart,  ///< with a greater incarnation
  restart_same,
  restart_less,
  blind,     ///< it sees nothing valid from now on, or sees again
  confident  ///< its confidence changes
};

/// What may happen, and in how large a world.
struct setting {
  std::string name;
  int robots = 2;
  std::vector<act> acts;  ///< besides advance, tick and deliver
  bool agree = false;     ///< all see the same; otherwise each is sure that it attacks best
  std::size_t flying = 6;
  int rounds = 8;  ///< without loss, after which a team has settled
  rota::duration step = rota::milliseconds(50);
  rota::duration longest_delay = rota::milliseconds(200);
};

struct move {
  act what{};
  std::uint8_t which = 0;  ///< a robot, or a message under way
};

inline rota::robot_options options_of(int /*n*/) {
  rota::robot_options o;
  o.cycles = 2;
  o.reign = o.max_reign = rota::milliseconds(400);
  o.silence = rota::milliseconds(400);
  o.claim_period = o.message_period = rota::milliseconds(100);
  o.opening = o.opening_period = rota::milliseconds(50);
  o.max_delay = rota::milliseconds(200);
  o.forget = rota::seconds(3);
  return o;
}

using claim_name = std::tuple<soccer::agent, std::uint64_t, std::uint64_t>;
inline claim_name name_of(claim const& c) { return {c.leader, c.incarnation.value, c.number}; }

/// One state of the team, and what an observer who sees everything knows of it.
class world {
public:
  world(setting const& s, rota::plan_type<soccer, view> const& play, rota::team<soccer> const& members)
      : setting_(&s), play_(&play), members_(&members) {
    for (int n = 1; n <= s.robots; ++n) {
      bodies_.push_back({fresh(n, 5), {}, 5, true, false, 0, start});
      bodies_.back().mind.enter(play, start);
    }
  }

  /// Whether it can be done now.
  [[nodiscard]] bool possible(move m) const {
    switch (m.what) {
    case act::advance: return true;
    case act::deliver:
    case act::lose: return m.which < air_.size();
    case act::duplicate: return m.which < air_.size() && air_.size() < setting_->flying && !air_[m.which].copied;
    default: break;
    }
    if (m.which >= bodies_.size()) return false;
    auto const& b = bodies_[m.which];
    if (m.what == act::tick) return b.ticked < now_ && air_.size() + bodies_.size() <= setting_->flying + 2;
    bool const in = b.mind.executes(play_id);
    if (m.what == act::leave) return in && b.trouble == 0;
    if (m.what == act::enter) return !in;
    if (m.what == act::blind) return b.trouble == 0 || b.is_blind;
    return b.trouble == 0;
  }

  /// Does it. Throws a sentence if an invariant is broken.
  void perform(move m, rota::workspace& space) {
    switch (m.what) {
    case act::advance: advance(setting_->step); break;
    case act::tick: tick(m.which, space); break;
    case act::deliver:
    case act::duplicate: {
      auto const f = air_[m.which];
      if (m.what == act::deliver) {
        air_.erase(air_.begin() + m.which);
      } else {
        air_[m.which].copied = true;
      }
      deliver(f);
      break;
    }
    case act::lose: air_.erase(air_.begin() + m.which); break;
    case act::leave:
      bodies_[m.which].mind.leave(play_id);
      ++bodies_[m.which].trouble;
      break;
    case act::enter: bodies_[m.which].mind.enter(*play_, now_); break;
    case act::restart: reborn(m.which, bodies_[m.which].incarnation + 1); break;
    case act::restart_same: reborn(m.which, bodies_[m.which].incarnation); break;
    case act::restart_less: reborn(m.which, bodies_[m.which].incarnation - 1); break;
    case act::blind:
      bodies_[m.which].is_blind = !bodies_[m.which].is_blind;
      ++bodies_[m.which].trouble;
      break;
    case act::confident:
      bodies_[m.which].mind.set_confidence(9);
      ++bodies_[m.which].trouble;
      break;
    }
    check();
  }

  /// From here on everything is heard: is there one leader, does everybody hear it, is nobody obeyed that does not lead, and
  /// are all back to normal when nobody speaks any more? What is under way comes first or last, or is lost.
  void settle(rota::workspace& space, int order) const {
    world w = *this;
    if (order == 0) w.air_.clear();
    for (std::size_t i = 0; i < w.bodies_.size(); ++i) {
      w.bodies_[i].mind.enter(*play_, w.now_);
      w.bodies_[i].is_blind = false;
    }
    auto old = std::exchange(w.air_, {});
    if (order == 1)
      for (auto const& f : old) w.deliver(f);
    // A moment with two leaders, or with one obeyed that has just ended, is unavoidable; two or three rounds are not.
    int two = 0, orphaned = 0;
    for (int round = 0; round < setting_->rounds; ++round) {
      w.round(space);
      if (round == 2 && order == 2)
        for (auto const& f : old)
          if (w.now_ - f.sent <= setting_->longest_delay) w.deliver(f);
      if (round + 6 < setting_->rounds) continue;  // not before everybody is heard again
      int leaders = 0;
      bool orphan = false;
      std::set<claim_name> led;
      for (auto const& b : w.bodies_)
        if (b.mind.rule(play_id)->leading()) ++leaders, led.insert(name_of(b.mind.rule(play_id)->current()));
      for (auto const& b : w.bodies_)
        if (auto const* const rule = b.mind.rule(play_id); rule->obeying())
          orphan |= !led.count(name_of(rule->current()));
      two = leaders > 1 ? two + 1 : 0;
      orphaned = orphan ? orphaned + 1 : 0;
      if (two > 2) throw std::string("two settled leaders");
      if (orphaned > 3) throw std::string("an orphan, or a ghost obeyed");
    }
    for (int i = 0; i < 30 && i * setting_->step < rota::milliseconds(400) + setting_->longest_delay; ++i)
      w.advance(setting_->step);
    w.air_.clear();
    for (std::size_t i = 0; i < w.bodies_.size(); ++i) {
      auto const& b = w.bodies_[i];
      auto d = w.bodies_[i].mind.deliberate(*play_, *members_, w.sight(i), w.now_, space);
      if (d.reason == rota::decision_reason::obeyed || b.mind.rule(play_id)->leading())
        if (!d.reign_began) throw std::string("a reign without end");
    }
  }

  [[nodiscard]] std::uint64_t digest() const {
    std::uint64_t sum = 0;
    for (auto const& b : bodies_)
      sum = sum * 0x9e3779b97f4a7c15u + (b.mind.digest(now_) ^ static_cast<std::uint64_t>(b.trouble) ^
                                         (b.is_blind ? 0x100u : 0u) ^ (b.ticked < now_ ? 0x200u : 0u));
    for (auto const& f : air_)
      sum += f.code * (2 * static_cast<std::uint64_t>((now_ - f.sent).ns / 1'000'000) + 3 + f.to);
    return sum;
  }
  [[nodiscard]] std::size_t under_way() const { return air_.size(); }
  [[nodiscard]] std::size_t size() const { return bodies_.size(); }
  [[nodiscard]] bool anybody_rules() const {
    return std::any_of(bodies_.begin(), bodies_.end(), [](body const& b) {
      auto const* rule = b.mind.rule(play_id);
      return rule && rule->active();
    });
  }

  /// One line of a script that a person can read.
  [[nodiscard]] std::string tell(move m) const {
    static constexpr char const* words[] = {"time passes",
                                            "thinks and speaks",
                                            "hears",
                                            "hears a copy of",
                                            "never hears",
                                            "leaves",
                                            "enters",
                                            "restarts",
                                            "restarts with the same incarnation",
                                            "restarts with a smaller incarnation",
                                            "goes blind or sees again",
                                            "grows confident"};
    std::ostringstream out;
    out << (now_ - start).ns / 1'000'000 << " ms: ";
    if (m.what == act::advance) return out.str() + words[0];
    if (m.what == act::deliver || m.what == act::duplicate || m.what == act::lose) {
      auto const& f = air_[m.which];
      out << "robot " << f.to + 1 << ' ' << words[static_cast<int>(m.what)] << ' ';
      if (auto const* c = std::get_if<claim>(&f.what)) {
        out << "claim " << int(c->leader) << '#' << c->number << " v" << c->version;
      } else {
        out << "plan message " << int(std::get<plan_message>(f.what).sender) << '.'
            << std::get<plan_message>(f.what).number.sequence;
      }
      return out.str();
    }
    out << "robot " << m.which + 1 << ' ' << words[static_cast<int>(m.what)];
    return out.str();
  }

private:
  struct body {
    robot mind;
    std::set<claim_name> ended;  // claims of which this robot, in this life, knew the end
    std::uint64_t incarnation = 0;
    bool alive = true;
    bool is_blind = false;
    int trouble = 0;       // how often something has happened to it: once is enough
    rota::instant ticked;  // it thinks once at each instant
  };
  struct flight {
    message what;
    std::uint64_t code = 0;
    rota::instant sent{};
    std::uint8_t to = 0;
    bool copied = false;
  };

  robot fresh(int n, std::uint64_t incarnation) const {
    auto o = options_of(n);
    o.first_message = start + rota::milliseconds(10 * n);
    return {agent(n), squad(setting_->robots), rota::incarnation{incarnation}, o};
  }
  [[nodiscard]] view sight(std::size_t i) const {
    view v = sees(setting_->agree ? 1 : static_cast<int>(i) + 1);
    if (bodies_[i].is_blind) v.attack.fill(-100);
    return v;
  }

  void advance(rota::duration d) {
    now_ = now_ + d;
    std::erase_if(air_, [&](flight const& f) { return now_ - f.sent > setting_->longest_delay; });
  }
  void tick(std::size_t i, rota::workspace& space) {
    auto& b = bodies_[i];
    b.ticked = now_;
    if (b.mind.executes(play_id)) (void)b.mind.deliberate(*play_, *members_, sight(i), now_, space);
    note();
    while (auto m = b.mind.next_message(now_))
      for (std::size_t to = 0; to < bodies_.size(); ++to)
        if (to != i) air_.push_back({*m, code_of(*m), now_, static_cast<std::uint8_t>(to), false});
    std::sort(air_.begin(), air_.end(), [](flight const& a, flight const& b2) {
      return std::tie(a.to, a.sent, a.code) < std::tie(b2.to, b2.sent, b2.code);
    });
  }
  /// Notes who leads, and until when.
  void note() {
    for (auto const& b : bodies_)
      if (auto const* const rule = b.mind.rule(play_id); rule && rule->leading()) {
        auto& end = truth_[name_of(rule->current())];
        end = (std::max)(end, rule->expiry());
      }
  }
  void round(rota::workspace& space) {
    advance(setting_->step);
    for (std::size_t i = 0; i < bodies_.size(); ++i) tick(i, space);
    while (!air_.empty()) {
      auto const f = air_.front();
      air_.erase(air_.begin());
      deliver(f);
    }
    check();
  }
  void deliver(flight const& f) {
    auto& b = bodies_[f.to];
    auto const* before = b.mind.rule(play_id);
    std::optional<claim> held;
    rota::instant until{};
    if (before && before->active()) held = before->current(), until = before->expiry();
    (void)b.mind.receive(f.what, now_);
    note();
    auto const* after = b.mind.rule(play_id);
    if (!after || !after->obeying()) return;
    if (held && now_ < until && held->leader != after->current().leader && after->current().stamp < held->stamp) {
      auto const* m = std::get_if<claim>(&f.what);
      if (m) throw std::string("turned to a smaller stamp");
    }
  }
  void reborn(std::size_t i, std::uint64_t incarnation) {
    auto& b = bodies_[i];
    b.incarnation = incarnation;
    b.mind = fresh(static_cast<int>(i) + 1, incarnation);
    b.ended.clear();
    b.mind.enter(*play_, now_);
    ++b.trouble;
    ++lives_;
  }

  /// What must hold of every state.
  void check() {
    for (auto& b : bodies_) {
      auto const* const rule = b.mind.rule(play_id);
      if (!rule) continue;
      if (rule->obeying()) {
        auto const name = name_of(rule->current());
        if (rule->current().leader == b.mind.self()) throw std::string("obeys itself");
        auto const end = truth_.find(name);
        if (end == truth_.end()) throw std::string("obeys a claim that nobody made");
        if (rule->expiry() > end->second + setting_->longest_delay) throw std::string("a reign longer than its bound");
        if (now_ < rule->expiry() && b.ended.count(name) != 0) throw std::string("a claim that had ended is obeyed");
      }
      if (rule->active() && now_ >= rule->expiry()) b.ended.insert(name_of(rule->current()));
      auto const& believed = *b.mind.believes(play_id);
      for (auto const* x = believed.atoms().begin(); x != believed.atoms().end(); ++x) {
        if (!believed.takes_part(x->agent)) throw std::string("an atom of nobody");
        if (x != believed.atoms().begin() && (x - 1)->agent == x->agent) throw std::string("two tasks for one");
      }
    }
  }
  static std::uint64_t code_of(message const& m) {
    std::uint64_t h = 7;
    auto const mix = [&](std::uint64_t x) { h = (h ^ x) * 0x9e3779b97f4a7c15u, h ^= h >> 31; };
    if (auto const* c = std::get_if<claim>(&m)) {
      mix(static_cast<std::uint64_t>(c->leader)), mix(c->number), mix(c->version), mix(c->incarnation.value);
      mix(static_cast<std::uint64_t>(c->remaining.ns)), mix(c->stamp.confidence);
    } else {
      auto const& p = std::get<plan_message>(m);
      mix(100 + static_cast<std::uint64_t>(p.sender)), mix(p.number.sequence), mix(p.number.incarnation.value);
      mix(p.claims);
    }
    return h;
  }

  setting const* setting_;
  rota::plan_type<soccer, view> const* play_;
  rota::team<soccer> const* members_;
  std::vector<body> bodies_;
  std::vector<flight> air_;
  std::map<claim_name, rota::instant> truth_;  // when the reign of each claim ends at its leader
  rota::instant now_ = start;
  int lives_ = 0;
};

/// A way to something that must not be.
struct fault {
  std::string what;
  std::vector<move> way;
};

/// Depth first within a growing limit, so that the first fault has a shortest way; a state is expanded once for each limit.
class search {
public:
  search(setting s, playground& f) : setting_(std::move(s)), fixture_(f), root_(setting_, f.play, f.members) {
    moves_ = {act::advance, act::tick, act::deliver};
    moves_.insert(moves_.end(), setting_.acts.begin(), setting_.acts.end());
  }

  /// Until so many different states were expanded, or a fault was found.
  std::optional<fault> run(std::uint64_t most_states) {
    for (int limit = 1; limit < 60; ++limit) {
      seen_.clear();
      way_.clear();
      limit_ = limit;
      most_ = most_states;
      if (auto f = descend(root_, limit)) return f;
      depth_ = limit;
      if (expanded_ >= most_states) break;
    }
    return std::nullopt;
  }
  /// Random walks from the start, so long each.
  std::optional<fault> walk(std::uint64_t walks, int length, std::uint64_t seed) {
    for (std::uint64_t k = 0; k < walks; ++k) {
      world w = root_;
      way_.clear();
      std::uint64_t rng = (seed + k) * 0x9e3779b97f4a7c15u + 1;
      auto const draw = [&](std::size_t n) {
        rng ^= rng << 13, rng ^= rng >> 7, rng ^= rng << 17;
        return static_cast<std::size_t>(rng % n);
      };
      for (int i = 0; i < length; ++i) {
        auto const what = draw(3) != 0 ? moves_[draw(3)] : moves_[draw(moves_.size())];
        move const m{what,
                     static_cast<std::uint8_t>(draw(what == act::deliver || what == act::duplicate || what == act::lose
                                                        ? (std::max)(w.under_way(), std::size_t{1})
                                                        : w.size()))};
        if (!w.possible(m)) continue;
        way_.push_back(m);
        ++states_;
        if (auto f = attempt(w, m, i % 4 == 0)) return f;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::uint64_t states() const { return states_; }
  [[nodiscard]] std::uint64_t ruled() const { return ruled_; }
  [[nodiscard]] int depth() const { return depth_; }

  /// The way as a script, by playing it again.
  std::string script(fault const& f) {
    world w = root_;
    std::string text = "  " + f.what + ":\n";
    for (auto m : f.way) {
      text += "    " + w.tell(m) + "\n";
      try {
        w.perform(m, space_);
      } catch (std::string const&) {
      }
    }
    return text;
  }

private:
  std::optional<fault> attempt(world& w, move m, bool settle) {
    try {
      w.perform(m, space_);
      ruled_ += w.anybody_rules();
      if (settle)
        for (int order = 0; order < 3; ++order) w.settle(space_, order);
    } catch (std::string const& what) {
      return fault{what, way_};
    }
    return std::nullopt;
  }

  std::optional<fault> descend(world const& w, int left) {
    if (left == 0) return std::nullopt;
    for (act const what : moves_) {
      bool const of_air = what == act::deliver || what == act::duplicate || what == act::lose;
      auto const count = what == act::advance ? 1 : of_air ? w.under_way() : w.size();
      for (std::size_t k = 0; k < count; ++k) {
        move const m{what, static_cast<std::uint8_t>(k)};
        if (!w.possible(m)) continue;
        if (expanded_ >= most_) return std::nullopt;
        world next = w;
        way_.push_back(m);
        bool const last = left == 1;  // states nearer to the root were settled at smaller limits
        if (auto f = attempt(next, m, last)) return f;
        auto const code = next.digest();
        auto& best = seen_[code];
        if (best < left) {
          best = left;
          if (last) ++expanded_, ++states_;
          if (auto f = descend(next, left - 1)) return f;
        }
        way_.pop_back();
      }
    }
    return std::nullopt;
  }

  setting setting_;
  playground& fixture_;
  world root_;
  rota::workspace space_;
  std::vector<act> moves_;
  std::vector<move> way_;
  std::unordered_map<std::uint64_t, int> seen_;  // how far a state was explored
  std::uint64_t states_ = 0;
  std::uint64_t expanded_ = 0;
  std::uint64_t most_ = 0;
  std::uint64_t ruled_ = 0;
  int limit_ = 0;
  int depth_ = 0;
};

}  // namespace explorer
