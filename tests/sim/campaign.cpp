// Teams under random faults keep what is promised; and who promises too much is told, with the seed that shows it.
#include <gtest/gtest.h>

#include <rota/sim/campaign.hpp>

#include <cstdlib>
#include <string>

namespace campaign_test {

namespace {

using namespace rota;
using namespace rota::sim;

/// ROTA_CAMPAIGN multiplies the ticks that are played.
std::uint64_t more() {
  char const* const text = std::getenv("ROTA_CAMPAIGN");
  return text ? std::strtoull(text, nullptr, 10) : 1;
}

std::string shown(campaign_report const& r) {
  if (!r.broken) return "nothing is broken";
  return std::string(to_string(r.broken->what)) + " at " + std::to_string(r.broken->at.ns) + " ns, robot " +
         std::to_string(r.broken->robot + 1) + ": " + r.broken->reason + "\nagain: rota campaign --runs 1 --seed " +
         std::to_string(r.failed);
}

TEST(campaign, no_promise_is_broken_whatever_goes_wrong) {
  campaign_options o;
  o.seed = 20110301;
  o.ticks = 40'000 * more();
  auto const r = run_campaign(o);
  ASSERT_FALSE(r.broken) << shown(r);
  auto const& s = r.seen;
  EXPECT_GE(s.ticks, o.ticks);
  // It went through everything.
  for (auto const outcome : {claim_outcome::adopted, claim_outcome::revised, claim_outcome::repeated,
                             claim_outcome::expired, claim_outcome::outranked, claim_outcome::challenged})
    EXPECT_GT(s.claims[static_cast<std::size_t>(outcome)], 10U) << static_cast<int>(outcome);
  for (auto const n : {s.detections, s.reigns, s.renewals, s.answers, s.given_way, s.stale, s.refused, s.deletions})
    EXPECT_GT(n, 10U);
  for (auto const n : {s.crashes, s.restarts, s.absences}) EXPECT_GT(n, 0U);
  RecordProperty("ticks", std::to_string(s.ticks));
}

TEST(campaign, equal_seeds_give_equal_runs) {
  auto const book = campaign_playbook();
  std::uint64_t digests[3] = {};
  for (std::size_t i = 0; i < 3; ++i)
    (void)play_run(book, make_run(i == 2 ? 78 : 77), [&](log_record const& r) {
      digests[i] = scatter(digests[i] ^ static_cast<std::uint64_t>(r.time.ns) ^ r.robot << 8 ^ r.change.size() << 16 ^
                           static_cast<std::uint64_t>(r.what) << 24);
    });
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_NE(digests[0], digests[2]);
}

TEST(campaign, the_number_of_robots_can_be_given_and_changes_nothing_else_that_is_drawn) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(make_run(seed, 4).robots, 4U);
    auto const drawn = make_run(seed);
    EXPECT_GE(drawn.robots, 2U);
    EXPECT_LE(drawn.robots, 7U);
    EXPECT_EQ(make_run(seed, drawn.robots).end, drawn.end);
    EXPECT_EQ(make_run(seed, 11).team.robot, drawn.team.robot);
  }
}

/// The first seed at which a wrong model is found out, and by which invariant.
template <class Monitor = conflict_monitor<names>, class Spoil>
void expect_broken(invariant what, Spoil spoil, std::uint64_t runs = 60) {
  auto const book = campaign_playbook();
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    auto run = make_run(seed);
    spoil(run);
    auto const r = play_run<Monitor>(book, run);
    if (!r.broken || r.broken->what != what) continue;
    auto const again = play_run<Monitor>(book, run);  // the seed replays it
    ASSERT_TRUE(again.broken);
    EXPECT_EQ(again.broken->at, r.broken->at);
    EXPECT_EQ(again.broken->reason, r.broken->reason);
    return;
  }
  ADD_FAILURE() << "nobody broke: " << to_string(what);
}

TEST(campaign, robots_that_believe_in_the_silent_for_longer_are_found_out) {
  expect_broken(invariant::silent_forgotten,
                [](campaign_run& run) { run.team.robot.silence = run.team.robot.silence + seconds(1); });
}

TEST(campaign, a_radio_that_is_slower_than_promised_is_found_out) {
  expect_broken(invariant::ends_with_leader, [](campaign_run& run) { run.promised.delay = milliseconds(1); });
}

TEST(campaign, robots_that_forget_later_than_promised_are_found_out) {
  expect_broken(invariant::messages_heard, [](campaign_run& run) { run.team.robot.forget = seconds(30); });
}

TEST(campaign, reigns_that_are_longer_than_promised_are_found_out) {
  expect_broken(invariant::reigns_bounded, [](campaign_run& run) {
    run.team.robot.reign = run.team.robot.max_reign = run.team.robot.reign + milliseconds(1);
  });
}

TEST(campaign, a_link_that_stays_broken_is_found_out) {
  expect_broken(invariant::all_hear_all, [](campaign_run& run) {
    for (std::size_t i = 1; i < run.robots; ++i) run.team.faults.broken.push_back({{}, 0, i});
  });
}

TEST(campaign, robots_that_never_agree_are_found_out) {
  expect_broken(invariant::all_agree, [](campaign_run& run) {
    run.team.sensor = {};  // each sees the ball nearer to itself than it is
    run.team.robot.resolution = false;
  });
}

TEST(campaign, greater_robots_that_let_smaller_ones_lead_are_found_out) {
  expect_broken(invariant::smaller_answered, [](campaign_run& run) {
    run.team.faults.confidences = {{0, {}, 5}};  // they have a reason: the smallest has more confidence
    run.promised.answers = run.team.robot.resolution;
  });
}

/// A monitor that is another whenever one looks.
struct restless : conflict_monitor<names> {
  using conflict_monitor<names>::conflict_monitor;
  template <class Digest>
  void digest_into(Digest& d) const {
    d(++looks);
  }
  inline static std::uint64_t looks = 0;
};

TEST(campaign, messages_that_change_something_although_they_do_not_count_are_found_out) {
  auto const r = play_run<restless>(campaign_playbook(), make_run(1));
  ASSERT_TRUE(r.broken);
  EXPECT_EQ(r.broken->what, invariant::nothing_changed);
}

/// A monitor that takes everything for a loop.
struct panic {
  panic() = default;
  explicit panic(monitor_options const&) {}
  void on_message(part_change<names> const& c, instant) { who = c.agent; }
  monitor_verdict<names> on_deliberation(event<in<names>> const&, allocation_atoms<names> const&, instant) {
    return {1, who};
  }
  void forget(names::agent) {}
  void clear() {}
  void shift(duration) {}
  template <class Digest>
  void digest_into(Digest& d) const {
    d(who);
  }
  names::agent who{};
};

TEST(campaign, robots_that_go_on_claiming_are_found_out) {
  expect_broken<panic>(invariant::nobody_rules, [](campaign_run&) {});
}

}  // namespace

}  // namespace campaign_test
