#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "playground.hpp"

#include <rota/team/conflict.hpp>
#include <support/allocation_counter.hpp>

#include <map>
#include <variant>

using rota::decision_reason;
using rota::message_case;
using rota::milliseconds;
using rota::refusal;
using rota::verdict;

namespace {

constexpr rota::instant start{};
constexpr auto attack = soccer::task::attack;
constexpr auto defend = soccer::task::defend;

atom does(int n, soccer::task t) { return {robot(n), soccer::plan::normal, t}; }

struct agent_test : testing::Test {
  rota::plan_type<soccer, view> play = make_play();
  rota::team<soccer> members = make_team(9);
  rota::workspace space;

  robot_agent robot_in_play(int n, rota::agent_options const& options = {}) {
    robot_agent a(robot(n), squad(9), options);
    a.enter(play, start);
    return a;
  }
  rota::decision<soccer> think(robot_agent& a, view const& v, rota::instant now = start) {
    return a.deliberate(play, members, v, now, space);
  }
};

TEST_F(agent_test, enters_alone_decides_and_leaves) {
  auto a = robot_in_play(1);
  EXPECT_FALSE(a.enter(play, start));
  auto const d = think(a, sees(1));
  EXPECT_EQ(d.reason, decision_reason::reallocated);
  EXPECT_EQ(d.event, event::addition(does(1, attack)));
  EXPECT_EQ(d.own, does(1, attack));
  EXPECT_EQ(a.believes(play_id)->state(robot(1)), soccer::state::get_ball) << "the entry state of the task";
  EXPECT_EQ(think(a, sees(1)).reason, decision_reason::kept);
  EXPECT_TRUE(a.leave(play_id));
  EXPECT_FALSE(a.leave(play_id));
  EXPECT_EQ(a.believes(play_id), nullptr);
  EXPECT_EQ(think(a, sees(1)).reason, decision_reason::not_executing);
}

TEST_F(agent_test, a_message_is_one_of_the_four_cases) {
  auto a = robot_in_play(1);
  auto hear = [&, n = std::uint64_t{0}](std::optional<soccer::task> task) mutable { return a.receive(says(2, ++n, task), start); };

  auto joined = hear(defend);
  ASSERT_EQ(joined.changes.size(), 1u);
  EXPECT_EQ(joined.changes[0].what, message_case::joined);
  EXPECT_EQ(joined.changes[0].event, event::addition(does(2, defend)));

  EXPECT_TRUE(hear(defend).changes.empty()) << "agreement";

  auto moved = hear(attack);
  EXPECT_EQ(moved.changes[0].what, message_case::moved);
  EXPECT_EQ(moved.changes[0].event, *event::make({does(2, attack)}, {does(2, defend)}));

  auto idle = hear(std::nullopt);
  EXPECT_EQ(idle.changes[0].what, message_case::left);
  EXPECT_EQ(idle.changes[0].event, event::subtraction(does(2, attack)));
  EXPECT_TRUE(a.believes(play_id)->takes_part(robot(2))) << "taking part without a task is taking part";

  hear(attack);
  auto gone = a.receive(says_nothing(2, 99), start);
  EXPECT_EQ(gone.changes[0].what, message_case::left);
  EXPECT_FALSE(a.believes(play_id)->takes_part(robot(2)));
}

TEST_F(agent_test, several_plan_types_are_independent) {
  auto const defence = make_play(defence_id);
  auto a = robot_in_play(1);
  a.enter(defence, start);
  auto m = says(2, 1, attack, play_id);
  m.types.push_back(says(2, 1, defend, defence_id).types[0]);
  auto const r = a.receive(m, start);
  ASSERT_EQ(r.changes.size(), 2u);
  EXPECT_EQ(r.changes[0].type, play_id);
  EXPECT_EQ(r.changes[1].type, defence_id);
  EXPECT_TRUE(a.believes(play_id)->atoms().contains(does(2, attack)));
  EXPECT_TRUE(a.believes(defence_id)->atoms().contains(does(2, defend)));
  a.leave(play_id);
  EXPECT_TRUE(a.believes(defence_id)->atoms().contains(does(2, defend)));
  think(a, sees(1));
  auto const sent = std::get<plan_message>(*a.next_message(start));
  ASSERT_EQ(sent.types.size(), 1u);
  EXPECT_EQ(sent.types[0].type, defence_id);
}

TEST_F(agent_test, old_and_duplicate_snapshots_are_dropped) {
  auto a = robot_in_play(1);
  a.receive(says(2, 5, attack), start);
  a.receive(says(2, 7, std::nullopt), start);
  auto const before = a;
  for (std::uint64_t n : {1u, 5u, 6u, 7u}) EXPECT_EQ(a.receive(says(2, n, attack), start).verdict, verdict::stale);
  EXPECT_EQ(a, before);
  auto reborn = says(2, 1, defend);
  reborn.number.incarnation = 2;
  EXPECT_EQ(a.receive(reborn, start).verdict, verdict::accepted) << "a restarted sender counts anew";
  EXPECT_EQ(a.receive(says(2, 8, attack), start).verdict, verdict::stale);
}

TEST_F(agent_test, the_silent_are_deleted) {
  auto a = robot_in_play(1);
  a.receive(says(2, 1, defend), start);
  a.receive(says(3, 1, defend), start + rota::seconds(1));
  think(a, sees(1), start + rota::seconds(2));
  auto const d = think(a, sees(1), start + rota::seconds(2) + milliseconds(1));
  EXPECT_EQ(d.deleted, event::subtraction(does(2, defend)));
  EXPECT_FALSE(a.believes(play_id)->takes_part(robot(2)));
  EXPECT_TRUE(a.believes(play_id)->takes_part(robot(3)));
  EXPECT_EQ(a.receive(says(2, 1, defend), start + rota::seconds(3)).verdict, verdict::stale)
      << "a delayed old message revives nobody";
  think(a, sees(1), start + rota::seconds(1000));
  EXPECT_TRUE(a.believes(play_id)->takes_part(robot(1))) << "nobody deletes itself";
}

TEST_F(agent_test, without_a_valid_allocation_nobody_has_a_task_and_all_still_take_part) {
  auto a = robot_in_play(1);
  think(a, sees(1));
  rota::team<soccer> keepers;
  for (auto who : squad(9)) keepers.add(who, rota::role<soccer>().forbid(attack));
  auto const d = a.deliberate(play, keepers, sees(1), start, space);
  EXPECT_EQ(d.reason, decision_reason::no_valid_allocation);
  EXPECT_EQ(d.own, std::nullopt);
  auto const m = std::get<plan_message>(*a.next_message(start));
  ASSERT_EQ(m.types.size(), 1u);
  EXPECT_FALSE(m.types[0].place);
}

TEST_F(agent_test, plan_messages_keep_a_drift_free_grid_under_a_30_ms_loop) {
  rota::agent_options options;
  options.first_message = start + milliseconds(17);
  auto a = robot_in_play(1, options);
  int sent = 0;
  std::uint64_t last = 0;
  for (auto now = start; now < start + rota::seconds(60); now = now + milliseconds(30)) {
    while (auto m = a.next_message(now)) {
      auto const& plan = std::get<plan_message>(*m);
      EXPECT_EQ(plan.number.sequence, ++last);
      ++sent;
    }
    EXPECT_EQ((a.next_due() - options.first_message).ns % milliseconds(100).ns, 0);
    EXPECT_GT(a.next_due(), now);
  }
  EXPECT_EQ(sent, 600);
  EXPECT_TRUE(a.next_message(start + rota::seconds(90)));
  EXPECT_FALSE(a.next_message(start + rota::seconds(90))) << "slots that were slept through are not made up for";
}

TEST_F(agent_test, own_state_travels_with_the_snapshot_and_is_no_event) {
  auto a = robot_in_play(1), b = robot_in_play(2);
  think(a, sees(1));
  b.receive(*a.next_message(start), start);
  EXPECT_TRUE(a.set_state(play_id, soccer::state::protect));
  EXPECT_FALSE(a.set_state(defence_id, soccer::state::protect));
  auto const r = b.receive(*a.next_message(start + milliseconds(100)), start);
  EXPECT_EQ(r.verdict, verdict::accepted);
  EXPECT_TRUE(r.changes.empty());
  EXPECT_EQ(b.believes(play_id)->state(robot(1)), soccer::state::protect);
}

// What must be refused, and change nothing.

claim claim_by(int leader, int attacker, std::uint64_t number = 1) {
  return {play_id, {does(attacker, attack)}, {0, robot(leader)}, robot(leader), 1, number, 1, rota::seconds(2)};
}

TEST_F(agent_test, bad_messages_are_refused_whole_with_a_reason) {
  auto a = robot_in_play(5);
  a.receive(says(2, 1, defend), start);
  think(a, sees(5));
  std::vector<std::pair<message, refusal>> bad;
  bad.push_back({says(5, 1, attack), refusal::own_id});
  bad.push_back({says(42, 1, attack), refusal::stranger});
  auto twice = says(2, 2, attack);
  twice.types.push_back(twice.types[0]);
  bad.push_back({twice, refusal::types_not_ascending});
  auto unsorted = says(2, 2, attack, defence_id);
  unsorted.types.push_back(says(2, 2, attack, play_id).types[0]);
  bad.push_back({unsorted, refusal::types_not_ascending});
  auto unknown = says(2, 2, attack);
  unknown.types[0].place->plan = soccer::plan::kickoff;
  bad.push_back({unknown, refusal::unknown_task});
  unknown = says(2, 2, soccer::task::support);
  bad.push_back({unknown, refusal::unknown_task});

  bad.push_back({claim_by(5, 1), refusal::own_id});
  bad.push_back({claim_by(42, 1), refusal::stranger});
  auto c = claim_by(9, 1);
  c.atoms.insert(does(42, defend));
  bad.push_back({c, refusal::stranger});
  c = claim_by(9, 1);
  c.stamp.id = robot(8);
  bad.push_back({c, refusal::foreign_stamp});
  c = claim_by(9, 1);
  c.type = defence_id;
  bad.push_back({c, refusal::not_executed});
  for (auto remaining : {rota::seconds(0), rota::seconds(-1), rota::seconds(2) + rota::nanoseconds(1), rota::duration{INT64_MIN}}) {
    c = claim_by(9, 1);
    c.remaining = remaining;
    bad.push_back({c, refusal::remaining_time});
  }
  c = claim_by(9, 1);
  c.atoms.insert(does(1, defend));
  bad.push_back({c, refusal::malformed_allocation});
  c = claim_by(9, 1);
  c.atoms.insert({robot(2), soccer::plan::normal, soccer::task::support});
  bad.push_back({c, refusal::unknown_task});

  auto const before = a;
  for (auto const& [m, why] : bad) {
    auto const r = a.receive(m, start);
    EXPECT_EQ(r.verdict, verdict::refused);
    EXPECT_EQ(static_cast<int>(r.why), static_cast<int>(why));
    EXPECT_TRUE(r.changes.empty());
    EXPECT_EQ(a, before);
  }
}

TEST_F(agent_test, a_claim_that_mixes_plans_is_malformed) {
  auto const worth = rota::additive_utility<soccer, view>([](auto, auto, view const&) { return std::optional(0.0); });
  using plan = rota::plan<soccer, view>;
  auto const two = *rota::plan_type<soccer, view>::make(
      play_id, {*plan::make({.plan = soccer::plan::normal, .tasks = {{attack, {0, 1}}}, .utility = worth}),
                *plan::make({.plan = soccer::plan::kickoff, .tasks = {{attack, {0, 1}}}, .utility = worth})});
  robot_agent a(robot(1), squad(9));
  a.enter(two, start);
  auto c = claim_by(9, 1);
  c.atoms.insert({robot(2), soccer::plan::kickoff, attack});
  EXPECT_EQ(a.receive(c, start).why, refusal::malformed_allocation);
}

TEST_F(agent_test, no_message_whatever_breaks_it) {
  int refused = 0, accepted = 0;
  EXPECT_TRUE(rc::check("refused or stale changes nothing; the invariants hold", [&] {
    auto a = robot_in_play(*rc::gen::inRange(1, 6).as("self"));
    auto now = start;
    int const steps = *rc::gen::inRange(1, 40).as("steps");
    for (int i = 0; i < steps; ++i) {
      now = now + milliseconds(*rc::gen::inRange(0, 50));
      message m;
      if (*rc::gen::arbitrary<bool>()) {
        plan_message p{robot(*rc::gen::inRange(1, 12)), {*rc::gen::inRange<std::uint64_t>(0, 3), *rc::gen::inRange<std::uint64_t>(0, 50)}, {}};
        int const types = *rc::gen::inRange(0, 3);
        for (int t = 0; t < types; ++t) {
          rota::participation<soccer> entry{soccer::plan_type(*rc::gen::inRange(0, 3)), std::nullopt};
          if (*rc::gen::arbitrary<bool>())
            entry.place = rota::placement<soccer>{soccer::plan(*rc::gen::weightedElement<int>({{5, 0}, {1, 1}, {1, 7}})),
                                                  soccer::task(*rc::gen::inRange(0, 4)), {}};
          p.types.push_back(entry);
        }
        m = p;
      } else {
        int const leader = *rc::gen::inRange(1, 12);
        claim c{play_id, {}, {0, robot(leader)}, robot(leader), *rc::gen::inRange<std::uint64_t>(0, 2),
                *rc::gen::inRange<std::uint64_t>(0, 4), *rc::gen::inRange<std::uint64_t>(0, 4),
                milliseconds(*rc::gen::weightedElement<int>({{6, 1500}, {1, 0}, {1, 5000}, {3, 40}}))};
        for (atom x : *any_atoms(11, 3)) {
          if (*rc::gen::inRange(0, 4) != 0) x.plan = soccer::plan::normal;
          c.atoms.insert(x);
        }
        m = c;
      }
      auto const before = a;
      auto const r = a.receive(m, now);
      if (r.verdict == verdict::accepted) {
        ++accepted;
      } else {
        ++refused;
        RC_ASSERT(a == before);
      }
      if (*rc::gen::arbitrary<bool>()) think(a, sees(*rc::gen::inRange(1, 10)), now);
      auto const& b = *a.believes(play_id);
      RC_ASSERT(b.participants().size() <= 9u);
      RC_ASSERT(b.takes_part(a.self()));
      for (auto const* x = b.atoms().begin(); x != b.atoms().end(); ++x) {
        RC_ASSERT(b.takes_part(x->agent));
        if (x != b.atoms().begin()) RC_ASSERT((x - 1)->agent != x->agent);
        RC_ASSERT(int(x->agent) >= 1 && int(x->agent) <= 9);
      }
    }
  }));
  EXPECT_GT(refused, 1000);
  EXPECT_GT(accepted, 1000);
}

// Conflicts, cycles and authority, through messages.

/// Robots that share a radio without delay or loss, each deliberating every 30 ms and speaking every 100 ms.
struct pitch {
  agent_test& fixture;
  std::vector<robot_agent> robots;
  std::vector<view> views;
  rota::instant now = start;
  std::map<int, int> detections, reigns;

