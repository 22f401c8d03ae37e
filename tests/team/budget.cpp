// Options from a budget of messages: what follows from how often robots are heard, and what it saves.
#include <gtest/gtest.h>

#include "playground.hpp"

#include <rota/team/budget.hpp>

#include <optional>
#include <vector>

namespace budget_test {

using rota::milliseconds;
using rota::seconds;

namespace {

struct budget : playground {};

TEST_F(budget, what_depends_on_how_often_robots_are_heard_follows) {
  auto const two_a_second = rota::sparing(milliseconds(500));
  EXPECT_EQ(two_a_second.message_period, milliseconds(1250));
  EXPECT_EQ(two_a_second.change_period, milliseconds(100));
  EXPECT_EQ(two_a_second.claim_period, milliseconds(500));
  EXPECT_EQ(two_a_second.silence, seconds(10));
  EXPECT_EQ(two_a_second.pending_age, seconds(5));
  EXPECT_TRUE(two_a_second.fingerprints);
  rota::robot_options own;
  own.silence = seconds(20);
  own.cycles = 7;
  EXPECT_EQ(rota::sparing(milliseconds(500), own).silence, seconds(20)) << "what is more patient stays";
  EXPECT_EQ(rota::sparing(milliseconds(500), own).cycles, 7u);
  for (auto const gap : {milliseconds(1), milliseconds(20), milliseconds(100), milliseconds(500), seconds(1)}) {
    auto const o = rota::sparing(gap);
    EXPECT_LE(o.change_period, gap);
    EXPECT_GE(o.silence, 8 * o.message_period);
    EXPECT_GE(o.forget, o.silence);
    (void)in_play(1, o);  // whose preconditions hold
  }
}

#ifndef NDEBUG
TEST_F(budget, no_gap_is_asserted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH((void)rota::sparing({}), "gap");
  EXPECT_DEATH((void)rota::sparing(milliseconds(1001)), "gap");
}
#endif

/// Two robots of which each believes that it attacks best.
struct quarrel {
  std::vector<robot> robots;
  int sent = 0;
  std::optional<rota::instant> detected{};

  quarrel(playground& f, rota::robot_options options, int calm_ms, int ms) {
    options.resolution = false;
    for (int n = 1; n <= 2; ++n) {
      options.first_message = start + milliseconds(37 * n);
      robots.push_back(f.in_play(n, options));
    }
    for (auto now = start; now < start + milliseconds(ms); now = now + milliseconds(1))
      for (std::size_t i = 0; i < 2; ++i) {
        bool const quarrels = now >= start + milliseconds(calm_ms);
        if (now.ns / 1'000'000 % 30 == static_cast<int>(11 * i) &&
            f.think(robots[i], sees(quarrels ? int(i) + 1 : 1), now).detected && !detected)
          detected = now;
        while (auto m = robots[i].next_message(now)) {
          ++sent;
          robots[1 - i].receive(*m, now);
        }
      }
  }
};

TEST_F(budget, a_calm_team_is_nearly_silent_and_a_quarrel_is_found_as_soon_as_ever) {
  quarrel const calm(*this, rota::sparing(milliseconds(500)), 100'000, 60'000);
  EXPECT_LE(calm.sent, 2 * (48 + 6)) << "a message every 1.25 s each, and some at the beginning";
  EXPECT_FALSE(calm.detected);
  quarrel const fight(*this, rota::sparing(milliseconds(500)), 10'000, 20'000);
  quarrel const as_ever(*this, {}, 10'000, 20'000);
  ASSERT_TRUE(fight.detected && as_ever.detected);
  EXPECT_LE(*fight.detected, *as_ever.detected + milliseconds(100));
  rota::robot_options seldom;
  seldom.message_period = milliseconds(500);
  quarrel const slow(*this, seldom, 10'000, 20'000);
  EXPECT_GT(*slow.detected, *fight.detected + seconds(1)) << "a slow message period alone is no cure";
}

/// At the defaults of silence and patience, a robot that speaks every 1.25 s would be deleted whenever two messages are lost.
TEST_F(budget, two_lost_messages_delete_nobody) {
  for (bool const patient : {true, false}) {
    auto o = rota::sparing(milliseconds(500));
    if (!patient) o.silence = rota::robot_options{}.silence;
    auto a = in_play(1, o), b = in_play(2, o);
    bool missed = false;
    for (int ms = 0; ms < 30'000; ms += 10) {
      auto const now = start + milliseconds(ms);
      (void)think(a, sees(1), now);
      (void)think(b, sees(1), now);
      while (a.next_message(now)) {
      }
      while (auto m = b.next_message(now)) {
        bool const lost = ms > 10'000 && ms < 13'000;
        if (!lost) a.receive(*m, now);
      }
      missed |= ms > 5'000 && !a.believes(play_id)->takes_part(agent(2));
    }
    EXPECT_EQ(missed, !patient);
  }
}

}  // namespace

}  // namespace budget_test
