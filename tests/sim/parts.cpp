#include <gtest/gtest.h>

#include "plays.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <vector>

namespace parts_test {

namespace {

using namespace rota;
using namespace rota::sim;

TEST(random, streams_differ_by_seed_purpose_and_index_and_by_nothing_else) {
  EXPECT_EQ(engine_for(7, stream::network, 3)(), engine_for(7, stream::network, 3)());
  std::vector<std::uint64_t> firsts;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (auto const what : {stream::clock, stream::world, stream::perception, stream::network})
      for (std::uint64_t index = 0; index < 20; ++index) firsts.push_back(engine_for(seed, what, index)());
  std::sort(firsts.begin(), firsts.end());
  EXPECT_EQ(std::adjacent_find(firsts.begin(), firsts.end()), firsts.end());
}

TEST(random, noise_has_the_deviation_asked_for) {
  auto engine = engine_for(1, stream::world, 0);
  double sum = 0, squares = 0;
  constexpr int n = 100'000;
  for (int i = 0; i < n; ++i) {
    auto const x = static_cast<double>(noise(engine, 1000));
    EXPECT_LE(std::abs(x), 3500);
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / n, 0, 15);
  EXPECT_NEAR(std::sqrt(squares / n), 1000, 10);
}

TEST(clock, never_runs_backwards_and_inverts_exactly) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    auto engine = engine_for(i, stream::clock, 0);
    robot_clock const clock({}, milliseconds(100), engine);
    for (int k = 0; k < 200; ++k) {
      instant const t{uniform(engine, 0, seconds(3600).ns)};
      instant const shown = clock.local(t);
      EXPECT_GE(clock.local(t + nanoseconds(1)), shown);
      EXPECT_LE(clock.global(shown), t);
      EXPECT_GE(clock.local(clock.global(shown)), shown);
      EXPECT_LT(clock.local(clock.global(shown) - nanoseconds(1)), shown);
    }
  }
}

TEST(network, loses_repeats_and_delays_as_told) {
  network n({milliseconds(5), milliseconds(10), 0.2, 0.1}, 3, 1);
  std::map<std::size_t, int> copies;
  double total = 0;
  int arrived = 0;
  constexpr int sent = 50'000;
  for (int i = 0; i < sent; ++i) {
    auto const delays = n.send(0, 2);
    ++copies[delays.size()];
    for (duration const d : delays) {
      EXPECT_GE(d, milliseconds(5));
      EXPECT_LE(d, milliseconds(15));
      total += to_milliseconds(d);
      ++arrived;
    }
  }
  EXPECT_NEAR(copies[0], 0.2 * sent, 400);
  EXPECT_NEAR(copies[2], 0.8 * 0.1 * sent, 300);
  EXPECT_NEAR(total / arrived, 10, 0.1);
}

TEST(network, links_are_independent_and_loss_changes_no_delay) {
  network quiet({milliseconds(2), milliseconds(3), 0, 0}, 3, 1);
  network lossy({milliseconds(2), milliseconds(3), 0.5, 0}, 3, 1);
  network busy({milliseconds(2), milliseconds(3), 0, 0}, 3, 1);
  for (int i = 0; i < 1000; ++i) {
    auto const expected = quiet.send(0, 1);
    (void)busy.send(1, 0);
    EXPECT_EQ(busy.send(0, 1), expected);
    auto const got = lossy.send(0, 1);
    EXPECT_TRUE(got.empty() || got == expected);
  }
}

TEST(network, jitter_above_the_message_period_reorders) {
  network n({milliseconds(1), milliseconds(300), 0, 0}, 2, 1);
  int overtaken = 0;
  duration last{};
  for (int i = 0; i < 1000; ++i) {
    duration const arrival = milliseconds(100) * i + n.send(0, 1)[0];
    overtaken += arrival < last ? 1 : 0;
    last = arrival;
  }
  EXPECT_GT(overtaken, 100);
}

TEST(perception, small_distances_are_underestimated_large_ones_overestimated) {
  sensor_options const s;
  EXPECT_EQ(seen_distance(s, s.exact_distance), s.exact_distance);
  for (double d = 0.1; d < 3; d += 0.1) EXPECT_LT(seen_distance(s, metres(d)), metres(d));
  for (double d = 3.1; d < 20; d += 0.1) EXPECT_GT(seen_distance(s, metres(d)), metres(d));
  for (double d = 0; d < 20; d += 0.1) EXPECT_LT(seen_distance(s, metres(d)), seen_distance(s, metres(d + 0.1)));
}

