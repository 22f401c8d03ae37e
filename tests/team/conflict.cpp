#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "soccer.hpp"

#include <rota/algebra/action.hpp>
#include <rota/team/conflict.hpp>
#include <rota/team/cycle.hpp>

#include <set>

namespace {

/// Def. 2 read from the page, over std::set.
bool printed_conflict(allocation const& c1, allocation const& c2) {
  if (c1.type != c2.type) return false;
  std::set<atom> const second(c2.atoms.begin(), c2.atoms.end());
  for (atom const& x : c1.atoms)
    if (second.count(x) == 0) return true;
  return false;
}

TEST(conflict, is_definition_2) {
  int conflicting = 0, cases = 0;
  EXPECT_TRUE(rc::check("conflicts_with and causes agree with the printed definition", [&] {
    auto const c1 = *any_allocation(3, 5).as("C1");
    auto c2 = *any_allocation(3, 5).as("C2");
    if (*rc::gen::inRange(0, 3).as("a third are subsets") == 0) c2.atoms = unite(c1.atoms, c2.atoms);
    bool const expected = printed_conflict(c1, c2);
    ++cases;
    conflicting += expected;
    RC_ASSERT(conflicts_with(c1, c2) == expected);
    RC_ASSERT(causes(c1, c2).empty() == !expected);
    for (atom const& x : causes(c1, c2)) RC_ASSERT(c1.atoms.contains(x) && !c2.atoms.contains(x));
    RC_ASSERT(in_conflict(c1, c2) == (printed_conflict(c1, c2) || printed_conflict(c2, c1)));
  }));
  EXPECT_GE(conflicting * 5, cases);
  EXPECT_GE((cases - conflicting) * 5, cases);
}

TEST(conflict, never_between_plan_types) {
  allocation const play{soccer::plan_type::play, {atom{robot(1), {}, {}}}};
  allocation const defence{soccer::plan_type::defence, {}};
  EXPECT_FALSE(conflicts_with(play, defence));
  EXPECT_FALSE(in_conflict(play, defence));
  EXPECT_TRUE(causes(play, defence).empty());
}

/// A witness is right if it names a conflict, in the printed sense, between b and the agent it points to.
bool witness_holds(rota::conflict_witness<soccer> const& w, allocation const& c1, allocation const& c2,
                   allocation const& cb) {
  allocation const& from = w.partner == rota::conflict_partner::second ? cb : c1;
  allocation const& to = w.partner == rota::conflict_partner::second ? c2 : cb;
  return printed_conflict(from, to) && from.atoms.contains(w.cause) && !to.atoms.contains(w.cause);
}

TEST(proposition_1, witness_is_a_conflict_with_b_in_every_branch) {
  int cases = 0, held = 0, elsewhere = 0, nothing = 0, self = 0;
  int always_first_wrong = 0, always_second_wrong = 0;
  EXPECT_TRUE(rc::check("witness implies conflict", [&] {
    // Four agents, what each believes, and two of them in conflict.
    std::array<allocation, 5> belief;
    for (auto& c : belief) c = {soccer::plan_type::play, *any_atoms(4, 6)};
    auto const a1 = static_cast<std::size_t>(*rc::gen::inRange(1, 5).as("a1"));
    auto const a2 = 1 + (a1 + static_cast<std::size_t>(*rc::gen::inRange(0, 3).as("a2 - a1 - 1"))) % 4;
    auto const x = *any_atom(4).as("cause");
    belief[a1].atoms.insert(x);
    belief[a2].atoms.erase(x);
    auto const b = static_cast<std::size_t>(x.agent);
    if (b != a1 && b != a2) {
      switch (*rc::gen::inRange(0, 3).as("C_b holds x, something else, nothing")) {
      case 0: belief[b].atoms.insert(x); break;
      case 1: belief[b].atoms.erase(x); break;
      default: belief[b].atoms.clear();
      }
    }
    auto const w = proposition_1(belief[a1], belief[a2], belief[b], x);
    RC_ASSERT(w.cause == x);
    RC_ASSERT(witness_holds(w, belief[a1], belief[a2], belief[b]));
    if (b == a1) RC_ASSERT(w.partner == rota::conflict_partner::second);  // the pair (a1, a2) itself
    if (b == a2) RC_ASSERT(w.partner == rota::conflict_partner::first);
    ++cases;
    self += b == a1 || b == a2;
    if (belief[b].atoms.empty())
      ++nothing;
    else if (belief[b].atoms.contains(x))
      ++held;
    else
      ++elsewhere;
    always_first_wrong += !witness_holds({rota::conflict_partner::first, x}, belief[a1], belief[a2], belief[b]);
    always_second_wrong += !witness_holds({rota::conflict_partner::second, x}, belief[a1], belief[a2], belief[b]);
  }));
  for (int branch : {held, elsewhere, nothing, self}) EXPECT_GE(branch * 100, cases * 15) << "of " << cases;
  // The wrong models "it is always a1" and "it is always a2" are rejected often.
  EXPECT_GT(always_first_wrong, 0);
  EXPECT_GT(always_second_wrong, 0);
}

/// Corollary: b's next message, if received by the witness other than b, is a non-empty event there.
TEST(proposition_1, corollary_b_s_message_is_news_to_the_witness) {
  EXPECT_TRUE(rc::check("b's part differs at the witness", [] {
    auto const x = *any_atom(3).as("cause");
    auto c1 = *any_allocation(3, 5).as("C1");
    auto c2 = *any_allocation(3, 5).as("C2");
    auto const cb = *any_allocation(3, 5).as("Cb");
    c1.atoms.insert(x);
    c2.atoms.erase(x);
    auto const w = proposition_1(c1, c2, cb, x);
    auto const& receiver = w.partner == rota::conflict_partner::second ? c2 : c1;
    auto const told = rota::part_of(cb.atoms, x.agent);
    auto const believed = rota::part_of(receiver.atoms, x.agent);
    RC_ASSERT(!std::equal(told.begin(), told.end(), believed.begin(), believed.end()));
  }));
}

/// The meaning of Def. 5: for e_m applied at C and e_r right after it, b's part of the allocation is restored.
TEST(cycle, is_restoration_of_b_s_part) {
  int cycles = 0, others = 0, cases = 0, any_event_wrong = 0;
  EXPECT_TRUE(rc::check("is_cycle iff b's part before e_m equals b's part after e_r", [&] {
    auto const b = robot(*rc::gen::inRange(1, 4).as("b"));
    auto const before = *any_atoms(3, 5).as("C");
    // e_m changes b's part only.
    atoms told;
    for (atom const& x : before)
      if (x.agent != b) told.insert(x);
    for (atom x : *any_atoms(3, 2).as("b's new part")) {
      x.agent = b;
      told.insert(x);
    }
    atoms after = *any_atoms(3, 5).as("C after reallocation");
    if (*rc::gen::inRange(0, 3).as("a third restore b's part") == 0) {
      atoms restored;
      for (atom const& x : after)
        if (x.agent != b) restored.insert(x);
      for (atom const& x : rota::part_of(before, b)) restored.insert(x);
      after = restored;
    }
    auto const e_m = rota::difference(before, told);
    auto const e_r = rota::difference(told, after);
    auto const old_part = rota::part_of(before, b);
    auto const new_part = rota::part_of(after, b);
    bool const restored = std::equal(old_part.begin(), old_part.end(), new_part.begin(), new_part.end());
    RC_ASSERT(is_cycle(e_m, e_r, b) == (restored && !e_m.empty()));
    ++cases;
    cycles += restored && !e_m.empty();
    others += !restored && !e_m.empty();
    // A wrong model: "the whole allocation is restored".
    any_event_wrong += (before == after) != restored && !e_m.empty();
  }));
  EXPECT_GE(cycles * 5, cases);
  EXPECT_GE(others * 5, cases);
  EXPECT_GT(any_event_wrong, 0);
}

TEST(cycle, an_empty_message_event_is_no_event) {
  auto const x = event::addition(atom{robot(1), {}, {}});
  EXPECT_FALSE(rota::is_cycle<soccer>({}, {}, robot(1)));
  EXPECT_FALSE(rota::is_cycle<soccer>({}, x, robot(2)));
  EXPECT_TRUE(rota::is_cycle<soccer>(x, inverse(x), robot(1)));
  EXPECT_FALSE(rota::is_cycle<soccer>(x, {}, robot(1)));
}

}  // namespace
