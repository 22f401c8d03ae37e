#include <gtest/gtest.h>

#include "pitch.hpp"

#include <cstdint>
#include <optional>
#include <variant>

namespace reigns_test {

using rota::decision_reason;
using rota::milliseconds;
using rota::refusal;
using rota::verdict;

namespace {

struct reigns : playground {};

TEST_F(reigns, robots_that_see_the_same_agree) {
  pitch p(*this, {sees(2), sees(2), sees(2)});
  p.run(rota::seconds(1));
  EXPECT_TRUE(p.agreed());
  EXPECT_TRUE(p.robots[0].believes(play_id)->atoms().contains(does(2, attack)));
  for (auto const& [who, n] : p.detections) EXPECT_EQ(n, 0) << who;
}

TEST_F(reigns, two_that_each_see_themselves_best_loop_until_one_rules) {
  rota::robot_options off;
  off.resolution = false;
  pitch without(*this, {sees(1), sees(2)}, off);
  int agreeing = 0;
  for (int i = 0; i < 10'000; ++i) {
    without.step();
    agreeing += i > 1000 && without.agreed();
  }
  EXPECT_LT(agreeing, 900) << "of 9000 ms";
  EXPECT_GT(without.detections[1] + without.detections[2], 5);
  EXPECT_EQ(without.reigns[1] + without.reigns[2], 0);

  rota::robot_options fixed;
  fixed.renewals = 0;
  pitch with(*this, {sees(1), sees(2)}, fixed);
  with.run(milliseconds(700));
  EXPECT_TRUE(with.agreed());
  EXPECT_TRUE(with.robots[1].rule(play_id)->leading()) << "the greatest id leads";
  EXPECT_TRUE(with.robots[0].rule(play_id)->obeying());
  EXPECT_TRUE(with.robots[0].believes(play_id)->atoms().contains(does(2, attack)));
  EXPECT_TRUE(with.robots[0].believes(play_id)->atoms().contains(does(1, defend)));
  auto const ends = with.robots[1].rule(play_id)->expiry();
  with.run(ends - with.now + milliseconds(1));
  EXPECT_FALSE(with.robots[0].rule(play_id)->active()) << "afterwards everybody is back to normal";
  EXPECT_FALSE(with.robots[1].rule(play_id)->active());
}

TEST_F(reigns, the_greater_agent_answers_even_if_it_detected_nothing) {
  pitch p(*this, {sees(1), sees(2), sees(2), sees(1)});
  for (int i = 0; i < 1000 && !p.robots[3].rule(play_id)->leading(); ++i) p.step();
  EXPECT_TRUE(p.robots[3].rule(play_id)->leading());
  p.run(milliseconds(50));
  for (int i : {0, 1, 2}) {
    auto const* rule = p.robots[static_cast<std::size_t>(i)].rule(play_id);
    ASSERT_TRUE(rule->obeying());
    EXPECT_EQ(rule->current().leader, agent(4));
  }
  EXPECT_TRUE(p.agreed());
}

TEST_F(reigns, a_leader_changes_its_mind_and_followers_with_it) {
  pitch p(*this, {sees(1), sees(2)});
  p.run(milliseconds(700));
  ASSERT_TRUE(p.robots[1].rule(play_id)->leading());
  p.views[1] = sees(1);
  p.run(milliseconds(40));
  EXPECT_TRUE(p.robots[0].believes(play_id)->atoms().contains(does(1, attack)));
  EXPECT_TRUE(p.agreed());
}

/// ALICA's defect: an agent never drops robots that the leader left idle.
TEST_F(reigns, followers_drop_agents_that_the_leader_left_idle) {
  auto a = in_play(1);
  a.receive(says(2, 1, defend), start);
  a.receive(says(3, 1, attack), start);
  auto const r = a.receive(claim_by(9, 1), start);
  EXPECT_EQ(r.claim, rota::claim_outcome::adopted);
  EXPECT_EQ(a.believes(play_id)->atoms(), (atoms{does(1, attack)}));
  EXPECT_TRUE(a.believes(play_id)->takes_part(agent(2))) << "idle, and still taking part";
  EXPECT_EQ(think(a, sees(3)).reason, decision_reason::obeyed);
}

TEST_F(reigns, tasks_in_plan_messages_are_ignored_under_authority_and_coming_and_going_is_not) {
  auto a = in_play(1);
  a.receive(says(2, 1, defend), start);
  a.receive(claim_by(9, 1), start);
  EXPECT_TRUE(a.receive(says(2, 2, attack), start).changes.empty());
  EXPECT_TRUE(a.receive(says(3, 1, attack), start).changes.empty());
  EXPECT_TRUE(a.believes(play_id)->takes_part(agent(3)));
  a.receive(says_nothing(2, 3), start);
  EXPECT_FALSE(a.believes(play_id)->takes_part(agent(2)));
  EXPECT_EQ(a.believes(play_id)->atoms(), (atoms{does(1, attack)}));
}

TEST_F(reigns, a_deleted_leader_releases_its_followers) {
  rota::robot_options options;
  options.silence = milliseconds(500);
  auto a = in_play(1, options);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(9, 1), start);
  EXPECT_EQ(think(a, sees(1), start + milliseconds(500)).reason, decision_reason::obeyed);
  EXPECT_NE(think(a, sees(1), start + milliseconds(501)).reason, decision_reason::obeyed);
  EXPECT_FALSE(a.rule(play_id)->active());
  // It speaks all the same: it is obeyed again, and no longer than it would have been.
  EXPECT_EQ(a.receive(claim_by(9, 1), start + milliseconds(600)).claim, rota::claim_outcome::adopted);
  EXPECT_EQ(a.rule(play_id)->expiry(), start + rota::seconds(2));
}

TEST_F(reigns, a_leader_that_leaves_the_type_ends_its_reign_and_numbers_go_on) {
  auto a = in_play(5), b = in_play(1);
  EXPECT_EQ(a.receive(claim_by(3, 3), start).claim, rota::claim_outcome::challenged);
  EXPECT_TRUE(a.rule(play_id)->leading());
  (void)think(a, sees(5));
  auto const first = std::get<claim>(*a.next_message(start));
  b.receive(first, start);
  a.leave(play_id);
  b.receive(*a.next_message(start + milliseconds(100)), start + milliseconds(100));
  EXPECT_FALSE(b.rule(play_id)->active());
  a.enter(play, start + milliseconds(200));
  a.receive(claim_by(3, 3, 2), start + milliseconds(200));
  (void)think(a, sees(5), start + milliseconds(200));
  auto const second = std::get<claim>(*a.next_message(start + milliseconds(200)));
  EXPECT_GT(second.number, first.number);
  EXPECT_EQ(b.receive(second, start + milliseconds(200)).claim, rota::claim_outcome::adopted);
}

TEST_F(reigns, each_copy_of_a_claim_restores_what_a_follower_lost_meanwhile) {
  auto a = in_play(1);
  auto c = claim_by(9, 3);
  c.atoms.insert(does(2, defend));
  c.ages.push_back({});
  a.receive(says(2, 1, defend), start);
  a.receive(c, start);
  a.receive(says_nothing(2, 2), start);
  a.receive(says(2, 3, defend), start);
  EXPECT_EQ(a.believes(play_id)->atoms(), (atoms{does(3, attack)}));
  auto const r = a.receive(c, start + milliseconds(100));
  EXPECT_EQ(r.claim, rota::claim_outcome::repeated);
  EXPECT_EQ(r.imposed, *event::make({does(2, defend)}, {}));
  EXPECT_TRUE(r.changes.empty());
  EXPECT_EQ(a.believes(play_id)->atoms(), c.atoms);
}

TEST_F(reigns, delayed_copies_of_an_answered_claim_begin_no_second_reign) {
  auto a = in_play(5);
  int begun = 0;
  for (int s = 0; s <= 8; s += 2)
    begun += a.receive(claim_by(4, 4), start + rota::seconds(s)).claim == rota::claim_outcome::challenged;
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(a.receive(claim_by(4, 4, 2), start + rota::seconds(10)).claim, rota::claim_outcome::challenged)
      << "another claim is answered again";
}

TEST_F(reigns, a_challenger_deliberates_before_it_speaks_and_counts_in_whom_the_claim_names) {
  auto a = in_play(5);
  auto c = claim_by(4, 3);
  c.atoms.insert(does(4, defend));
  c.ages.push_back({});
  a.receive(c, start);
  auto const before = a.next_message(start);  // its plan message only
  ASSERT_TRUE(before);
  EXPECT_TRUE(std::holds_alternative<plan_message>(*before));
  EXPECT_FALSE(a.next_message(start));
  (void)think(a, sees(3), start + milliseconds(10));
  auto const mine = std::get<claim>(*a.next_message(start + milliseconds(10)));
  EXPECT_EQ(mine.atoms, (atoms{does(3, attack), does(4, defend), does(5, defend)}));
}

TEST_F(reigns, a_leader_heard_through_claims_alone_is_not_silent) {
  auto a = in_play(1);
  a.receive(says(9, 1, defend), start);
  auto c = claim_by(9, 1);
  c.remaining = rota::seconds(2);
  for (int ms = 1500; ms <= 2000; ms += 100) {
    a.receive(c, start + milliseconds(ms));
    c.remaining = c.remaining - milliseconds(100);
  }
  EXPECT_EQ(think(a, sees(1), start + milliseconds(2010)).reason, decision_reason::obeyed);
}

TEST_F(reigns, a_restarted_leader_leads_no_longer) {
  auto a = in_play(1);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(9, 3), start);
  auto reborn = says(9, 1, std::nullopt);
  reborn.number.incarnation = {2};
  a.receive(reborn, start + milliseconds(10));
  EXPECT_FALSE(a.rule(play_id)->active());
  EXPECT_EQ(a.receive(claim_by(9, 3), start + milliseconds(20)).verdict, verdict::stale);
}

