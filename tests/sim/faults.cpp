// Each fault does what it says, and nothing else.
#include <gtest/gtest.h>

#include <rota/sim/campaign.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace sim_faults_test {

namespace {

using namespace rota;
using namespace rota::sim;

constexpr instant at(int ms) { return instant{} + milliseconds(ms); }
constexpr spell always{};

/// A message that carries a number of everything.
message<names> letter(std::uint64_t sequence = 1) {
  plan_message<names> m{{1}, {{1000}, sequence}, 3, {}};
  m.types.push_back({{1}, placement<names>{{1}, {2}, {2}}, 2, std::nullopt});
  return m;
}

/// Five robots, exact eyes, a still ball, a radio that loses nothing.
struct sim_faults : testing::Test {
  playbook book = campaign_playbook();
  simulation_options options = [] {
    simulation_options o;
    o.network = {milliseconds(2), milliseconds(3), 0, 0};
    o.sensor = exact_sensor();
    return o;
  }();
  restless_options world{};

  using team = simulation<restless_world>;
  [[nodiscard]] team start(std::size_t robots = 5) const {
    return {book, restless_world(robots, options.seed, world), options};
  }
  /// Everything that happens until then.
  std::uint64_t play(int ms, std::function<void(team const&, log_record const&)> const& observe = {}) const {
    auto t = start();
    std::uint64_t digest = 0;
    t.run(at(ms), [&](log_record const& r) {
      for (auto const x : {static_cast<std::uint64_t>(r.time.ns), static_cast<std::uint64_t>(r.what), r.robot, r.other,
                           r.believed.size(), r.change.size(), static_cast<std::uint64_t>(r.verdict)})
        digest = scatter(digest ^ x);
      if (observe) observe(t, r);
    });
    return digest;
  }
};

TEST_F(sim_faults, faults_that_never_come_change_nothing) {
  auto const without = play(3000);
  spell const later{at(4000), at(5000)};
  options.faults.bursts = burst_loss{later};
  options.faults.late = late_copies{later};
  options.faults.flips = flipped_bits{later};
  options.faults.partitions = {{later, 1}};
  options.faults.crashes = {{0, at(4000)}};
  options.faults.stuck = {{0, later}};
  options.faults.absences = {{0, later}};
  EXPECT_EQ(play(3000), without);
  options.faults.broken = {{{at(1000), at(2000)}, 0, 1}};
  EXPECT_NE(play(3000), without);
}

TEST_F(sim_faults, losses_come_in_bursts) {
  faults f;
  f.bursts = burst_loss{always, 0.05, 0.25, 1};
  interference air(f, 2, 1);
  int lost = 0, bursts = 0;
  bool before = false;
  for (int i = 0; i < 100'000; ++i) {
    network::delays d{milliseconds(1)};
    air.disturb(d, 0, 1, at(i));
    bursts += d.empty() && !before ? 1 : 0;
    before = d.empty();
    lost += before ? 1 : 0;
  }
  EXPECT_NEAR(lost / 1e5, 0.05 / 0.30, 0.01);
  EXPECT_NEAR(static_cast<double>(lost) / bursts, 1 / 0.25, 0.2);
}

TEST_F(sim_faults, copies_come_late_and_only_for_a_time) {
  faults f;
  f.late = late_copies{{at(100), at(200)}, 0.5, seconds(1), seconds(3)};
  interference air(f, 2, 1);
  int late = 0;
  for (int i = 0; i < 10'000; ++i) {
    network::delays d;
    air.disturb(d, 1, 0, at(100 + i % 100));
    if (d.empty()) continue;
    ++late;
    EXPECT_TRUE(d[0] >= seconds(1) && d[0] <= seconds(3));
    network::delays never_late{milliseconds(1)};
    air.disturb(never_late, 1, 0, at(200));
    EXPECT_EQ(never_late.size(), 1U);
  }
  EXPECT_NEAR(late, 5000, 250);
  EXPECT_EQ(f.healed(), at(3200));
}

TEST_F(sim_faults, partitions_cut_both_ways_and_broken_links_one) {
  faults f;
  f.partitions = {{{at(100), at(200)}, 0b0101}};
  f.broken = {{{at(300), at(400)}, 1, 2}};
  interference air(f, 4, 1);
  auto const passes = [&](std::size_t from, std::size_t to, int ms) {
    network::delays d{milliseconds(1)};
    air.disturb(d, from, to, at(ms));
    return !d.empty();
  };
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_TRUE(passes(i, j, 99));
      EXPECT_EQ(passes(i, j, 100), (i + j) % 2 == 0);
      EXPECT_EQ(passes(i, j, 199), (i + j) % 2 == 0);
      EXPECT_TRUE(passes(i, j, 200));
      EXPECT_EQ(passes(i, j, 300), !(i == 1 && j == 2));
    }
  EXPECT_EQ(f.healed(), at(400));
}

