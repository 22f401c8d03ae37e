#include "sim/plays.hpp"

#include <rota/sim/closed/play.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <vector>

/// The other ways of deciding do what their papers say.
namespace rota::test {
namespace closed_others_test {

using namespace sim;
using namespace sim::closed;

/// Robots that stand still and see what the test says. What one says arrives at once, unless the test loses it.
template <coordinator C>
class hall {
public:
  hall(playbook const& book, std::size_t robots, perceived const& world) : book_(book), members_(team_of(robots)) {
    for (std::size_t i = 0; i < robots; ++i) sees.push_back(world), off.push_back(false);
    for (std::size_t i = 0; i < robots; ++i) {
      post p;
      p.self = i;
      p.robots = robots;
      p.book = &book_;
      p.members = &members_;
      p.first_message = instant{} + milliseconds(7 * static_cast<std::int64_t>(i));
      minds.emplace_back(p, instant{});
    }
  }
  /// In steps of 5 ms; each robot looks every 30 ms, at another time than the others.
  void run(duration d, std::function<void()> const& after = [] {}) {
    for (instant const end = now + d; now < end; now += milliseconds(5))
      for (std::size_t i = 0; i < minds.size(); ++i) {
        if (off[i]) continue;
        if ((now.ns / milliseconds(5).ns + static_cast<std::int64_t>(i)) % 6 == 0) minds[i].tick(sees[i], now);
        while (minds[i].next_due() <= now) {
          auto const m = minds[i].next_message(now);
          if (!m) break;
          ++said;
          for (std::size_t k = 0; k < minds.size(); ++k)
            if (k != i && !off[k] && !lost(i, k)) minds[k].receive(*m, now);
        }
        after();
      }
  }
  [[nodiscard]] std::optional<std::uint64_t> attacker(std::size_t mind) const {
    for (auto const& x : minds[mind].believed())
      if (book_.attacks(x)) return x.agent.value;
    return std::nullopt;
  }
  void expect_all_attack_with(std::uint64_t who) const {
    for (std::size_t i = 0; i < minds.size(); ++i)
      if (!off[i]) {
        EXPECT_EQ(attacker(i), who) << "robot " << i + 1 << " thinks";
      }
  }

