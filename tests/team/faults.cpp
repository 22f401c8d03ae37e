// What a lossy radio, crashes, restarts, clocks and forgeries do to a robot, run by run. Each of these went wrong once.
#include <gtest/gtest.h>

#include "pitch.hpp"

#include <optional>

namespace faults_test {

using rota::claim_outcome;
using rota::decision_reason;
using rota::milliseconds;
using rota::refusal;
using rota::seconds;
using rota::verdict;

namespace {

struct faults : playground {
  /// A claim of `leader` as it is sent at `now`, if it began at `start`.
  static claim sent(int leader, rota::instant now, std::uint64_t number = 1) {
    auto c = claim_by(leader, leader, number);
    c.remaining = seconds(2) - (now - start);
    return c;
  }
  static plan_message leaves(int sender, std::uint64_t sequence, std::uint64_t claims) {
    auto m = says_nothing(sender, sequence);
    m.claims = claims;
    return m;
  }
};

rota::instant at(int ms) { return start + milliseconds(ms); }

TEST_F(faults, a_claim_known_to_have_ended_is_not_obeyed_by_who_was_away) {
  auto a = in_play(2);
  EXPECT_EQ(a.receive(claim_by(3, 3), start).claim, claim_outcome::adopted);
  a.leave(play_id);
  a.enter(play, at(100));
  EXPECT_EQ(a.receive(claim_by(1, 1), at(200)).claim, claim_outcome::challenged);
  EXPECT_EQ(a.receive(claim_by(3, 3), at(2100)).claim, claim_outcome::expired) << "a copy that took 2.1 s";
}

TEST_F(faults, who_gave_way_to_a_greater_leader_is_obeyed_again_when_that_one_leaves) {
  auto a = in_play(1);
  a.receive(says(8, 1, defend), start);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(8, 8), start);
  EXPECT_EQ(a.receive(claim_by(9, 9), start).claim, claim_outcome::adopted);
  EXPECT_EQ(a.receive(sent(8, at(30)), at(30)).claim, claim_outcome::outranked);
  a.receive(leaves(9, 2, 1), at(100));
  EXPECT_FALSE(a.rule(play_id)->active());
  EXPECT_EQ(a.receive(sent(8, at(130)), at(130)).claim, claim_outcome::adopted);
  EXPECT_EQ(a.rule(play_id)->expiry(), at(2000));
  EXPECT_EQ(a.receive(claim_by(9, 9), at(200)).claim, claim_outcome::expired) << "its leader has said that it is over";
}

TEST_F(faults, who_answered_and_left_obeys_the_claim_that_it_answered) {
  auto a = in_play(9);
  EXPECT_EQ(a.receive(claim_by(8, 8), start).claim, claim_outcome::challenged);
  a.leave(play_id);
  a.enter(play, at(100));
  EXPECT_EQ(a.receive(sent(8, at(100)), at(100)).claim, claim_outcome::adopted);
}

TEST_F(faults, a_leader_that_left_and_came_back_leaves_no_orphans) {
  auto a = in_play(1);
  auto m = says(9, 1, defend);
  m.claims = m.types[0].leads = 1;
  a.receive(m, start);
  a.receive(claim_by(9, 9), start);
  m.number.sequence = 2;
  m.types[0].leads = 0;  // between its plan messages it has left and entered
  a.receive(m, at(100));
  EXPECT_FALSE(a.rule(play_id)->active());
  EXPECT_TRUE(think(a, sees(1), at(110)).reign_ended);
}

TEST_F(faults, what_a_leader_says_of_its_claims_reaches_only_those_that_it_had_made) {
  auto a = in_play(1);
  a.receive(says(9, 1, defend), start);
  EXPECT_EQ(a.receive(claim_by(9, 9, 2), start).claim, claim_outcome::adopted);
  a.receive(leaves(9, 2, 1), at(10));  // sent before claim 2 was made, and late
  EXPECT_TRUE(a.rule(play_id)->obeying()) << "it leads on";
  EXPECT_EQ(a.receive(sent(9, at(20), 2), at(20)).claim, claim_outcome::repeated);
  auto m = says(9, 3, defend);
  m.claims = m.types[0].leads = 2;
  a.receive(m, at(30));
  EXPECT_TRUE(a.rule(play_id)->obeying());
}

/// The greatest of five robots sees no valid allocation; the others agree on everything.
TEST_F(faults, a_robot_that_sees_nothing_valid_abstains_and_the_others_play) {
  view nothing;
  nothing.attack.fill(-100);
  pitch p(*this, {sees(1), sees(1), sees(1), sees(1), nothing});
  int steps = 0, wrong = 0;
  for (; p.now < at(10000); ++steps) {
    p.step();
    int attackers = 0;
    for (auto const& r : p.robots) attackers += r.believes(play_id)->part(r.self()) == does(int(r.self()), attack);
    wrong += attackers != 1;
  }
  EXPECT_EQ(p.reigns[5], 0);
  EXPECT_EQ(p.detections[5], 0);
  EXPECT_LE(wrong * 100, steps * 3) << wrong << " of " << steps;
}

TEST_F(faults, a_leader_that_sees_nothing_valid_any_more_gives_up) {
  auto a = in_play(9);
  a.receive(claim_by(8, 8), start);
  ASSERT_TRUE(a.rule(play_id)->leading());
  view nothing;
  nothing.attack.fill(-100);
  EXPECT_EQ(think(a, nothing, at(30)).reason, decision_reason::no_valid_allocation);
  EXPECT_FALSE(a.rule(play_id)->active());
  EXPECT_EQ(a.receive(sent(8, at(60)), at(60)).claim, claim_outcome::adopted) << "and obeys";
}

TEST_F(faults, claims_keep_no_dead_robot_alive) {
  auto a = in_play(1);
  a.receive(says(2, 1, defend), start);  // its last message
  std::optional<int> gone;
  for (int ms = 0; ms <= 6000; ms += 100) {
    auto c = claim_by(9, 9, static_cast<std::uint64_t>(1 + ms / 2000));
    c.remaining = seconds(2) - milliseconds(ms % 2000);
    c.atoms.insert(does(2, defend));
    c.ages = {milliseconds(ms), rota::duration{}};
    a.receive(c, at(ms));
    (void)think(a, sees(1), at(ms));
    if (!gone && !a.believes(play_id)->takes_part(agent(2))) gone = ms;
    if (gone) {
      EXPECT_FALSE(a.believes(play_id)->takes_part(agent(2))) << ms;
    }
  }
  ASSERT_TRUE(gone);
  EXPECT_LE(*gone, 2100);
}

TEST_F(faults, a_copy_with_a_corrupt_time_ends_no_reign_at_once) {
  auto a = in_play(1);
  a.receive(claim_by(9, 9), start);
  auto c = claim_by(9, 9);
  c.remaining = rota::nanoseconds(1);
  a.receive(c, at(10));
  EXPECT_TRUE(a.rule(play_id)->obeying());
  EXPECT_EQ(a.rule(play_id)->expiry(), at(2000) - a.options().max_delay);
}

TEST_F(faults, beside_a_greater_leader_that_is_still_heard_nobody_leads) {
  rota::robot_options options;
  options.cycles = 2;
  for (bool const heard : {true, false}) {
    auto a = in_play(1, options);
    a.receive(claim_by(9, 9), start);
    std::uint64_t sequence = 0;
    bool led = false, detected = false;
    for (int ms = 100; ms < 1000; ms += 50) {
      auto const now = at(ms) + milliseconds(2100);  // this robot's clock has jumped
      if (heard) a.receive(sent(9, at(ms)), now);
      a.receive(says(2, ++sequence, attack), now);
      auto const d = think(a, sees(1), now);
      led |= d.reign_began;
      detected |= d.detected.has_value();
      if (led) break;
    }
    EXPECT_TRUE(detected);
    EXPECT_EQ(led, !heard);
  }
}

TEST_F(faults, a_robot_whose_incarnation_went_back_is_heard_after_half_a_minute) {
  auto a = in_play(1);
  auto m = says(2, 500, defend);
  m.number.incarnation = {7};
  a.receive(m, start);
  m = says(2, 1, attack);  // restarted, by a clock without battery
  m.number.incarnation = {3};
  EXPECT_EQ(a.receive(m, at(1000)).verdict, verdict::stale);
  EXPECT_EQ(a.receive(m, at(30000)).verdict, verdict::stale);
  EXPECT_EQ(a.receive(m, at(30001)).verdict, verdict::accepted);
  EXPECT_EQ(a.believes(play_id)->part(agent(2)), does(2, attack));
  EXPECT_EQ(a.receive(m, at(30002)).verdict, verdict::stale);
  auto c = claim_by(2, 2);
  c.incarnation = {3};
  EXPECT_EQ(a.receive(c, at(30003)).claim, claim_outcome::adopted) << "its claims count anew, too";
}

TEST_F(faults, an_own_id_from_another_life_is_reported) {
  robot a(agent(5), squad(9), rota::incarnation{4});
  a.enter(play, start);
  auto m = says(5, 1, defend);
  for (auto const& [incarnation, reason] : {std::pair{3u, refusal::own_former_life}, std::pair{4u, refusal::own_id},
                                            std::pair{5u, refusal::own_later_life}}) {
    m.number.incarnation = {incarnation};
    EXPECT_EQ(a.receive(m, start).reason, reason);
    auto c = claim_by(5, 5);
    c.incarnation = {incarnation};
    EXPECT_EQ(a.receive(c, start).reason, reason);
  }
}

TEST_F(faults, numbers_out_of_reach_are_refused_and_a_forged_one_is_forgotten) {
  auto a = in_play(1);
  a.receive(says(2, 5, defend), start);
  a.receive(claim_by(9, 9, 5), start);
  auto const before = a;
  auto const refused = [&](message const& m) {
    auto const r = a.receive(m, at(10));
    EXPECT_EQ(r.reason, refusal::number_out_of_reach);
    EXPECT_EQ(a, before);
  };
  for (std::uint64_t const far : {5 + rota::most_jump + 1, std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
    refused(says(2, far, attack));
    refused(claim_by(9, 9, far));
    auto c = claim_by(9, 9, 5);
    c.version = far;
    refused(c);
  }
  auto m = says(2, 6, attack);
  m.number.incarnation = {~std::uint64_t{0}};
  refused(m);
  m = says(2, 6, attack);
  m.claims = ~std::uint64_t{0};
  refused(m);
  m.claims = 2;
  m.types[0].leads = 3;
  EXPECT_EQ(a.receive(m, at(10)).reason, refusal::foreign_claim);

  EXPECT_EQ(a.receive(says(2, 5 + rota::most_jump, attack), at(10)).verdict, verdict::accepted);
  EXPECT_EQ(a.receive(says(2, 6, defend), at(100)).verdict, verdict::stale)
      << "a forgery within reach mutes its victim";
  EXPECT_EQ(a.receive(says(2, 7, defend), at(40000)).verdict, verdict::accepted) << "but not for long";
}

TEST_F(faults, a_forged_claim_of_another_life_mutes_nobody) {
  auto a = in_play(1);
  a.receive(says(9, 1, defend), start);
  auto forged = claim_by(9, 3);
  forged.incarnation = {1000};
  a.receive(forged, start);
  EXPECT_EQ(a.receive(claim_by(9, 9), at(2000)).claim, claim_outcome::expired);
  a.receive(says(9, 2, defend), at(2600));
  EXPECT_EQ(a.receive(claim_by(9, 9), at(2700)).claim, claim_outcome::adopted);
}

/// A forged plan message says that a forged claim is over. Its leader has made no such claim: the next genuine one heals it.
TEST_F(faults, a_forged_claim_that_is_declared_over_mutes_nobody) {
  auto a = in_play(1);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(9, 9, 1'000'000), start);
  a.receive(leaves(9, 2, 1'000'000), at(10));
  ASSERT_FALSE(a.rule(play_id)->active());
  a.receive(says(9, 3, defend), at(100));
  EXPECT_EQ(a.receive(claim_by(9, 9), at(110)).claim, claim_outcome::expired) << "it may be late";
  a.receive(says(9, 4, defend), at(2600));
  EXPECT_EQ(a.receive(claim_by(9, 9), at(2610)).claim, claim_outcome::adopted);
}

TEST_F(faults, one_version_says_one_thing) {
  auto a = in_play(1);
  a.receive(claim_by(9, 9), start);
  auto const before = a;
  EXPECT_EQ(a.receive(claim_by(9, 3), start).reason, refusal::foreign_stamp);
  EXPECT_EQ(a, before);
}

TEST_F(faults, more_types_than_a_message_may_have_are_refused) {
  auto a = in_play(1);
  auto m = says_nothing(2, 1);
  for (int i = 0; i <= static_cast<int>(m.most_types); ++i) m.types.push_back({soccer::plan_type(100 + i)});
  EXPECT_EQ(a.receive(m, start).reason, refusal::too_many_types);
  m.types.pop_back();
  EXPECT_EQ(a.receive(m, start).verdict, verdict::accepted);
}

TEST_F(faults, a_clock_that_is_set_back_takes_everything_back_with_it) {
  auto a = in_play(1);
  a.receive(says(2, 1, defend), at(10000));
  a.receive(sent(9, start), at(10000));
  auto b = in_play(1);
  b.receive(says(2, 1, defend), at(4000));
  b.receive(sent(9, start), at(4000));
  EXPECT_TRUE(a.next_message(at(10000)));
  EXPECT_TRUE(b.next_message(at(4000)));
  auto const d = think(a, sees(1), at(4000));  // six seconds back
  EXPECT_EQ(d.clock_set_back, seconds(6));
  EXPECT_EQ(think(b, sees(1), at(4000)).clock_set_back, rota::duration{});
  EXPECT_EQ(a.rule(play_id)->expiry(), b.rule(play_id)->expiry());
  EXPECT_EQ(a.believes(play_id)->heard(agent(2)), at(4000));
  for (int ms = 4000; ms < 8000; ms += 10) {
    EXPECT_EQ(a.next_due(), b.next_due()) << ms;
    EXPECT_EQ(a.next_message(at(ms)).has_value(), b.next_message(at(ms)).has_value()) << ms;
    EXPECT_EQ(think(a, sees(1), at(ms)).own, think(b, sees(1), at(ms)).own) << ms;
  }
  EXPECT_FALSE(a.believes(play_id)->takes_part(agent(2)));
}

TEST_F(faults, instants_below_zero_are_instants) {
  rota::robot_options options;
  options.first_message = at(40);
  robot a(agent(1), squad(9), rota::incarnation{1}, options);
  auto const begin = start - seconds(1000);
  a.enter(play, begin);
  int said = 0;
  for (int ms = 0; ms < 1000; ms += 10) {
    auto const now = begin + milliseconds(ms);
    if (a.next_message(now)) {
      ++said;
      EXPECT_EQ(ms % 100, 40);
    }
    EXPECT_GT(a.next_due(), now);
    EXPECT_LE(a.next_due(), now + milliseconds(100));
  }
  EXPECT_EQ(said, 10);
}

TEST_F(faults, an_answer_lasts_no_longer_than_what_it_answers) {
  auto a = in_play(9);
  EXPECT_EQ(a.receive(sent(4, at(1500)), at(1500)).claim, claim_outcome::challenged);
  EXPECT_EQ(a.rule(play_id)->expiry(), at(2000));
}

/// With confidences that change, i answers j, which answers i, and so on, unless stamps hold still.
TEST_F(faults, a_stamp_holds_for_as_long_as_a_claim_can_live) {
  auto a = in_play(3);
  a.receive(claim_by(2, 2), start);
  ASSERT_TRUE(a.rule(play_id)->leading());
  EXPECT_EQ(a.rule(play_id)->current().stamp, (rota::claim_stamp<soccer>{0, agent(3)}));
  auto greater = claim_by(2, 2, 2);
  greater.stamp.confidence = 1;
  a.receive(greater, at(10));
  EXPECT_TRUE(a.rule(play_id)->obeying());
  a.set_confidence(5);
  a.receive(leaves(2, 1, 2), at(20));
  EXPECT_EQ(a.receive(claim_by(4, 4), at(30)).claim, claim_outcome::adopted) << "it was 3, and stays so for now";
  EXPECT_EQ(a.receive(claim_by(4, 4, 2), at(2040)).claim, claim_outcome::challenged);
}

/// A line 1 – 2 – 3: only neighbours hear each other. Robot 2 forwards what is news.
TEST_F(faults, forwarding_what_is_news_makes_a_line_a_team_and_ends) {
  for (bool const relays : {true, false}) {
    std::vector<robot> line;
    for (int n = 1; n <= 3; ++n) {
      rota::robot_options options;
      options.first_message = at(37 * n);
      robot r(agent(n), squad(3), rota::incarnation{1}, options);
      r.enter(play, start);
      line.push_back(r);
    }
    int attackers_wrong = 0, steps = 0;
    std::size_t forwarded = 0, spoken = 0;
    std::vector<std::pair<std::size_t, message>> air;  // who says what
    for (auto now = start; now < at(5000); now = now + milliseconds(1)) {
      for (std::size_t i = 0; i < 3; ++i) {
        // 1 and 3 are each sure that they are closest.
        if ((now.ns / 1'000'000) % 30 == static_cast<std::int64_t>(i * 7))
          (void)think(line[i], sees(i == 0 ? 1 : 3), now);
        while (auto m = line[i].next_message(now)) air.emplace_back(i, *m), ++spoken;
      }
      while (!air.empty()) {
        auto const [from, m] = air.back();
        air.pop_back();
        for (std::size_t to = 0; to < 3; ++to) {
          if (to + 1 != from && from + 1 != to) continue;
          if (!line[to].receive(m, now).relay || !relays) continue;
          air.emplace_back(to, m);
          ASSERT_LT(++forwarded, 4 * spoken + 100) << "forwarding does not end";
        }
      }
      int attackers = 0;
      for (auto const& r : line) attackers += r.believes(play_id)->part(r.self()) == does(int(r.self()), attack);
      if (now > at(1000)) ++steps, attackers_wrong += attackers != 1;
    }
    if (relays) {
      EXPECT_LE(attackers_wrong * 5, steps) << attackers_wrong;
    } else {
      EXPECT_GE(attackers_wrong * 3, steps) << attackers_wrong;
    }
  }
}

TEST_F(faults, news_is_said_before_the_next_slot_if_so_wished_and_twice) {
  rota::robot_options options;
  options.message_period = milliseconds(500);
  options.change_period = milliseconds(50);
  auto a = in_play(1, options);
  ASSERT_TRUE(a.next_message(start));
  (void)think(a, sees(1), at(10));
  EXPECT_EQ(a.next_due(), at(50)) << "no more often than that";
  EXPECT_FALSE(a.next_message(at(49)));
  EXPECT_TRUE(a.next_message(at(50)));
  EXPECT_EQ(a.next_due(), at(100)) << "once more, as a message may be lost";
  EXPECT_TRUE(a.next_message(at(100)));
  EXPECT_EQ(a.next_due(), at(500)) << "nothing is news: the slow beat";
  (void)think(a, sees(1), at(110));
  EXPECT_EQ(a.next_due(), at(500));
  a.receive(says(2, 1, attack), at(120));
  EXPECT_EQ(a.next_due(), at(500)) << "what others say is no news of one's own";
  (void)think(a, sees(1), at(130));
  EXPECT_EQ(a.next_due(), at(150)) << "but not to go along with it is, though the own task stays";
  EXPECT_TRUE(a.next_message(at(150)));
  EXPECT_TRUE(a.next_message(at(200)));
  EXPECT_EQ(a.next_due(), at(500));
}

TEST_F(faults, a_disagreement_that_a_fingerprint_shows_is_answered_once) {
  rota::robot_options options;
  options.message_period = milliseconds(500);
  options.change_period = milliseconds(50);
  options.fingerprints = true;
  auto a = in_play(1, options);
  (void)think(a, sees(1), start);
  for (int ms : {0, 50}) EXPECT_TRUE(a.next_message(at(ms)));
  auto m = says(2, 1, defend);
  m.types[0].fingerprint = 0;
  EXPECT_EQ(a.receive(m, at(60)).disagreements.size(), 1u);
  EXPECT_EQ(a.next_due(), at(100));
  EXPECT_TRUE(a.next_message(at(100)));
  EXPECT_EQ(a.next_due(), at(500));
}

TEST_F(faults, a_fingerprint_shows_from_one_message_that_two_believe_otherwise_of_a_third) {
  rota::robot_options options;
  options.fingerprints = true;
  auto a = in_play(1, options), b = in_play(2, options);
  auto const tell = [&](robot& from, robot& to, rota::instant now) {
    std::optional<rota::reception<soccer>> last;
    while (auto m = from.next_message(now)) last = to.receive(*m, now);
    return last;
  };
  for (auto* r : {&a, &b}) {
    r->receive(says(3, 1, defend), start);
    (void)think(*r, sees(1), start);
  }
  (void)tell(a, b, start), (void)tell(b, a, start);
  for (auto* r : {&a, &b}) (void)think(*r, sees(1), at(90));
  auto agreed = tell(a, b, at(100));
  ASSERT_TRUE(agreed);
  EXPECT_TRUE(agreed->disagreements.empty());
  b.receive(says_nothing(3, 2), at(150));  // a has not heard that 3 left
  (void)think(b, sees(1), at(160));
  auto const disagreed = tell(a, b, at(200));
  ASSERT_TRUE(disagreed);
  EXPECT_EQ(disagreed->disagreements.size(), 1u);
}

}  // namespace

}  // namespace faults_test
