#pragma once

#include "../playground.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

namespace explorer {

constexpr std::size_t most_robots = 3;
constexpr std::size_t most_types = 2;
constexpr std::array<soccer::plan_type, most_types> type_ids{play_id, defence_id};

/// A team with little patience, so that everything happens soon.
inline rota::robot_options impatient() {
  rota::robot_options o;
  o.cycles = 2;
  o.reign = o.max_reign = rota::milliseconds(400);
  o.silence = rota::milliseconds(400);
  o.claim_period = o.message_period = rota::milliseconds(100);
  o.opening = o.opening_period = rota::milliseconds(50);
  o.max_delay = rota::milliseconds(200);
  o.forget = rota::seconds(1);
  o.renewals = 2;
  return o;
}

constexpr std::uint64_t mixed(std::uint64_t sum, std::uint64_t x) noexcept {
  sum = (sum ^ x) * 0x9e3779b97f4a7c15u;
  return sum ^ (sum >> 29);
}

/// Finds numbers by numbers, in one piece of memory.
class number_map {
public:
  number_map() : places_(1024) {}
  /// The value of a key, and whether it was there before; else it becomes `value`.
  std::pair<std::uint32_t, bool> insert(std::uint64_t key, std::uint32_t value) {
    if (key == 0) key = 1;
    if (2 * size_ >= places_.size()) {
      auto const old = std::exchange(places_, std::vector<entry>(4 * places_.size()));
      for (auto const& e : old)
        if (e.key != 0) places_[place(e.key)] = e;
    }
    auto& e = places_[place(key)];
    if (e.key == key) return {e.value, true};
    e = {key, value};
    ++size_;
    return {value, false};
  }
  /// False if it was there.
  bool insert(std::uint64_t key) { return !insert(key, 0).second; }

private:
  struct entry {
    std::uint64_t key = 0;
    std::uint32_t value = 0;
  };
  [[nodiscard]] std::size_t place(std::uint64_t key) const noexcept {
    auto at = static_cast<std::size_t>(mixed(key, 0) >> 16) & (places_.size() - 1);
    while (places_[at].key != 0 && places_[at].key != key) at = (at + 1) & (places_.size() - 1);
    return at;
  }
  std::vector<entry> places_;
  std::size_t size_ = 0;
};

using mind_id = std::uint32_t;
using message_id = std::uint32_t;
using claim_id = std::uint16_t;

/// A claim that somebody made.
struct claim_name {
  soccer::plan_type type{};
  soccer::agent leader{};
  std::uint64_t incarnation = 0;
  std::uint64_t number = 0;
  friend auto operator<=>(claim_name const&, claim_name const&) = default;
};

/// What can be seen from outside of a robot and one plan type.
struct outlook {
  bool executes = false;
  bool leads = false;
  bool obeys = false;
  claim_id ruling = 0;  // the claim in force
  soccer::agent leader{};
  rota::claim_stamp<soccer> stamp{};
  rota::duration left{};  // until that claim ends
  std::uint32_t renewals = 0;
  std::uint32_t answers = 0;
  std::uint32_t known = 0;  // the robots that take part, a bit each
  std::uint32_t held = 0;   // the allocation, four bits for each robot
};

/// All states of robots that were met, each once, and what each does when something happens to it. Worlds are made of few
/// different robots: so `robot` runs once for each of these, and not once for each world.
///
/// Robots are told apart by `robot::digest`, which counts time from now. That equal digests behave alike is tried out on
/// some of those that are not equal otherwise.
class minds {
public:
  struct thought {
    mind_id after = 0;
    std::vector<message_id> said;
  };
  struct hearing {
    mind_id after = 0;
    rota::verdict verdict{};
    std::optional<rota::claim_outcome> outcome{};
  };

  minds(playground& f, int robots, std::size_t types)
      : fixture_(f), everybody_(squad(robots)), types_{f.play, make_play(defence_id)}, count_(types) {}

