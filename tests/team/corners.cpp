// Corners of the protocol that nothing else looks into: a break of each went unnoticed by all other tests.
#include <gtest/gtest.h>

#include "playground.hpp"

#include <rota/team/wire.hpp>

#include <array>
#include <variant>

namespace corners_test {

using rota::claim_outcome;
using rota::milliseconds;
using rota::refusal;
using rota::seconds;
using rota::verdict;

namespace {

using authority = rota::authority<soccer>;
using stamp = rota::claim_stamp<soccer>;

constexpr rota::instant at(int ms) { return start + milliseconds(ms); }

struct corners : playground {
  static rota::heard_claim hear(authority& a, claim c, rota::duration left, rota::instant now) {
    c.remaining = left;
    return a.hear(c, std::nullopt, now, seconds(2));
  }
  /// Robot 9 has answered a claim, having heard robot 2 at 0 ms. It speaks at 40 ms.
  robot leader() {
    auto a = in_play(9);
    a.receive(says(2, 1, defend), start);
    a.receive(claim_by(1, 1), at(10));
    (void)think(a, sees(9), at(40));
    return a;
  }
  static rota::duration age_in(claim const& c, int n) {
    for (std::size_t i = 0; i < c.atoms.size(); ++i)
      if (c.atoms.begin()[i].agent == agent(n)) return c.ages[i];
    return seconds(-1);
  }
};

TEST_F(corners, a_claim_begins_with_version_1_and_its_opening_counts_from_its_beginning) {
  authority a;
  a.lead(play_id, {does(2, attack)}, stamp{0, agent(2)}, first_life, 1, at(1000), at(1000), at(3000));
  auto const c = a.next_claim(at(1000), milliseconds(100), milliseconds(200), milliseconds(30));
  ASSERT_TRUE(c);
  EXPECT_EQ(c->version, 1u);
  EXPECT_EQ(a.next_due(), at(1030));
  ASSERT_TRUE(a.next_claim(at(1030), milliseconds(100), milliseconds(200), milliseconds(300)));
  EXPECT_EQ(a.next_due(), at(1130)) << "an opening makes nobody slower";
  EXPECT_FALSE(a.next_claim(at(3000), milliseconds(100)));
}

TEST_F(corners, a_claim_that_was_never_sent_is_due_when_its_leader_deliberates) {
  authority a;
  a.lead(play_id, {does(2, attack)}, stamp{0, agent(2)}, first_life, 1, start, at(100), at(2000));
  EXPECT_EQ(a.next_due(), at(100));
  a.revise({does(2, attack)}, at(10));
  EXPECT_EQ(a.next_due(), at(10));
}

TEST_F(corners, a_copy_is_fresh_if_none_with_as_little_time_left_was_heard) {
  authority a;
  EXPECT_TRUE(hear(a, claim_by(9, 9), milliseconds(1000), start).fresh);
  EXPECT_FALSE(hear(a, claim_by(9, 9), milliseconds(1500), at(10)).fresh);
  EXPECT_FALSE(hear(a, claim_by(9, 9), milliseconds(1200), at(20)).fresh);
  EXPECT_TRUE(hear(a, claim_by(9, 9), milliseconds(950), at(60)).fresh);
}

TEST_F(corners, only_a_greater_claim_that_its_leader_has_not_ended_is_heard_late) {
  authority a;
  hear(a, claim_by(3, 3), seconds(1), start);
  a.expire(at(1000));
  EXPECT_EQ(hear(a, claim_by(3, 3), milliseconds(900), at(1100)).outcome, claim_outcome::expired);
  EXPECT_EQ(a.heard_late({0, agent(2)}), at(1100));
  EXPECT_EQ(a.heard_late({0, agent(5)}), rota::long_ago);
  hear(a, claim_by(9, 9), seconds(2), at(1200));
  EXPECT_TRUE(a.hear_over(agent(9), first_life, 1, 0, at(1300), seconds(2)));
  hear(a, claim_by(9, 9), seconds(1), at(1400));
  EXPECT_EQ(a.heard_late({0, agent(5)}), rota::long_ago);
}

TEST_F(corners, what_another_leader_ends_or_a_silence_forgets_does_not_touch_the_claim_in_force) {
  authority a;
  hear(a, claim_by(8, 8), seconds(2), start);
  hear(a, claim_by(9, 9), seconds(1), start);
  EXPECT_FALSE(a.hear_over(agent(8), first_life, 1, 0, at(10), seconds(2)));
  EXPECT_TRUE(a.obeying());
  a.forget(agent(9));
  hear(a, claim_by(9, 9), seconds(2), at(50));
  EXPECT_EQ(a.expiry(), at(1000));
}

TEST_F(corners, a_clock_set_back_moves_the_ends_of_claims_and_the_ages_of_what_monitors_know) {
  authority a;
  hear(a, claim_by(9, 9), seconds(2), at(1000));
  a.shift(milliseconds(-500));
  hear(a, claim_by(9, 9), seconds(2), at(600));
  EXPECT_EQ(a.expiry(), at(2500));

  rota::part_change<soccer> const moved{agent(2), does(2, attack), does(2, defend)};
  rota::cycle_monitor<soccer> cycles(rota::monitor_options{.cycles = 1});
  cycles.on_message(moved, at(1000));
  cycles.shift(milliseconds(-900));
  EXPECT_FALSE(cycles.on_deliberation({}, {does(2, attack)}, at(1500)).detected) << "1.4 s old";

  rota::insistence_monitor<soccer> insistence(rota::monitor_options{.cycles = 2});
  insistence.on_message(moved, at(1000));
  (void)insistence.on_deliberation({}, {does(2, attack)}, at(1000));
  insistence.shift(milliseconds(-900));
  insistence.on_message(moved, at(3500));
  EXPECT_FALSE(insistence.on_deliberation({}, {does(2, attack)}, at(3500)).detected) << "3.4 s later";
}

TEST_F(corners, cycles_before_a_pause_do_not_count) {
  rota::part_change<soccer> const moved{agent(2), does(2, attack), does(2, defend)};
  rota::cycle_monitor<soccer> m(rota::monitor_options{.cycles = 2});
  for (int const ms : {0, 1600}) {
    m.on_message(moved, at(ms));
    EXPECT_FALSE(m.on_deliberation({}, {does(2, attack)}, at(ms)).detected);
    EXPECT_FALSE(m.on_deliberation({}, {does(2, attack)}, at(ms + 1500)).detected);
  }
}

TEST_F(corners, insisting_begins_anew_with_what_is_accepted_and_with_who_was_forgotten) {
  rota::part_change<soccer> const attacks{agent(2), {}, does(2, attack)}, defends{agent(2), {}, does(2, defend)};
  auto const one_after = [&](auto before) {
    rota::insistence_monitor<soccer> m(rota::monitor_options{.cycles = 2, .yielding = 2});
    before(m);
    int times = 0;
    do {
      m.on_message(attacks, start);
      ++times;
    } while (!m.on_deliberation({}, {does(2, defend)}, start).detected);
    return times;
  };
  auto const says_and_gets = [&](auto& m, auto const& what, soccer::task gets) {
    m.on_message(what, start);
    EXPECT_FALSE(m.on_deliberation({}, {does(2, gets)}, start).detected);
  };
  EXPECT_EQ(one_after([&](auto&) {}), 2);
  EXPECT_EQ(one_after([&](auto& m) { says_and_gets(m, defends, defend); }), 2);
  EXPECT_EQ(one_after([&](auto& m) { says_and_gets(m, attacks, defend), says_and_gets(m, attacks, attack); }), 2);
  EXPECT_EQ(one_after([&](auto& m) { says_and_gets(m, attacks, defend), m.forget(agent(2)); }), 2);
  EXPECT_EQ(one_after([&](auto& m) { says_and_gets(m, attacks, defend), says_and_gets(m, defends, defend); }), 3);
}

TEST_F(corners, an_older_version_imposes_nothing_and_what_is_imposed_counts_as_said) {
  auto a = in_play(1);
  a.receive(says(9, 1, defend), start);
  auto c = claim_by(9, 9);
  a.receive(c, start);
  EXPECT_EQ(a.believes(play_id)->said(agent(9)), does(9, attack));
  auto next = c;
  next.version = 2;
  next.atoms = {does(9, defend)};
  next.remaining = milliseconds(1900);
  a.receive(next, at(100));
  a.receive(c, at(200));
  EXPECT_EQ(a.believes(play_id)->atoms(), next.atoms);
}

TEST_F(corners, a_decision_says_once_that_the_clock_was_set_back_and_silence_counts_from_there) {
  auto a = in_play(1);
  a.receive(says(2, 5, defend), at(40'000));
  EXPECT_EQ(think(a, sees(1), at(5'000)).clock_set_back, seconds(35));
  EXPECT_EQ(think(a, sees(1), at(5'000)).clock_set_back, rota::duration{});
  EXPECT_EQ(a.receive(says(2, 1, defend), at(34'000)).verdict, verdict::stale);
  EXPECT_EQ(a.receive(says(2, 1, defend), at(36'000)).verdict, verdict::accepted) << "a new life";
}

TEST_F(corners, a_claim_says_how_long_ago_its_leader_heard_whom_it_names) {
  auto a = leader();
  auto m = a.next_message(at(40));
  ASSERT_TRUE(m && std::holds_alternative<claim>(*m));
  EXPECT_EQ(age_in(std::get<claim>(*m), 9), rota::duration{});
  EXPECT_EQ(age_in(std::get<claim>(*m), 2), milliseconds(40));
  while (a.next_message(at(40))) {
  }
  EXPECT_EQ(a.next_due(), at(70));
  a.receive(says_nothing(2, 2), at(60));
  m = a.next_message(at(70));
  ASSERT_TRUE(m && std::holds_alternative<claim>(*m));
  EXPECT_GT(age_in(std::get<claim>(*m), 2), a.options().silence);
}

TEST_F(corners, a_stamp_stays_until_the_last_claim_that_was_heard_can_have_ended) {
  auto a = in_play(5);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(9, 9), start);
  auto brief = claim_by(8, 8);
  brief.remaining = milliseconds(100);
  EXPECT_EQ(a.receive(brief, at(10)).claim, claim_outcome::outranked);
  a.set_confidence(7);
  auto over = says_nothing(9, 2);
  over.claims = 1;
  a.receive(over, at(500));
  EXPECT_EQ(a.receive(claim_by(1, 1), at(600)).claim, claim_outcome::challenged);
  EXPECT_EQ(a.rule(play_id)->current().stamp.confidence, 0u);
}

TEST_F(corners, a_stamp_thaws_when_the_clock_that_was_set_back_says_so) {
  auto a = in_play(5);
  a.receive(says(9, 1, defend), at(1000));
  a.receive(claim_by(9, 9), at(1000));
  (void)think(a, sees(5), at(500));  // the claim ends at 2500 now
  a.set_confidence(7);
  EXPECT_EQ(a.receive(claim_by(1, 1), at(2600)).claim, claim_outcome::challenged);
  EXPECT_EQ(a.rule(play_id)->current().stamp.confidence, 7u);
}

TEST_F(corners, a_new_life_after_a_long_silence_may_claim_with_any_number) {
  auto a = in_play(1);
  auto old = says(9, 1, defend);
  old.number.incarnation.value = 5;
  a.receive(old, start);
  auto c = claim_by(9, 9);
  c.incarnation.value = 5;
  EXPECT_EQ(a.receive(c, start).claim, claim_outcome::adopted);
  old.number.incarnation.value = 4;
  EXPECT_EQ(a.receive(old, at(31'000)).verdict, verdict::accepted);
  c.incarnation.value = 4;
  EXPECT_EQ(a.receive(c, at(31'010)).claim, claim_outcome::adopted);
}

TEST_F(corners, a_blind_robot_obeys_a_smaller_claim) {
  auto a = in_play(9);
  view nothing;
  nothing.attack.fill(-100);
  EXPECT_EQ(think(a, nothing).reason, rota::decision_reason::no_valid_allocation);
  EXPECT_EQ(a.receive(claim_by(1, 1), start).claim, claim_outcome::adopted);
}

TEST_F(corners, what_a_robot_insisted_on_before_it_was_deleted_does_not_count) {
  for (bool const deleted : {false, true}) {
    auto a = in_play(1, {.cycles = 2, .pending_age = seconds(3), .silence = seconds(1)});
    a.receive(says(2, 1, attack), start);
    EXPECT_FALSE(think(a, sees(1), start).detected);
    if (deleted) {
      EXPECT_FALSE(think(a, sees(1), at(1050)).deleted.empty());
    }
    a.receive(says(2, 2, attack), at(1100));
    EXPECT_EQ(think(a, sees(1), at(1100)).detected.has_value(), !deleted);
  }
}

TEST_F(corners, a_clock_set_back_moves_what_a_robot_insisted_on) {
  auto a = in_play(1, {.cycles = 2});
  a.receive(says(2, 1, attack), at(10'000));
  EXPECT_FALSE(think(a, sees(1), at(10'000)).detected);
  EXPECT_FALSE(think(a, sees(1), at(1'000)).detected);
  a.receive(says(2, 2, attack), at(4'500));
  EXPECT_FALSE(think(a, sees(1), at(4'500)).detected) << "3.5 s later";
}

TEST_F(corners, a_late_copy_of_a_claim_makes_nobody_whom_it_names_younger) {
  auto a = in_play(1);
  auto c = claim_by(9, 9);
  c.atoms.insert(does(2, defend));
  c.ages = {milliseconds(100), rota::duration{}};
  a.receive(c, start);
  auto const heard = a.believes(play_id)->heard(agent(2));
  a.receive(c, at(300));
  EXPECT_EQ(a.believes(play_id)->heard(agent(2)), heard);
}

/// The same where the late copy is answered: while the first came, a greater leader ruled.
TEST_F(corners, a_late_copy_that_is_answered_makes_nobody_whom_it_names_younger) {
  for (int late : {0, 1900}) {
    auto a = in_play(5);
    a.receive(says(9, 1, defend), start);
    a.receive(claim_by(9, 9), start);
    auto c = claim_by(3, 3);
    c.atoms.insert(does(2, defend));
    c.ages = {rota::duration{}, rota::duration{}};
    EXPECT_EQ(a.receive(c, at(10)).claim, rota::claim_outcome::outranked);
    auto over = says(9, 2, defend);
    over.claims = 1;
    a.receive(over, at(10));
    EXPECT_EQ(a.receive(c, at(10 + late)).claim, rota::claim_outcome::challenged);
    EXPECT_EQ(a.believes(play_id)->takes_part(agent(2)), late == 0) << "it was heard " << late << " ms ago, and more";
  }
}

TEST_F(corners, a_claim_keeps_to_one_plan) {
  auto const one_plan = [](soccer::plan p) {
    return *rota::plan<soccer, view>::make(
        {.plan = p,
         .tasks = {{attack, {1, 1}, soccer::state::get_ball}, {defend, {0, 3}, soccer::state::protect}},
         .utility = rota::additive_utility<soccer, view>(
             [](soccer::agent, soccer::task, view const&) { return std::optional<double>(1); })});
  };
  auto const both =
      *rota::plan_type<soccer, view>::make(play_id, {one_plan(soccer::plan::normal), one_plan(soccer::plan::kickoff)});
  robot a(agent(1), squad(9), first_life);
  a.enter(both, start);
  auto c = claim_by(9, 9);
  c.atoms.insert({agent(2), soccer::plan::kickoff, defend});
  c.ages = {rota::duration{}, rota::duration{}};
  EXPECT_EQ(a.receive(c, start).reason, refusal::malformed_allocation);
}

TEST_F(corners, refusals_by_name) {
  auto a = in_play(1);
  EXPECT_EQ(a.receive(says(2, std::uint64_t{1} << 62, defend), start).reason, refusal::number_out_of_reach);
  EXPECT_EQ(a.receive(says(2, 1, defend), start).reason, refusal::none);
  auto const far = rota::most_jump + 2;
  EXPECT_EQ(a.receive(says(2, far, defend), at(1000)).reason, refusal::number_out_of_reach);
  EXPECT_EQ(a.receive(says(2, far, defend), at(31'000)).reason, refusal::none);

  auto two = claim_by(9, 9);
  two.atoms.insert(does(9, defend));
  two.ages.push_back({});
  EXPECT_EQ(a.receive(two, start).reason, refusal::malformed_allocation);
  auto young = claim_by(9, 9);
  young.ages = {milliseconds(-1)};
  EXPECT_EQ(a.receive(young, start).reason, refusal::malformed_allocation);

  auto b = in_play(1, {.resolution = false});
  EXPECT_EQ(b.receive(claim_by(9, 9), start).reason, refusal::resolution_off);
}

TEST_F(corners, bytes_of_too_many_types_or_of_a_reign_without_end_are_refused) {
  auto const decoded = [](auto write) {
    std::array<std::byte, 512> out{};
    rota::detail::byte_writer w(out);
    write(w);
    w.fixed32(rota::detail::crc32(std::span<std::byte const>(out).first(w.size())));
    return rota::decode<soccer>(std::span<std::byte const>(out).first(w.size()));
  };
  for (std::uint64_t const types : {std::uint64_t{64}, std::uint64_t{65}}) {
    auto const m = decoded([&](auto& w) {
      w.byte(0xa4);
      for (std::uint64_t const x : {std::uint64_t{1}, std::uint64_t{1}, std::uint64_t{1}, std::uint64_t{0}, types})
        w.number(x);
      for (std::uint64_t k = 0; k < types; ++k) w.number(k), w.byte(0), w.number(0);
    });
    EXPECT_EQ(m.has_value(), types == 64);
  }
  for (std::uint64_t const us : {std::uint64_t{2'000'000}, std::uint64_t{1} << 62}) {
    auto const m = decoded([&](auto& w) {
      w.byte(0xa5);
      for (int k = 0; k < 9; ++k) w.number(1);
      w.number(us);
      w.number(0);
    });
    EXPECT_EQ(m.has_value(), us == 2'000'000);
  }
}

}  // namespace

}  // namespace corners_test