  std::vector<C> minds;
  std::vector<perceived> sees;
  std::vector<bool> off;
  std::function<bool(std::size_t, std::size_t)> lost = [](std::size_t, std::size_t) { return false; };
  instant now{};
  std::size_t said = 0;

private:
  playbook const& book_;
  team<names> members_;
};

perceived formation(std::size_t robots, point ball) {
  perceived p;
  for (std::size_t i = 0; i < robots; ++i) p.robots.push_back(formation_spot(i));
  p.ball = ball;
  return p;
}
point beside(std::size_t robot) { return formation_spot(robot) + point{metres(0.5), 0}; }

TEST(closed_central, the_greatest_decides_by_its_own_eyes_and_after_its_silence_the_next) {
  auto const book = soccer();
  hall<central_coordinator<eyes::own>> h(book, 5, formation(5, beside(0)));
  h.sees[4].ball = beside(2);
  h.run(seconds(1));
  h.expect_all_attack_with(3);
  h.off[4] = true;
  h.run(milliseconds(800));
  h.expect_all_attack_with(3);
  h.run(milliseconds(400));
  h.expect_all_attack_with(1);
  h.off[4] = false;
  h.run(seconds(1));
  h.expect_all_attack_with(3);
}

TEST(closed_central, who_sees_with_the_eyes_of_all_is_not_misled_by_its_own) {
  auto const book = soccer();
  hall<central_coordinator<eyes::pooled>> h(book, 5, formation(5, beside(0)));
  h.sees[4].ball = beside(2);
  h.run(seconds(1));
  h.expect_all_attack_with(1);
  for (std::size_t i : {0u, 1u, 4u}) h.sees[i].ball = beside(3);
  h.run(milliseconds(100));
  h.expect_all_attack_with(4);
}

TEST(closed_central, orders_that_are_lost_are_repeated) {
  auto const book = soccer();
  hall<central_coordinator<eyes::own>> h(book, 5, formation(5, beside(0)));
  auto engine = engine_for(1, stream::network, 0);
  h.lost = [&](std::size_t, std::size_t) { return chance(engine, 0.5); };
  h.run(seconds(1));
  for (auto& s : h.sees) s.ball = beside(3);
  h.run(seconds(1));
  h.expect_all_attack_with(4);
}

/// At every moment, under loss: whoever acts on a change, everybody that is on has confirmed it.
TEST(closed_commit, nobody_acts_on_a_change_before_all_have_confirmed_it) {
  auto const book = soccer();
  hall<commit_coordinator> h(book, 5, formation(5, beside(0)));
  h.run(seconds(1));
  auto engine = engine_for(1, stream::network, 0);
  h.lost = [&](std::size_t, std::size_t) { return chance(engine, 0.3); };
  std::size_t changes = 0;
  for (std::size_t ball = 1; ball < 5; ++ball) {
    for (auto& s : h.sees) s.ball = beside(ball);
    auto const before = h.minds[4].acts_on();
    h.run(milliseconds(600), [&] {
      for (auto const& m : h.minds)
        for (std::size_t k = 0; k < 4; ++k) ASSERT_GE(h.minds[k].confirmed(), m.acts_on());
    });
    h.expect_all_attack_with(ball + 1);
    changes += h.minds[4].acts_on() > before;
  }
  EXPECT_EQ(changes, 4u);
}

TEST(closed_commit, who_cannot_be_heard_holds_up_all_until_it_counts_as_off) {
  auto const book = soccer();
  hall<commit_coordinator> h(book, 5, formation(5, beside(0)));
  h.run(seconds(1));
  h.expect_all_attack_with(1);
  h.lost = [](std::size_t from, std::size_t) { return from == 1; };
  for (auto& s : h.sees) s.ball = beside(3);
  h.run(milliseconds(800));
  h.expect_all_attack_with(1);
  h.run(milliseconds(400));
  EXPECT_EQ(h.attacker(0), 4u);
  EXPECT_EQ(h.attacker(4), 4u);
}

TEST(closed_argue, grounds_that_others_support_win_and_then_all_act_on_them) {
  auto const book = soccer();
  hall<argue_coordinator> h(book, 5, formation(5, beside(0)));
  // Deluded; and nearer to its ball than anybody to the true one, so that only the support of the others tells.
  h.sees[4].ball = h.sees[4].robots[4] + point{metres(0.2), 0};
  h.run(seconds(1));
  h.expect_all_attack_with(1);
  auto const before = h.minds[0].agreed_on();
  h.run(seconds(5));
  h.expect_all_attack_with(1);
  auto const rounds = h.minds[0].agreed_on().number - before.number;
  EXPECT_GE(rounds, 3u) << "it argues again after a second";
  EXPECT_LE(rounds, 6u) << "… and not sooner";
  h.sees[4].ball = beside(0);
  h.run(seconds(1));
  auto const said = h.said;
  auto const then = h.minds[0].agreed_on();
  h.run(seconds(1));
  EXPECT_EQ(h.minds[0].agreed_on(), then) << "nobody argues about what all see";
  EXPECT_LE(h.said - said, 55u);
}

TEST(closed_argue, between_equals_who_is_nearer_to_the_ball_is_believed) {
  auto const book = soccer();
  hall<argue_coordinator> h(book, 2, formation(2, beside(0)));
  h.sees[1].ball = beside(1) + point{metres(2), 0};  // 2.5 m away from itself
  h.run(seconds(2));
  h.expect_all_attack_with(1);
}

/// A game for the auction: the pay that a robot sees for a task; needed slots pay a bonus.
micrometres pay_for(perceived const& seen, std::size_t robot, std::size_t task, bool needed) {
  point const where = task == 0 ? seen.ball : home_of(task - 1);
  micrometres const worth = (std::max<micrometres>)(field_diagonal - distance(seen.robots[robot], where), 0);
  return (task == 0 ? worth : worth / 16) + (needed ? field_diagonal / 16 : 0);
}
struct place {
  std::size_t task;
  bool needed;
};
constexpr place places[] = {{0, true}, {1, true}, {1, false}, {2, false}, {2, false}};

playbook soccer_without_hysteresis() {
  plan_sketch s = soccer().plans.front();
  s.hysteresis = 0;
  return *make_playbook({1}, {s});
}
perceived random_world(std::uint64_t seed, std::size_t robots) {
  auto engine = engine_for(seed, stream::world, 7);
  perceived p;
  auto const somewhere = [&] {
    auto const x = uniform(engine, -metres(8), metres(8));
    return point{x, uniform(engine, -metres(5), metres(5))};
  };
  for (std::size_t i = 0; i < robots; ++i) p.robots.push_back(somewhere());
  p.ball = somewhere();
  return p;
}

/// Theorem 1 and 2 of the paper, with and without loss: all agree on what the sequential greedy algorithm gives, which is
/// worth at least half of the optimum.
TEST(closed_auction, converges_to_the_greedy_assignment) {
  auto const book = soccer_without_hysteresis();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    auto const world = random_world(seed, 5);
    hall<auction_coordinator> h(book, 5, world);
    auto engine = engine_for(seed, stream::network, 0);
    if (seed % 2 == 1) h.lost = [&](std::size_t, std::size_t) { return chance(engine, 0.3); };
    h.run(seconds(seed % 2 == 1 ? 3 : 1));

    std::vector<std::size_t> winner(5, 9), busy;
    micrometres greedy = 0;
    for (int round = 0; round < 5; ++round) {
      micrometres most = -1;
      std::size_t who = 0, where = 0;
      for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t j = 0; j < 5; ++j) {
          if (winner[j] != 9 || std::count(busy.begin(), busy.end(), i) > 0) continue;
          auto const pay = pay_for(world, i, places[j].task, places[j].needed);
          if (pay > most) most = pay, who = i, where = j;
        }
      winner[where] = who;
      busy.push_back(who);
      greedy += most;
    }
    allocation_atoms<names> expected;
    for (std::size_t j = 0; j < 5; ++j)
      expected.insert({{winner[j] + 1}, {1}, {static_cast<std::uint64_t>(places[j].task) + 1}});
    for (auto const& m : h.minds) EXPECT_EQ(m.believed(), expected) << "seed " << seed;