  /// Robot n begins a life.
  mind_id fresh(int n, std::uint64_t incarnation, rota::instant first_message) {
    auto o = impatient();
    o.first_message = first_message;
    robot r(agent(n), everybody_, rota::incarnation{incarnation}, o);
    for (std::size_t k = 0; k < count_; ++k) r.enter(types_[k], start);
    return intern(std::move(r), start);
  }
  /// It deliberates, believing that robot `best` attacks best, or seeing nothing valid if that is 0, and says what is due.
  thought const& think(mind_id id, int best) {
    return thoughts_[remembered(deed::think, id, static_cast<std::uint32_t>(best), [&] {
      auto r = robots_[id];
      auto said = think(r, best, when_[id]);
      auto const after = intern(std::move(r), when_[id]);
      thoughts_.push_back({after, std::move(said)});
      return static_cast<std::uint32_t>(thoughts_.size() - 1);
    })];
  }
  hearing const& hear(mind_id id, message_id m) {
    return hearings_[remembered(deed::hear, id, m, [&] {
      auto r = robots_[id];
      auto const reception = r.receive(messages_[m], when_[id]);
      hearings_.push_back({intern(std::move(r), when_[id]), reception.verdict, reception.claim});
      return static_cast<std::uint32_t>(hearings_.size() - 1);
    })];
  }
  mind_id pass(mind_id id, rota::duration d) {
    return remembered(deed::pass, id, static_cast<std::uint32_t>(d.ns / 1'000'000),
                      [&] { return intern(robot(robots_[id]), when_[id] + d); });
  }
  mind_id enter(mind_id id, std::size_t type) {
    return remembered(deed::enter, id, static_cast<std::uint32_t>(type), [&] {
      auto r = robots_[id];
      r.enter(types_[type], when_[id]);
      return intern(std::move(r), when_[id]);
    });
  }
  mind_id leave(mind_id id, std::size_t type) {
    return remembered(deed::leave, id, static_cast<std::uint32_t>(type), [&] {
      auto r = robots_[id];
      r.leave(type_ids[type]);
      return intern(std::move(r), when_[id]);
    });
  }
  mind_id grow_confident(mind_id id, std::uint32_t confidence) {
    return remembered(deed::grow, id, confidence, [&] {
      auto r = robots_[id];
      r.set_confidence(confidence);
      return intern(std::move(r), when_[id]);
    });
  }

  [[nodiscard]] outlook const& see(mind_id id, std::size_t type) const { return seen_[id][type]; }
  [[nodiscard]] std::uint64_t digest(mind_id id) const { return robots_[id].digest(when_[id]); }
  [[nodiscard]] std::uint64_t code(mind_id id) const { return codes_[id]; }
  [[nodiscard]] message const& text(message_id m) const { return messages_[m]; }
  [[nodiscard]] claim_name const& name(claim_id c) const { return names_[c]; }
  [[nodiscard]] claim_id find(claim_name const& n) {
    auto const where = std::find(names_.begin(), names_.end(), n);
    if (where != names_.end()) return static_cast<claim_id>(where - names_.begin());
    names_.push_back(n);
    return static_cast<claim_id>(names_.size() - 1);
  }
  /// Forgets all robots, which may be met again, but neither messages nor claims.
  void forget() {
    robots_.clear(), when_.clear(), codes_.clear(), seen_.clear();
    ids_ = {}, deeds_ = {};
    results_.clear(), thoughts_.clear(), hearings_.clear();
  }
  /// How many it remembers.
  [[nodiscard]] std::size_t size() const { return robots_.size(); }
  [[nodiscard]] std::size_t types() const { return count_; }
  [[nodiscard]] std::size_t everybody() const { return everybody_.size(); }
  [[nodiscard]] std::uint64_t met() const { return met_; }
  /// How often two robots that are not equal, but whose digests are, were made to do the same.
  [[nodiscard]] std::uint64_t compared() const { return compared_; }
  /// What is wrong with a robot by itself, if anything was ever seen.
  [[nodiscard]] char const* wrong() const { return wrong_; }

private:
  enum class deed : std::uint8_t { think, hear, pass, enter, leave, grow };

  /// What came of a deed before, or comes of it now.
  template <class Do>
  std::uint32_t remembered(deed d, mind_id id, std::uint32_t what, Do act) {
    auto const key = mixed(codes_[id], std::uint64_t{what} << 8 | static_cast<std::uint64_t>(d));
    auto const [place, known] = deeds_.insert(key, static_cast<std::uint32_t>(results_.size()));
    if (known) return results_[place];
    results_.push_back(0);
    auto const result = act();
    return results_[place] = result;
  }

  std::vector<message_id> think(robot& r, int best, rota::instant now) {
    auto v = sees(best);
    if (best == 0) v.attack.fill(-100);
    for (std::size_t k = 0; k < count_; ++k)
      if (r.executes(type_ids[k])) (void)r.deliberate(types_[k], fixture_.members, v, now, space_);
    std::vector<message_id> said;
    while (auto m = r.next_message(now)) said.push_back(intern(*std::move(m)));
    return said;
  }

