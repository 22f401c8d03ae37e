#pragma once

#include "world.hpp"

#include <sstream>

namespace explorer {

/// Where a search begins.
enum class beginning : std::uint8_t {
  fresh,  ///< all have just entered
  brink,  ///< the next round brings a reign
  reign,  ///< it has begun, and its claim is under way
  late    ///< it is nearly over
};
constexpr std::array<beginning, 4> beginnings{beginning::fresh, beginning::brink, beginning::reign, beginning::late};

/// A way to something that must not be.
struct fault {
  std::string what;
  std::vector<move> way;
  int settled = -1;  ///< in which `world::order` the team was to settle; −1: it was broken before
};

/// Breadth first, so that the first fault has a shortest way; or long random ways, which are then shortened.
class search {
public:
  search(setting s, beginning from, playground& f)
      : setting_(std::move(s)), minds_(f, setting_.robots, setting_.types), root_(setting_, minds_), from_(from) {
    moves_ = {act::advance, act::tick, act::deliver};
    moves_.insert(moves_.end(), setting_.acts.begin(), setting_.acts.end());
    begin();
    root_ = root();
  }
  search(search const&) = delete;
  search& operator=(search const&) = delete;

  /// Until so many different states were met, or a fault was found.
  std::optional<fault> run(std::uint64_t most_states) {
    std::vector<node> nodes{{0, {}, 0}};
    met_.insert(root_.digest());
    std::vector<std::pair<std::uint32_t, world>> path{{0, root_}};  // from the root to the node that is expanded
    for (std::uint32_t at = 0; at < nodes.size() && nodes.size() < most_states; ++at) {
      if (forget_minds()) path = {{0, root_}};
      lead_to(nodes, at, path);
      depth_ = nodes[at].depth;
      for (move const m : possible(path.back().second)) {
        world next = path.back().second;
        ++steps_;
        auto const* wrong = next.perform(m);
        if (!wrong && !met_.insert(next.digest())) continue;
        int order = -1;
        if (!wrong) wrong = settle(next, order);
        nodes.push_back({at, m, depth_ + 1});
        if (wrong) return fault{wrong, way(nodes), order};
        ruled_ += next.anybody_rules();
      }
    }
    states_ += nodes.size();
    return std::nullopt;
  }

  /// Random ways from the beginning, so long each.
  std::optional<fault> walk(std::uint64_t walks, int length, std::uint64_t seed) {
    for (std::uint64_t k = 0; k < walks; ++k) {
      forget_minds();
      std::optional<fault> found;
      std::vector<move> taken;
      wander(length, seed + k, [&](world const& w, move m, char const* wrong) {
        taken.push_back(m);
        ++steps_;
        states_ += met_.insert(w.digest());
        ruled_ += w.anybody_rules();
        int order = -1;
        if (!wrong && taken.size() % 8 == 0) wrong = settle(w, order);
        if (wrong) found = fault{wrong, taken, order};
        return wrong == nullptr;
      });
      if (found) return shortened(*std::move(found));
    }
    return std::nullopt;
  }
  /// A random way.
  std::vector<move> any_way(int length, std::uint64_t seed) {
    std::vector<move> taken;
    wander(length, seed, [&](world const&, move m, char const*) {
      taken.push_back(m);
      return true;
    });
    return taken;
  }

