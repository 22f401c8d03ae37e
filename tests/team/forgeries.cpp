// Forged, replayed and late messages: what a robot that heard one does about genuine ones, with whole robots.
#include <gtest/gtest.h>

#include "pitch.hpp"

#include <rota/team/print.hpp>

#include <algorithm>

namespace forgeries_test {

using rota::claim_outcome;
using rota::milliseconds;
using rota::seconds;
using rota::verdict;

namespace {

rota::instant at(std::int64_t ms) { return start + milliseconds(ms); }

struct forgeries : playground {
  /// A genuine leader, robot 9: it rules for two of every three seconds, and says so. @return how many of its claims `a` heeds
  int heeded(robot& a, std::uint64_t sequence, int from_ms, int until_ms) {
    std::uint64_t number = 0;
    int heard = 0;
    for (int ms = from_ms; ms < until_ms; ms += 100) {
      if (ms % 3000 == 0) ++number;
      bool const rules = ms % 3000 < 2000;
      auto m = says(9, ++sequence, attack);
      m.claims = number;
      if (rules) m.types[0].leads = number;
      a.receive(m, at(ms));
      auto c = claim_by(9, 9, number);
      c.remaining = seconds(2) - milliseconds(ms % 3000);
      if (rules) heard += a.receive(c, at(ms)).claim != claim_outcome::expired ? 1 : 0;
      (void)think(a, sees(1), at(ms));
    }
    return heard;
  }
};

/// The number of the forged claim is within reach, and a forged plan message says that it was made, and is over.
TEST_F(forgeries, a_claim_that_was_never_made_deafens_nobody) {
  auto a = in_play(1);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(9, 3, 60000), at(1));
  auto forged = says(9, 2, defend);
  forged.claims = 60000;
  a.receive(forged, at(2));
  EXPECT_GT(heeded(a, 2, 3000, 33000), 150);
}

/// Copies of a claim that has ended say nothing of their leader, however often they come.
TEST_F(forgeries, a_replayed_claim_keeps_nobody_from_leading) {
  auto a = in_play(1);
  auto const old = claim_by(9, 9);
  a.receive(old, start);
  std::uint64_t sequence = 0;
  int led = 0;
  for (int ms = 10000; ms < 20000; ms += 50) {
    a.receive(old, at(ms));
    a.receive(says(2, ++sequence, attack), at(ms));
    led += think(a, sees(1), at(ms + 10)).reign_began ? 1 : 0;
  }
  EXPECT_GT(led, 2);
}

/// Thirty claims of robot 9, recorded and replayed at a robot that never heard them: each rules for as long as it says, and once.
TEST_F(forgeries, recorded_claims_rule_once_and_no_longer_than_they_say) {
  auto a = in_play(1);
  int ruled = 0;
  for (int round = 0; round < 2; ++round)
    for (std::uint64_t number = 1; number <= 30; ++number) {
      auto const then = at(1'000'000 + 100'000 * round + 3'000 * static_cast<int>(number));
      bool const obeyed = a.receive(claim_by(9, 9, number), then).claim == claim_outcome::adopted;
      ruled += obeyed ? 1 : 0;
      EXPECT_EQ(obeyed, round == 0) << number;
      (void)think(a, sees(1), then + milliseconds(1999));
      EXPECT_EQ(a.rule(play_id)->obeying(), round == 0);
      (void)think(a, sees(1), then + milliseconds(2000));
      EXPECT_FALSE(a.rule(play_id)->active());
    }
  EXPECT_EQ(ruled, 30);
}

/// A board that obtains the same incarnation, or a smaller one, at each start is heard `forget` after it was last heard.
TEST_F(forgeries, a_restart_with_no_greater_incarnation_is_heard_in_the_end) {
  for (std::uint64_t const life : {1u, 2u}) {
    auto a = in_play(1);
    auto m = says(2, 500, attack);
    m.number.incarnation = {2};
    EXPECT_EQ(a.receive(m, start).verdict, verdict::accepted);
    m.number = {{life}, 0};
    int heard_after = 0;
    for (int ms = 100; ms < 60'000 && heard_after == 0; ms += 100) {
      m.number.sequence = static_cast<std::uint64_t>(ms / 100);
      if (life == 2 && m.number.sequence >= 500) break;  // it would have passed its old number
      if (a.receive(m, at(ms)).verdict == verdict::accepted) heard_after = ms;
    }
    EXPECT_EQ(heard_after, 30'100) << life;
  }
}

TEST_F(forgeries, a_claim_that_is_remembered_keeps_its_stamp) {
  auto a = in_play(1);
  a.receive(claim_by(8, 8), start);
  a.receive(claim_by(9, 9), at(1));
  auto forged = claim_by(8, 8);
  forged.stamp.confidence = 1000;
  forged.remaining = milliseconds(1900);
  auto const before = a;
  EXPECT_EQ(a.receive(forged, at(2)).reason, rota::refusal::foreign_stamp);
  EXPECT_EQ(a.rule(play_id)->current(), before.rule(play_id)->current());
}

TEST_F(forgeries, a_forged_time_does_not_end_relaying) {
  auto a = in_play(1);
  a.receive(claim_by(9, 9), start);
  auto forged = claim_by(9, 9);
  forged.remaining = rota::nanoseconds(1);
  a.receive(forged, at(1));
  auto genuine = claim_by(9, 9);
  genuine.remaining = milliseconds(1900);
  EXPECT_TRUE(a.receive(genuine, at(100)).relay);
  EXPECT_FALSE(a.receive(genuine, at(101)).relay) << "the same once more";
}

/// What was said before the claim was made cannot end it.
TEST_F(forgeries, a_plan_message_from_before_a_claim_releases_nobody) {
  auto a = in_play(1);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(9, 9), at(10));
  a.receive(says_nothing(9, 2), at(11));
  EXPECT_TRUE(a.rule(play_id)->obeying());
  auto later = says_nothing(9, 3);
  later.claims = 1;
  a.receive(later, at(12));
  EXPECT_FALSE(a.rule(play_id)->obeying());
}

/// A copy that was under way for so much longer than another makes those whom it names as much older.
TEST_F(forgeries, a_late_duplicate_makes_no_dead_robot_younger) {
  auto a = in_play(1);
  a.receive(says(2, 1, defend), start);
  auto c = claim_by(9, 9);
  c.atoms.insert(does(2, defend));
  c.ages = {milliseconds(0), milliseconds(0)};
  a.receive(c, start);
  std::uint64_t sequence = 0;
  int gone = 0;
  for (int ms = 0; ms < 4000 && gone == 0; ms += 10) {
    if (ms % 100 == 0) {
      auto m = says(9, ++sequence, attack);
      m.claims = 1;
      m.types[0].leads = ms < 2000 ? 1 : 0;
      a.receive(m, at(ms));
    }
    if (ms == 1900) a.receive(c, at(ms));
    (void)think(a, sees(1), at(ms));
    if (!a.believes(play_id)->takes_part(agent(2))) gone = ms;
  }
  EXPECT_GT(gone, 1500);
  EXPECT_LE(gone, 2600);
}

/// A robot that sees nothing valid says so: it has no task, and others may have theirs.
TEST_F(forgeries, a_blind_robots_reason_is_true_of_what_it_believes) {
  auto a = in_play(3);
  a.receive(says(1, 1, attack), start);
  view nothing;
  nothing.attack.fill(-100);
  auto const d = think(a, nothing);
  EXPECT_EQ(d.reason, rota::decision_reason::no_valid_allocation);
  EXPECT_EQ(a.believes(play_id)->atoms().size(), 1u);
  auto const text = describe(d);
  EXPECT_EQ(text.find("nobody"), std::string::npos) << text;
  EXPECT_NE(text.find("believes what the others say"), std::string::npos) << text;
}

/// Robot 2 insists on attacking; robot 1 lets it defend and lets it idle in turn. No part is restored, so nothing is a cycle, but for the first message.
TEST_F(forgeries, a_robot_that_insists_is_seen_although_no_cycle_is_completed) {
  auto const one = rota::plan<soccer, view>::make(
      {.plan = soccer::plan::normal,
       .tasks = {{attack, {1, 1}, soccer::state::get_ball}, {defend, {0, 3}, soccer::state::protect}},
       .utility = rota::additive_utility<soccer, view>([](soccer::agent x, soccer::task t, view const& v) {
         if (t == attack) return x == agent(1) ? std::optional<double>(1) : std::nullopt;
         return std::optional<double>(v.attack[0] > 0 ? 0.5 : -0.5);
       })});
  auto const type = *rota::plan_type<soccer, view>::make(play_id, {*one});
  robot a(agent(1), squad(2), first_life);
  a.enter(type, start);
  int messages = 0;
  for (bool detected = false; !detected && messages < 20;) {
    ++messages;
    view v;
    v.attack.fill(messages % 2 == 0 ? 1 : -1);
    a.receive(says(2, static_cast<std::uint64_t>(messages), attack), at(100 * messages));
    auto const d = a.deliberate(type, members, v, at(100 * messages + 10), space);
    EXPECT_EQ(d.cycles, messages == 1 ? 1u : 0u) << "only its joining is undone";
    EXPECT_EQ(a.believes(play_id)->part(agent(2)).has_value(), messages % 2 == 0);
    detected = d.detected == agent(2);
  }
  EXPECT_EQ(messages, 4);
}

/// Its followers obey until they hear of it, so they hear of it at once.
TEST_F(forgeries, a_leader_that_gives_up_says_so_before_its_next_slot) {
  rota::robot_options o;
  o.message_period = seconds(1);
  o.change_period = milliseconds(50);
  auto a = in_play(9, o);
  for (int n : {1, 2, 3, 4, 5}) a.receive(says(n, 1, n == 1 ? attack : defend), start);
  a.receive(claim_by(8, 8), start);
  (void)think(a, sees(1), at(1));
  for (int ms = 60; ms < 700; ms += 10)
    while (a.next_message(at(ms))) {
    }
  ASSERT_TRUE(a.rule(play_id)->leading());
  ASSERT_GT(a.next_due(), at(705));
  view nothing;
  nothing.attack.fill(-100);
  (void)think(a, nothing, at(700));
  EXPECT_FALSE(a.rule(play_id)->leading());
  EXPECT_LE(a.next_due(), at(705));
}

}  // namespace

}  // namespace forgeries_test