  mind_id intern(robot&& r, rota::instant now) {
    auto const code = mixed(r.digest(now), r.options().confidence);
    auto const [id, known] = ids_.insert(code, static_cast<mind_id>(robots_.size()));
    if (known) {
      if (++hits_ % 32 == 0) compare(r, now, id);
      return id;
    }
    ++met_;
    auto& seen = seen_.emplace_back();
    for (std::size_t k = 0; k < count_; ++k) seen[k] = look(r, k, now);
    codes_.push_back(code);
    when_.push_back(now);
    robots_.push_back(std::move(r));
    return id;
  }
  /// Makes both do the same.
  void compare(robot r, rota::instant now, mind_id id) {
    if (now == when_[id] && r == robots_[id]) return;
    ++compared_;
    auto other = robots_[id];
    auto then = when_[id];
    int const best = static_cast<int>(compared_ % 3);
    bool same = true;
    for (int i = 0; i < 2; ++i) {
      same = same && think(r, best, now) == think(other, best, then);
      now = now + rota::milliseconds(50), then = then + rota::milliseconds(50);
      if (messages_.empty()) continue;
      auto const& m = messages_[static_cast<std::size_t>(compared_ * 7) % messages_.size()];
      same = same && r.receive(m, now).verdict == other.receive(m, then).verdict;
    }
    if (!same || (now == then && r.digest(now) != other.digest(then)))
      wrong_ = "two robots with one digest behave differently";
  }

  outlook look(robot const& r, std::size_t type, rota::instant now) {
    outlook o;
    auto const* const rule = r.rule(type_ids[type]);
    o.executes = rule != nullptr;
    if (!rule) return o;
    o.leads = rule->leading();
    o.obeys = rule->obeying();
    if (rule->active()) {
      auto const& c = rule->current();
      o.ruling = find({c.type, c.leader, c.incarnation.value, c.number});
      o.leader = c.leader;
      o.stamp = c.stamp;
      o.renewals = c.renewals;
      o.answers = c.answers;
      o.left = rule->expiry() - now;
      if (o.obeys == (c.leader == r.self())) wrong_ = "obeys itself, or leads with the claim of another";
    }
    auto const& believed = *r.believes(type_ids[type]);
    for (auto const b : believed.participants()) o.known |= 1u << static_cast<unsigned>(b);
    for (auto const& x : believed.atoms()) {
      auto const shift = 4 * static_cast<unsigned>(x.agent);
      if (!believed.takes_part(x.agent)) wrong_ = "a task of nobody";
      if ((o.held >> shift & 15) != 0) wrong_ = "two tasks for one";
      o.held |= (1 + static_cast<std::uint32_t>(x.task)) << shift;
    }
    return o;
  }

  message_id intern(message&& m) {
    std::uint64_t h = 7;
    if (auto const* c = std::get_if<claim>(&m)) {
      h = mixed(mixed(mixed(h, static_cast<std::uint64_t>(c->leader)), c->number), c->version);
      h = mixed(mixed(h, c->incarnation.value), static_cast<std::uint64_t>(c->remaining.ns));
    } else {
      auto const& p = std::get<plan_message>(m);
      h = mixed(mixed(mixed(h, 100 + static_cast<std::uint64_t>(p.sender)), p.number.sequence), p.claims);
    }
    auto const [first, last] = message_ids_.equal_range(h);
    for (auto i = first; i != last; ++i)
      if (messages_[i->second] == m) return i->second;
    messages_.push_back(std::move(m));
    return message_ids_.emplace(h, static_cast<message_id>(messages_.size() - 1))->second;
  }

  playground& fixture_;
  std::vector<soccer::agent> everybody_;
  std::array<rota::plan_type<soccer, view>, most_types> types_;
  std::size_t count_;
  rota::workspace space_;
  std::deque<message> messages_;
  std::unordered_multimap<std::uint64_t, message_id> message_ids_;
  std::vector<claim_name> names_;
  std::deque<robot> robots_;
  std::vector<rota::instant> when_;  // each was first met
  std::vector<std::uint64_t> codes_;
  std::vector<std::array<outlook, most_types>> seen_;
  number_map ids_;    // by code
  number_map deeds_;  // by mind and deed
  std::vector<std::uint32_t> results_;
  std::deque<thought> thoughts_;
  std::deque<hearing> hearings_;
  std::uint64_t met_ = 0;
  std::uint64_t hits_ = 0;
  std::uint64_t compared_ = 0;
  char const* wrong_ = nullptr;
};

}  // namespace explorer
