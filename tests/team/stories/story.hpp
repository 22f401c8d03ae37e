#pragma once

#include "../playground.hpp"

#include <deque>
#include <istream>
#include <map>
#include <sstream>
#include <string>

namespace stories {

/// Plays a story of robots, told in sentences that a person can read: stories/README.md lists them. The robots are real.
class story {
public:
  explicit story(playground& f) : fixture_(f) {}

  /// Plays it to its end, or to the first line that fails: says which line and why, or nothing.
  std::string play(std::istream& in) {
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      line.erase((std::min)(line.find('#'), line.size()));
      try {
        tell(line);
      } catch (std::string const& why) {
        return "line " + std::to_string(number) + ": " + line + ": " + why;
      }
    }
    return "";
  }
  [[nodiscard]] std::uint64_t digest(int n) const { return cast_.at(n).mind.digest(cast_.at(n).now(now_)); }

private:
  struct actor {
    robot mind;
    int best;               // attacks best, it believes
    bool blind = false;     // it sees nothing valid
    bool dissents = false;  // it would do otherwise than its leader says
    bool alive = true;
    rota::duration clock{};  // so much its clock is ahead
    bool found = false;      // it has found a loop
    rota::duration set_back{};
    std::vector<message> said{};
    std::map<int, std::size_t> heard{};  // so many of each other's messages are heard or lost
    [[nodiscard]] rota::instant now(rota::instant real) const { return real + clock; }
  };

  void tell(std::string line) {
    auto const colon = line.find(": ");
    read(line.substr(0, colon));
    bool const at = is("at # ms"), until = is("until # ms");
    if (!at && !until) return happen(line);
    auto const then = start + rota::milliseconds(n_[0]);
    if (then < now_) throw std::string("time goes forward");
    line.erase(0, colon + 2);
    if (until) {
      read(line);
      need(is("all think, speak and hear"), "all think, speak and hear");
      need((then - start).ns % 10'000'000 == 0, "it goes on in steps of 10 ms");
      return go_on(then);
    }
    now_ = then;
    std::istringstream sentences(line);
    for (std::string one; std::getline(sentences, one, ';');) happen(one);
  }

  /// A form of a sentence, in which # is a number and * a word, and what it does.
  struct form {
    char const* words;
    void (*means)(story&);
  };
  static std::vector<form> const& forms() {
    static std::vector<form> const all{
        {"cycles #", [](story& s) { s.early().cycles = static_cast<std::uint32_t>(s.n_[0]); }},
        {"reign # ms", [](story& s) { s.early().reign = s.options_.max_reign = s.ms(0); }},
        {"renewals #", [](story& s) { s.early().renewals = static_cast<std::uint32_t>(s.n_[0]); }},
        {"silence # ms", [](story& s) { s.early().silence = s.ms(0); }},
        {"message period # ms", [](story& s) { s.early().message_period = s.ms(0); }},
        {"claim period # ms", [](story& s) { s.early().claim_period = s.ms(0); }},
        {"opening # ms, every # ms",
         [](story& s) { s.early().opening = s.ms(0), s.options_.opening_period = s.ms(1); }},
        {"max delay # ms", [](story& s) { s.early().max_delay = s.ms(0); }},
        {"forget # ms", [](story& s) { s.early().forget = s.ms(0); }},
        {"incarnation #", [](story& s) { s.early(), s.life_ = s.n_[0]; }},
        {"robots #", [](story& s) { s.early(), s.begin_all(s.n_[0]); }},
        {"everybody forwards what is news", [](story& s) { s.forward_ = true; }},
        {"# and # are out of range", [](story& s) { s.apart(true); }},
        {"# and # are in range", [](story& s) { s.apart(false); }},

        {"that is all", [](story&) {}},
        {"everybody enters", [](story& s) { s.each([&](actor& a) { s.enter(a, s.fixture_.play); }); }},
        {"# enters", [](story& s) { s.enter(s.who(0), s.fixture_.play); }},
        {"# enters the defence", [](story& s) { s.enter(s.who(0), s.defence_); }},
        {"# leaves", [](story& s) { need(s.who(0).mind.leave(play_id), "it takes no part"); }},
        {"# leaves the defence", [](story& s) { need(s.who(0).mind.leave(defence_id), "it takes no part"); }},
        {"everybody believes that # attacks best", [](story& s) { s.each([&](actor& a) { a.best = s.n_[0]; }); }},
        {"# believes that # attacks best", [](story& s) { s.who(0).best = s.n_[1]; }},
        {"# sees nothing valid", [](story& s) { s.who(0).blind = true; }},
        {"# sees again", [](story& s) { s.who(0).blind = false; }},
        {"# has confidence #", [](story& s) { s.who(0).mind.set_confidence(static_cast<std::uint32_t>(s.n_[1])); }},
        {"# dies", [](story& s) { s.who(0).alive = false; }},
        {"# restarts with incarnation #", [](story& s) { s.begin(s.n_[0], s.n_[1], s.who(0).now(s.now_)); }},
        {"the clock of # goes back # ms", [](story& s) { s.who(0).clock -= s.ms(1); }},
        {"# deliberates", [](story& s) { s.think(s.living(0)); }},
        {"# speaks", [](story& s) { s.speak(s.living(0)); }},
        {"# thinks and speaks", [](story& s) { s.think(s.living(0)), s.speak(s.living(0)); }},
        {"# hears #", [](story& s) { s.hear_what_is_new(); }},
        {"# never hears #", [](story& s) { s.unheard() = s.who(1).said.size(); }},
        {"# hears message # of #",
         [](story& s) { s.living(0), s.who(2), s.hear(s.n_[0], s.n_[2], static_cast<std::size_t>(s.n_[1])); }},

        {"expect # leads", [](story& s) { s.state(s.who(0), "leads"); }},
        {"expect # leads until # ms", [](story& s) { s.state(s.who(0), "leads", 1); }},
        {"expect # obeys #", [](story& s) { s.state(s.who(0), "obeys " + std::to_string(s.n_[1])); }},
        {"expect # obeys # until # ms", [](story& s) { s.state(s.who(0), "obeys " + std::to_string(s.n_[1]), 2); }},
        {"expect # is free", [](story& s) { s.state(s.who(0), "is free"); }},
        {"expect everybody is free", [](story& s) { s.each([&](actor& a) { s.state(a, "is free"); }); }},
        {"expect everybody agrees", [](story& s) { need(s.agree(), "they do not"); }},
        {"expect they disagree", [](story& s) { need(!s.agree(), "they agree"); }},
        {"expect # knows #", [](story& s) { need(s.knows(), "it does not"); }},
        {"expect # does not know #", [](story& s) { need(!s.knows(), "it does"); }},
        {"expect # has found a loop", [](story& s) { need(s.who(0).found, "it has not"); }},
        {"expect # has found no loop", [](story& s) { need(!s.who(0).found, "it has"); }},
        {"expect nobody has found a loop",
         [](story& s) { s.each([](actor& a) { need(!a.found, name(a) + " has"); }); }},
        {"expect the clock of # was set back # ms", [](story& s) { need(s.who(0).set_back == s.ms(1), "it was not"); }},
        {"expect that was *", [](story& s) { need(s.last_ == s.word_, "it was " + s.last_); }},
        {"expect # dissents", [](story& s) { need(s.who(0).dissents, "it does not"); }},
        {"expect # does not dissent", [](story& s) { need(!s.who(0).dissents, "it does"); }},
        {"expect # thinks that # *", [](story& s) { s.task(s.who(0), s.who(1)); }},
        {"expect # *", [](story& s) { s.task(s.who(0), s.who(0)); }},
    };
    return all;
  }
  void happen(std::string const& sentence) {
    read(sentence);
    if (words_.empty()) return;
    for (auto const& f : forms())
      if (is(f.words)) return f.means(*this);
    throw std::string("no such sentence");
  }

