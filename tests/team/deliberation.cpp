#include <gtest/gtest.h>

#include "pitch.hpp"

#include <support/allocation_counter.hpp>

namespace deliberation_test {

using rota::decision_reason;
using rota::milliseconds;
using rota::verdict;

namespace {

struct deliberation : playground {};

TEST_F(deliberation, enters_alone_decides_and_leaves) {
  auto a = in_play(1);
  EXPECT_FALSE(a.enter(play, start));
  auto const d = think(a, sees(1));
  EXPECT_EQ(d.reason, decision_reason::reallocated);
  EXPECT_EQ(d.event, event::addition(does(1, attack)));
  EXPECT_EQ(d.own, does(1, attack));
  EXPECT_EQ(a.believes(play_id)->state(agent(1)), soccer::state::get_ball) << "the entry state of the task";
  EXPECT_EQ(think(a, sees(1)).reason, decision_reason::kept);
  EXPECT_TRUE(a.leave(play_id));
  EXPECT_FALSE(a.leave(play_id));
  EXPECT_EQ(a.believes(play_id), nullptr);
  EXPECT_EQ(think(a, sees(1)).reason, decision_reason::not_executing);
}

TEST_F(deliberation, changes_no_more_readily_than_its_options_say) {
  auto const swaps_for = [&](rota::robot_options const& options, double gain) {
    auto a = in_play(1, options);
    (void)a.receive(says(2, 1, defend), start);
    view v = sees(1);
    v.attack[2] = 1 + gain;  // two robots would change
    auto const before = a.believes(play_id)->atoms();
    (void)think(a, sees(1));
    EXPECT_NE(a.believes(play_id)->atoms(), before);
    return think(a, v).reason == decision_reason::reallocated;
  };
  EXPECT_TRUE(swaps_for({}, 0.25));
  EXPECT_FALSE(swaps_for({.change_cost = 0.25}, 0.25));
  EXPECT_TRUE(swaps_for({.change_cost = 0.0625}, 0.25));
  EXPECT_FALSE(swaps_for({.hysteresis = {.absolute = 0.25}}, 0.25));
  EXPECT_TRUE(swaps_for({.hysteresis = {.absolute = 0.25}}, 0.5));
  EXPECT_FALSE(swaps_for({.hysteresis = {.relative = 0.5}}, 0.5)) << "half of 1.125 is more";
}

TEST_F(deliberation, the_silent_are_deleted) {
  auto a = in_play(1);
  a.receive(says(2, 1, defend), start);
  a.receive(says(3, 1, defend), start + rota::seconds(1));
  (void)think(a, sees(1), start + rota::seconds(2));
  auto const d = think(a, sees(1), start + rota::seconds(2) + milliseconds(1));
  EXPECT_EQ(d.deleted, event::subtraction(does(2, defend)));
  EXPECT_FALSE(a.believes(play_id)->takes_part(agent(2)));
  EXPECT_TRUE(a.believes(play_id)->takes_part(agent(3)));
  EXPECT_EQ(a.receive(says(2, 1, defend), start + rota::seconds(3)).verdict, verdict::stale)
      << "a delayed old message revives nobody";
  (void)think(a, sees(1), start + rota::seconds(1000));
  EXPECT_TRUE(a.believes(play_id)->takes_part(agent(1))) << "nobody deletes itself";
}

TEST_F(deliberation, without_a_valid_allocation_nobody_has_a_task_and_all_still_take_part) {
  auto a = in_play(1);
  (void)think(a, sees(1));
  rota::team<soccer> keepers;
  for (auto who : squad(9)) keepers.add(who, rota::role<soccer>().forbid(attack));
  auto const d = a.deliberate(play, keepers, sees(1), start, space);
  EXPECT_EQ(d.reason, decision_reason::no_valid_allocation);
  EXPECT_EQ(d.own, std::nullopt);
  auto const m = std::get<plan_message>(*a.next_message(start));
  ASSERT_EQ(m.types.size(), 1u);
  EXPECT_FALSE(m.types[0].place);
}

TEST_F(deliberation, who_is_given_another_task_is_taken_to_begin_it) {
  auto a = in_play(1);
  auto m = says(2, 1, defend);
  m.types[0].place->state = soccer::state::help;
  a.receive(m, start);
  EXPECT_EQ(a.believes(play_id)->state(agent(2)), soccer::state::help);
  (void)think(a, sees(2));
  EXPECT_EQ(a.believes(play_id)->part(agent(2)), does(2, attack));
  EXPECT_EQ(a.believes(play_id)->state(agent(2)), soccer::state::get_ball);
  a.receive(claim_by(9, 2), start);
  m.number.sequence = 2;
  a.receive(m, start);
  EXPECT_EQ(a.believes(play_id)->state(agent(2)), soccer::state::get_ball) << "a state of a task that is ignored";
}

#ifndef NDEBUG
TEST_F(deliberation, another_plan_type_under_the_same_id_is_asserted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  using plan = rota::plan<soccer, view>;
  auto const worth = rota::additive_utility<soccer, view>([](auto, auto, view const&) { return std::optional(1.0); });
  auto const other = *rota::plan_type<soccer, view>::make(
      play_id, {*plan::make({.plan = soccer::plan::kickoff, .tasks = {{attack, {1, 1}, {}}}, .utility = worth})});
  auto a = in_play(1);
  EXPECT_DEATH((void)a.deliberate(other, members, sees(1), start, space), "knows");
}
#endif

TEST_F(deliberation, a_regular_value_that_replays_alike) {
  pitch p(*this, {sees(1), sees(2), sees(3)});
  p.run(milliseconds(333));
  pitch q = p;
  EXPECT_EQ(p.robots, q.robots);
  p.run(rota::seconds(3));
  EXPECT_NE(p.robots, q.robots);
  q.run(rota::seconds(3));
  EXPECT_EQ(p.robots, q.robots);
}

TEST_F(deliberation, a_steady_deliberation_allocates_nothing) {
  auto a = in_play(1);
  for (int n : {2, 3, 4, 5}) a.receive(says(n, 1, n == 2 ? attack : defend), start);
  view const calm = sees(2);
  for (int i = 0; i < 2; ++i) (void)think(a, calm);
  auto const before = rota_test::allocation_count();
  for (int i = 0; i < 100; ++i) (void)think(a, calm);
  EXPECT_EQ(rota_test::allocation_count() - before, 0u);
  auto const positive_control = rota_test::allocation_count();
  auto* copy = new robot(a);
  EXPECT_GT(rota_test::allocation_count(), positive_control);
  delete copy;
}

}  // namespace

}  // namespace deliberation_test
