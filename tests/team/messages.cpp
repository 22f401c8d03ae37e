#include <gtest/gtest.h>

#include "playground.hpp"

#include <rota/team/wire.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace messages_test {

using rota::message_case;
using rota::milliseconds;
using rota::refusal;
using rota::verdict;

namespace {

struct messages : playground {};

TEST_F(messages, a_message_is_one_of_the_four_cases) {
  auto a = in_play(1);
  auto hear = [&, n = std::uint64_t{0}](std::optional<soccer::task> task) mutable {
    return a.receive(says(2, ++n, task), start);
  };

  auto joined = hear(defend);
  ASSERT_EQ(joined.changes.size(), 1u);
  EXPECT_EQ(joined.changes[0].part.what(), message_case::joined);
  EXPECT_EQ(joined.changes[0].part.event(), event::addition(does(2, defend)));

  EXPECT_TRUE(hear(defend).changes.empty()) << "agreement";

  auto moved = hear(attack);
  EXPECT_EQ(moved.changes[0].part.what(), message_case::moved);
  EXPECT_EQ(moved.changes[0].part.event(), *event::make({does(2, attack)}, {does(2, defend)}));

  auto idle = hear(std::nullopt);
  EXPECT_EQ(idle.changes[0].part.what(), message_case::left);
  EXPECT_EQ(idle.changes[0].part.event(), event::subtraction(does(2, attack)));
  EXPECT_TRUE(a.believes(play_id)->takes_part(agent(2))) << "taking part without a task is taking part";

  hear(attack);
  auto gone = a.receive(says_nothing(2, 99), start);
  EXPECT_EQ(gone.changes[0].part.what(), message_case::left);
  EXPECT_FALSE(a.believes(play_id)->takes_part(agent(2)));
}

TEST_F(messages, several_plan_types_are_independent) {
  auto const defence = make_play(defence_id);
  auto a = in_play(1);
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
  (void)think(a, sees(1));
  auto const sent = std::get<plan_message>(*a.next_message(start));
  ASSERT_EQ(sent.types.size(), 1u);
  EXPECT_EQ(sent.types[0].type, defence_id);
}

TEST_F(messages, old_and_duplicate_snapshots_are_dropped) {
  auto a = in_play(1);
  a.receive(says(2, 5, attack), start);
  a.receive(says(2, 7, std::nullopt), start);
  auto const before = a;
  for (std::uint64_t n : {1u, 5u, 6u, 7u}) EXPECT_EQ(a.receive(says(2, n, attack), start).verdict, verdict::stale);
  EXPECT_EQ(a, before);
  auto reborn = says(2, 1, defend);
  reborn.number.incarnation = {2};
  EXPECT_EQ(a.receive(reborn, start).verdict, verdict::accepted) << "a restarted sender counts anew";
  EXPECT_EQ(a.receive(says(2, 8, attack), start).verdict, verdict::stale);
}

/// What a constant incarnation would do: the restarted robot is unheard until it has sent as many messages as before.
TEST_F(messages, a_restarted_robot_is_heard_at_once_if_its_incarnation_has_grown) {
  static_assert(rota::incarnation::started_at(1'299'000'000).value == 1'299'000'000);
  static_assert(rota::incarnation::started_at(1) < rota::incarnation::started_at(2));
  static_assert(rota::incarnation::started_at(-1) == rota::incarnation{}, "a clock before 1970 is no clock");
  for (auto const second : {rota::incarnation{2}, rota::incarnation{1}}) {
    auto peer = in_play(1);
    auto a = in_play(2);
    EXPECT_EQ(a.incarnation(), first_life);
    for (int ms = 0; ms < 1000; ms += 100) peer.receive(*a.next_message(start + milliseconds(ms)), start);
    robot again(agent(2), squad(9), second);
    again.enter(play, start);
    auto const heard = peer.receive(*again.next_message(start), start).verdict;
    EXPECT_EQ(heard, second > first_life ? verdict::accepted : verdict::stale);
  }
}

#ifndef NDEBUG
TEST_F(messages, a_robot_without_an_incarnation_is_asserted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(robot(agent(1), squad(9), rota::incarnation{}), "value > 0");
}
#endif

TEST_F(messages, plan_messages_keep_a_drift_free_grid_under_a_30_ms_loop) {
  rota::robot_options options;
  options.first_message = start + milliseconds(17);
  auto a = in_play(1, options);
  int sent = 0;
  std::uint64_t last = 0;
  for (auto now = start; now < start + rota::seconds(60); now += milliseconds(30)) {
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

TEST_F(messages, own_state_travels_with_the_snapshot_and_is_no_event) {
  auto a = in_play(1), b = in_play(2);
  (void)think(a, sees(1));
  b.receive(*a.next_message(start), start);
  EXPECT_TRUE(a.set_state(play_id, soccer::state::protect));
  EXPECT_FALSE(a.set_state(defence_id, soccer::state::protect));
  auto const r = b.receive(*a.next_message(start + milliseconds(100)), start);
  EXPECT_EQ(r.verdict, verdict::accepted);
  EXPECT_TRUE(r.changes.empty());
  EXPECT_EQ(b.believes(play_id)->state(agent(1)), soccer::state::protect);
}

TEST_F(messages, bad_messages_are_refused_whole_with_a_reason) {
  auto a = in_play(5);
  a.receive(says(2, 1, defend), start);
  (void)think(a, sees(5));
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
  c.stamp.id = agent(8);
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
  c.atoms.insert({agent(2), soccer::plan::normal, soccer::task::support});
  bad.push_back({c, refusal::unknown_task});

  auto const before = a;
  for (auto const& [m, reason] : bad) {
    auto const r = a.receive(m, start);
    EXPECT_EQ(r.verdict, verdict::refused);
    EXPECT_EQ(r.reason, reason);
    EXPECT_TRUE(r.changes.empty() && r.imposed.empty());
    EXPECT_EQ(a, before);
  }
}

TEST_F(messages, a_claim_that_mixes_plans_is_malformed) {
  auto const worth = rota::additive_utility<soccer, view>([](auto, auto, view const&) { return std::optional(0.0); });
  using plan = rota::plan<soccer, view>;
  auto const two = *rota::plan_type<soccer, view>::make(
      play_id, {*plan::make({.plan = soccer::plan::normal, .tasks = {{attack, {0, 1}, {}}}, .utility = worth}),
                *plan::make({.plan = soccer::plan::kickoff, .tasks = {{attack, {0, 1}, {}}}, .utility = worth})});
  robot a(agent(1), squad(9), first_life);
  a.enter(two, start);
  auto c = claim_by(9, 1);
  c.atoms.insert({agent(2), soccer::plan::kickoff, attack});
  EXPECT_EQ(a.receive(c, start).reason, refusal::malformed_allocation);
}

/// What a robot believes before it deliberates may mix plans, and nobody has judged it.
TEST_F(messages, an_answer_says_what_a_deliberation_chose) {
  auto const worth = rota::additive_utility<soccer, view>([](auto, auto, view const&) { return std::optional(1.0); });
  using plan = rota::plan<soccer, view>;
  std::vector<rota::plan_task<soccer>> const tasks{{attack, {0, 1}, {}}, {defend, {0, 9}, {}}};
  auto const two = *rota::plan_type<soccer, view>::make(
      play_id, {*plan::make({.plan = soccer::plan::normal, .tasks = tasks, .utility = worth}),
                *plan::make({.plan = soccer::plan::kickoff, .tasks = tasks, .utility = worth})});
  auto const entered = [&](int n) {
    robot r(agent(n), squad(9), first_life);
    r.enter(two, start);
    return r;
  };
  robot a = entered(9), b = entered(2);
  a.receive(says(2, 1, attack), start);
  auto other = says(3, 1, defend);
  other.types[0].place->plan = soccer::plan::kickoff;
  a.receive(other, start);
  ASSERT_EQ(a.receive(claim_by(8, 8), start).claim, rota::claim_outcome::challenged);
  for (int ms = 0; ms < 500; ms += 10) {
    auto const now = start + milliseconds(ms);
    if (ms % 30 == 0) {
      EXPECT_EQ(a.receive(claim_by(8, 8), now).claim, rota::claim_outcome::outranked);
    }
    while (auto m = a.next_message(now)) EXPECT_TRUE(std::holds_alternative<plan_message>(*m)) << ms;
    EXPECT_GT(a.next_due(), now);
  }
  auto const now = start + milliseconds(500);
  (void)a.deliberate(two, members, sees(9), now, space);
  EXPECT_LE(a.next_due(), now);
  auto const m = a.next_message(now);
  ASSERT_TRUE(m && std::holds_alternative<claim>(*m));
  EXPECT_EQ(b.receive(*m, now).claim, rota::claim_outcome::adopted);
}

/// Nothing was heard since the last deliberation that changes what it chose: then that is the answer, at once.
TEST_F(messages, an_answer_is_said_at_once_if_it_is_judged_already) {
  for (bool const news : {false, true}) {
    auto a = in_play(9);
    a.receive(says(2, 1, defend), start);
    (void)think(a, sees(9));
    while (a.next_message(start)) {
    }
    a.receive(says(2, 2, news ? attack : defend), start);
    ASSERT_EQ(a.receive(claim_by(8, 8), start).claim, rota::claim_outcome::challenged);
    auto const m = a.next_message(start);
    EXPECT_EQ(m.has_value(), !news);
    if (!m) continue;
    EXPECT_EQ(std::get<claim>(*m).atoms, (atoms{does(2, defend), does(9, attack)}));
    EXPECT_EQ(std::get<claim>(*m).ages.size(), 2u);
  }
}

/// Messages count microseconds. A claim with less left would say that none is left, and be refused.
TEST_F(messages, the_last_claim_of_a_reign_has_a_microsecond_left) {
  rota::robot_options options;
  options.claim_period = rota::nanoseconds(100);
  options.message_period = options.pending_age = rota::seconds(100);
  auto a = in_play(9, options), b = in_play(2);
  ASSERT_EQ(a.receive(claim_by(8, 8), start).claim, rota::claim_outcome::challenged);
  (void)think(a, sees(9), start + milliseconds(1990));
  std::array<std::byte, 256> buffer{};
  auto const end = start + rota::seconds(2);
  rota::duration least = rota::seconds(2);
  for (auto now = end - rota::microseconds(5); now < end; now = now + rota::nanoseconds(50)) {
    while (auto const m = a.next_message(now)) {
      if (!std::holds_alternative<claim>(*m)) continue;
      auto const arrived = rota::decode<soccer>(std::span(buffer).first(*rota::encode(*m, buffer)));
      EXPECT_EQ(b.receive(*arrived, now).verdict, verdict::accepted) << (end - now).ns << " ns before the end";
      least = std::get<claim>(*arrived).remaining;
    }
    EXPECT_GT(a.next_due(), now) << "or else a loop would not end";
  }
  EXPECT_EQ(least, rota::microseconds(1));
  EXPECT_EQ(a.next_due(), end);
}

TEST_F(messages, no_message_whatever_breaks_it) {
  int refused = 0, accepted = 0;
  EXPECT_TRUE(rc::check("refused or stale changes nothing; the invariants hold", [&] {
    auto a = in_play(*rc::gen::inRange(1, 6).as("self"));
    auto now = start;
    int const steps = *rc::gen::inRange(1, 40).as("steps");
    for (int i = 0; i < steps; ++i) {
      now += milliseconds(*rc::gen::inRange(0, 50));
      message m;
      if (*rc::gen::arbitrary<bool>()) {
        plan_message p{agent(*rc::gen::inRange(1, 12)),
                       {{*rc::gen::inRange<std::uint64_t>(0, 3)}, *rc::gen::inRange<std::uint64_t>(0, 50)},
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
                {0, agent(leader)},
                agent(leader),
                {*rc::gen::inRange<std::uint64_t>(0, 2)},
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
      if (*rc::gen::arbitrary<bool>()) (void)think(a, sees(*rc::gen::inRange(1, 10)), now);
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

}  // namespace

}  // namespace messages_test