  pitch(agent_test& f, std::vector<view> what_they_see, rota::agent_options options = {})
      : fixture(f), views(std::move(what_they_see)) {
    for (std::size_t i = 0; i < views.size(); ++i) {
      options.first_message = start + milliseconds(static_cast<std::int64_t>(37 * i));
      robots.push_back(f.robot_in_play(static_cast<int>(i) + 1, options));
    }
  }
  void step() {
    now = now + milliseconds(1);
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if ((now.ns / 1'000'000) % 30 == static_cast<std::int64_t>(i * 7 % 30)) {
        auto const d = fixture.think(robots[i], views[i], now);
        detections[static_cast<int>(i) + 1] += d.detected.has_value();
        reigns[static_cast<int>(i) + 1] += d.reign_began;
      }
      while (auto m = robots[i].next_message(now))
        for (auto& other : robots)
          if (&other != &robots[i]) {
            EXPECT_NE(other.receive(*m, now).verdict, verdict::refused);
          }
    }
  }
  void run(rota::duration d) {
    for (auto const until = now + d; now < until;) step();
  }
  bool agreed() const {
    for (auto const& r : robots)
      if (r.believes(play_id)->atoms() != robots[0].believes(play_id)->atoms()) return false;
    return true;
  }
};

TEST_F(agent_test, robots_that_see_the_same_agree) {
  pitch p(*this, {sees(2), sees(2), sees(2)});
  p.run(rota::seconds(1));
  EXPECT_TRUE(p.agreed());
  EXPECT_TRUE(p.robots[0].believes(play_id)->atoms().contains(does(2, attack)));
  for (auto const& [who, n] : p.detections) EXPECT_EQ(n, 0) << who;
}

