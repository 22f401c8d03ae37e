#include <gtest/gtest.h>

#include "plays.hpp"

#include <map>
#include <rota/team/monitors/literal.hpp>

namespace detection_test {

namespace {

using namespace rota;
using namespace rota::sim;

TEST(detection, takes_as_long_as_the_theory_says) {
  timing_options o;
  o.runs = 300;
  auto const at_100 = measure_timing(o);
  EXPECT_EQ(at_100.samples, 2 * o.runs);
  EXPECT_NEAR(at_100.two_cycles_ms, 115, 5);
  EXPECT_NEAR(at_100.four_cycles_ms, 315, 8);
  EXPECT_NEAR(at_100.two_detected_ms, 149, 8);
  EXPECT_NEAR(at_100.four_detected_ms, 349, 8);
  o.message_period = milliseconds(200);
  auto const at_200 = measure_timing(o);
  EXPECT_NEAR(at_200.two_cycles_ms, 215, 5);
  EXPECT_NEAR(at_200.four_cycles_ms, 615, 8);
}

/// ALICA counts cycles in ticks: at 30 Hz it finds reversals 233 ms apart, and never those 267 ms apart.
TEST(detection, counts_events_not_ticks) {
  for (int const period : {233, 267, 500}) {
    timing_options o;
    o.runs = 20;
    o.message_period = milliseconds(period);
    auto const f = measure_timing(o);
    EXPECT_EQ(f.samples, 2 * o.runs) << period;
    EXPECT_NEAR(f.four_cycles_ms, 3 * period + 15, 15) << period;
  }
}

/// Robot 1 at the ball; robot 2 keeps saying that it attacks; robot 3 changes its task each time, rightly.
template <class Monitor>
std::optional<int> messages_until_detection(bool third_changes) {
  auto const book = soccer();
  auto const members = team_of(3);
  robot<names, Monitor> me({1}, members.agents(), incarnation{1});
  instant now{};
  me.enter(book.type, now);
  point const at_defence{metres(-6), 0}, at_support{metres(-2), metres(3)};
  perceived seen{{0, 0}, {{metres(0.5), 0}, at_defence, at_defence}};
  workspace space;
  std::uint64_t number = 0;
  auto const says = [&](std::uint64_t who, std::uint64_t task) {
    plan_message<names> m{{who}, {{1}, ++number}, {}};
    m.types.push_back({{1}, placement<names>{{1}, {task}, {task}}});
    me.receive(m, now);
  };
  says(2, 2);
  says(3, 2);
  (void)me.deliberate(book.type, members, seen, now, space);
  for (int i = 1; i <= 1000; ++i) {
    now += milliseconds(70);
    bool const supports = third_changes && i % 2 == 1;
    seen.robots[2] = supports ? at_support : at_defence;
    says(2, 1);
    says(3, supports ? 3 : 2);
    now += milliseconds(30);
    auto const d = me.deliberate(book.type, members, seen, now, space);
    EXPECT_EQ(me.believes({1})->part({2}), (in<names>{{2}, {1}, {2}}));
    if (d.detected) return i;
  }
  return std::nullopt;
}

/// One unrelated change in the same tick hides a cycle from the literal reading of Def. 5 for ever.
TEST(detection, is_not_hidden_by_a_third_robot) {
  EXPECT_EQ(messages_until_detection<cycle_monitor<names>>(false), 4);
  EXPECT_EQ(messages_until_detection<literal_monitor<names>>(false), 4);
  EXPECT_EQ(messages_until_detection<cycle_monitor<names>>(true), 4);
  EXPECT_EQ(messages_until_detection<literal_monitor<names>>(true), std::nullopt);
}

/// With the clocks of the simulator: 100 ms stay 100 ms under a loop of 30 ms, to within the drift of the clock.
TEST(simulation, keeps_loops_and_the_message_grid) {
  auto options = brief(scenario::ball_fight, false);
  options.length = seconds(20);
  std::map<std::size_t, std::vector<instant>> said, decided;
  (void)play(soccer(), options, [&](log_record const& r) {
    if (r.what == happening::said_plan) said[r.robot].push_back(r.time);
    if (r.what == happening::deliberated) decided[r.robot].push_back(r.time);
  });
  for (auto const& [robot, times] : said) {
    ASSERT_GE(times.size(), 219U);
    for (std::size_t i = 0; i < times.size(); ++i) {
      auto const off = times[i] - times[0] - milliseconds(100) * static_cast<std::int64_t>(i);
      EXPECT_LE(std::abs(off.ns), 1 + static_cast<std::int64_t>(i) * 100 * 50);
    }
  }
  for (auto const& [robot, times] : decided) {
    EXPECT_NEAR(static_cast<double>(times.size()), 22 / 0.03, 5);
    EXPECT_NEAR(to_milliseconds(times[100] - times[0]), 3000, 16);
  }
}

/// Whoever leads, at most one robot does for longer than it takes to hear of a greater claim.
TEST(simulation, reigns_end_and_the_greatest_stamp_leads) {
  auto options = brief(scenario::ball_fight, true);
  options.length = seconds(30);
  options.team.robot.renewals = 0;
  std::optional<instant> began[5];
  int ended = 0;
  (void)play(soccer(), options, [&](log_record const& r) {
    if (r.what == happening::reign_began) began[r.robot] = r.time;
    if (r.what != happening::reign_ended) return;
    ASSERT_TRUE(began[r.robot]);
    EXPECT_LE(r.time - *began[r.robot], seconds(2) + milliseconds(101));
    EXPECT_TRUE(!r.superseded || r.robot < 4);
    ++ended;
  });
  EXPECT_GT(ended, 5);
}

}  // namespace

}  // namespace detection_test
