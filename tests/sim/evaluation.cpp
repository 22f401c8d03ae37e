#include <gtest/gtest.h>

#include "plays.hpp"

#include <rota/team/conflict.hpp>
#include <rota/team/monitors/literal.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace evaluation_test {

namespace {

using namespace rota;
using namespace rota::sim;

/// What a simple reader makes of a log: everything kept, everything compared with everything.
struct reading {
  double conflict_share = 0;
  std::vector<std::int64_t> lengths;  // of episodes, in tenths of a millisecond, ascending
  std::uint64_t cycles = 0, detections = 0, reigns = 0, renewals = 0, right = 0;
  std::vector<std::uint64_t> led = std::vector<std::uint64_t>(5);
};

/// Who attacks in the best allocation under the true world, by enumeration of all 4^5 ways to hand out Attack (1 of 5),
/// Defend (1 or 2), Support (0 to 2) and idling.
std::size_t true_attacker(world_state const& w) {
  auto const gap = [](point a, point b) {
    return std::hypot(to_metres(a.x) - to_metres(b.x), to_metres(a.y) - to_metres(b.y));
  };
  double const diagonal = std::hypot(18.0, 12.0);
  double best = -1;
  std::size_t who = 0;
  for (unsigned code = 0; code < 1024; ++code) {
    double total = 0;
    int count[4] = {};
    std::size_t attacker = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      unsigned const task = code >> (2 * i) & 3U;
      ++count[task];
      point const at = w.robots[i].position;
      if (task == 1) attacker = i;
      if (task == 1) total += diagonal - gap(at, w.ball);
      if (task == 2) total += (diagonal - gap(at, {metres(-6), 0})) / 16;
      if (task == 3) total += (diagonal - gap(at, {metres(-2), metres(3)})) / 16;
    }
    bool const valid = count[1] == 1 && count[2] >= 1 && count[2] <= 2 && count[3] <= 2;
    if (valid && total > best) {
      best = total;
      who = attacker;
    }
  }
  return who;
}

reading read(std::vector<line> const& log, instant begin, instant end) {
  reading r;

  // When the team was in conflict: beliefs follow from the changes alone.
  struct stretch {
    instant from;
    bool conflict;
  };
  std::vector<stretch> stretches;
  std::vector<allocation_atoms<>> beliefs(5);
  for (std::size_t i = 0; i < log.size(); ++i) {
    auto const applied = apply(log[i].change, beliefs[log[i].robot]);
    EXPECT_TRUE(applied);
    beliefs[log[i].robot] = applied.value();
    EXPECT_EQ(beliefs[log[i].robot], log[i].believed);
    if (i + 1 < log.size() && log[i + 1].time == log[i].time) continue;
    bool conflict = false;
    for (auto const& c1 : beliefs)
      for (auto const& c2 : beliefs) conflict |= conflicts_with(allocation<>{{1}, c1}, allocation<>{{1}, c2});
    stretches.push_back({log[i].time, conflict});
  }
  auto const until = [&](std::size_t i) { return i + 1 < stretches.size() ? stretches[i + 1].from : end; };

  duration total{};
  std::vector<std::pair<instant, instant>> conflicts;  // merged where they touch
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    instant const from = std::max(stretches[i].from, begin);
    instant const to = until(i);
    if (!stretches[i].conflict || to <= from) continue;
    total += to - from;
    if (!conflicts.empty() && conflicts.back().second == from) {
      conflicts.back().second = to;
    } else {
      conflicts.emplace_back(from, to);
    }
  }
  r.conflict_share = to_seconds(total) / to_seconds(end - begin);
  for (std::size_t i = 0; i < conflicts.size();) {
    std::size_t last = i;
    while (last + 1 < conflicts.size() && conflicts[last + 1].first - conflicts[last].second < milliseconds(300))
      ++last;
    r.lengths.push_back((conflicts[last].second - conflicts[i].first).ns / 100'000);
    i = last + 1;
  }
  std::sort(r.lengths.begin(), r.lengths.end());

  for (std::size_t i = 0; i < log.size(); ++i) {
    if (log[i].time < begin) continue;
    r.cycles += log[i].cycles;
    r.detections += log[i].detected && log[i].what == happening::deliberated ? 1 : 0;
    bool const renewed = log[i].what == happening::reign_renewed;
    if (log[i].what != happening::reign_began && !renewed) continue;
    auto const mine = [&](line const& x) { return x.robot == log[i].robot; };
    std::size_t judged = log[i].detected || renewed ? i : i + 1;
    while (judged < log.size() && judged > i &&
           !(mine(log[judged]) && log[judged].what == happening::deliberated && log[judged].leading))
      ++judged;
    std::size_t ended = i + 1;
    while (ended < log.size() && !(mine(log[ended]) && (log[ended].what == happening::reign_ended ||
                                                        log[ended].what == happening::reign_renewed)))
      ++ended;
    if (judged > ended || judged == log.size()) continue;
    if (ended < log.size() && log[ended].superseded && log[ended].time - log[i].time < milliseconds(300)) continue;
    if (ended == log.size() && end - log[i].time < milliseconds(300)) continue;
    ++(renewed ? r.renewals : r.reigns);
    ++r.led[log[i].robot];
    bool const right = log[judged].believed.contains({{true_attacker(log[judged].truth) + 1}, {1}, {1}});
    r.right += right ? 1 : 0;
  }
  return r;
}