  /// Different ones, each judged and settled.
  [[nodiscard]] std::uint64_t states() const { return states_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  /// In how many of them somebody ruled.
  [[nodiscard]] std::uint64_t ruled() const { return ruled_; }
  [[nodiscard]] int depth() const { return depth_; }
  [[nodiscard]] minds const& all_minds() const { return minds_; }
  [[nodiscard]] std::uint64_t digest_of(world const& w, std::size_t i) const { return minds_.digest(w.mind(i)); }

  /// The way as a story, which tests/team/stories.hpp plays again. Calls `last` with the world that it ends in.
  template <class Last>
  std::string script(fault const& f, Last last) {
    chronicle told;
    told.out << "# " << setting_.name << ": " << f.what << '\n' << preamble();
    world w(setting_, minds_);
    for (std::size_t i = 0; i < w.size(); ++i) tell_entering(told.line(w), i);
    for (auto const& m : prelude_) tell(told, w, m);
    w.agree_from_now_on();
    if (setting_.agree) told.line(w) << "everybody believes that 1 attacks best\n";
    for (auto const m : f.way) tell(told, w, m);
    if (f.settled >= 0) tell_settling(told, w, static_cast<world::order>(f.settled));
    told.line(w) << "that is all\n";
    last(w);
    return told.out.str();
  }
  std::string script(fault const& f) {
    return script(f, [](world const&) {});
  }

private:
  struct node {
    std::uint32_t parent;
    move made;
    int depth;
  };
  /// What a story needs to name messages: the how-manieth of its sender each one is.
  struct chronicle {
    std::ostringstream out;
    std::array<int, most_robots> said{};
    std::vector<std::tuple<message_id, rota::instant, std::size_t, int>> letters;
    std::ostream& line(world const& w) { return out << "at " << (w.now() - start).ns / 1'000'000 << " ms: "; }
  };

  /// Calls `visit` after each step of a random way, until it returns false.
  template <class Visit>
  void wander(int length, std::uint64_t seed, Visit visit) {
    world w = root_;
    std::uint64_t rng = seed * 0x9e3779b97f4a7c15u + 1;
    auto const draw = [&](std::size_t n) {
      rng ^= rng << 13, rng ^= rng >> 7, rng ^= rng << 17;
      return static_cast<std::size_t>(rng % n);
    };
    for (int i = 0; i < length; ++i) {
      auto const what = draw(3) != 0 ? moves_[draw(3)] : moves_[draw(moves_.size())];
      auto which = draw(of_air(what) ? (std::max)(w.air().size(), std::size_t{1}) : w.size());
      if (of_types(what)) which += most_robots * draw(setting_.types);
      move const m{what, static_cast<std::uint8_t>(which)};
      if (!w.possible(m)) continue;
      auto const* const wrong = w.perform(m);
      if (!visit(std::as_const(w), m, wrong)) return;
    }
  }

  /// The moves of the prelude, so that a script can tell them.
  void begin() {
    if (from_ == beginning::fresh) return;
    world w = root_, before = w;
    std::vector<move> taken, taken_before;
    for (int i = 0; i < 40 && !w.anybody_rules(); ++i) {
      before = w, taken_before = taken;
      make_round(w, taken, true);
    }
    if (from_ != beginning::brink) {
      w = before, taken = taken_before;
      make_round(w, taken, false);  // the same round again, of which nothing is heard
      if (from_ == beginning::late) {
        while (!w.air().empty()) make(w, taken, {act::deliver, 0});
        for (int i = 0; i < 6; ++i) make_round(w, taken, true);
      }
      taken_before = taken;
    }
    prelude_ = taken_before;
  }
  [[nodiscard]] world root() {
    world w(setting_, minds_);
    for (auto const m : prelude_) w.perform(m);
    w.agree_from_now_on();
    return w;
  }
  /// If they become too many to remember.
  bool forget_minds() {
    if (minds_.size() < 200'000) return false;
    minds_.forget();
    root_ = root();
    return true;
  }
  void make_round(world& w, std::vector<move>& taken, bool heard) {
    make(w, taken, {act::advance});
    for (std::size_t i = 0; i < w.size(); ++i) make(w, taken, {act::tick, static_cast<std::uint8_t>(i)});
    while (heard && !w.air().empty()) make(w, taken, {act::deliver, 0});
  }
  void make(world& w, std::vector<move>& taken, move m) {
    taken.push_back(m);
    if (auto const* wrong = w.perform(m)) ADD_FAILURE() << setting_.name << ", before the search: " << wrong;
  }

  [[nodiscard]] std::vector<move> possible(world const& w) const {
    std::vector<move> all;
    for (act const what : moves_)
      for (std::size_t type = 0; type < (of_types(what) ? setting_.types : 1); ++type) {
        auto const count = what == act::advance ? 1 : of_air(what) ? w.air().size() : w.size();
        for (std::size_t k = 0; k < count; ++k) {
          move const m{what, static_cast<std::uint8_t>(k + most_robots * type)};
          if (w.possible(m)) all.push_back(m);
        }
      }
    return all;
  }
  char const* settle(world const& w, int& order) {
    for (int o = 0; o < 3; ++o) {
      world copy = w;
      order = o;
      if (auto const* wrong = copy.settle(static_cast<world::order>(o), settled_)) return wrong;
    }
    order = -1;
    return nullptr;
  }

  static void lead_to(std::vector<node> const& nodes, std::uint32_t to,
                      std::vector<std::pair<std::uint32_t, world>>& path) {
    std::vector<std::uint32_t> wanted{to};
    while (wanted.back() != 0) wanted.push_back(nodes[wanted.back()].parent);
    std::reverse(wanted.begin(), wanted.end());
    std::size_t common = 0;
    while (common < path.size() && common < wanted.size() && path[common].first == wanted[common]) ++common;
    path.erase(path.begin() + static_cast<std::ptrdiff_t>(common), path.end());
    for (; common < wanted.size(); ++common) {
      world next = path.back().second;
      next.perform(nodes[wanted[common]].made);
      path.emplace_back(wanted[common], next);
    }
  }
  static std::vector<move> way(std::vector<node> const& nodes) {
    std::vector<move> back;
    for (auto at = static_cast<std::uint32_t>(nodes.size() - 1); at != 0; at = nodes[at].parent)
      back.push_back(nodes[at].made);
    std::reverse(back.begin(), back.end());
    return back;
  }

  /// Whether this way, without what is impossible on it, ends in the same fault, and where.
  std::optional<fault> leads_to(std::vector<move> const& moves, fault const& f) {
    world w = root_;
    fault same{f.what, {}, f.settled};
    for (auto const m : moves) {
      if (!w.possible(m)) continue;
      same.way.push_back(m);
      auto const* const wrong = w.perform(m);
      if (wrong) return f.settled < 0 && f.what == wrong ? std::optional(same) : std::nullopt;
    }
    if (f.settled < 0) return std::nullopt;
    number_map nothing;
    auto const* const wrong = w.settle(static_cast<world::order>(f.settled), nothing);
    return wrong && f.what == wrong ? std::optional(same) : std::nullopt;
  }
  fault shortened(fault f) {
    for (std::size_t length = f.way.size(); length > 0; length /= 2)
      for (std::size_t i = 0; i < f.way.size();) {
        auto fewer = f.way;
        auto const from = fewer.begin() + static_cast<std::ptrdiff_t>(i);
        fewer.erase(from, from + static_cast<std::ptrdiff_t>((std::min)(length, fewer.size() - i)));
        if (auto shorter = leads_to(fewer, f)) {
          f = *std::move(shorter);
        } else {
          i += length;
        }
      }
    return f;
  }

  void tell_entering(std::ostream& out, std::size_t i) const {
    out << i + 1 << " enters";
    if (setting_.types == 2) out << "; " << i + 1 << " enters the defence";
    out << '\n';
  }
  std::string preamble() const {
    std::ostringstream out;
    auto const o = impatient();
    auto const ms = [](rota::duration d) { return d.ns / 1'000'000; };
    out << "cycles " << o.cycles << "\nrenewals " << o.renewals << "\nreign " << ms(o.reign) << " ms\nsilence "
        << ms(o.silence) << " ms\nmessage period " << ms(o.message_period) << " ms\nclaim period " << ms(o.claim_period)
        << " ms\nopening " << ms(o.opening) << " ms, every " << ms(o.opening_period) << " ms\nmax delay "
        << ms(o.max_delay) << " ms\nforget " << ms(o.forget) << " ms\nincarnation 5\nrobots " << setting_.robots
        << '\n';
    bool const same = setting_.agree && from_ == beginning::fresh;
    for (int n = 1; n <= setting_.robots; ++n) out << n << " believes that " << (same ? 1 : n) << " attacks best\n";
    return out.str();
  }

  void tell(chronicle& told, world& w, move m) {
    std::size_t const i = m.which % most_robots, type = m.which / most_robots;
    auto const before = w;
    if (!of_air(m.what) && m.what != act::advance) told.line(w) << i + 1;
    char const* const where = type == 1 ? " the defence\n" : "\n";
    switch (m.what) {
    case act::advance: break;
    case act::tick: told.out << " thinks and speaks\n"; break;
    case act::deliver:
    case act::duplicate: tell_heard(told, w, w.air()[m.which]); break;
    case act::lose: break;
    case act::leave: told.out << " leaves" << where; break;
    case act::enter: told.out << " enters" << where; break;
    case act::crash: told.out << " dies\n"; break;
    case act::restart: told.out << " restarts with incarnation " << w.incarnation(i) + 1 << '\n'; break;
    case act::restart_same: told.out << " restarts with incarnation " << w.incarnation(i) << '\n'; break;
    case act::restart_less: told.out << " restarts with incarnation " << w.incarnation(i) - 1 << '\n'; break;
    case act::blind: told.out << (w.blind(i) ? " sees again\n" : " sees nothing valid\n"); break;
    case act::confident: told.out << " has confidence 9\n"; break;
    }
    if (m.what >= act::restart && m.what <= act::restart_less) {
      tell_entering(told.line(w), i);
      if (w.blind(i)) told.line(w) << i + 1 << " sees again\n";
    }
    w.perform(m);
    if (m.what == act::tick) tell_said(told, before, i);
  }
  /// Numbers what robot i says.
  void tell_said(chronicle& told, world const& before, std::size_t i) {
    for (auto const m : minds_.think(before.mind(i), before.sight(i)).said)
      told.letters.emplace_back(m, before.now(), i, ++told.said[i]);
  }
  void tell_heard(chronicle& told, world const& w, flight const& f) {
    for (auto const& [what, sent, sender, number] : told.letters) {
      if (what != f.what || sent != f.sent) continue;
      told.line(w) << f.to + 1 << " hears message " << number << " of " << sender + 1;
      auto const& text = minds_.text(what);
      if (auto const* c = std::get_if<claim>(&text)) told.out << "  # claim " << c->number << " v" << c->version;
      told.out << '\n';
      return;
    }
  }
  void tell_settling(chronicle& told, world& w, world::order o) {
    told.out << "# From here on everything is heard. What was under way is heard "
             << (o == world::order::never   ? "never"
                 : o == world::order::first ? "first"
                                            : "after three rounds")
             << ".\n";
    for (std::size_t i = 0; i < w.size(); ++i) {
      if (!w.alive(i)) continue;
      if (w.blind(i)) told.line(w) << i + 1 << " sees again\n";
      for (std::size_t type = 0; type < setting_.types; ++type)
        if (!w.see(i, type).executes) told.line(w) << i + 1 << " enters" << (type == 1 ? " the defence\n" : "\n");
    }
    auto const old = w.begin_settling(o);
    auto const hear_old = [&] {
      for (auto const& f : old)
        if (w.now() - f.sent <= longest_delay) tell_heard(told, w, f), w.hear(f);
    };
    if (o == world::order::first) hear_old();
    for (int k = 0; k < setting_.rounds; ++k) {
      tell(told, w, {act::advance});
      for (std::size_t i = 0; i < w.size(); ++i)
        if (w.alive(i)) tell(told, w, {act::tick, static_cast<std::uint8_t>(i)});
      while (!w.air().empty()) tell(told, w, {act::deliver, 0});
      if (k == 2 && o == world::order::late) hear_old();
      tell_rule(told, w);
    }
  }
  /// Who rules in whose eyes, as a remark.
  void tell_rule(chronicle& told, world const& w) const {
    for (std::size_t type = 0; type < setting_.types; ++type) {
      told.out << "#";
      for (std::size_t i = 0; i < w.size(); ++i) {
        auto const& o = w.see(i, type);
        if (w.alive(i) && o.leads) told.out << ' ' << i + 1 << " leads;";
        if (w.alive(i) && o.obeys) told.out << ' ' << i + 1 << " obeys " << static_cast<int>(o.leader) << ';';
      }
      told.out << '\n';
    }
  }

  setting setting_;
  minds minds_;
  world root_;
  beginning from_;
  std::vector<act> moves_;
  std::vector<move> prelude_;
  number_map met_, settled_;
  std::uint64_t states_ = 0;
  std::uint64_t steps_ = 0;
  std::uint64_t ruled_ = 0;
  int depth_ = 0;
};

}  // namespace explorer