TEST_F(agent_test, two_that_each_see_themselves_best_loop_until_one_rules) {
  rota::agent_options off;
  off.resolution = false;
  pitch without(*this, {sees(1), sees(2)}, off);
  int agreeing = 0;
  for (int i = 0; i < 10'000; ++i) {
    without.step();
    agreeing += i > 1000 && without.agreed();
  }
  EXPECT_LT(agreeing, 900) << "of 9000 ms";
  EXPECT_GT(without.detections[1] + without.detections[2], 5);
  EXPECT_EQ(without.reigns[1] + without.reigns[2], 0);

  pitch with(*this, {sees(1), sees(2)});
  with.run(milliseconds(700));
  EXPECT_TRUE(with.agreed());
  EXPECT_TRUE(with.robots[1].rule(play_id)->leading()) << "the greatest id leads";
  EXPECT_TRUE(with.robots[0].rule(play_id)->obeying());
  EXPECT_TRUE(with.robots[0].believes(play_id)->atoms().contains(does(2, attack)));
  EXPECT_TRUE(with.robots[0].believes(play_id)->atoms().contains(does(1, defend)));
  auto const ends = with.robots[1].rule(play_id)->expiry();
  with.run(ends - with.now + milliseconds(1));
  EXPECT_FALSE(with.robots[0].rule(play_id)->active()) << "afterwards everybody is back to normal";
  EXPECT_FALSE(with.robots[1].rule(play_id)->active());
}