double percentile(std::vector<std::int64_t> const& sorted, double q) {
  if (sorted.empty()) return 0;
  auto const rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(sorted.size()) - 1e-9));
  return static_cast<double>(sorted[std::max<std::size_t>(rank, 1) - 1]) / 10;
}

std::string printed(figures const& f) {
  std::ostringstream out;
  out << f.measured.ns << ' ' << f.in_conflict.ns << ' ' << f.episodes.count() << ' ' << f.episodes.percentile_ms(50)
      << ' ' << f.episodes.percentile_ms(99) << ' ' << f.episodes.longest_ms() << ' ' << f.cycles << ' ' << f.detections
      << ' ' << f.reigns << ' ' << f.right << ' ' << f.deliberations << ' ' << f.messages << ' ' << f.perception_digest;
  return out.str();
}

class scenarios : public testing::TestWithParam<scenario> {};
INSTANTIATE_TEST_SUITE_P(evaluation, scenarios, testing::ValuesIn(all_scenarios), [](auto const& it) {
  std::string name(to_string(it.param));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_P(scenarios, every_figure_follows_from_the_log_and_resolution_shortens_episodes) {
  auto const book = soccer();
  figures of[2];
  for (bool const resolution : {false, true}) {
    SCOPED_TRACE(resolution ? "on" : "off");
    std::vector<line> log;
    auto const options = brief(GetParam(), resolution);
    auto const& f = of[resolution] = play(book, options, recorder{log});
    instant const begin = instant{} + options.warm_up;
    auto const r = read(log, begin, begin + *options.length);
    EXPECT_DOUBLE_EQ(f.conflict_share(), r.conflict_share);
    EXPECT_EQ(f.episodes.count(), r.lengths.size());
    EXPECT_EQ(f.episodes.percentile_ms(50), percentile(r.lengths, 0.5));
    EXPECT_EQ(f.episodes.percentile_ms(99), percentile(r.lengths, 0.99));
    EXPECT_EQ(f.episodes.longest_ms(), percentile(r.lengths, 1));
    EXPECT_EQ(f.cycles, r.cycles);
    EXPECT_EQ(f.detections, r.detections);
    EXPECT_EQ(f.reigns, r.reigns);
    EXPECT_EQ(f.renewals, r.renewals);
    EXPECT_EQ(f.right, r.right);
    EXPECT_EQ(f.led, r.led);
  }
  figures const& off = of[0];
  figures const& on = of[1];
  EXPECT_EQ(off.perception_digest, on.perception_digest);
  EXPECT_EQ(off.deliberations, on.deliberations);
  EXPECT_EQ(off.reigns, 0U);
  EXPECT_LE(on.episodes.longest_ms(), 4000);
  EXPECT_TRUE(on.resolved());
  EXPECT_LT(on.conflict_share(), off.conflict_share());
  if (!is_persistent(GetParam())) return;
  EXPECT_GT(off.episodes.longest_ms(), 10'000);
  EXPECT_FALSE(off.resolved());
  EXPECT_LT(on.episodes.percentile_ms(50), off.episodes.percentile_ms(50));
  EXPECT_LT(on.episodes.percentile_ms(99), off.episodes.percentile_ms(99));
  EXPECT_GT(on.terms(), 10U) << "reigns and renewals: the cause lasts";
}

/// As the paper has it, whatever the options say: reigns of fixed length, ids, and the literal monitor.
TEST(evaluation, as_published_is_the_paper_s_behaviour) {
  auto const book = soccer();
  auto options = brief(scenario::ball_fight, true);
  options.team.stamp = [](knowledge const& k) { return k.self == 0 ? 9U : 0U; };
  auto const published = play_as_published(book, options);
  EXPECT_GT(published.reigns, 10U) << "the conflict is back after each reign";
  EXPECT_EQ(published.renewals, 0U);
  EXPECT_EQ(published.led.back(), published.reigns) << "the greatest id leads";
  auto plain = brief(scenario::ball_fight, true);
  plain.team.robot.renewals = 0;
  EXPECT_EQ(printed(play<literal_monitor<names>>(book, plain)), printed(published));
  EXPECT_NE(printed(play(book, plain)), printed(published)) << "another monitor";
}

TEST(evaluation, equal_seeds_give_equal_figures_and_logs_others_do_not) {
  auto const book = soccer();
  for (auto const s : {scenario::ball_fight, scenario::hour}) {
    std::string shown[3];
    std::uint64_t digests[3] = {};
    for (std::size_t i = 0; i < 3; ++i) {
      auto options = brief(s, true, i == 2 ? 8 : 7);
      options.length = seconds(20);
      shown[i] = printed(play(book, options, [&](log_record const& r) {
        for (auto const x : {r.time.ns, static_cast<std::int64_t>(r.robot), static_cast<std::int64_t>(r.what),
                             static_cast<std::int64_t>(r.change.size()), static_cast<std::int64_t>(r.other)})
          digests[i] = scatter(digests[i] ^ static_cast<std::uint64_t>(x));
      }));
    }
    EXPECT_EQ(shown[0], shown[1]);
    EXPECT_EQ(digests[0], digests[1]);
    EXPECT_NE(shown[0], shown[2]);
    EXPECT_NE(digests[0], digests[2]);
  }
}

/// Pinned, so that another compiler, flag or library that changes what robots see is noticed.
TEST(evaluation, perceptions_are_the_same_everywhere) {
  auto const book = soccer();
  std::uint64_t digest = 0;
  for (auto const s : all_scenarios) {
    auto options = brief(s, false, 20110301);
    options.length = seconds(28);  // three rounds
    digest = scatter(digest ^ play(book, options).perception_digest);
  }
  EXPECT_EQ(digest, 6923462404225071532U);
}

/// Nobody's decisions reach the world, the eyes or the clocks, whatever the protocol does.
TEST(evaluation, perceptions_do_not_depend_on_network_monitor_or_plan) {
  auto options = brief(scenario::mislocalised, true);
  options.length = seconds(10);
  auto const expected = play(soccer(), options).perception_digest;
  EXPECT_EQ(play<literal_monitor<names>>(soccer(), options).perception_digest, expected);
  EXPECT_EQ(play(duel_playbook(), options).perception_digest, expected);
  options.team.network.loss = 0.6;
  options.team.robot.cycles = 2;
  EXPECT_EQ(play(soccer(), options).perception_digest, expected);
}

/// The scenarios are what they are called: how many robots act as attackers, most of the time.
TEST(evaluation, phantoms_make_two_pursue_the_ball_or_none) {
  auto const book = soccer();
  for (auto const& [s, expected] : {std::pair(scenario::ball_fight, 2), std::pair(scenario::phantom_two, 2),
                                    std::pair(scenario::phantom_none, 0)}) {
    bool attacks[5] = {};
    std::int64_t times[6] = {};
    (void)play(book, brief(s, false), [&](log_record const& r) {
      if (r.what != happening::deliberated) return;
      attacks[r.robot] = r.believed.contains({{r.robot + 1}, {1}, {1}});
      ++times[std::count(attacks, attacks + 5, true)];
    });
    auto const all = std::accumulate(times, times + 6, std::int64_t{0});
    EXPECT_GT(times[expected] * 2, all) << to_string(s) << ": " << times[0] << ' ' << times[1] << ' ' << times[2];
  }
}

TEST(evaluation, a_team_that_cannot_hear_still_plays) {
  auto options = brief(scenario::ball_fight, true);
  options.length = seconds(5);
  options.team.network.loss = 1;
  auto const f = play(duel_playbook(), options);
  EXPECT_EQ(f.cycles, 0U);
  EXPECT_EQ(f.reigns, 0U);
  EXPECT_EQ(f.conflict_share(), 1);
}

}  // namespace

}  // namespace evaluation_test
