// Clocks that are set, read twice in a turn, or show absurd times; and options and numbers that no robot can work with.
#include <gtest/gtest.h>

#include "pitch.hpp"

namespace clocks_test {

using rota::milliseconds;
using rota::nanoseconds;
using rota::seconds;

namespace {

rota::instant at(std::int64_t ms) { return start + milliseconds(ms); }

struct clocks : playground {};

/// The radio stamps a message a little later than the loop's own reading of the clock: each turn the clock seems to go back.
TEST_F(clocks, a_step_back_in_each_turn_silences_nobody) {
  for (rota::duration const step : {nanoseconds(1), milliseconds(2)}) {
    auto a = in_play(1);
    int said = 0;
    for (int ms = 0; ms < 6000; ms += 30) {
      a.receive(says(2, static_cast<std::uint64_t>(ms) + 1, defend), at(ms) + step);
      (void)think(a, sees(1), at(ms));
      while (a.next_message(at(ms))) ++said;
    }
    EXPECT_GE(said, 55) << step.ns;
  }
}

TEST_F(clocks, what_was_due_stays_due_when_the_clock_is_set_back) {
  auto a = in_play(1);
  (void)think(a, sees(1), start);
  while (a.next_message(start)) {
  }
  (void)think(a, sees(1), at(110));
  EXPECT_LE(a.next_due(), at(110));
  (void)think(a, sees(1), at(109));
  EXPECT_LE(a.next_due(), at(109));
}

/// Fifty-six years back and forth, again and again: what is remembered does not leave the range of instants.
TEST_F(clocks, may_be_set_back_and_forth_by_half_a_century) {
  auto a = in_play(1);
  a.receive(claim_by(9, 9), start);
  for (int k = 0; k < 12; ++k) {
    auto const late = start + seconds(1'796'000'000 + k);
    a.receive(says(2, static_cast<std::uint64_t>(k) + 1, defend), late);
    (void)think(a, sees(1), late);
    (void)a.next_message(late);
    auto const d = think(a, sees(1), start + seconds(k));
    EXPECT_EQ(d.clock_set_back, seconds(1'796'000'000));
  }
}

TEST_F(clocks, set_far_move_an_instant_no_further_than_distances_can_be_computed) {
  constexpr auto century = rota::century;
  rota::instant const now{century.ns};
  auto t = rota::moved(rota::moved(-now.ns < 0 ? rota::instant{-century.ns} : now, -century), -2 * century);
  EXPECT_EQ(rota::moved(t, -2 * century), t);
  EXPECT_GT((now - t).ns, 0);
  EXPECT_EQ(rota::moved(rota::never, -century), rota::never);
  EXPECT_EQ(rota::moved(rota::long_ago, century), rota::long_ago);
  EXPECT_EQ(rota::moved(rota::moved(now, century), -century), rota::instant{century.ns / 10 * 8});
}

TEST_F(clocks, options_that_cannot_work_are_known_as_such) {
  using rota::robot_options;
  auto const after = [](auto change) {
    robot_options o;
    change(o);
    return rota::usable(o);
  };
  EXPECT_TRUE(rota::usable(robot_options{}));
  EXPECT_TRUE(after([](robot_options& o) { o.opening = o.opening_period = {}; }));
  EXPECT_FALSE(after([](robot_options& o) { o.opening_period = {}; })) << "a claim would be due for ever";
  EXPECT_FALSE(after([](robot_options& o) { o.message_period = {}; }));
  EXPECT_FALSE(after([](robot_options& o) { o.claim_period = milliseconds(-1); }));
  EXPECT_FALSE(after([](robot_options& o) { o.reign = o.max_reign + nanoseconds(1); }));
  EXPECT_FALSE(after([](robot_options& o) { o.max_reign = o.reign = rota::never - rota::instant{}; }));
  EXPECT_FALSE(after([](robot_options& o) { o.change_period = rota::never - rota::instant{}; }));
  EXPECT_FALSE(after([](robot_options& o) { o.forget = o.max_delay - nanoseconds(1); }));
  EXPECT_FALSE(after([](robot_options& o) { o.forget = seconds(7200); })) << "a peer that was away is out of reach";
  EXPECT_FALSE(after([](robot_options& o) { o.message_period = milliseconds(2100); })) << "nothing ever lasts";
  EXPECT_FALSE(after([](robot_options& o) { o.first_message = rota::long_ago; }));
  EXPECT_FALSE(after([](robot_options& o) { o.silence = seconds(-1); }));
}

/// A plan message lists no more types, so no robot enters more.
TEST_F(clocks, a_robot_enters_no_more_types_than_it_can_say) {
  robot a(agent(1), squad(2), first_life);
  for (std::size_t i = 0; i < plan_message::most_types; ++i)
    ASSERT_TRUE(a.enter(make_play(soccer::plan_type(static_cast<unsigned char>(i))), start)) << i;
  EXPECT_FALSE(a.enter(make_play(soccer::plan_type(200)), start));
  EXPECT_TRUE(a.leave(soccer::plan_type(7)));
  EXPECT_TRUE(a.enter(make_play(soccer::plan_type(200)), start));
}

}  // namespace

}  // namespace clocks_test