  template <class F>
  void each(F f) {
    need(!cast_.empty(), "there are no robots yet");
    for (auto& [n, a] : cast_)
      if (a.alive) f(a);
  }
  void enter(actor& a, rota::plan_type<soccer, view> const& type) {
    need(a.mind.enter(type, a.now(now_)), "it takes part already");
  }
  /// The options, while there are no robots that would not hear of a change.
  rota::robot_options& early() {
    need(cast_.empty(), "the robots have their options already");
    return options_;
  }
  void apart(bool are) {
    who(0), who(1);
    apart_[{n_[0], n_[1]}] = apart_[{n_[1], n_[0]}] = are;
  }
  void begin_all(int robots) {
    count_ = robots;
    for (int n = 1; n <= robots; ++n) begin(n, life_, start + rota::milliseconds(10 * n));
  }
  void begin(int n, int incarnation, rota::instant first_message) {
    auto o = options_;
    o.first_message = first_message;
    robot const fresh(agent(n), squad(count_), rota::incarnation{static_cast<std::uint64_t>(incarnation)}, o);
    auto const [where, is_new] = cast_.try_emplace(n, actor{fresh, n});
    where->second.mind = fresh;
    where->second.alive = true;
  }
  void think(actor& a) {
    auto v = sees(a.best);
    if (a.blind) v.attack.fill(-100);
    for (auto const* type : {&fixture_.play, &defence_}) {
      if (!a.mind.executes(type->id())) continue;
      auto const d = a.mind.deliberate(*type, fixture_.members, v, a.now(now_), space_);
      a.found |= d.detected.has_value();
      a.dissents = d.dissents;
      a.set_back = (std::max)(a.set_back, d.clock_set_back);
    }
  }
  void speak(actor& a) {
    while (auto m = a.mind.next_message(a.now(now_))) a.said.push_back(*std::move(m));
  }
  /// How many messages the first robot named has heard of the second, which has said more.
  std::size_t& unheard() {
    auto& done = living(0).heard[n_[1]];
    need(done < who(1).said.size(), "there is nothing that it has not heard");
    return done;
  }
  void hear_what_is_new() {
    unheard();
    need(!apart_[{n_[0], n_[1]}], "it is out of range");
    hear(n_[0], n_[1]);
  }
  void hear(int to, int from) {
    auto& done = cast_.at(to).heard[from];
    while (done < cast_.at(from).said.size()) hear(to, from, done + 1);
  }
  void hear(int to, int from, std::size_t number) {
    auto const& said = cast_.at(from).said;
    need(number >= 1 && number <= said.size(), "no such message was said");
    auto& done = cast_.at(to).heard[from];
    if (done + 1 == number) ++done;
    take_in(to, message(said[number - 1]));
  }
  void take_in(int to, message const& m) {
    auto& a = cast_.at(to);
    if (!a.alive) return;
    auto const r = a.mind.receive(m, a.now(now_));
    last_ = r.verdict == rota::verdict::stale ? "stale" : r.verdict == rota::verdict::refused ? "refused" : "accepted";
    if (r.claim) last_ = outcomes[static_cast<std::size_t>(*r.claim)];
    if (!r.relay || !forward_) return;
    for (auto& [n, other] : cast_)
      if (n != to && !apart_[{to, n}]) take_in(n, m);
  }
  /// Each thinks every 30 ms, and speaks when it has something to say, which all in range hear at once.
  void go_on(rota::instant until) {
    for (; now_ < until; now_ += rota::milliseconds(10)) {
      for (auto& [n, a] : cast_) {
        if (!a.alive) continue;
        if (((now_ - start).ns / 10'000'000 + n) % 3 == 0) think(a);
        speak(a);
        for (auto& [k, other] : cast_) {
          if (k == n) continue;
          if (apart_[{k, n}]) other.heard[n] = a.said.size();
          hear(k, n);
        }
      }
    }
  }

