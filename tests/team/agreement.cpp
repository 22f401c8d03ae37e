// Robots with equal beliefs come to agree, whatever the hysteresis and whenever they join; and conflicts of every kind are
// seen.
#include <gtest/gtest.h>

#include "pitch.hpp"

#include <cstdlib>
#include <optional>

namespace agreement_test {

using rota::milliseconds;
using rota::seconds;

namespace {

struct agreement : playground {};

/// How long after the last joining and the last change of the world they still disagreed, or nothing if they do to the end.
std::optional<rota::duration> time_to_agree(playground& f, int team, double h, int before, int after, int seed) {
  auto rng = static_cast<std::uint64_t>(seed) * 0x9e3779b97f4a7c15u + 1;
  auto const below = [&](int n) {
    rng ^= rng << 13, rng ^= rng >> 7, rng ^= rng << 17;
    return static_cast<int>(rng % static_cast<std::uint64_t>(n));
  };
  std::vector<robot> robots;
  std::vector<rota::instant> joins;
  std::vector<int> tick;
  for (int n = 1; n <= team; ++n) {
    rota::robot_options options;
    options.resolution = false;
    options.hysteresis.absolute = h;
    options.first_message = start + milliseconds(below(100));
    robots.emplace_back(agent(n), squad(team), rota::incarnation{1}, options);
    joins.push_back(start + milliseconds(below(3000)));
    tick.push_back(below(30));
  }
  view world = sees(1);
  world.attack[static_cast<std::size_t>(before)] = 1;
  auto const change = start + milliseconds(1000 + below(1500));
  rota::instant last_conflict = start, settled = change;
  for (auto j : joins) settled = std::max(settled, j);
  for (auto now = start; now < start + seconds(6); now = now + milliseconds(1)) {
    if (now == change) world.attack[static_cast<std::size_t>(after)] = 1 + h / 2;  // better by less than the hysteresis
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if (now == joins[i]) robots[i].enter(f.play, now);
      if (now < joins[i]) continue;
      if (now.ns / 1'000'000 % 30 == tick[i]) (void)f.think(robots[i], world, now);
      while (auto m = robots[i].next_message(now))
        for (auto& other : robots)
          if (&other != &robots[i]) other.receive(*m, now);
    }
    for (auto const& r : robots)
      if (now >= settled && r.believes(play_id)->atoms() != robots[0].believes(play_id)->atoms()) last_conflict = now;
  }
  if (last_conflict >= start + seconds(5)) return std::nullopt;
  return last_conflict < settled ? rota::duration{} : last_conflict - settled;
}

/// ROTA_AGREEMENT multiplies the join phases that are played.
int more() {
  char const* const text = std::getenv("ROTA_AGREEMENT");
  return text ? std::atoi(text) : 1;
}

/// docs/protocol.md, Agreement: within (m + 1)(P + L + D), since an own part moves to the optimum once and then stays. Three
/// robots with hysteresis once disagreed for ever, at three of ten phases.
TEST_F(agreement, comes_within_a_bound_whatever_the_hysteresis_and_whenever_they_join) {
  rota::duration longest{};
#ifdef __OPTIMIZE__
  constexpr int seeds = 60;
#else
  constexpr int seeds = 6;
#endif
  for (int seed = 0; seed < seeds * more(); ++seed)
    for (int const team : {2, 3, 4})
      for (double const h : {0.0, 0.1, 0.5}) {
        auto const t = time_to_agree(*this, team, h, 1, 2, seed);
        ASSERT_TRUE(t) << "for ever: seed " << seed << ", " << team << " robots, hysteresis " << h;
        EXPECT_LE(*t, (team + 1) * milliseconds(100 + 30)) << "seed " << seed << ", " << team << " robots, h " << h;
        longest = std::max(longest, *t);
      }
  RecordProperty("longest_ms", static_cast<int>(longest.ns / 1'000'000));
}

TEST_F(agreement, what_was_said_before_a_deliberation_and_after_it_is_combined) {
  rota::robot_options options;
  options.hysteresis.absolute = 0.1;
  auto a = in_play(3, options);
  view world = sees(1);
  world.attack[2] = 1.05;
  a.receive(says(1, 1, attack), start);
  (void)think(a, world);                 // 2 is not here yet: 1 attacks
  a.receive(says(2, 1, defend), start);  // and 2 says that it defends
  EXPECT_EQ(a.believes(play_id)->told(agent(3)), (atoms{does(1, attack), does(2, defend), does(3, defend)}));
  (void)think(a, world);
  EXPECT_EQ(a.believes(play_id)->part(agent(1)), does(1, attack)) << "better by less than the hysteresis";
  EXPECT_EQ(a.believes(play_id)->said(agent(2)), does(2, defend));
}

struct loops : playground {
  /// What robot 1 hears of robot 2 before each deliberation, until it detects.
  template <class Says>
  std::optional<int> deliberations_until_detection(Says const& what_is_said, int most) {
    auto a = in_play(1);
    std::uint64_t sequence = 0;
    auto now = start;
    for (int i = 1; i <= most; ++i) {
      for (auto const& m : what_is_said(i, sequence)) {
        now = now + milliseconds(50);
        a.receive(m, now);
      }
      now = now + milliseconds(50);
      if (think(a, sees(1), now).detected) return i;
    }
    return std::nullopt;
  }
};

TEST_F(loops, insisting_is_seen) {
  EXPECT_EQ(deliberations_until_detection([](int, std::uint64_t& n) { return std::vector{says(2, ++n, attack)}; }, 20),
            4);
}

TEST_F(loops, joining_and_leaving_again_and_again_is_seen) {
  EXPECT_EQ(deliberations_until_detection(
                [](int i, std::uint64_t& n) {
                  std::vector<plan_message> said;
                  if (i > 1) said.push_back(says_nothing(2, ++n));
                  said.push_back(says(2, ++n, attack));
                  return said;
                },
                20),
            4);
}

TEST_F(loops, yielding_for_a_moment_between_cycles_is_seen) {
  EXPECT_EQ(deliberations_until_detection(
                [](int i, std::uint64_t& n) {
                  std::vector<plan_message> said;
                  if (i > 1) said.push_back(says(2, ++n, defend));
                  said.push_back(says(2, ++n, attack));
                  return said;
                },
                20),
            4);
}

}  // namespace

}  // namespace agreement_test