TEST_F(sim_faults, one_bit_of_one_number_flips) {
  faults f;
  f.flips = flipped_bits{always, 1};
  interference air(f, 2, 1);
  int same = 0;
  std::vector<int> where(7);
  for (int i = 0; i < 1000; ++i) {
    auto const original = letter();
    auto const broken = air.flipped(original, 0, 1, at(0));
    ASSERT_TRUE(broken);
    auto const& a = *std::get_if<plan_message<names>>(&original);
    auto const& b = *std::get_if<plan_message<names>>(&*broken);
    bool const differs[] = {a.sender != b.sender,
                            a.number.incarnation != b.number.incarnation,
                            a.number.sequence != b.number.sequence,
                            a.claims != b.claims,
                            a.types[0].type != b.types[0].type,
                            a.types[0].leads != b.types[0].leads,
                            a.types[0].place != b.types[0].place};
    EXPECT_EQ(std::count(std::begin(differs), std::end(differs), true), 1);
    for (std::size_t k = 0; k < 7; ++k) where[k] += differs[k];
    same += original == *broken;
  }
  EXPECT_EQ(same, 0);
  EXPECT_GT(*std::min_element(where.begin(), where.end()), 90);
}

/// Each number is drawn alike, and no flip leaves the message as it was.
TEST_F(sim_faults, any_number_of_a_claim_flips) {
  faults f;
  f.flips = flipped_bits{always, 1};
  interference air(f, 2, 1);
  claim<names> c{{1}, {}, {3, {5}}, {5}, {1000}, 7, 2, milliseconds(900), {milliseconds(1), milliseconds(2)}};
  c.atoms.insert({{4}, {1}, {1}});
  c.atoms.insert({{5}, {1}, {2}});
  std::vector<int> where(11);
  for (int i = 0; i < 2000; ++i) {
    auto const broken = air.flipped(c, 0, 1, at(0));
    ASSERT_TRUE(broken);
    auto const& b = *std::get_if<claim<names>>(&*broken);
    EXPECT_NE(b, c);
    bool const differs[] = {b.type != c.type,
                            b.leader != c.leader,
                            b.incarnation != c.incarnation,
                            b.number != c.number,
                            b.version != c.version,
                            b.remaining != c.remaining,
                            b.stamp.confidence != c.stamp.confidence,
                            b.stamp.id != c.stamp.id,
                            b.ages[0] != c.ages[0],
                            b.ages[1] != c.ages[1],
                            b.atoms != c.atoms};
    EXPECT_EQ(std::count(std::begin(differs), std::end(differs), true), 1);
    for (std::size_t k = 0; k < where.size(); ++k) where[k] += differs[k];
  }
  EXPECT_GT(*std::min_element(where.begin(), where.end()), 80);
  EXPECT_GT(where.back(), 600) << "three numbers for each of two atoms";
}

/// A crash that does not happen, because the robot is down already, brings nobody back.
TEST_F(sim_faults, a_robot_that_is_down_does_not_crash_and_comes_back_once) {
  for (bool const for_good : {true, false}) {
    options.faults.crashes = {{2, at(1000), for_good ? crash::for_good : seconds(3)}, {2, at(1500), milliseconds(500)}};
    play(5000, [&](team const& t, log_record const& r) {
      EXPECT_EQ(t.up(2), r.time < at(1000) || (!for_good && r.time >= at(4000))) << r.time.ns;
    });
  }
}

