// Two robots, each sure that it is closer to the ball, decide every 30 ms and speak every 100 ms. They disagree, the
// disagreement loops, the loop is found, and one of them rules for two seconds.
#include <rota/rota.hpp>
#include <rota/team/print.hpp>

#include <cstdio>
#include <ctime>

struct soccer {
  enum class agent { left = 1, right };
  enum class plan_type { play };
  enum class plan { normal };
  enum class task { attack, defend };
  enum class state { get_ball, protect };
  friend char const* to_string(agent a) { return a == agent::left ? "left" : "right"; }
  friend char const* to_string(task t) { return t == task::attack ? "attack" : "defend"; }
};
struct beliefs {
  soccer::agent closest;
};
using game = rota::domain<soccer, beliefs>;

int main() {
  using enum soccer::agent;
  using enum soccer::task;
  auto const plan =
      game::plan::make({.plan = soccer::plan::normal,
                        .tasks = {{attack, {1, 1}, soccer::state::get_ball}, {defend, {0, 1}, soccer::state::protect}},
                        .utility = [](soccer::agent a, soccer::task t, beliefs const& b) {
                          return t == attack && a == b.closest ? 1.0 : 0.25;
                        }});
  auto const play = *game::plan_type::make(soccer::plan_type::play, {*plan});
  game::team const members{left, right};
  auto const life = rota::incarnation::started_at(std::time(nullptr));  // greater at every restart

  struct player {
    game::robot robot;
    beliefs sees;
    rota::instant next_tick{};
    rota::workspace space{};
  };
  player players[]{{{left, members.agents(), life}, {left}}, {{right, members.agents(), life}, {right}}};
  for (auto& me : players) me.robot.enter(play, rota::instant{});
  players[1].next_tick = rota::instant{} + rota::milliseconds(13);

  bool ruled = false;
  for (rota::instant now{}; now < rota::instant{} + rota::seconds(1); now += rota::milliseconds(1)) {
    for (auto& me : players) {
      auto& other = &me == players ? players[1] : players[0];
      if (now >= me.next_tick) {
        me.next_tick += rota::milliseconds(30);
        auto const d = me.robot.deliberate(play, members, me.sees, now, me.space);
        if (d.detected || (d.reason == rota::decision_reason::obeyed && !ruled))
          std::printf("%s, %s: %s\n", to_string(now).c_str(), to_string(me.robot.self()), describe(d).c_str());
        ruled = ruled || d.reason == rota::decision_reason::obeyed;
      }
      while (auto m = me.robot.next_message(now)) other.robot.receive(*m, now);  // the radio
    }
  }
  auto const agree = players[0].robot.believes(play.id())->atoms() == players[1].robot.believes(play.id())->atoms();
  std::printf("they %s\n", agree ? "agree" : "disagree");
  return ruled && agree ? 0 : 1;
}
