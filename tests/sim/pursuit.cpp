// Who attacks beside who should: hand-made logs whose figures can be counted with one's fingers, and a real one counted otherwise.
#include <gtest/gtest.h>

#include "plays.hpp"

#include <algorithm>
#include <bit>
#include <vector>

namespace pursuit_test {

namespace {

using namespace rota;
using namespace rota::sim;

/// Two robots, told by hand what they do. Robot 0 stands left of the centre, robot 1 right of it.
class by_hand {
public:
  explicit by_hand(instant begin = {}) : watch_(book_, members_, begin) {
    truth_.robots = {{{-metres(2), 0}, {}, {}}, {{metres(2), 0}, {}, {}}};
    truth_.ball = {-metres(1), 0};
    for (std::size_t i = 0; i < 2; ++i) tell(0, i, happening::entered);
  }
  /// The ball is nearest to this robot from now on; a deliberation of robot 0 reads it.
  void nearest(std::int64_t ms, std::size_t robot) {
    truth_.ball.x = robot == 0 ? -metres(1) : metres(1);
    tell(ms, 0, happening::deliberated);
  }
  void attack(std::int64_t ms, std::size_t robot, bool yes = true) {
    auto const before = believed_[robot];
    names::agent const self{robot + 1};
    believed_[robot] = {};
    if (yes) believed_[robot].insert(in<names>{self, {1}, {1}});
    tell(ms, robot, happening::deliberated, difference(before, believed_[robot]));
  }
  void tell(std::int64_t ms, std::size_t robot, happening what, event<in<names>> const& change = {}) {
    watch_(log_record{instant{} + milliseconds(ms), robot, what, change, believed_[robot], truth_});
  }
  [[nodiscard]] pursuit_figures finish(std::int64_t ms) { return watch_.finish(instant{} + milliseconds(ms)); }

private:
  playbook book_ = duel_playbook();
  team<names> members_ = team_of(2);
  world_state truth_;
  allocation_atoms<names> believed_[2];
  pursuit_watch watch_;
};

TEST(pursuit, counts_the_time_without_exactly_one_attacker_and_with_a_wrong_one) {
  by_hand log;
  log.attack(100, 0);         // 0 to 100: none
  log.attack(300, 1);         // 300 to 700: two, one of them wrong
  log.attack(700, 0, false);  // 700 to 900: the wrong one alone
  log.nearest(900, 1);        // now it is the right one
  auto const f = log.finish(1000);
  EXPECT_EQ(f.not_one, milliseconds(500));
  EXPECT_EQ(f.wrong, milliseconds(600));
}

TEST(pursuit, counts_nothing_before_the_beginning) {
  by_hand log(instant{} + milliseconds(600));
  log.attack(500, 1);
  auto const f = log.finish(1000);
  EXPECT_EQ(f.not_one, duration{});
  EXPECT_EQ(f.wrong, milliseconds(400));
}

TEST(pursuit, who_has_left_or_crashed_neither_attacks_nor_should) {
  for (auto const gone : {happening::left, happening::crashed}) {
    by_hand log;
    log.attack(0, 0);
    log.attack(0, 1);
    log.tell(400, 0, gone);
    auto const f = log.finish(1000);
    EXPECT_EQ(f.not_one, milliseconds(400));
    EXPECT_EQ(f.wrong, milliseconds(400)) << "then robot 1 is the best of those who play";
  }
}

TEST(pursuit, a_reaction_takes_from_the_change_until_exactly_the_right_one_attacks) {
  by_hand log;
  log.attack(0, 0);
  log.nearest(2000, 1);
  log.attack(2090, 1);
  log.attack(2120, 0, false);
  auto const f = log.finish(5000);
  EXPECT_EQ(f.reactions.count(), 1u);
  EXPECT_EQ(f.reactions.mean_ms(), 120);
  EXPECT_EQ(f.missed, 0u);
}

TEST(pursuit, a_slow_reaction_counts_as_soon_as_it_comes_and_a_prepared_one_as_none) {
  by_hand log;
  log.attack(0, 0);
  log.nearest(2000, 1);
  log.attack(4500, 0, false);
  log.attack(4500, 1);  // after 2.5 s
  log.attack(6000, 1, false);
  log.attack(6000, 0);
  log.nearest(7000, 0);  // it attacks already
  auto const f = log.finish(9000);
  EXPECT_EQ(f.reactions.count(), 2u);
  EXPECT_EQ(f.reactions.longest_ms(), 2500);
  EXPECT_EQ(f.reactions.mean_ms(), 1250);
  EXPECT_EQ(f.missed, 0u);
}

TEST(pursuit, a_change_that_does_not_last_asks_for_no_reaction_and_ends_no_other) {
  by_hand log;
  log.attack(0, 0);
  log.nearest(2000, 1);
  log.nearest(2999, 0);
  EXPECT_EQ(by_hand(log).finish(9000).missed, 0u) << "shorter than a second";
  log.nearest(4000, 1);
  log.nearest(5500, 0);
  log.nearest(5600, 1);
  log.attack(6000, 0, false);
  log.attack(6000, 1);
  auto const f = log.finish(9000);
  EXPECT_EQ(f.reactions.count(), 1u);
  EXPECT_EQ(f.reactions.longest_ms(), 2000);
  EXPECT_EQ(f.missed, 0u);
}

TEST(pursuit, a_change_is_missed_if_another_or_the_end_comes_first) {
  by_hand log;
  log.attack(0, 0);
  log.nearest(2000, 1);
  log.nearest(4000, 0);  // missed; robot 0 attacks still
  log.nearest(6000, 1);  // missed
  auto const f = log.finish(8000);
  EXPECT_EQ(f.reactions.count(), 1u);
  EXPECT_EQ(f.reactions.longest_ms(), 0);
  EXPECT_EQ(f.missed, 2u);
}

/// The same shares from a real run, by sampling every millisecond who attacks and who is best.
TEST(pursuit, shares_of_a_real_run_are_those_that_sampling_finds) {
  auto const book = soccer();
  auto options = brief(scenario::ball_fight, true);
  options.team.robot.renewals = 0;  // or else there is next to nothing to count
  struct sample {
    std::int64_t ms;
    std::uint32_t attacking;
    std::uint32_t best;
  };
  std::vector<sample> samples;
  std::uint32_t attacking = 0, best = 0;
  workspace space;
  auto const members = team_of(5);
  auto const f = play(book, options, [&](log_record const& r) {
    auto const bit = std::uint32_t{1} << r.robot;
    attacking &= ~bit;
    if (r.believed.contains({{r.robot + 1}, {1}, {1}})) attacking |= bit;
    if (r.what == happening::deliberated) {
      perceived truth;
      know(r.truth, truth);
      best = 0;
      auto const allocation = best_allocation(problem(book.type, members, truth), space);
      ASSERT_TRUE(allocation);
      for (auto const& x : allocation->atoms)
        if (x.task == names::task{1}) best |= std::uint32_t{1} << (x.agent.value - 1);
    }
    samples.push_back({r.time.ns / 1'000'000, attacking, best});
  });
  std::int64_t not_one = 0, wrong = 0;
  std::size_t at = 0;
  for (std::int64_t ms = 2000; ms < 62'000; ++ms) {
    while (at + 1 < samples.size() && samples[at + 1].ms < ms) ++at;
    not_one += std::popcount(samples[at].attacking) == 1 ? 0 : 1;
    wrong += (samples[at].attacking & ~samples[at].best) == 0 ? 0 : 1;
  }
  EXPECT_NEAR(f.not_one_share(), static_cast<double>(not_one) / 60'000, 0.002);
  EXPECT_NEAR(f.wrong_share(), static_cast<double>(wrong) / 60'000, 0.002);
  EXPECT_GT(not_one, 1000);
  EXPECT_GT(wrong, 1000);
}

TEST(statistics, of_two_runs_add_up) {
  length_statistics a, b, both;
  EXPECT_EQ(a.mean_ms(), 0);
  for (int i = 1; i <= 10; ++i) (i % 3 == 0 ? a : b).add(milliseconds(i)), both.add(milliseconds(i));
  a.add(b);
  EXPECT_EQ(a.count(), 10u);
  EXPECT_EQ(a.mean_ms(), 5.5);
  for (unsigned const percent : {10u, 50u, 95u}) EXPECT_EQ(a.percentile_ms(percent), both.percentile_ms(percent));
}

}  // namespace

}  // namespace pursuit_test
