#include "sim/plays.hpp"

#include <rota/sim/closed/play.hpp>
#include <rota/sim/restless_world.hpp>

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace rota::test {
namespace closed_world_test {

using namespace sim;
using namespace sim::closed;

world_numbers no_opponents() {
  world_numbers n;
  n.taken_per_minute = 0;
  return n;
}

TEST(closed_world, who_goes_for_the_ball_gets_there_keeps_it_and_kicks_it) {
  closed_world w(trouble::none, 2, 1, no_opponents());
  point const from = w.state().robots[0].position;
  point const ball = w.state().ball;
  double const drive = to_metres(distance(from, ball) - metres(0.3)) / 3.0;
  w.send(0, ball, true);
  w.advance(instant{} + milliseconds(static_cast<std::int64_t>(drive * 1000) - 20));
  EXPECT_EQ(w.won(), 0u);
  w.advance(instant{} + milliseconds(static_cast<std::int64_t>(drive * 1000) + 30));
  EXPECT_EQ(w.won(), 1u);
  EXPECT_NEAR(to_seconds(w.free()), drive, 0.03);
  w.advance(w.now() + milliseconds(900));
  EXPECT_EQ(w.kicks(), 1u) << "it has the ball for a second at least";
  w.advance(w.now() + milliseconds(2200));
  EXPECT_EQ(w.kicks(), 2u) << "… and for three at most";
  EXPECT_NE(w.state().ball, ball);
}

TEST(closed_world, who_does_not_attack_takes_no_ball_and_two_attackers_hinder_each_other) {
  closed_world w(trouble::none, 2, 1, no_opponents());
  point const ball = w.state().ball;
  w.send(0, ball, false);
  w.advance(instant{} + seconds(10));
  EXPECT_EQ(w.won(), 0u);
  EXPECT_EQ(w.state().robots[0].position, ball) << "it stands there, and defends";
  w.send(0, ball + point{metres(0.9), 0}, false);
  w.send(1, ball - point{metres(0.9), 0}, false);
  w.advance(instant{} + seconds(20));
  w.send(0, ball, true);
  w.send(1, ball, true);
  w.advance(instant{} + seconds(40));
  EXPECT_EQ(w.won(), 0u);
  for (robot_state const& r : w.state().robots)
    EXPECT_GE(distance(r.position, ball), metres(0.47)) << "one step of 3 cm";
  w.stop(1);
  w.advance(instant{} + seconds(41));
  EXPECT_EQ(w.won(), 1u);
}

TEST(closed_world, opponents_kick_as_often_as_they_should) {
  closed_world w(trouble::none, 2, 1);
  w.advance(instant{} + seconds(3600));
  EXPECT_NEAR(static_cast<double>(w.kicks()), 360, 60);
  EXPECT_EQ(to_seconds(w.free()), 3600);
}

/// In 450 s each of five robots is deluded in each of three ways.
TEST(closed_world, delusions_go_round) {
  closed_world w(trouble::delusion, 5, 1);
  w.advance(instant{} + seconds(30) - milliseconds(10));
  for (robot_state const& r : w.state().robots) EXPECT_TRUE(!r.phantom && r.pose_error == point{});
  std::vector<int> near_itself(5), elsewhere(5), lost(5);
  for (int round = 0; round < 15; ++round) {
    w.advance(instant{} + seconds(30 * (round + 1)) + milliseconds(20));
    std::size_t deluded = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      robot_state const& r = w.state().robots[i];
      bool const shifted = r.pose_error != point{};
      if (r.phantom || shifted) ++deluded;
      if (shifted) ++lost[i];
      if (r.phantom) ++(distance(*r.phantom, r.position) <= metres(2.1) ? near_itself : elsewhere)[i];
    }
    EXPECT_EQ(deluded, 1u);
  }
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(near_itself[i] + elsewhere[i], 2) << i;
  EXPECT_EQ(lost, std::vector<int>(5, 1));
}

allocation_atoms<names> attack_by(std::initializer_list<std::uint64_t> who) {
  allocation_atoms<names> all;
  for (auto const i : who) all.insert({{i}, {1}, {1}});
  return all;
}
instant at(std::int64_t ms) { return instant{} + milliseconds(ms); }

world_state three(double a, double b, double c) {
  world_state w;
  for (double const x : {a, b, c}) w.robots.push_back({{metres(x), 0}, {}, {}});
  return w;
}

/// Two seconds by hand: robot 1 attacks; the ball is kicked to robot 2, which notices after 40 ms, robot 1 after 100.
TEST(closed_tally, adds_up_what_happens) {
  tally t(3, at(0));
  auto const one = attack_by({1}), two = attack_by({2});
  t.note(0, &one, true);
  t.note(1, &one, false);
  t.note(2, &one, false);
  t.look(three(1, 8, 9), false, false);
  t.pass_to(at(1000));
  t.look(three(8, 1, 9), true, false);
  t.pass_to(at(1040));
  t.note(1, &two, true);
  t.note(2, &two, false);
  t.pass_to(at(1100));
  t.note(0, &two, false);
  t.pass_to(at(1500));
  t.note(1, &two, false);  // it says so, and does nothing
  t.pass_to(at(1600));
  t.note(1, &two, true);
  auto const f = t.finish(at(2000));
  EXPECT_EQ(f.measured, seconds(2));
  EXPECT_EQ(f.wrong, milliseconds(40));
  EXPECT_EQ(f.several, milliseconds(60));
  EXPECT_EQ(f.nobody, milliseconds(100));
  EXPECT_EQ(f.in_conflict, milliseconds(60));
  EXPECT_EQ(f.episodes.count(), 1u);
  EXPECT_EQ(f.episodes.longest_ms(), 60);
  EXPECT_EQ(f.reactions.count(), 1u);
  EXPECT_EQ(f.reaction_ms(), 40);
  EXPECT_EQ(f.missed, 0u);
}

TEST(closed_tally, a_change_that_nobody_answers_is_missed_and_who_is_off_counts_for_nothing) {
  tally t(3, at(0));
  auto const one = attack_by({1}), two = attack_by({2});
  for (std::size_t i = 0; i < 3; ++i) t.note(i, &one, i == 0);
  t.look(three(8, 1, 9), true, false);
  t.pass_to(at(100));
  t.look(three(1, 8, 9), true, false);  // kicked back before robot 2 has reacted
  t.pass_to(at(200));
  t.look(three(8, 1, 9), true, false);
  t.pass_to(at(300));
  t.note(1, nullptr, false);  // nobody is awaited who is off
  t.pass_to(at(400));
  t.note(2, &two, false);
  t.note(2, nullptr, false);
  auto const f = t.finish(at(500));
  EXPECT_EQ(f.missed, 1u);
  EXPECT_EQ(f.reactions.count(), 0u);
  EXPECT_EQ(f.in_conflict, duration{});
  EXPECT_EQ(f.nobody + f.several, duration{});
  EXPECT_EQ(f.wrong, milliseconds(200)) << "while robot 2 is on, and nearer";
}

TEST(closed_tally, reigns_of_300_ms_count_and_are_right_if_nobody_else_is_clearly_nearer) {
  tally t(3, at(0));
  auto const one = attack_by({1});
  for (std::size_t i = 0; i < 3; ++i) t.note(i, &one, i == 0);
  t.look(three(8, 1, 1.4), false, false);
  t.note_reign(0, true, 0);
  t.note_reign(1, true, 1);
  t.note_reign(2, true, std::nullopt);
  t.pass_to(at(299));
  t.note_reign(1, false, 1);
  t.pass_to(at(300));
  t.note_reign(1, true, 2);
  t.pass_to(at(400));
  t.note_reign(0, true, 1);  // it goes on, with another attacker
  auto const f = t.finish(at(700));
  EXPECT_EQ(f.reigns, 3u);
  EXPECT_EQ(f.right, 1u) << "the second of robot 2";
}

/// A coordinator for tests: everybody attacks, whatever it sees, and says nothing.
class reckless {
public:
  struct message {};
  reckless(post const& p, instant) : mine_{{p.agent(), {1}, {1}}} {}
  void tick(perceived const&, instant) {}
  void receive(message const&, instant) {}
  std::optional<message> next_message(instant) { return std::nullopt; }
  instant next_due() const { return never; }
  allocation_atoms<names> const& believed() const { return mine_; }
  static std::size_t bytes(message const&) { return 0; }

private:
  allocation_atoms<names> mine_;
};

TEST(closed_game, if_all_attack_nobody_gets_the_ball) {
  auto const book = soccer();
  game_options o;
  o.length = seconds(12);
  auto const f = game<reckless>(book, o).play();
  EXPECT_EQ(f.incoherent(), 1);
  EXPECT_EQ(f.share(f.in_conflict), 1);
  EXPECT_LE(f.won, 1u);  // one may be there first, and be alone for a moment
  EXPECT_EQ(f.messages, 0u);
}

TEST(closed_game, the_seed_alone_decides) {
  auto const book = soccer();
  auto const played = [&](way how, std::uint64_t seed) {
    game_options o;
    o.what = trouble::mixed;
    o.length = seconds(8);
    o.seed = seed;
    auto const f = play_game(book, how, o);
    return std::vector<std::uint64_t>{f.bytes, f.messages, f.won, static_cast<std::uint64_t>(f.in_conflict.ns)};
  };
  for (way const w : all_ways) {
    EXPECT_EQ(played(w, 1), played(w, 1)) << to_string(w);
    EXPECT_NE(played(w, 1), played(w, 2)) << to_string(w);
  }
}

TEST(closed_game, a_lasting_delusion_is_a_lasting_quarrel_unless_somebody_leads) {
  auto const book = soccer();
  game_options o;
  o.what = trouble::delusion;
  o.length = seconds(60);
  o.world.sane = {};
  auto const without = play_game(book, way::silent, o);
  EXPECT_GT(without.incoherent(), 0.2);
  EXPECT_LT(play_game(book, way::rota, o).incoherent(), without.incoherent() / 2);
}

/// What distinguishes each way from its neighbour, in some seconds of delusion; and loss reaches the radio in all of them.
TEST(closed_game, each_way_is_its_own_and_the_radio_loses_what_it_is_told_to) {
  auto const book = soccer();
  game_options o;
  o.what = trouble::delusion;
  o.world.sane = {};
  o.length = seconds(12);
  game_figures of[all_ways.size()], deaf[all_ways.size()];
  for (std::size_t i = 0; i < all_ways.size(); ++i) {
    o.network.loss = 0;
    of[i] = play_game(book, all_ways[i], o);
    o.network.loss = 0.8;
    deaf[i] = play_game(book, all_ways[i], o);
    EXPECT_GT(deaf[i].in_conflict, of[i].in_conflict) << to_string(all_ways[i]);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(of[i].bytes == of[k].bytes && of[i].in_conflict == of[k].in_conflict)
          << to_string(all_ways[i]) << " decides as " << to_string(all_ways[k]);
  }
  auto const& f = [&](way w) -> game_figures const& { return of[static_cast<std::size_t>(w)]; };
  EXPECT_EQ(f(way::silent).reigns, 0U);
  EXPECT_GT(f(way::alica).reigns, f(way::rota).reigns) << "each lasts two seconds, and the quarrel is back";
  EXPECT_GT(f(way::alica).incoherent(), 2 * f(way::rota).incoherent());
  EXPECT_GT(f(way::steam).reaction_ms(), f(way::majority).reaction_ms()) << "nobody acts before all have confirmed";
  EXPECT_GT(f(way::rota).messages, f(way::silent).messages) << "it says news at once";
  o.network.loss = 0;
  o.rules.news = false;
  EXPECT_LT(play_game(book, way::rota, o).messages, f(way::rota).messages);
}

/// A stamp policy is asked at each deliberation, and hears what all mates have seen.
TEST(closed_game, stamps_know_what_mates_have_said) {
  auto const book = soccer();
  game_options o;
  o.length = seconds(1);
  o.sensor = exact_sensor();
  std::size_t asked = 0, heard_all = 0, agreed = 0;
  o.rules.stamp = [&](knowledge const& k) -> std::uint32_t {
    ++asked;
    std::size_t heard = 0, agree = 0;
    for (auto const& t : k.told)
      if (t) ++heard, agree += distance(t->ball, k.seen.ball) < metres(0.01) ? 1 : 0;
    heard_all += heard == 4;
    agreed += agree == 4;
    return 0;
  };
  auto const with = play_game(book, way::rota, o);
  EXPECT_GT(asked, 400u);
  EXPECT_GT(heard_all, asked * 9 / 10);
  EXPECT_GT(agreed, asked / 2);
  o.rules.stamp = {};
  auto const without = play_game(book, way::rota, o);
  EXPECT_EQ(with.messages, without.messages);
  EXPECT_GE(with.bytes, without.bytes + 5 * without.messages);
}

/// Every 20 s one robot is off for 5 s: the others go on, and it takes part again.
TEST(closed_game, robots_break_down_and_come_back) {
  auto const book = soccer();
  game_options o;
  o.what = trouble::breakdowns;
  std::size_t fewest = 5, at_the_end = 0;
  game<robot_coordinator<conflict_monitor<names>>> g(book, o);
  g.run(instant{} + seconds(27), [&](auto const& now) {
    std::size_t on = 0;
    for (std::size_t i = 0; i < now.size(); ++i) on += now.mind(i) != nullptr;
    fewest = (std::min)(fewest, on);
    at_the_end = on;
  });
  EXPECT_EQ(fewest, 4u);
  EXPECT_EQ(at_the_end, 5u);
  for (std::size_t i = 0; i < g.size(); ++i) EXPECT_EQ(g.mind(i)->believed().size(), 5u) << "robot " << i + 1;
}

}  // namespace closed_world_test
}  // namespace rota::test
