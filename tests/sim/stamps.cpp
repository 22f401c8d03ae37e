// Who should lead: what each policy makes of what a robot knows, how that reaches the robot, and what it comes to.
#include <gtest/gtest.h>

#include "plays.hpp"

#include <rota/sim/oracle.hpp>
#include <rota/sim/restless_world.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace stamps_test {

namespace {

using namespace rota;
using namespace rota::sim;

/// What five robots know where the ball is at (0, 0) and each sees it; the robots are at x = 1, 2, 3, 4 and 5 m.
struct scene {
  playbook book = soccer();
  team<names> members = team_of(5);
  workspace space;
  std::vector<testimony> says = std::vector<testimony>(5);

  scene() {
    for (std::size_t i = 0; i < 5; ++i) says[i].self = {metres(1 + static_cast<double>(i)), 0};
  }
  [[nodiscard]] std::uint32_t confidence(stamp_policy p, std::size_t robot) {
    perceived seen;
    seen.ball = says[robot].ball;
    seen.blind = says[robot].blind;
    std::vector<std::optional<testimony>> told;
    for (std::size_t i = 0; i < 5; ++i) {
      seen.robots.push_back(says[i].self);
      told.push_back(i == robot ? std::nullopt : std::optional(says[i]));
    }
    return function_of(p)(
        {robot, instant{} + milliseconds(100), seen, says[robot].relocated, told, book, members, space});
  }
  /// The one with the greatest stamp.
  [[nodiscard]] std::size_t leader(stamp_policy p) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < 5; ++i)
      if (confidence(p, i) >= confidence(p, best)) best = i;
    return best;
  }
};

TEST(stamps, each_policy_has_a_name_of_its_own_and_no_other_name_is_one) {
  for (auto const p : all_stamp_policies) EXPECT_EQ(parse_stamp_policy(to_string(p)), p);
  for (auto const* name : {"", "ID", "psychic", "id ", "mates-then"}) EXPECT_FALSE(parse_stamp_policy(name)) << name;
  EXPECT_FALSE(function_of(stamp_policy::id)) << "nothing is asked";
}

TEST(stamps, the_closest_leads_where_all_agree) {
  scene s;
  for (auto const p : {stamp_policy::closeness, stamp_policy::closeness_if_agreed, stamp_policy::mates_then_closeness,
                       stamp_policy::consensus})
    EXPECT_EQ(s.leader(p), 0u) << to_string(p);
  EXPECT_EQ(s.confidence(stamp_policy::mates, 3), 4u);
}

/// Robot 5 sees a ball half a metre before it.
TEST(stamps, who_sees_a_phantom_leads_by_closeness_and_is_outvoted_by_the_others) {
  scene s;
  s.says[4].ball = {metres(4.5), 0};
  EXPECT_EQ(s.leader(stamp_policy::closeness), 4u);
  for (auto const p : {stamp_policy::closeness_if_agreed, stamp_policy::mates_then_closeness, stamp_policy::consensus})
    EXPECT_EQ(s.leader(p), 0u) << to_string(p);
  EXPECT_EQ(s.confidence(stamp_policy::mates, 4), 0u);
}

/// Robot 5 is half a metre from the ball, and believes that it is four metres beside that.
TEST(stamps, who_has_lost_its_place_is_believed_how_far_the_ball_is) {
  scene s;
  s.says[4].self = {metres(0.5), metres(4)};
  s.says[4].ball = {0, metres(4)};
  EXPECT_EQ(s.leader(stamp_policy::consensus), 0u) << "a phantom, as far as anybody knows";
  s.says[4].relocated = true;
  EXPECT_EQ(s.leader(stamp_policy::consensus), 4u) << "its place has jumped, so the place is wrong";
  EXPECT_EQ(s.leader(stamp_policy::mates_then_closeness), 0u) << "counting votes cannot tell";
}

TEST(stamps, who_sees_nothing_leads_last) {
  scene s;
  s.says[0].blind = true;
  for (auto const p : {stamp_policy::closeness, stamp_policy::closeness_if_agreed, stamp_policy::consensus}) {
    EXPECT_EQ(s.confidence(p, 0), 0u) << to_string(p);
    EXPECT_EQ(s.leader(p), 1u) << to_string(p);
  }
}

TEST(stamps, an_old_testimony_does_not_count) {
  for (auto const age : {seconds(1), seconds(3)}) {
    scene s;
    s.says[1].heard = instant{} - age;
    auto const before = s.confidence(stamp_policy::consensus, 0);
    EXPECT_GT(before, 0u);
    s.says[1].self = {metres(-6), 0};  // at the home of Defend: the better for everybody
    EXPECT_EQ(s.confidence(stamp_policy::consensus, 0) == before, age == seconds(3));
  }
}