/// Unlike a clock's drift alone: a robot whose clock is 10 % fast deliberates 10 % more often.
TEST_F(sim_faults, clocks_drift_in_the_simulation) {
  options.faults.drifts = {{1, 100'000}};
  int ticks[2] = {};
  play(30'000, [&](team const&, log_record const& r) {
    if (r.what == happening::deliberated && r.robot < 2) ++ticks[r.robot];
  });
  EXPECT_NEAR(ticks[1] * 1.0 / ticks[0], 1.1, 0.01);
}

/// Some numbers can only be refused: the flips of a run arrive at its robots.
TEST_F(sim_faults, flipped_messages_arrive_and_are_refused) {
  int refused[2] = {};
  for (int flips : {0, 1}) {
    options.faults.flips = flips ? std::optional(flipped_bits{always, 0.5}) : std::nullopt;
    play(3000, [&](team const&, log_record const& r) {
      if (r.what == happening::heard_plan) refused[flips] += r.verdict == verdict::refused ? 1 : 0;
    });
  }
  EXPECT_EQ(refused[0], 0);
  EXPECT_GT(refused[1], 30);
}

TEST_F(sim_faults, a_crashed_robot_is_mute_and_forgets_and_comes_back_with_the_incarnation_it_gets) {
  for (auto const& [as, life] :
       {std::pair{rebirth::greater, 1001u}, std::pair{rebirth::equal, 1000u}, std::pair{rebirth::smaller, 999u}}) {
    options.faults.crashes = {{2, at(1000), seconds(1), as}};
    std::vector<happening> what;
    play(2500, [&](team const& t, log_record const& r) {
      if (r.robot != 2 || r.time < at(1000)) return;
      EXPECT_EQ(t.up(2), r.time >= at(2000));
      EXPECT_TRUE(r.time == at(1000) || r.time >= at(2000));
      what.push_back(r.what);
      if (r.time < at(2000)) return;
      EXPECT_EQ(t.robot(2).incarnation(), incarnation{life});
      if (r.what == happening::entered) {
        EXPECT_EQ(t.robot(2).believes({1})->participants().size(), 1U) << "it knows nobody";
      }
    });
    ASSERT_GT(what.size(), 10U);
    EXPECT_EQ(what[0], happening::crashed);
    EXPECT_EQ(what[1], happening::restarted);
    EXPECT_EQ(what[2], happening::entered);
  }
}

TEST_F(sim_faults, a_robot_whose_sensor_is_stuck_decides_as_before) {
  world.jumps = milliseconds(300);
  for (bool const stuck : {false, true}) {
    options.faults.stuck.clear();
    for (std::size_t i = 0; i < 5 && stuck; ++i) options.faults.stuck.push_back({i, {at(1000), never}});
    int changes = 0;
    play(6000, [&](team const&, log_record const& r) { changes += r.time >= at(1500) && !r.change.empty() ? 1 : 0; });
    if (stuck) {
      EXPECT_EQ(changes, 0);
    } else {
      EXPECT_GT(changes, 20);
    }
  }
}

TEST_F(sim_faults, a_blind_robot_takes_no_task_but_a_leaders_until_it_sees_again) {
  options.faults.blind = {{4, {at(1000), at(3000)}}};
  int blind = 0, busy = 0;
  play(4000, [&](team const& t, log_record const& r) {
    if (r.robot != 4 || r.what != happening::deliberated || t.robot(4).rule({1})->obeying()) return;
    bool const has_task = t.robot(4).believes({1})->part({5}).has_value();
    if (r.time >= at(1000) && r.time < at(3000)) {
      blind += has_task ? 0 : 1;
      EXPECT_FALSE(has_task);
    } else if (r.time >= at(500)) {
      busy += has_task ? 1 : 0;
    }
  });
  EXPECT_GT(blind, 5);
  EXPECT_GT(busy, 10);
}

TEST_F(sim_faults, an_absent_robot_is_dropped_and_comes_back) {
  options.faults.absences = {{1, {at(1000), at(2000)}}};
  play(3000, [&](team const& t, log_record const& r) {
    bool const away = r.time >= at(1000) && r.time < at(2000);
    if (r.robot == 1 && r.time != at(1000) && r.time != at(2000)) {
      EXPECT_EQ(t.plays(1), !away);
    }
    if (r.robot != 0 || r.what != happening::deliberated) return;
    if (r.time > at(1200) && r.time < at(2000)) {
      EXPECT_FALSE(t.robot(0).believes({1})->takes_part({2}));
    }
    if (r.time > at(2200)) {
      EXPECT_TRUE(t.robot(0).believes({1})->takes_part({2}));
    }
  });
}

TEST_F(sim_faults, confidences_decide_who_leads) {
  world.delusions = milliseconds(300);
  options.faults.confidences = {{0, at(500), 7}};
  options.robot.renewals = 0;
  int led_by_first = 0, led_by_others = 0;
  play(20'000, [&](team const&, log_record const& r) {
    if (r.what != happening::reign_ended || r.superseded || r.time < at(3000)) return;
    ++(r.robot == 0 ? led_by_first : led_by_others);
  });
  EXPECT_GT(led_by_first, 3);
  EXPECT_EQ(led_by_others, 0);
}

TEST_F(sim_faults, a_clock_that_drifts_much_still_inverts_exactly) {
  auto engine = engine_for(1, stream::clock, 0);
  for (std::int64_t const ppm : {-100'000, -10'000, 1, 10'000, 100'000}) {
    robot_clock clock({}, milliseconds(100), engine);
    instant const before = clock.local(instant{} + seconds(100));
    clock.drift_by(ppm);
    EXPECT_EQ(clock.local(instant{} + seconds(100)) - before, microseconds(100 * ppm));
    for (int k = 0; k < 1000; ++k) {
      instant const shown = clock.local({uniform(engine, 0, seconds(80'000).ns)});
      EXPECT_GE(clock.local(clock.global(shown)), shown);
      EXPECT_LT(clock.local(clock.global(shown) - nanoseconds(1)), shown);
    }
  }
}

}  // namespace

}  // namespace sim_faults_test
