#pragma once

#include "setting.hpp"

#include <bit>

namespace explorer {

/// One state of the team, and what an observer who sees everything has noted. What is broken, it says in a sentence.
class world {
public:
  world(setting const& s, minds& m) : setting_(&s), minds_(&m) {
    for (std::size_t i = 0; i < size(); ++i) {
      auto const n = static_cast<int>(i) + 1;
      bodies_[i].mind = m.fresh(n, bodies_[i].incarnation, start + rota::milliseconds(10 * n));
    }
  }

  /// Whether it can be done now.
  [[nodiscard]] bool possible(move m) const {
    if (m.what == act::advance) return true;
    if (of_air(m.what)) {
      if (m.which >= air_.size()) return false;
      return m.what != act::duplicate || (!air_[m.which].copied && air_.size() < setting_->flying);
    }
    std::size_t const i = m.which % most_robots, type = m.which / most_robots;
    if (i >= size() || type >= minds_->types()) return false;
    auto const& b = bodies_[i];
    bool const untroubled = b.troubles < setting_->troubles;
    if (m.what == act::restart) return untroubled || !b.alive;
    if (!b.alive) return false;
    switch (m.what) {
    case act::tick: return !b.thought && air_.size() + size() <= setting_->flying + 2;
    case act::leave: return minds_->see(b.mind, type).executes && untroubled;
    case act::enter: return !minds_->see(b.mind, type).executes;
    case act::blind: return untroubled || b.blind;
    default: return untroubled;
    }
  }

  /// Does it, and says what it has broken, if anything. @pre `possible(m)`
  char const* perform(move m) {
    std::size_t const i = m.which % most_robots, type = m.which / most_robots;
    auto& b = bodies_[i];
    if (!of_air(m.what) && m.what > act::lose && m.what != act::enter) ++b.troubles;
    switch (m.what) {
    case act::advance: advance(step); break;
    case act::tick: return tick(i);
    case act::deliver:
    case act::duplicate: {
      auto const f = air_[m.which];
      if (m.what == act::deliver) {
        air_.erase(air_.begin() + m.which);
      } else {
        air_[m.which].copied = true;
      }
      return deliver(f);
    }
    case act::lose: air_.erase(air_.begin() + m.which); break;
    case act::leave: b.mind = minds_->leave(b.mind, type); break;
    case act::enter: b.mind = minds_->enter(b.mind, type); break;
    case act::crash:
      b.alive = false;
      b.died = now_;
      forget_flights_to(i);
      break;
    case act::restart: reborn(i, b.incarnation + 1); break;
    case act::restart_same: reborn(i, b.incarnation); break;
    case act::restart_less: reborn(i, b.incarnation - 1); break;
    case act::blind: b.blind = !b.blind; break;
    case act::confident:
      b.confidence = 9;
      b.mind = minds_->grow_confident(b.mind, b.confidence);
      break;
    }
    return minds_->wrong();
  }

  /// In which order what is under way is heard, when the team settles.
  enum class order : std::uint8_t { never, first, late };