    std::vector<std::size_t> all(5);
    std::iota(all.begin(), all.end(), std::size_t{0});
    micrometres best = 0;
    do {
      micrometres sum = 0;
      for (std::size_t j = 0; j < 5; ++j) sum += pay_for(world, all[j], places[j].task, places[j].needed);
      best = (std::max)(best, sum);
    } while (std::next_permutation(all.begin(), all.end()));
    EXPECT_GE(2 * greedy, best);
  }
}

TEST(closed_auction, needed_slots_are_filled_first_and_the_slots_of_the_silent_are_open_again) {
  auto const book = soccer();
  hall<auction_coordinator> h(book, 2, formation(2, beside(0)));
  h.run(seconds(1));
  EXPECT_EQ(h.minds[0].believed(), (allocation_atoms<names>{{{1}, {1}, {1}}, {{2}, {1}, {2}}}));
  h.off[0] = true;
  h.run(milliseconds(1200));
  EXPECT_EQ(h.attacker(1), 2u);
  h.off[0] = false;
  h.run(seconds(1));
  h.expect_all_attack_with(1);
}

TEST(closed_auction, whoever_bids_in_error_wins) {
  auto const book = soccer();
  hall<auction_coordinator> h(book, 5, formation(5, beside(0) + point{metres(1), 0}));
  h.sees[4].ball = beside(4);
  h.run(seconds(1));
  h.expect_all_attack_with(5);
}

/// One kick each, in the whole: nobody is slower than two deliberations and the way of a message or three.
TEST(closed_others, react_within_a_few_deliberations) {
  auto const book = soccer();
  for (way const w : {way::central, way::majority, way::steam, way::consa, way::cbba}) {
    game_options o;
    o.length = seconds(30);
    o.network.loss = 0;
    auto const f = play_game(book, w, o);
    EXPECT_GT(f.reactions.count() + f.missed, 2u) << to_string(w);
    EXPECT_LT(f.reactions.percentile_ms(50), 80) << to_string(w);
    EXPECT_LT(f.incoherent(), 0.02) << to_string(w);
    EXPECT_GT(f.won, 4u) << to_string(w);
  }
}

}  // namespace closed_others_test
}  // namespace rota::test