TEST_F(agent_test, the_greater_agent_answers_even_if_it_detected_nothing) {
  pitch p(*this, {sees(1), sees(2), sees(2), sees(1)});
  for (int i = 0; i < 1000 && !p.robots[3].rule(play_id)->leading(); ++i) p.step();
  EXPECT_TRUE(p.robots[3].rule(play_id)->leading());
  p.run(milliseconds(50));
  for (int i : {0, 1, 2}) {
    auto const* rule = p.robots[static_cast<std::size_t>(i)].rule(play_id);
    ASSERT_TRUE(rule->obeying());
    EXPECT_EQ(rule->current().leader, robot(4));
  }
  EXPECT_TRUE(p.agreed());
}

TEST_F(agent_test, a_leader_changes_its_mind_and_followers_with_it) {
  pitch p(*this, {sees(1), sees(2)});
  p.run(milliseconds(700));
  ASSERT_TRUE(p.robots[1].rule(play_id)->leading());
  p.views[1] = sees(1);
  p.run(milliseconds(40));
  EXPECT_TRUE(p.robots[0].believes(play_id)->atoms().contains(does(1, attack)));
  EXPECT_TRUE(p.agreed());
}

/// ALICA's defect: an agent never drops robots that the leader left idle.
TEST_F(agent_test, followers_drop_agents_that_the_leader_left_idle) {
  auto a = robot_in_play(1);
  a.receive(says(2, 1, defend), start);
  a.receive(says(3, 1, attack), start);
  auto const r = a.receive(claim_by(9, 1), start);
  EXPECT_EQ(r.claim, rota::claim_outcome::adopted);
  EXPECT_EQ(a.believes(play_id)->atoms(), (atoms{does(1, attack)}));
  EXPECT_TRUE(a.believes(play_id)->takes_part(robot(2))) << "idle, and still taking part";
  EXPECT_EQ(think(a, sees(3)).reason, decision_reason::obeyed);
}

