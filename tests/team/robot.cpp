#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "playground.hpp"

#include <rota/team/conflict.hpp>
#include <support/allocation_counter.hpp>

#include <map>
#include <variant>

namespace agent_test {

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

  robot_agent robot_in_play(int n, rota::robot_options const& options = {}) {
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

TEST_F(agent_test, changes_no_more_readily_than_its_options_say) {
  auto const swaps_for = [&](rota::robot_options const& options, double gain) {
    auto a = robot_in_play(1, options);
    (void)a.receive(says(2, 1, defend), start);
    view v = sees(1);
    v.attack[2] = 1 + gain;  // two robots would change
    auto const before = a.believes(play_id)->atoms();
    (void)think(a, sees(1));
    EXPECT_NE(a.believes(play_id)->atoms(), before);
    return think(a, v).reason == decision_reason::reallocated;
  };
  EXPECT_TRUE(swaps_for({}, 0.25));
  EXPECT_FALSE(swaps_for({.change_cost = 0.25}, 0.25));
  EXPECT_TRUE(swaps_for({.change_cost = 0.0625}, 0.25));
  EXPECT_FALSE(swaps_for({.hysteresis = {.absolute = 0.25}}, 0.25));
  EXPECT_TRUE(swaps_for({.hysteresis = {.absolute = 0.25}}, 0.5));
  EXPECT_FALSE(swaps_for({.hysteresis = {.relative = 0.5}}, 0.5)) << "half of 1.125 is more";
}

TEST_F(agent_test, a_message_is_one_of_the_four_cases) {
  auto a = robot_in_play(1);
  auto hear = [&, n = std::uint64_t{0}](std::optional<soccer::task> task) mutable {
    return a.receive(says(2, ++n, task), start);
  };

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
  rota::robot_options options;
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
  for (auto remaining :
       {rota::seconds(0), rota::seconds(-1), rota::seconds(2) + rota::nanoseconds(1), rota::duration{INT64_MIN}}) {
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
      play_id, {*plan::make({.plan = soccer::plan::normal, .tasks = {{attack, {0, 1}, {}}}, .utility = worth}),
                *plan::make({.plan = soccer::plan::kickoff, .tasks = {{attack, {0, 1}, {}}}, .utility = worth})});
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
        plan_message p{robot(*rc::gen::inRange(1, 12)),
                       {*rc::gen::inRange<std::uint64_t>(0, 3), *rc::gen::inRange<std::uint64_t>(0, 50)},
                       {}};
        int const types = *rc::gen::inRange(0, 3);
        for (int t = 0; t < types; ++t) {
          rota::participation<soccer> entry{soccer::plan_type(*rc::gen::inRange(0, 3)), std::nullopt};
          if (*rc::gen::arbitrary<bool>())
            entry.place =
                rota::placement<soccer>{soccer::plan(*rc::gen::weightedElement<int>({{5, 0}, {1, 1}, {1, 7}})),
                                        soccer::task(*rc::gen::inRange(0, 4)),
                                        {}};
          p.types.push_back(entry);
        }
        m = p;
      } else {
        int const leader = *rc::gen::inRange(1, 12);
        claim c{play_id,
                {},
                {0, robot(leader)},
                robot(leader),
                *rc::gen::inRange<std::uint64_t>(0, 2),
                *rc::gen::inRange<std::uint64_t>(0, 4),
                *rc::gen::inRange<std::uint64_t>(0, 4),
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

  pitch(agent_test& f, std::vector<view> what_they_see, rota::robot_options options = {})
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
  rota::robot_options off;
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
  rota::robot_options options;
  options.silence = milliseconds(500);
  auto a = robot_in_play(1, options);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(9, 1), start);
  EXPECT_EQ(think(a, sees(1), start + milliseconds(500)).reason, decision_reason::obeyed);
  EXPECT_NE(think(a, sees(1), start + milliseconds(501)).reason, decision_reason::obeyed);
  EXPECT_FALSE(a.rule(play_id)->active());
  // It speaks all the same: it is obeyed again, and no longer than it would have been.
  EXPECT_EQ(a.receive(claim_by(9, 1), start + milliseconds(600)).claim, rota::claim_outcome::adopted);
  EXPECT_EQ(a.rule(play_id)->expiry(), start + rota::seconds(2));
}

TEST_F(agent_test, a_leader_that_leaves_the_type_ends_its_reign_and_numbers_go_on) {
  auto a = robot_in_play(5), b = robot_in_play(1);
  EXPECT_EQ(a.receive(claim_by(3, 3), start).claim, rota::claim_outcome::challenged);
  EXPECT_TRUE(a.rule(play_id)->leading());
  think(a, sees(5));
  auto const first = std::get<claim>(*a.next_message(start));
  b.receive(first, start);
  a.leave(play_id);
  b.receive(*a.next_message(start + milliseconds(100)), start + milliseconds(100));
  EXPECT_FALSE(b.rule(play_id)->active());
  a.enter(play, start + milliseconds(200));
  a.receive(claim_by(3, 3, 2), start + milliseconds(200));
  think(a, sees(5), start + milliseconds(200));
  auto const second = std::get<claim>(*a.next_message(start + milliseconds(200)));
  EXPECT_GT(second.number, first.number);
  EXPECT_EQ(b.receive(second, start + milliseconds(200)).claim, rota::claim_outcome::adopted);
}

TEST_F(agent_test, each_copy_of_a_claim_restores_what_a_follower_lost_meanwhile) {
  auto a = robot_in_play(1);
  auto c = claim_by(9, 3);
  c.atoms.insert(does(2, defend));
  a.receive(says(2, 1, defend), start);
  a.receive(c, start);
  a.receive(says_nothing(2, 2), start);
  a.receive(says(2, 3, defend), start);
  EXPECT_EQ(a.believes(play_id)->atoms(), (atoms{does(3, attack)}));
  auto const r = a.receive(c, start + milliseconds(100));
  EXPECT_EQ(r.claim, rota::claim_outcome::repeated);
  ASSERT_EQ(r.changes.size(), 1u);
  EXPECT_EQ(r.changes[0].what, message_case::imposed);
  EXPECT_EQ(a.believes(play_id)->atoms(), c.atoms);
}

TEST_F(agent_test, delayed_copies_of_an_answered_claim_begin_no_second_reign) {
  auto a = robot_in_play(5);
  int reigns = 0;
  for (int s = 0; s <= 8; s += 2)
    reigns += a.receive(claim_by(4, 4), start + rota::seconds(s)).claim == rota::claim_outcome::challenged;
  EXPECT_EQ(reigns, 1);
  EXPECT_EQ(a.receive(claim_by(4, 4, 2), start + rota::seconds(10)).claim, rota::claim_outcome::challenged)
      << "another claim is answered again";
}

TEST_F(agent_test, a_challenger_deliberates_before_it_speaks_and_counts_in_whom_the_claim_names) {
  auto a = robot_in_play(5);
  auto c = claim_by(4, 3);
  c.atoms.insert(does(4, defend));
  a.receive(c, start);
  auto const before = a.next_message(start);  // its plan message only
  ASSERT_TRUE(before);
  EXPECT_TRUE(std::holds_alternative<plan_message>(*before));
  EXPECT_FALSE(a.next_message(start));
  think(a, sees(3), start + milliseconds(10));
  auto const mine = std::get<claim>(*a.next_message(start + milliseconds(10)));
  EXPECT_EQ(mine.atoms, (atoms{does(3, attack), does(4, defend), does(5, defend)}));
}

TEST_F(agent_test, a_leader_heard_through_claims_alone_is_not_silent) {
  auto a = robot_in_play(1);
  a.receive(says(9, 1, defend), start);
  auto c = claim_by(9, 1);
  c.remaining = rota::seconds(2);
  for (int ms = 1500; ms <= 2000; ms += 100) {
    a.receive(c, start + milliseconds(ms));
    c.remaining = c.remaining - milliseconds(100);
  }
  EXPECT_EQ(think(a, sees(1), start + milliseconds(2010)).reason, decision_reason::obeyed);
}

TEST_F(agent_test, a_restarted_leader_leads_no_longer) {
  auto a = robot_in_play(1);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(9, 3), start);
  auto reborn = says(9, 1, std::nullopt);
  reborn.number.incarnation = 2;
  a.receive(reborn, start + milliseconds(10));
  EXPECT_FALSE(a.rule(play_id)->active());
  EXPECT_EQ(a.receive(claim_by(9, 3), start + milliseconds(20)).verdict, verdict::stale);
}

TEST_F(agent_test, a_stamp_is_frozen_for_a_claim) {
  auto a = robot_in_play(1);
  auto c = claim_by(9, 1);
  c.stamp.confidence = 10;
  a.receive(c, start);
  auto const before = a;
  for (std::uint32_t confidence : {0u, 9u, 11u}) {
    c.stamp.confidence = confidence;
    ++c.version;
    EXPECT_EQ(a.receive(c, start).why, refusal::foreign_stamp);
  }
  EXPECT_EQ(a, before);
}

TEST_F(agent_test, a_claim_of_a_former_life_is_stale) {
  auto a = robot_in_play(1);
  auto reborn = says(9, 1, defend);
  reborn.number.incarnation = 2;
  a.receive(reborn, start);
  auto const before = a;
  EXPECT_EQ(a.receive(claim_by(9, 1), start).verdict, verdict::stale);
  EXPECT_EQ(a, before);
}

TEST_F(agent_test, the_end_of_a_reign_is_told_whoever_noticed_it) {
  auto a = robot_in_play(1);
  auto c = claim_by(9, 1);
  c.remaining = milliseconds(50);
  a.receive(c, start);
  EXPECT_FALSE(think(a, sees(1), start + milliseconds(30)).reign_ended);
  (void)a.next_message(start + milliseconds(60));
  EXPECT_TRUE(think(a, sees(1), start + milliseconds(61)).reign_ended);
  EXPECT_FALSE(think(a, sees(1), start + milliseconds(91)).reign_ended);
}

TEST_F(agent_test, who_is_given_another_task_is_taken_to_begin_it) {
  auto a = robot_in_play(1);
  auto m = says(2, 1, defend);
  m.types[0].place->state = soccer::state::help;
  a.receive(m, start);
  EXPECT_EQ(a.believes(play_id)->state(robot(2)), soccer::state::help);
  think(a, sees(2));
  EXPECT_EQ(a.believes(play_id)->part(robot(2)), does(2, attack));
  EXPECT_EQ(a.believes(play_id)->state(robot(2)), soccer::state::get_ball);
  a.receive(claim_by(9, 2), start);
  m.number.sequence = 2;
  a.receive(m, start);
  EXPECT_EQ(a.believes(play_id)->state(robot(2)), soccer::state::get_ball) << "a state of a task that is ignored";
}

/// Rule vi of the monitor: what happened before or during authority never counts afterwards.
TEST_F(agent_test, cycles_do_not_survive_a_reign_or_a_deletion) {
  for (int interruption : {0, 1, 2, 3}) {
    rota::robot_options options;
    options.silence = rota::seconds(3);
    auto a = robot_in_play(5, options);
    std::uint64_t n = 0;
    auto now = start;
    auto const cycle = [&] {
      now = now + milliseconds(10);
      a.receive(says(2, ++n, attack), now);
      return think(a, sees(5), now);
    };
    a.receive(says(2, ++n, defend), now);
    think(a, sees(5), now);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(cycle().cycles, 1u);
    switch (interruption) {
    case 0: break;
    case 1:  // obeys for a while, in which messages contradict the claim
      a.receive(claim_by(9, 5), now);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(cycle().cycles, 0u);
      now = now + rota::seconds(2);
      think(a, sees(5), now);
      break;
    case 2:  // leads for a while
      a.receive(claim_by(4, 5), now);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(cycle().cycles, 0u);
      now = now + rota::seconds(2);
      think(a, sees(5), now);
      break;
    case 3:  // b falls silent, is deleted, and comes back
      now = now + rota::seconds(4);
      think(a, sees(5), now);
      a.receive(says(2, ++n, defend), now);
      think(a, sees(5), now);
      break;
    }
    a.receive(says(2, ++n, defend), now);
    think(a, sees(5), now);
    auto const last = interruption == 0 ? std::optional<soccer::agent>() : cycle().detected;
    EXPECT_EQ(last, std::nullopt) << interruption;
  }
}

/// Loss, duplication, reordering, delay, leaving, entering and restart, over whole agents and their beliefs.
TEST_F(agent_test, authority_over_every_interleaving_of_real_agents) {
  constexpr int n = 4;
  int obeyed = 0, led = 0, restarted = 0, settled = 0, abandoned = 0;
  EXPECT_TRUE(rc::check("one leader, greater stamps only, bounded reigns; one round without loss settles", [&] {
    auto const who = squad(n);
    rota::robot_options options;
    options.cycles = 2;
    std::vector<robot_agent> robots;
    std::vector<std::uint64_t> incarnation(n, 1);
    for (auto a : who) {
      robots.emplace_back(a, who, options);
      robots.back().enter(play, start);
    }
    struct copy {
      message what;
      rota::instant sent;
    };
    std::vector<copy> flying;
    auto now = start;
    rota::instant last_reign_ends = start;
    rota::duration greatest_delay{};

    // Everybody thinks and speaks, everybody hears.
    auto const lossless_round = [&] {
      now = now + milliseconds(30);
      for (std::size_t i = 0; i < robots.size(); ++i) {
        think(robots[i], sees(static_cast<int>(i) + 1), now);
        while (auto m = robots[i].next_message(now)) {
          flying.push_back({*m, now});
          for (auto& other : robots)
            if (&other != &robots[i]) other.receive(*m, now);
        }
        if (robots[i].rule(play_id)->leading())
          last_reign_ends = std::max(last_reign_ends, robots[i].rule(play_id)->expiry());
      }
    };
    int const prelude = *rc::gen::inRange(0, 14).as("rounds without loss");
    for (int round = 0; round < prelude; ++round) lossless_round();

    int const steps = *rc::gen::inRange(20, 150).as("steps");
    for (int step = 0; step < steps; ++step) {
      auto const i = static_cast<std::size_t>(*rc::gen::inRange(0, n));
      auto& r = robots[i];
      auto const held = [&]() -> std::optional<claim> {
        auto const* rule = r.rule(play_id);
        if (!rule || !rule->active()) return std::nullopt;
        return rule->current();
      };
      auto const before = held();
      switch (*rc::gen::weightedElement<int>({{3, 0}, {8, 1}, {4, 2}, {12, 3}, {1, 4}, {1, 5}})) {
      case 0: now = now + milliseconds(*rc::gen::inRange(1, 300)); break;
      case 1: think(r, sees(static_cast<int>(i) + 1), now); break;
      case 2:
        while (auto m = r.next_message(now)) flying.push_back({*m, now});
        break;
      case 3: {
        if (flying.empty()) break;
        auto const& c = flying[static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(flying.size())))];
        greatest_delay = std::max(greatest_delay, now - c.sent);
        auto const held_until = before ? r.rule(play_id)->expiry() : now;
        r.receive(c.what, now);
        auto const after = held();
        // It held that claim until it heard this message: it may have expired just now, but not been outranked by less.
        bool const expired = before && now >= held_until;
        if (before && after && !expired && after->leader != before->leader) RC_ASSERT(before->stamp < after->stamp);
        break;
      }
      case 4:
        if (!r.leave(play_id)) r.enter(play, now);
        break;
      default:
        options.incarnation = ++incarnation[i];
        options.first_message = now;
        r = robot_agent(who[i], who, options);
        r.enter(play, now);
        ++restarted;
      }
      for (auto& each : robots) {
        auto const* rule = each.rule(play_id);
        if (!rule || !rule->active()) continue;
        RC_ASSERT(rule->leading() == (rule->current().leader == each.self()));
        if (rule->leading()) last_reign_ends = std::max(last_reign_ends, rule->expiry());
        RC_ASSERT(rule->expiry() <= last_reign_ends + greatest_delay);
        obeyed += rule->obeying();
        led += rule->leading();
      }
    }

    // From now on nothing is lost. Everybody takes part and speaks; whoever rules then rules alone.
    for (auto& r : robots) r.enter(play, now);
    for (int round = 0; round < 12; ++round) lossless_round();
    std::vector<soccer::agent> leaders;
    for (auto const& r : robots)
      if (r.rule(play_id)->leading()) leaders.push_back(r.self());
    if (!leaders.empty()) {
      ++settled;
      RC_ASSERT(leaders.size() == 1u);
      auto const& leader = *std::find_if(robots.begin(), robots.end(), [&](auto& r) { return r.self() == leaders[0]; });
      for (auto const& r : robots) {
        if (!r.rule(play_id)->obeying()) continue;
        auto const& held = r.rule(play_id)->current();
        if (held.leader != leaders[0]) {
          // A greater leader that has left unheard: its followers hold to expiry, as nobody can tell silence from loss.
          auto const& gone = robots[static_cast<std::size_t>(held.leader) - 1];
          RC_ASSERT(leader.rule(play_id)->current().stamp < held.stamp);
          RC_ASSERT(!gone.rule(play_id)->leading());
          ++abandoned;
          continue;
        }
        RC_ASSERT(r.believes(play_id)->atoms() == leader.believes(play_id)->atoms());
      }
    }

    // Nobody speaks any more: afterwards everybody is back to normal.
    now = now + rota::seconds(2) + greatest_delay;
    for (std::size_t i = 0; i < robots.size(); ++i) {
      auto const d = think(robots[i], sees(1), now);
      RC_ASSERT(d.reason != decision_reason::obeyed);
    }
  }));
  EXPECT_GT(obeyed, 1000);
  EXPECT_GT(led, 1000);
  EXPECT_GT(restarted, 100);
  EXPECT_GT(settled, 100);
  EXPECT_LT(abandoned, settled / 2);
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

}  // namespace agent_test