TEST_F(reigns, a_stamp_is_frozen_for_a_claim) {
  auto a = in_play(1);
  auto c = claim_by(9, 1);
  c.stamp.confidence = 10;
  a.receive(c, start);
  auto const before = a;
  for (std::uint32_t confidence : {0u, 9u, 11u}) {
    c.stamp.confidence = confidence;
    ++c.version;
    EXPECT_EQ(a.receive(c, start).reason, refusal::foreign_stamp);
  }
  EXPECT_EQ(a, before);
}

TEST_F(reigns, a_claim_of_a_former_life_is_stale) {
  auto a = in_play(1);
  auto reborn = says(9, 1, defend);
  reborn.number.incarnation = {2};
  a.receive(reborn, start);
  auto const before = a;
  EXPECT_EQ(a.receive(claim_by(9, 1), start).verdict, verdict::stale);
  EXPECT_EQ(a, before);
}

TEST_F(reigns, the_end_of_a_reign_is_told_whoever_noticed_it) {
  auto a = in_play(1);
  auto c = claim_by(9, 1);
  c.remaining = milliseconds(50);
  a.receive(c, start);
  EXPECT_FALSE(think(a, sees(1), start + milliseconds(30)).reign_ended);
  (void)a.next_message(start + milliseconds(60));
  EXPECT_TRUE(think(a, sees(1), start + milliseconds(61)).reign_ended);
  EXPECT_FALSE(think(a, sees(1), start + milliseconds(91)).reign_ended);
}