  /// From here on everything is heard: is there one leader, does everybody who hears it obey, is nobody obeyed that does not
  /// lead, is everybody heard that is alive, nobody believed that is not, and are all back to normal when nobody speaks any
  /// more? `known` holds worlds, on the way to settling, of which that was shown.
  char const* settle(order o, number_map& known) {
    auto const old = begin_settling(o);
    if (o == order::first)
      for (auto const& f : old)
        if (auto const* wrong = deliver(f)) return wrong;
    // A moment with two leaders, or with one obeyed that has just ended, is unavoidable; two or three rounds are not.
    rota::small_vector<int, 4> lasting{0, 0, 0, 0};
    for (int i = 0; i < setting_->rounds; ++i) {
      auto code = mixed(digest(), static_cast<std::uint64_t>(i));
      for (int const n : lasting) code = mixed(code, static_cast<std::uint64_t>(n));
      if (o == order::late && i <= 2)
        for (auto const& f : old) code = mixed(code, digest_of(f));
      if (!known.insert(code)) return nullptr;
      if (auto const* wrong = round()) return wrong;
      if (i == 2 && o == order::late)
        for (auto const& f : old)
          if (now_ - f.sent <= longest_delay)
            if (auto const* wrong = deliver(f)) return wrong;
      if (i + 6 < setting_->rounds) continue;  // not before everybody is heard again
      for (std::size_t type = 0; type < minds_->types(); ++type)
        if (auto const* wrong = judge(type, lasting.data() + 2 * type)) return wrong;
    }
    if (auto const* wrong = judge_knowledge()) return wrong;
    advance(impatient().reign + longest_delay);
    for (std::size_t i = 0; i < size(); ++i) {
      if (!bodies_[i].alive) continue;
      auto const& after = minds_->think(bodies_[i].mind, sight(i));
      for (std::size_t type = 0; type < minds_->types(); ++type) {
        auto const& o2 = minds_->see(after.after, type);
        if (o2.obeys || (o2.leads && o2.left != impatient().reign)) return "a reign without end";
      }
    }
    return nullptr;
  }
  /// Everybody takes part and sees. Returns what was under way.
  rota::small_vector<flight, 12> begin_settling(order o) {
    for (std::size_t i = 0; i < size(); ++i) {
      auto& b = bodies_[i];
      b.blind = false;
      for (std::size_t type = 0; type < minds_->types(); ++type)
        if (b.alive && !minds_->see(b.mind, type).executes) b.mind = minds_->enter(b.mind, type);
    }
    auto old = std::exchange(air_, {});
    if (o == order::never) old.clear();
    return old;
  }
  /// Time passes, everybody thinks and speaks, and everything is heard.
  char const* round() {
    advance(step);
    for (std::size_t i = 0; i < size(); ++i)
      if (bodies_[i].alive)
        if (auto const* wrong = tick(i)) return wrong;
    for (auto const& f : std::exchange(air_, {}))
      if (auto const* wrong = deliver(f)) return wrong;
    return nullptr;
  }
  /// Two worlds with equal digests are alike from now on.
  [[nodiscard]] std::uint64_t digest() const {
    std::uint64_t sum = 1;
    for (std::size_t i = 0; i < size(); ++i) {
      auto const& b = bodies_[i];
      sum = mixed(sum, minds_->code(b.mind));
      sum = mixed(sum, b.incarnation << 32 | b.confidence << 16 | static_cast<std::uint64_t>(b.troubles) << 8 |
                           (b.alive ? 1u : 0u) | (b.blind ? 2u : 0u) | (b.thought ? 4u : 0u) | (b.was_blind ? 8u : 0u));
      sum = mixed(sum, b.alive ? 0 : since(b.died));
      for (std::size_t j = 0; j < size(); ++j)
        sum = mixed(mixed(sum, b.heard[j].incarnation << 32 | b.heard[j].sequence), since(b.heard[j].when));
      for (auto const& s : b.stamps) sum = mixed(mixed(sum, s.confidence), since(s.frozen_until));
      for (auto const d : b.disputes) sum = mixed(sum, d);
    }
    for (auto const& n : notes_) {
      sum = mixed(mixed(sum, n.name), mixed(since(n.end), n.answered));
      for (std::size_t i = 0; i < size(); ++i) sum = mixed(mixed(sum, since(n.heard[i])), since(n.floor[i]));
    }
    for (auto const& f : air_) sum = mixed(sum, digest_of(f));
    return sum;
  }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(setting_->robots); }
  [[nodiscard]] rota::small_vector<flight, 12> const& air() const { return air_; }
  [[nodiscard]] rota::instant now() const { return now_; }
  [[nodiscard]] std::uint64_t incarnation(std::size_t i) const { return bodies_[i].incarnation; }
  [[nodiscard]] bool alive(std::size_t i) const { return bodies_[i].alive; }
  [[nodiscard]] bool blind(std::size_t i) const { return bodies_[i].blind; }
  [[nodiscard]] mind_id mind(std::size_t i) const { return bodies_[i].mind; }
  [[nodiscard]] outlook const& see(std::size_t i, std::size_t type) const { return minds_->see(bodies_[i].mind, type); }
  [[nodiscard]] bool anybody_rules() const {
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t type = 0; type < minds_->types(); ++type)
        if (see(i, type).leads || see(i, type).obeys) return true;
    return false;
  }
  /// Who attacks best in its eyes; 0: it sees nothing valid.
  [[nodiscard]] int sight(std::size_t i) const {
    if (bodies_[i].blind) return 0;
    return agree_ ? 1 : static_cast<int>(i) + 1;
  }
  /// A message arrives that is not under way any more.
  char const* hear(flight const& f) { return deliver(f); }
  /// If the setting says so, all see the same from now on.
  void agree_from_now_on() { agree_ = setting_->agree; }

