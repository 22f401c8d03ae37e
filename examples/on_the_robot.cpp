// Two robots, each sure that it is closer to the ball, decide every 30 ms and speak every 100 ms. They disagree, the
// disagreement loops, the loop is found, and one of them rules for two seconds.
#include <rota/rota.hpp>

#include <array>
#include <cstdio>
#include <ctime>

struct soccer {
  enum class agent { left = 1, right };
  enum class plan_type { play };
  enum class plan { normal };
  enum class task { attack, defend };
  enum class state { get_ball, protect };
};
struct beliefs {
  soccer::agent closest;
};

int main() {
  using enum soccer::agent;
  using enum soccer::task;
  using rota::milliseconds;

  auto const plan = rota::plan<soccer, beliefs>::make(
      {.plan = soccer::plan::normal,
       .tasks = {{attack, {1, 1}, soccer::state::get_ball}, {defend, {0, 1}, soccer::state::protect}},
       .utility = rota::additive_utility<soccer, beliefs>([](soccer::agent a, soccer::task t, beliefs const& b) {
         return std::optional<double>(t == attack && a == b.closest ? 1.0 : 0.25);
       })});
  auto const play = *rota::plan_type<soccer, beliefs>::make(soccer::plan_type::play, {*plan});
  rota::team<soccer> const members{left, right};

  struct robot {
    rota::robot<soccer> self;
    beliefs sees;
    rota::workspace space;
    rota::instant next_tick;
  };
  std::array const roster{left, right};
  auto const life = rota::incarnation::started_at(std::time(nullptr));  // greater at every restart
  std::array<robot, 2> robots{
      robot{rota::robot<soccer>(left, roster, life), {left}, {}, {}},
      robot{rota::robot<soccer>(right, roster, life), {right}, {}, rota::instant{} + milliseconds(13)}};
  for (auto& r : robots) r.self.enter(play, rota::instant{});

  bool ruled = false;
  for (rota::instant now{}; now < rota::instant{} + rota::seconds(1); now = now + milliseconds(1)) {
    for (auto& me : robots) {
      auto& other = &me == &robots[0] ? robots[1] : robots[0];
      if (now >= me.next_tick) {
        me.next_tick = me.next_tick + milliseconds(30);
        auto const d = me.self.deliberate(play, members, me.sees, now, me.space);
        if (d.detected)
          std::printf("%3lld ms: robot %d sees the loop\n", static_cast<long long>(now.ns / 1'000'000),
                      int(me.self.self()));
      }
      while (auto m = me.self.next_message(now)) other.self.receive(*m, now);  // the radio
    }
    auto const* rule = robots[0].self.rule(play.id());
    if (!ruled && rule->obeying()) {
      std::printf("%3lld ms: robot 1 obeys robot %d\n", static_cast<long long>(now.ns / 1'000'000),
                  int(rule->current().leader));
      ruled = true;
    }
  }
  auto const agree = robots[0].self.believes(play.id())->atoms() == robots[1].self.believes(play.id())->atoms();
  std::printf("they %s\n", agree ? "agree" : "disagree");
  return ruled && agree ? 0 : 1;
}