TEST_F(agent_test, tasks_in_plan_messages_are_ignored_under_authority_and_coming_and_going_is_not) {
  auto a = robot_in_play(1);
  a.receive(says(2, 1, defend), start);
  a.receive(claim_by(9, 1), start);
  EXPECT_TRUE(a.receive(says(2, 2, attack), start).changes.empty());
  EXPECT_TRUE(a.receive(says(3, 1, attack), start).changes.empty());
  EXPECT_TRUE(a.believes(play_id)->takes_part(robot(3)));
  a.receive(says_nothing(2, 3), start);
  EXPECT_FALSE(a.believes(play_id)->takes_part(robot(2)));
  EXPECT_EQ(a.believes(play_id)->atoms(), (atoms{does(1, attack)}));
}

TEST_F(agent_test, a_deleted_leader_releases_its_followers) {
  rota::agent_options options;
  options.silence = milliseconds(500);
  auto a = robot_in_play(1, options);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(9, 1), start);
  EXPECT_EQ(think(a, sees(1), start + milliseconds(500)).reason, decision_reason::obeyed);
  EXPECT_NE(think(a, sees(1), start + milliseconds(501)).reason, decision_reason::obeyed);
  EXPECT_EQ(a.receive(claim_by(9, 1), start + milliseconds(600)).claim, rota::claim_outcome::expired);
}