/// What none can know: which of the two that fight is closer, that robot 5 sees a phantom, and what the choice of each is worth.
TEST(stamps, oracles_know_what_is_true) {
  scene s;
  world_state truth;
  for (auto const& t : s.says) truth.robots.push_back({t.self, {}, {}});
  truth.robots[4].phantom = s.says[4].ball = {metres(4.5), 0};
  auto const knowing = [&](oracle what, std::size_t robot) {
    perceived seen;
    seen.ball = s.says[robot].ball;
    for (auto const& t : s.says) seen.robots.push_back(t.self);
    std::vector<std::optional<testimony>> told(5);
    return confidence_knowing(what, {robot, {}, seen, false, told, s.book, s.members, s.space}, truth, exact_sensor());
  };
  EXPECT_EQ(knowing(oracle::confused, 4), 0u);
  EXPECT_EQ(knowing(oracle::confused, 3), 1u);
  EXPECT_EQ(knowing(oracle::choice, 4), 0u) << "it would go itself";
  EXPECT_EQ(knowing(oracle::choice, 3), 1u) << "it would send robot 1";
  EXPECT_GT(knowing(oracle::eyes, 0), knowing(oracle::eyes, 3)) << "which knows less of robot 1";
  EXPECT_GT(knowing(oracle::eyes, 3), knowing(oracle::eyes, 4));
}

/// What a robot knows: its own eyes, each mate's testimony after its first message, none of its own, and never the truth.
TEST(stamps, a_robot_is_told_by_messages_and_only_by_messages) {
  for (double const loss : {0.0, 1.0}) {
    auto options = brief(scenario::mislocalised, true);
    options.length = seconds(2);
    options.team.network.loss = loss;
    std::size_t asked = 0, told = 0, late = 0;
    options.team.stamp = [&](knowledge const& k) -> std::uint32_t {
      ++asked;
      EXPECT_EQ(k.told.size(), 5u);
      EXPECT_FALSE(k.told[k.self]);
      for (auto const& t : k.told) {
        told += t ? 1 : 0;
        late += t && k.now - t->heard > milliseconds(110) ? 1 : 0;
      }
      return 0;
    };
    (void)play(soccer(), options);
    EXPECT_GT(asked, 600u);
    if (loss == 1) {
      EXPECT_EQ(told, 0u);
    } else {
      EXPECT_GT(told, 4 * (asked - 25)) << "all but in the first messages";
      EXPECT_EQ(late, 0u);
    }
  }
}

/// Asking for a number changes nothing unless the numbers differ: no random stream, no message, no decision.
TEST(stamps, equal_numbers_give_the_run_without_stamps_byte_for_byte) {
  for (auto const s : {scenario::ball_fight, scenario::hour}) {
    std::uint64_t digests[2] = {};
    for (int i = 0; i < 2; ++i) {
      auto options = brief(s, true);
      options.length = seconds(20);
      if (i == 1) options.team.stamp = [](knowledge const&) { return 0u; };
      (void)play(soccer(), options, [&](log_record const& r) {
        for (auto const x : {r.time.ns, static_cast<std::int64_t>(r.robot), static_cast<std::int64_t>(r.what),
                             static_cast<std::int64_t>(r.change.size())})
          digests[i] = scatter(digests[i] ^ static_cast<std::uint64_t>(x));
      });
    }
    EXPECT_EQ(digests[0], digests[1]);
  }
}

/// A policy that is no function of what the robot knows: all reigns end, and everybody obeys one leader all the same.
TEST(stamps, any_numbers_settle) {
  auto options = brief(scenario::ball_fight, true);
  std::uint64_t x = 1;
  options.team.stamp = [&](knowledge const&) { return static_cast<std::uint32_t>(x = scatter(x)); };
  auto const f = play(soccer(), options);
  EXPECT_GT(f.reigns, 0u);
  EXPECT_TRUE(f.resolved());
  EXPECT_LT(f.not_one_share(), 0.1);
}

TEST(stamps, what_a_policy_throws_reaches_the_caller_and_the_simulation_goes_on) {
  auto const book = soccer();
  simulation_options options;
  bool armed = true;
  options.stamp = [&](knowledge const& k) -> std::uint32_t {
    if (armed && k.self == 3) throw std::runtime_error("no idea");
    return 1;
  };
  simulation<scripted_world> team(book, scripted_world(scenario::ball_fight, 5, 1), options);
  std::size_t decided = 0;
  auto const watch = [&](log_record const& r) { decided += r.what == happening::deliberated && r.robot == 3 ? 1 : 0; };
  EXPECT_THROW(team.run(instant{} + seconds(1), watch), std::runtime_error);
  EXPECT_EQ(decided, 0u);
  armed = false;
  team.run(instant{} + seconds(1), watch);
  EXPECT_GT(decided, 30u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(team.robot(i).believes({1})->participants().size(), 5u);
}

/// The figures of docs/evaluation.md at one seed: the best policy is far better than the greatest id.
TEST(stamps, consensus_is_right_far_more_often_than_the_greatest_id) {
  auto const book = soccer();
  std::uint64_t right[2] = {}, terms[2] = {};
  for (auto const s : {scenario::ball_fight, scenario::mislocalised})
    for (int i = 0; i < 2; ++i) {
      auto options = brief(s, true);
      options.team.stamp = function_of(i == 0 ? stamp_policy::id : best_stamp_policy);
      auto const f = play(book, options);
      right[i] += f.right;
      terms[i] += f.terms();
    }
  EXPECT_LT(100 * right[0], 70 * terms[0]);
  EXPECT_GT(100 * right[1], 85 * terms[1]);
}

}  // namespace

}  // namespace stamps_test