  [[nodiscard]] std::string state_of(actor const& a) const {
    auto const* const rule = a.mind.rule(play_id);
    if (!rule) return "takes no part";
    if (!rule->active() || a.now(now_) >= rule->expiry()) return "is free";
    auto const what = rule->leading() ? "leads" : "obeys " + std::to_string(static_cast<int>(rule->current().leader));
    return what + " until " + std::to_string((rule->expiry() - a.clock - start).ns / 1'000'000) + " ms";
  }
  void state(actor const& a, std::string wanted, std::size_t until = 0) {
    auto const seen = state_of(a);
    if (until != 0) wanted += " until " + std::to_string(n_[until]) + " ms";
    need(seen == wanted || seen.substr(0, seen.find(" until")) == wanted, name(a) + ' ' + seen);
  }
  bool agree() {
    rota::belief<soccer> const* first = nullptr;
    bool same = true;
    each([&](actor& a) {
      auto const* const believed = a.mind.believes(play_id);
      if (believed && first) same = same && believed->atoms() == first->atoms();
      if (believed) first = believed;
    });
    return same;
  }
  bool knows() { return who(0).mind.believes(play_id)->takes_part(who(1).mind.self()); }
  void task(actor const& a, actor const& about) {
    auto const* const believed = a.mind.believes(play_id);
    need(believed != nullptr, "it takes no part");
    auto const part = believed->part(about.mind.self());
    std::string const seen = !part ? "idles" : part->task == attack ? "attacks" : "defends";
    need(seen == word_, name(about) + ' ' + seen);
  }
  static std::string name(actor const& a) { return std::to_string(static_cast<int>(a.mind.self())); }

  void read(std::string const& sentence) {
    std::istringstream in(sentence);
    words_.clear();
    for (std::string w; in >> w;) words_.push_back(w);
  }
  /// Whether the sentence has this form. Fills `n_` and `word_`.
  bool is(char const* words) {
    n_.clear();
    std::istringstream in(words);
    std::size_t k = 0;
    for (std::string w; in >> w; ++k) {
      if (k == words_.size()) return false;
      bool const digits = words_[k].size() < 10 && words_[k].find_first_not_of("0123456789") == std::string::npos;
      if (w == "#" && digits) n_.push_back(std::stoi(words_[k]));
      if (w == "*") word_ = words_[k];
      if (w == "#" ? !digits : w != "*" && w != words_[k]) return false;
    }
    return k == words_.size();
  }
  static void need(bool holds, std::string const& why) {
    if (!holds) throw std::string(why);
  }
  actor& who(std::size_t k) {
    auto const where = cast_.find(n_[k]);
    need(where != cast_.end(), "there is no such robot");
    return where->second;
  }
  actor& living(std::size_t k) {
    need(who(k).alive, "it is dead");
    return who(k);
  }
  rota::duration ms(std::size_t k) const { return rota::milliseconds(n_[k]); }

  static constexpr std::array outcomes{"obeyed", "obeyed", "repeated", "over", "outranked", "answered"};

  playground& fixture_;
  rota::plan_type<soccer, view> defence_ = make_play(defence_id);
  rota::workspace space_;
  rota::robot_options options_;
  int life_ = 1;
  int count_ = 0;
  std::map<int, actor> cast_;
  std::map<std::pair<int, int>, bool> apart_;
  bool forward_ = false;
  rota::instant now_ = start;
  std::vector<std::string> words_;
  std::vector<int> n_;
  std::string word_;
  std::string last_;  // what the last message heard was
};

}  // namespace stories
