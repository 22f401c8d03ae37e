// How long five robots take to overcome each fault: few runs here, `rota campaign --figures` for many.
#include <gtest/gtest.h>

#include <rota/sim/fault_figures.hpp>

#include <vector>

namespace fault_figures_test {

namespace {

using namespace rota;
using namespace rota::sim;

TEST(fault_figures, stay_within_what_follows_from_the_options) {
  fault_study study;
  study.runs = 2;
  std::vector<std::string_view> steps;
  auto const f = measure_faults(study, [&](std::size_t n, std::string_view what) {
    EXPECT_EQ(n, 9U);
    steps.push_back(what);
  });
  EXPECT_EQ(steps.size(), 9U);
  robot_options const o;
  EXPECT_GT(f.dead_believed_ms, to_milliseconds(o.silence) - 100);
  EXPECT_LE(f.dead_believed_ms, to_milliseconds(o.silence + o.max_delay + o.claim_period));
  EXPECT_GT(f.disagreement_ms, 0);
  EXPECT_LE(f.disagreement_ms, 300);
  EXPECT_GT(f.greater_heard_ms, 0);
  EXPECT_LE(f.greater_heard_ms, 106) << "one message period and the longest delay";
  EXPECT_GT(f.equal_heard_ms, 5900) << "until its old number is passed";
  EXPECT_LE(f.equal_heard_ms, 7200);
  EXPECT_LE(f.others_wrong_share, 0.03);
  EXPECT_LE(f.blind_wrong_share, 0.03);
  EXPECT_LE(f.seeing_wrong_share, 0.01);
  ASSERT_EQ(f.settled.size(), 3U);
  EXPECT_EQ(f.settled[0].loss, 0);
  EXPECT_LE(f.settled[0].settled_ms_p95, 35) << "the greatest answers with its next deliberation";
  for (std::size_t i = 0; i < 3; ++i) EXPECT_GT(f.settled[i].cascades, 15U);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_GT(f.settled[i].settled_ms_p95, f.settled[i - 1].settled_ms_p95);
    EXPECT_GE(f.settled[i].two_leaders_ms, f.settled[i - 1].two_leaders_ms);
  }
}

/// Robots that forget the silent later believe in the dead for longer, and the figure shows it.
TEST(fault_figures, say_so_where_robots_are_worse) {
  fault_study study;
  study.runs = 2;
  study.robot.silence = seconds(4);
  study.robot.opening = {};
  study.robot.claim_period = milliseconds(400);
  sim::detail::fault_runs runs(study);
  EXPECT_GT(runs.dead_believed(), 3900);
  auto const slow = runs.settling(0.6);
  study.robot = {};
  EXPECT_GT(slow.settled_ms_p95, 1.5 * sim::detail::fault_runs(study).settling(0.6).settled_ms_p95);
}

}  // namespace

}  // namespace fault_figures_test