/// Rule vi of the monitor: what happened before or during authority never counts afterwards.
TEST_F(reigns, cycles_do_not_survive_a_reign_or_a_deletion) {
  for (int interruption : {0, 1, 2, 3}) {
    rota::robot_options options;
    options.silence = rota::seconds(3);
    auto a = in_play(5, options);
    std::uint64_t n = 0;
    auto now = start;
    auto const cycle = [&] {
      now += milliseconds(10);
      a.receive(says(2, ++n, attack), now);
      return think(a, sees(5), now);
    };
    a.receive(says(2, ++n, defend), now);
    (void)think(a, sees(5), now);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(cycle().cycles, 1u);
    switch (interruption) {
    case 0: break;
    case 1:  // obeys for a while, in which messages contradict the claim
      a.receive(claim_by(9, 5), now);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(cycle().cycles, 0u);
      now += rota::seconds(2);
      (void)think(a, sees(5), now);
      break;
    case 2:  // leads for a while
      a.receive(claim_by(4, 5), now);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(cycle().cycles, 0u);
      now += rota::seconds(2);
      (void)think(a, sees(5), now);
      break;
    case 3:  // b falls silent, is deleted, and comes back
      now += rota::seconds(4);
      (void)think(a, sees(5), now);
      a.receive(says(2, ++n, defend), now);
      (void)think(a, sees(5), now);
      break;
    }
    a.receive(says(2, ++n, defend), now);
    (void)think(a, sees(5), now);
    auto const last = interruption == 0 ? std::optional<soccer::agent>() : cycle().detected;
    EXPECT_EQ(last, std::nullopt) << interruption;
  }
}

}  // namespace

}  // namespace reigns_test
