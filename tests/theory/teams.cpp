// Def. 2, Prop. 1 and Def. 5, for all beliefs about two or three agents.

#include "theory/every_case.hpp"

#include <rota/algebra/apply.hpp>
#include <rota/algebra/dense_event.hpp>
#include <rota/team/conflict.hpp>
#include <rota/team/cycle.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>

namespace teams_theory {
namespace {

using namespace theory;

TEST(conflict, is_definition_2) {
  law directed("C₁ conflicts with C₂ ⇔ some atom is in C₁ and not in C₂");
  law agents("in conflict ⇔ either way");
  law cause("the causes are those atoms");
  law types("never between plan types");
  auto const all = beliefs(3);
  for (auto const& c : all)
    for (auto const& d : all) {
      allocation const c1{names::plan_type::ours, c};
      allocation const c2{names::plan_type::ours, d};
      allocation const other{names::plan_type::other, d};
      atom_set missing;
      for (auto const& x : c)
        if (std::find(d.begin(), d.end(), x) == d.end()) missing.insert(x);
      directed(conflicts_with(c1, c2) == !missing.empty());
      cause(causes(c1, c2) == missing);
      agents(in_conflict(c1, c2) == (conflicts_with(c1, c2) || conflicts_with(c2, c1)));
      types(!conflicts_with(c1, other) && !in_conflict(c1, other) && causes(c1, other).empty());
    }
}
TEST(proposition_1, the_witness_is_in_conflict_with_b) {
  law conflict("the witness and b are in conflict, by the same cause");
  law news("b's next message is a non-empty event at the witness");
  std::map<rota::conflict_partner, int> branches;
  auto const all = beliefs(2);
  for (auto const& c : all)
    for (auto const& d : all)
      for (auto const& own : all) {
        allocation const c1{names::plan_type::ours, c};
        allocation const c2{names::plan_type::ours, d};
        allocation const cb{names::plan_type::ours, own};
        for (auto const& x : causes(c1, c2)) {
          auto const w = proposition_1(c1, c2, cb, x);
          bool const first = w.partner == rota::conflict_partner::first;
          ++branches[w.partner];
          conflict(w.cause == x && (first ? causes(c1, cb) : causes(cb, c2)).contains(x));
          news(part(first ? c : d, x.agent) != part(own, x.agent));
        }
      }
  EXPECT_EQ(branches.size(), 2u);
}

TEST(cycle, restores_the_part_of_b) {
  law restores("a cycle ⇔ e_m ≠ ∅ and b's part is as it was");
  law dense("of dense events, too");
  using both_agents = rota::in_universe<names, rota::name_list<names::agent{0}, names::agent{1}>,
                                        rota::name_list<names::plan{0}, names::plan{1}>,
                                        rota::name_list<names::task{0}, names::task{1}, names::task{2}>>;
  auto const in_planes = [](event const& e) { return to_dense(e, both_agents{}).value(); };
  auto const all = beliefs(2);
  for (auto const& before : all)
    for (std::uint8_t agent = 0; agent < 2; ++agent) {
      auto const b = static_cast<names::agent>(agent);
      for (std::size_t i = 0; i <= atoms_per_agent; ++i) {
        auto const told = with_part(before, b, i == atoms_per_agent ? atom_set{} : atom_set{nth(agent * 6u + i)});
        auto const e_m = difference(before, told);
        for (auto const& after : all) {
          auto const e_r = difference(told, after);
          bool const restored = !e_m.empty() && part(after, b) == part(before, b);
          restores(is_cycle(e_m, e_r, b) == restored);
          dense(is_cycle(in_planes(e_m), in_planes(e_r), b) == restored);
        }
      }
    }
}

TEST(cycle, entails_a_conflict_only_while_b_stands_by_its_message) {
  law stands("a cycle, and b's part of C_b is still what it told ⇒ a and b are in conflict");
  law moved("a cycle, and C_b is by now what a believes ⇒ they are not");
  auto const all = beliefs(2);
  auto const b = static_cast<names::agent>(1);
  for (auto const& before : all)
    for (auto const& told : all)
      for (auto const& after : all) {
        if (part(told, names::agent{}) != part(before, names::agent{})) continue;  // b speaks for itself
        if (!is_cycle(difference(before, told), difference(told, after), b)) continue;
        allocation const believed{names::plan_type::ours, after};
        moved(!in_conflict(believed, allocation{names::plan_type::ours, after}));
        for (auto const& own : all)
          if (part(own, b) == part(told, b)) stands(in_conflict(believed, allocation{names::plan_type::ours, own}));
      }
}

}  // namespace
}  // namespace teams_theory