TEST(perception, two_at_the_ball_each_see_it_closer_to_themselves) {
  sensor_options exact;
  exact.ball_noise = exact.ball_noise_permille = exact.mate_noise = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    scripted_world const world(scenario::ball_fight, 5, seed);
    std::vector<std::size_t> fighters;
    for (std::size_t i = 0; i < 5; ++i) {
      auto const d = distance(world.state().robots[i].position, world.state().ball);
      if (d < metres(1)) {
        fighters.push_back(i);
        EXPECT_GE(d, metres(0.499));
        EXPECT_LE(d, metres(0.701));
      }
    }
    ASSERT_EQ(fighters.size(), 2U);
    for (std::size_t const me : fighters) {
      std::size_t const other = fighters[0] + fighters[1] - me;
      perceived seen;
      sensor(exact, me, seed).look(world.state(), seen);
      EXPECT_LT(distance(seen.robots[me], seen.ball), distance(seen.robots[other], seen.ball)) << "seed " << seed;
    }
  }
}

TEST(world, everybody_stays_on_the_field_and_below_its_speed) {
  for (auto const s : all_scenarios) {
    scripted_world world(s, 11, 3);
    auto before = world.state();
    for (int tick = 1; tick < 5'000; ++tick) {
      world.advance(instant{} + milliseconds(10) * tick);
      auto const& now = world.state();
      EXPECT_LE(std::abs(now.ball.x), field_length / 2);
      EXPECT_LE(std::abs(now.ball.y), field_width / 2);
      for (std::size_t i = 0; i < 11 && s == scenario::hour; ++i)
        EXPECT_LE(distance(now.robots[i].position, before.robots[i].position), metres(0.0301));
      before = now;
    }
  }
}

TEST(world, incidents_come_as_often_and_last_as_long_as_stated) {
  world_options o;
  o.phantoms_per_hour = 120;
  scripted_world world(scenario::hour, 5, 1, o);
  int phantoms = 0, seen = 0, ticks = 0;
  bool before = false;
  for (; ticks < 2 * 360'000; ++ticks) {
    world.advance(instant{} + o.tick * ticks);
    auto const& robots = world.state().robots;
    bool const now = std::any_of(robots.begin(), robots.end(), [](auto const& r) { return r.phantom.has_value(); });
    phantoms += now && !before ? 1 : 0;
    seen += now ? 1 : 0;
    before = now;
  }
  // They do not overlap: one comes 30 s after the last has gone, and stays 8 s, on average.
  EXPECT_NEAR(phantoms, 2 * 3600 / (30 + 8), 45);
  EXPECT_NEAR(to_seconds(o.tick * seen) / phantoms, to_seconds(o.phantom_length), 2.4);
}

TEST(playbook, finds_the_attack_task_and_refuses_plans_that_are_none) {
  plan_sketch s;
  s.id = {1};
  s.name = "P";
  s.tasks = {{{1}, "Guard", {0, 2}, {}}, {{2}, "Push", {1, 1}, {}}, {{3}, "AttackLeft", {0, 1}, {}}};
  EXPECT_EQ(attack_task(s), names::task{3});
  s.tasks.pop_back();
  EXPECT_EQ(attack_task(s), names::task{2});
  s.tasks.pop_back();
  EXPECT_EQ(attack_task(s), names::task{1});
  s.tasks.push_back(s.tasks.front());
  EXPECT_FALSE(make_playbook({1}, {s}));
  s.tasks.clear();
  EXPECT_FALSE(make_playbook({1}, {s}));
  EXPECT_FALSE(make_playbook({1}, {}));
}

TEST(happenings, each_has_words_of_its_own) {
  std::set<std::string_view> words;
  auto const count = static_cast<std::size_t>(happening::reign_ended) + 1;
  for (std::size_t i = 0; i < count; ++i) words.insert(to_string(static_cast<happening>(i)));
  EXPECT_EQ(words.size(), count);
}

TEST(statistics, percentiles_are_nearest_ranks) {
  length_statistics s;
  EXPECT_EQ(s.percentile_ms(50), 0);
  for (int i = 1; i <= 200; ++i) s.add(milliseconds(i));
  EXPECT_EQ(s.count(), 200U);
  EXPECT_EQ(s.percentile_ms(50), 100);
  EXPECT_EQ(s.percentile_ms(99), 198);
  EXPECT_EQ(s.longest_ms(), 200);
}

}  // namespace

}  // namespace parts_test