private:
  /// As far as it matters.
  [[nodiscard]] std::uint64_t since(rota::instant t) const {
    auto const ms = (now_ - t).ns / 1'000'000;
    return static_cast<std::uint64_t>((std::clamp)(ms, std::int64_t{-5000}, std::int64_t{3001}));
  }
  [[nodiscard]] std::uint64_t digest_of(flight const& f) const {
    return mixed(mixed(f.what, f.to), since(f.sent) << 1 | (f.copied ? 1u : 0u));
  }
  note& note_of(claim_id name) {
    for (auto& n : notes_)
      if (n.name == name) return n;
    note fresh;
    fresh.name = name;
    fresh.heard.fill(not_yet), fresh.floor.fill(long_past);
    auto const* at = notes_.begin();
    while (at != notes_.end() && at->name < name) ++at;
    return *notes_.insert(at, fresh);
  }

  void advance(rota::duration d) {
    now_ = now_ + d;
    for (std::size_t i = 0; i < size(); ++i) {
      auto& b = bodies_[i];
      if (b.alive) b.mind = minds_->pass(b.mind, d);
      b.thought = false;
    }
    for (std::size_t k = air_.size(); k-- > 0;)
      if (now_ - air_[k].sent > longest_delay) air_.erase(air_.begin() + k);
  }
  void forget_flights_to(std::size_t i) {
    for (std::size_t k = air_.size(); k-- > 0;)
      if (air_[k].to == i) air_.erase(air_.begin() + k);
  }

  char const* tick(std::size_t i) {
    auto& b = bodies_[i];
    auto const before = b.mind;
    auto const& t = minds_->think(before, sight(i));
    b.mind = t.after;
    b.thought = true;
    b.was_blind = b.blind;
    for (auto const m : t.said)
      for (std::size_t to = 0; to < size(); ++to)
        if (to != i && bodies_[to].alive) {
          flight const f{m, static_cast<std::uint8_t>(to), false, now_};
          auto const* at = air_.begin();
          while (at != air_.end() && *at < f) ++at;
          air_.insert(at, f);
        }
    for (std::size_t type = 0; type < minds_->types(); ++type) {
      auto const& o = minds_->see(b.mind, type);
      if (o.leads && b.blind) return "a blind robot leads";
      if (!o.executes) continue;
      for (std::size_t other = 0; other < size(); ++other)
        if (!bodies_[other].alive && (o.known >> (other + 1) & 1) != 0 &&
            now_ - bodies_[other].died > impatient().silence + longest_delay + impatient().claim_period)
          return "a dead robot is believed";
    }
    if (auto const* wrong = note_reign(i, before)) return wrong;
    return look_at(i);
  }

  char const* deliver(flight const& f) {
    auto& b = bodies_[f.to];
    auto const before = b.mind;
    auto const& text = minds_->text(f.what);
    auto const& h = minds_->hear(before, f.what);
    b.mind = h.after;
    if (auto const* c = std::get_if<claim>(&text)) {
      std::size_t const type = c->type == type_ids[0] ? 0 : 1;
      auto const& was = minds_->see(before, type);
      if (auto const* wrong = note_claim(f.to, *c, h, was)) return wrong;
      auto const& is = minds_->see(b.mind, type);
      if ((was.leads || was.obeys) && was.left > rota::duration{} && is.obeys && is.leader != was.leader &&
          is.stamp < was.stamp)
        return "turns to a smaller stamp";
    } else if (auto const* wrong = note_plan(f.to, std::get<plan_message>(text), h)) {
      return wrong;
    }
    if (auto const* wrong = note_reign(f.to, before)) return wrong;
    return look_at(f.to);
  }

  char const* note_plan(std::size_t i, plan_message const& m, minds::hearing const& h) {
    if (h.verdict != rota::verdict::accepted) return nullptr;
    auto const sender = static_cast<std::size_t>(m.sender) - 1;
    auto& last = bodies_[i].heard[sender];
    number const said{m.number.incarnation.value, m.number.sequence, now_};
    bool const new_life = !(last < said);
    if (new_life && now_ - last.when <= impatient().forget) return "an old message is taken in";
    last = said;
    for (std::size_t type = 0; type < minds_->types(); ++type) bodies_[i].disputes[type] &= ~(1u << sender);
    for (auto const& p : m.types)
      if (p.stance != rota::stance::none) bodies_[i].disputes[p.type == type_ids[0] ? 0 : 1] |= 1u << sender;
    // If its leader has not made the last claim in this life, and that is past or over, all are forgotten: its claims may be made
    // again under their names.
    std::array<bool, 2> anew{new_life, new_life};
    for (auto const& n : notes_) {
      auto const& name = minds_->name(n.name);
      bool const unmade = std::tie(name.incarnation, name.number) > std::tie(said.incarnation, m.claims);
      bool const past = n.heard[i] == long_past || now_ - n.heard[i] > longest_delay;
      if (name.leader == m.sender && unmade && past) anew[name.type == type_ids[0] ? 0 : 1] = true;
    }
    for (auto& n : notes_) {
      auto const& name = minds_->name(n.name);
      if (name.leader != m.sender) continue;
      if (anew[name.type == type_ids[0] ? 0 : 1]) {
        n.heard[i] = not_yet;
        n.answered = static_cast<std::uint8_t>(n.answered & ~(1u << i));
      }
      std::uint64_t leads = 0;
      for (auto const& p : m.types)
        if (p.type == name.type) leads = p.leads;
      bool const former = name.incarnation < said.incarnation;
      bool const over = name.incarnation == said.incarnation && name.number <= m.claims && leads < name.number;
      if ((former || over) && n.heard[i] != not_yet) n.heard[i] = long_past;
    }
    return nullptr;
  }
  char const* note_claim(std::size_t i, claim const& c, minds::hearing const& h, outlook const& was) {
    if (h.verdict != rota::verdict::accepted) return nullptr;
    auto& b = bodies_[i];
    std::size_t const type = c.type == type_ids[0] ? 0 : 1;
    auto& n = note_of(minds_->find({c.type, c.leader, c.incarnation.value, c.number}));
    auto const end = now_ + c.remaining;
    if (n.heard[i] == not_yet) n.floor[i] = end - impatient().max_delay;
    if (n.heard[i] != long_past) n.heard[i] = (std::max)(n.floor[i], (std::min)(n.heard[i], end));
    if (h.outcome == rota::claim_outcome::expired) return nullptr;
    if (was.obeys && was.leader == c.leader && was.renewals < c.renewals) b.stamps[type].frozen_until = long_past;
    freeze(i, type, now_ + c.remaining);
    if (h.outcome != rota::claim_outcome::challenged) return nullptr;
    if (b.was_blind) return "a blind robot answers";
    if ((n.answered >> i & 1) != 0) return "a claim is answered twice";
    n.answered = static_cast<std::uint8_t>(n.answered | 1u << i);
    if (minds_->see(b.mind, type).left > c.remaining) return "an answer outlives its claim";
    if (minds_->see(b.mind, type).renewals != c.renewals) return "an answer may be renewed more often than its claim";
    return nullptr;
  }
  void freeze(std::size_t i, std::size_t type, rota::instant until) {
    auto& s = bodies_[i].stamps[type];
    if (now_ >= s.frozen_until) s.confidence = bodies_[i].confidence;
    s.frozen_until = (std::max)(s.frozen_until, until);
  }
  /// If the robot leads since now: until when, and with its right stamp?
  char const* note_reign(std::size_t i, mind_id before) {
    for (std::size_t type = 0; type < minds_->types(); ++type) {
      auto const& was = minds_->see(before, type);
      auto const& is = minds_->see(bodies_[i].mind, type);
      if (!is.leads || (was.leads && was.ruling == is.ruling)) continue;
      if (was.leads && was.left > rota::duration{}) {
        if (is.renewals != was.renewals + 1) return "a leader begins anew without renewing";
        if (bodies_[i].disputes[type] == 0) return "a reign is renewed that nobody disputes";
        bodies_[i].stamps[type].frozen_until = long_past;
      }
      if (is.renewals > impatient().renewals) return "a reign is renewed too often";
      if (is.answers >= minds_->everybody()) return "more answers than robots";
      freeze(i, type, now_ + is.left);
      if (is.stamp.confidence != bodies_[i].stamps[type].confidence) return "a stamp changes while claims live";
      auto& end = note_of(is.ruling).end;
      end = (std::max)(end, now_ + is.left);
    }
    return nullptr;
  }
  /// What must hold of every robot.
  char const* look_at(std::size_t i) {
    for (std::size_t type = 0; type < minds_->types(); ++type) {
      auto const& o = minds_->see(bodies_[i].mind, type);
      if (!o.obeys || o.left <= rota::duration{}) continue;
      auto const& n = note_of(o.ruling);
      if (n.end == long_past) return "obeys a claim that nobody made";
      if (now_ >= n.heard[i]) return "a claim that has ended is obeyed";
      if (now_ + o.left > n.heard[i]) return "a reign longer than a copy said";
      if (now_ + o.left > n.end + longest_delay) return "a reign longer than its bound";
    }
    return minds_->wrong();
  }

  /// While everything is heard: one leader, whom all obey; nobody obeys another. `lasting` counts rounds in which it is not so.
  char const* judge(std::size_t type, int* lasting) const {
    int leaders = 0;
    outlook const* leader = nullptr;
    for (std::size_t i = 0; i < size(); ++i)
      if (bodies_[i].alive && see(i, type).leads) ++leaders, leader = &see(i, type);
    bool orphan = false, deaf = false, other = false;
    for (std::size_t i = 0; i < size(); ++i) {
      if (!bodies_[i].alive) continue;
      auto const& o = see(i, type);
      orphan |= o.obeys && (!leader || (leaders == 1 && leader->ruling != o.ruling));
      deaf |= leader && !o.leads && !o.obeys;
      other |= leader && o.obeys && o.ruling == leader->ruling && o.held != leader->held;
    }
    lasting[0] = leaders > 1 ? lasting[0] + 1 : 0;
    lasting[1] = orphan || deaf || other ? lasting[1] + 1 : 0;
    if (lasting[0] > 2) return "two settled leaders";
    if (lasting[1] > 3) return orphan ? "an orphan, or a ghost obeyed" : deaf ? "deaf to a leader" : "obeys otherwise";
    return nullptr;
  }
  /// After all was heard: those who are alive know one another, and nobody else; and if all see the same they agree.
  char const* judge_knowledge() const {
    std::uint32_t living = 0;
    for (std::size_t i = 0; i < size(); ++i)
      if (bodies_[i].alive) living |= 1u << (i + 1);
    std::size_t const first = static_cast<std::size_t>(std::countr_zero(living)) - 1;
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t type = 0; type < minds_->types(); ++type) {
        if (!bodies_[i].alive) continue;
        auto const& o = see(i, type);
        if ((living & ~o.known) != 0) return "a robot is unheard";
        if ((o.known & ~living) != 0) return "a dead robot is believed for long";
        if (agree_ && !anybody_rules() && o.held != see(first, type).held) return "equal beliefs, and no agreement";
      }
    return nullptr;
  }

  void reborn(std::size_t i, std::uint64_t incarnation) {
    auto& b = bodies_[i];
    auto const troubles = b.troubles;
    b = body{};
    b.mind = minds_->fresh(static_cast<int>(i) + 1, incarnation, start);
    b.incarnation = incarnation;
    b.troubles = troubles;
    for (auto& n : notes_) {
      n.heard[i] = not_yet;
      n.answered = static_cast<std::uint8_t>(n.answered & ~(1u << i));
    }
  }

  setting const* setting_;
  minds* minds_;
  rota::instant now_ = start;
  bool agree_ = false;
  std::array<body, most_robots> bodies_{};
  rota::small_vector<flight, 12> air_;  // ascending
  rota::small_vector<note, 4> notes_;   // ascending by name
};

}  // namespace explorer