TEST_F(agent_test, a_leader_that_leaves_the_type_ends_its_reign_and_numbers_go_on) {
  auto a = robot_in_play(5), b = robot_in_play(1);
  a.receive(claim_by(3, 3), start);  // challenged: 5 leads
  auto const first = std::get<claim>(*a.next_message(start));
  b.receive(first, start);
  a.leave(play_id);
  b.receive(*a.next_message(start + milliseconds(100)), start + milliseconds(100));
  EXPECT_FALSE(b.rule(play_id)->active());
  a.enter(play, start + milliseconds(200));
  a.receive(claim_by(3, 3, 2), start + milliseconds(200));
  auto const second = std::get<claim>(*a.next_message(start + milliseconds(200)));
  EXPECT_GT(second.number, first.number);
  EXPECT_EQ(b.receive(second, start + milliseconds(200)).claim, rota::claim_outcome::adopted);
}

TEST_F(agent_test, a_regular_value_that_replays_alike) {
  pitch p(*this, {sees(1), sees(2), sees(3)});
  p.run(milliseconds(333));
  pitch q = p;
  EXPECT_EQ(p.robots, q.robots);
  p.run(rota::seconds(3));
  EXPECT_NE(p.robots, q.robots);
  q.run(rota::seconds(3));
  EXPECT_EQ(p.robots, q.robots);
}

TEST_F(agent_test, a_steady_deliberation_allocates_nothing) {
  auto a = robot_in_play(1);
  for (int n : {2, 3, 4, 5}) a.receive(says(n, 1, n == 2 ? attack : defend), start);
  view const calm = sees(2);
  for (int i = 0; i < 2; ++i) think(a, calm);
  auto const before = rota_test::allocation_count();
  for (int i = 0; i < 100; ++i) think(a, calm);
  EXPECT_EQ(rota_test::allocation_count() - before, 0u);
  auto const positive_control = rota_test::allocation_count();
  auto* copy = new robot_agent(a);
  EXPECT_GT(rota_test::allocation_count(), positive_control);
  delete copy;
}

}  // namespace
