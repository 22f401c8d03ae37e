// Who sees nothing valid abstains; and once it sees again, it is itself again.
#include <gtest/gtest.h>

#include "playground.hpp"

namespace blindness_test {

using rota::milliseconds;

struct blindness : playground {};

// Found by tests/fuzz: its stamp was frozen by the claim that it obeyed before it was ever computed, so it claimed as robot 0.
TEST_F(blindness, who_obeyed_while_blind_claims_in_its_own_name_later) {
  rota::robot_options o;
  o.cycles = 1;
  robot a = in_play(5, o);
  view none;
  none.attack.fill(-100);
  EXPECT_EQ(think(a, none).reason, rota::decision_reason::no_valid_allocation);
  EXPECT_EQ(a.receive(claim_by(9, 9), start + milliseconds(10)).claim, rota::claim_outcome::adopted);
  auto gives_up = says(9, 1, attack);
  gives_up.claims = 1;
  (void)a.receive(gives_up, start + milliseconds(20));
  ASSERT_TRUE(think(a, sees(5), start + milliseconds(30)).reign_began);
  EXPECT_EQ(a.rule(play_id)->current().leader, agent(5));
  EXPECT_EQ(a.rule(play_id)->current().stamp.id, agent(5));
}

}  // namespace blindness_test
