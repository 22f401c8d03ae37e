// Claims and robots that are over and came back nevertheless: four runs that random faults have found (`rota campaign`).
#include <gtest/gtest.h>

#include "playground.hpp"

namespace ghosts_test {

using rota::claim_outcome;
using rota::duration;
using rota::milliseconds;
using rota::seconds;

namespace {

rota::instant at(int ms) { return start + milliseconds(ms); }

struct ghosts : playground {
  /// Claim `number` of `leader`, of which so much is left.
  static claim with(int leader, std::uint64_t number, duration remaining) {
    auto c = claim_by(leader, leader, number);
    c.remaining = remaining;
    return c;
  }
};

TEST_F(ghosts, a_leaders_first_plan_message_wipes_out_no_knowledge_of_its_claims) {
  auto a = in_play(2);
  EXPECT_EQ(a.receive(claim_by(3, 3), start).claim, claim_outcome::adopted);
  EXPECT_EQ(a.receive(claim_by(9, 9), start).claim, claim_outcome::adopted);
  auto m = says(3, 1, defend);
  m.claims = 1;  // it has given way, too
  a.receive(m, at(10));
  a.receive(says_nothing(9, 1), at(20));
  a.receive(says(9, 2, defend), at(30));
  EXPECT_EQ(a.receive(with(3, 1, milliseconds(1900)), at(150)).claim, claim_outcome::expired) << "a late copy";
}

/// Only a number that would be stale begins a new life.
TEST_F(ghosts, a_claim_stays_over_although_its_leaders_plan_messages_were_unheard_for_long) {
  auto a = in_play(1);
  a.receive(says(9, 1, defend), start);
  EXPECT_EQ(a.receive(with(9, 1, milliseconds(100)), at(31000)).claim, claim_outcome::adopted);
  (void)think(a, sees(1), at(31105));
  auto m = says(9, 311, defend);
  m.claims = m.types[0].leads = 1;
  a.receive(m, at(31110));
  EXPECT_EQ(a.receive(with(9, 1, milliseconds(50)), at(31120)).claim, claim_outcome::expired) << "a late copy";
}

/// A claim says how old the last sign of life was when the claim was sent, and may have been under way for `max_delay`.
TEST_F(ghosts, the_dead_grow_no_younger_with_each_leader_that_passes_them_on) {
  auto a = in_play(1);
  auto const named = [](duration age, std::uint64_t number) {
    auto c = claim_by(9, 9, number);
    c.atoms.insert(does(2, defend));
    c.ages = {age, duration{}};
    return c;
  };
  auto const limit = a.options().silence - a.options().max_delay;
  a.receive(named(limit + milliseconds(1), 1), at(5000));
  EXPECT_FALSE(a.believes(play_id)->takes_part(agent(2)));
  a.receive(named(limit, 2), at(5000));
  ASSERT_TRUE(a.believes(play_id)->takes_part(agent(2)));
  EXPECT_EQ(a.believes(play_id)->heard(agent(2)), at(5000) - a.options().silence);
}

TEST_F(ghosts, a_forged_number_of_a_claim_mutes_its_leader_for_a_reign_and_no_longer) {
  auto a = in_play(1);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(9, 9, 5000), start);
  auto m = says(9, 2, defend);
  m.claims = m.types[0].leads = 6;
  a.receive(m, at(100));
  EXPECT_EQ(a.receive(claim_by(9, 9, 6), at(110)).claim, claim_outcome::expired);
  m.number.sequence = 3;
  a.receive(m, at(2600));
  EXPECT_EQ(a.receive(claim_by(9, 9, 6), at(2610)).claim, claim_outcome::adopted);
}

}  // namespace

}  // namespace ghosts_test
