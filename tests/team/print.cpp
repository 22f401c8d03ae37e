#include <gtest/gtest.h>

#include "playground.hpp"

#include <rota/print.hpp>

#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

namespace print_test {

using testing::AssertionResult;

namespace {

struct print : playground {};

/// Names that are no numbers, for what takes a way to name things.
struct shirts {
  std::string operator()(soccer::agent a) const { return "#" + std::to_string(int(a)); }
  std::string operator()(soccer::plan_type t) const { return t == play_id ? "play" : "defence"; }
  std::string operator()(soccer::plan p) const { return p == soccer::plan::normal ? "normal" : "kickoff"; }
  std::string operator()(soccer::task t) const { return t == attack ? "attack" : t == defend ? "defend" : "support"; }
  std::string operator()(soccer::state z) const { return z == soccer::state::none ? "none" : "busy"; }
};

AssertionResult tells(std::string const& sentence, std::vector<std::string> const& parts) {
  for (auto const& part : parts)
    if (sentence.find(part) == std::string::npos)
      return testing::AssertionFailure() << '"' << sentence << "\" does not say \"" << part << '"';
  return testing::AssertionSuccess();
}

/// Every value from 0 to `last` has words of its own, and what is no value has none.
template <class Enum>
void each_has_words(Enum last) {
  std::set<std::string> words;
  auto const count = static_cast<unsigned>(last) + 1;
  for (unsigned i = 0; i < count; ++i) words.insert(to_string(static_cast<Enum>(i)));
  EXPECT_EQ(words.size(), count);
  EXPECT_EQ(words.count("?"), 0u);
}

TEST_F(print, every_value_of_every_enumeration_has_words_of_its_own) {
  each_has_words(rota::message_case::left);
  each_has_words(rota::conflict_partner::second);
  each_has_words(rota::verdict::refused);
  each_has_words(rota::refusal::resolution_off);
  each_has_words(rota::claim_outcome::challenged);
  each_has_words(rota::decision_reason::obeyed);
  each_has_words(rota::wire_fault::out_of_range);
}

TEST_F(print, messages_are_printed_in_the_notation_of_the_paper) {
  auto m = says(2, 7, attack);
  m.types.push_back(says(2, 7, std::nullopt, defence_id).types[0]);
  EXPECT_EQ(to_string(m, shirts{}), "agent #2, message 1:7: play: (normal, attack, none), defence: no task");
  EXPECT_EQ(to_string(message(m), shirts{}), to_string(m, shirts{}));
  EXPECT_EQ(to_string(says_nothing(2, 8)), "agent 2, message 1:8: executes no plan type");
  auto const c = claim_by(9, 3, 4);
  EXPECT_EQ(to_string(c, shirts{}),
            "agent #9, claim 1:4, version 1: play: {In(#3, normal, attack)}, stamp (0, #9), 2 s left");
  EXPECT_EQ(to_string(message(c)), "agent 9, claim 1:4, version 1: 0: {In(3, 0, 0)}, stamp (0, 9), 2 s left");
}

TEST_F(print, everything_goes_into_a_stream) {
  auto a = in_play(1);
  std::ostringstream out;
  out << rota::verdict::stale << '|' << first_life << '|' << message(says_nothing(2, 1)) << '|' << *a.believes(play_id)
      << '|' << a.receive(says(2, 1, attack), start) << '|' << think(a, sees(1));
  EXPECT_TRUE(
      tells(out.str(), {"stale|1|agent 2, message 1:1: executes no plan type|{}, without a task: 1|accepted; in 0",
                        "|plan 0 is adopted"}));
}

TEST_F(print, a_belief_names_those_without_a_task) {
  auto a = in_play(1);
  EXPECT_EQ(to_string(*a.believes(play_id), shirts{}), "{}, without a task: #1");
  a.receive(says(2, 1, attack), start);
  EXPECT_EQ(to_string(*a.believes(play_id), shirts{}), "{In(#2, normal, attack)}, without a task: #1");
  (void)think(a, sees(2));
  EXPECT_EQ(to_string(*a.believes(play_id)), "{In(1, 0, 1), In(2, 0, 0)}");
}

TEST_F(print, a_reception_says_what_changed_or_why_it_was_refused) {
  auto a = in_play(1);
  EXPECT_EQ(describe(a.receive(says(2, 1, attack), start), shirts{}),
            "accepted; in play agent #2 joined: ({In(#2, normal, attack)}, {})");
  EXPECT_EQ(describe(a.receive(says(2, 1, attack), start)), "stale");
  EXPECT_EQ(describe(a.receive(says(1, 1, attack), start)),
            "refused: it says that the receiver sent it: an echo, or two robots with one id");
  EXPECT_EQ(describe(a.receive(claim_by(9, 3), start), shirts{}),
            "accepted: the claim is obeyed from now on; imposed: ({In(#3, normal, attack)}, {In(#2, normal, attack)})");
}

/// Mistake 10: to deliberate before entering, or on another plan type.
TEST_F(print, a_decision_about_a_plan_type_that_was_not_entered_says_which_were) {
  robot a(agent(1), squad(9), first_life);
  auto d = think(a, sees(1));
  EXPECT_EQ(d.reason, rota::decision_reason::not_executing);
  EXPECT_EQ(describe(d, shirts{}), "plan type play is not executed: no plan type was entered");
  auto const defence = make_play(defence_id);
  a.enter(defence, start);
  d = think(a, sees(1));
  EXPECT_EQ(d.type, play_id);
  EXPECT_EQ(d.executed.size(), 1u);
  EXPECT_EQ(describe(d, shirts{}), "plan type play is not executed: entered were defence");
  a.enter(play, start);
  a.leave(defence_id);
  d = a.deliberate(defence, members, sees(1), start, space);
  EXPECT_EQ(describe(d), "plan type 1 is not executed: entered were 0") << "numbers, where nobody names things";
}

TEST_F(print, a_decision_says_what_the_search_says_and_what_the_robot_does) {
  auto a = in_play(1);
  a.receive(says(2, 1, attack), start);
  auto const d = think(a, sees(1));
  ASSERT_TRUE(d.search);
  EXPECT_EQ(d.search->reason, rota::reallocation_reason::adopted_better);
  EXPECT_TRUE(tells(describe(d, shirts{}), {describe(*d.search, shirts{}), "own task: In(#1, normal, attack)"}));
}

/// What best_allocation says of a utility that is no number, a robot says as well.
TEST_F(print, a_utility_that_is_not_a_number_is_named_with_its_agent) {
  auto a = in_play(3);
  view v;
  v.attack[3] = std::numeric_limits<double>::quiet_NaN();
  auto const d = think(a, v);
  EXPECT_EQ(d.reason, rota::decision_reason::no_valid_allocation);
  EXPECT_TRUE(tells(describe(d, shirts{}), {"is not a number", "#3", "no task of its own"}));
}

TEST_F(print, a_decision_says_what_the_running_allocation_violates) {
  auto a = in_play(1);
  a.receive(says(2, 1, attack), start);
  a.receive(says(3, 1, attack), start);
  auto const d = think(a, sees(2));
  ASSERT_TRUE(d.search && d.search->violated);
  EXPECT_TRUE(tells(describe(d, shirts{}), {describe(*d.search->violated, shirts{})}));
}

TEST_F(print, a_decision_says_who_leads_and_since_when_it_obeys) {
  auto a = in_play(1);
  a.receive(claim_by(9, 1), start);
  auto d = think(a, sees(2));
  EXPECT_EQ(d.leader, agent(9));
  EXPECT_EQ(describe(*a.rule(play_id), shirts{}), "obeys agent #9 until 2 s");
  EXPECT_EQ(describe(d, shirts{}),
            "a leader decides: agent #9; own task: In(#1, normal, attack); by itself it would take "
            "{In(#1, normal, attack), In(#9, normal, defend)}");
  d = think(a, sees(1), start + rota::seconds(2));
  EXPECT_TRUE(tells(describe(d, shirts{}), {"a reign has ended"}));
  EXPECT_FALSE(d.leader);
  EXPECT_EQ(describe(*a.rule(play_id)), "nobody rules");

  auto b = in_play(5);
  std::uint64_t n = 0;
  for (int i = 0; i < 4; ++i) {
    b.receive(says(2, ++n, i == 0 ? defend : attack), start);
    (void)think(b, sees(5));
  }
  b.receive(says(2, ++n, attack), start);
  d = think(b, sees(5));
  EXPECT_TRUE(tells(describe(d, shirts{}),
                    {"cycles completed: 1", "a loop with agent #2 was detected", "the robot claims authority"}));
  EXPECT_EQ(d.leader, agent(5));
  EXPECT_EQ(describe(*b.rule(play_id), shirts{}), "leads until 2 s");
  EXPECT_TRUE(tells(describe(think(b, sees(5)), shirts{}), {"the robot leads"}));
}

TEST_F(print, a_decision_names_the_silent_that_were_deleted) {
  auto a = in_play(1);
  a.receive(says(2, 1, attack), start);
  auto const d = think(a, sees(1), start + rota::seconds(3));
  EXPECT_TRUE(tells(describe(d, shirts{}), {"silent agents were deleted: ({}, {In(#2, normal, attack)})"}));
}

}  // namespace

}  // namespace print_test
