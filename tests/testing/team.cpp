// Def. 2, Prop. 1 and Def. 5. Each law is a test of its own, such as conflict.definition_2.conflict_iff_some_cause.
// Then one wrong model per law.

#include "testing/foreign.hpp"
#include "testing/wrong.hpp"

#include <rota/testing/gtest.hpp>
#include <rota/testing/team_laws.hpp>

namespace team_test {

using namespace rota::testing;
using sample::atom;
using sample::atom_set;
using sample::dense_event;
using sample::event;
using sample::map_event;
using sample::names;
using allocation = rota::allocation<names>;
using witness = rota::conflict_witness<names>;

using right = conflict_model<names>;

[[maybe_unused]] bool const registered =
    register_laws("conflict", conflict_laws<right>()) && register_laws("conflict", conflict_theorems<right>()) &&
    register_laws("conflict", proposition_1_laws<right>()) &&
    register_laws("conflict", proposition_1_theorems<right>()) && register_laws("cycle", cycle_laws<event>()) &&
    register_laws("cycle", cycle_theorems<event>()) && register_laws("dense_cycle", cycle_laws<dense_event>()) &&
    register_laws("dense_cycle", cycle_theorems<dense_event>());

/// Compares allocations of different plan types.
struct ignores_the_type : right {
  static bool conflicts_with(allocation const& c1, allocation const& c2) { return !is_subset(c1.atoms, c2.atoms); }
  static atom_set causes(allocation const& c1, allocation const& c2) { return subtract(c1.atoms, c2.atoms); }
  static bool in_conflict(allocation const& c1, allocation const& c2) { return c1.atoms != c2.atoms; }
};
struct names_one_cause_only : right {
  static atom_set causes(allocation const& c1, allocation const& c2) {
    auto const all = rota::causes(c1, c2);
    return all.empty() ? all : atom_set{*all.begin()};
  }
};
/// Def. 2 read as a symmetric relation.
struct symmetric : right {
  static bool conflicts_with(allocation const& c1, allocation const& c2) { return rota::in_conflict(c1, c2); }
};
struct looks_one_way : right {
  static bool in_conflict(allocation const& c1, allocation const& c2) { return rota::conflicts_with(c1, c2); }
};
/// An agent disagrees with itself if it believes anything.
struct reflexive : right {
  static bool conflicts_with(allocation const& c1, allocation const& c2) {
    return rota::conflicts_with(c1, c2) || (c1 == c2 && !c1.atoms.empty());
  }
};
TEST(wrong_conflict, one_model_for_each_law) {
  EXPECT_EQ(broken(conflict_laws<ignores_the_type>()), "never_between_plan_types");
  EXPECT_EQ(broken(conflict_laws<names_one_cause_only>()), "causes_are_what_the_other_lacks");
  EXPECT_EQ(broken(conflict_laws<symmetric>()), "conflict_iff_some_cause");
  EXPECT_EQ(broken(conflict_laws<looks_one_way>()), "agents_conflict_either_way");
}
TEST(wrong_conflict, theorems_fall_too) {
  EXPECT_EQ(broken(conflict_theorems<symmetric>()), "directed");
  EXPECT_EQ(broken(conflict_theorems<reflexive>()), "irreflexive");
}

/// "It is always a₁", and "it is always a₂".
template <rota::conflict_partner Partner>
struct always : right {
  static witness proposition_1(allocation const&, allocation const&, allocation const&, atom const& cause) {
    return {Partner, cause};
  }
};
struct names_another_cause : right {
  static witness proposition_1(allocation const& c1, allocation const& c2, allocation const& cb, atom cause) {
    auto w = rota::proposition_1(c1, c2, cb, cause);
    w.cause = nth_atom<atom>(0);
    return w;
  }
};
TEST(wrong_proposition_1, one_model_for_each_law) {
  EXPECT_EQ(broken(proposition_1_laws<always<rota::conflict_partner::first>>()), "witness_is_in_conflict_with_b");
  EXPECT_EQ(broken(proposition_1_laws<always<rota::conflict_partner::second>>()), "witness_is_in_conflict_with_b");
  EXPECT_EQ(broken(proposition_1_laws<names_another_cause>()), "witness_names_the_cause");
  EXPECT_EQ(broken(proposition_1_theorems<always<rota::conflict_partner::first>>()), "b_is_news_to_the_witness");
}

/// The whole allocation is restored, not b's part.
template <class E>
struct asks_for_everybody : rota::structure<E> {
  using right = rota::structure<E>;
  static bool is_cycle(E const& e_m, E const& e_r, names::agent) {
    return !(e_m == right::identity()) && right::combine(e_m, e_r) == right::identity();
  }
};
template <class E>
struct forgets_that_empty_is_no_event : rota::structure<E> {
  static bool is_cycle(E const& e_m, E const& e_r, names::agent b) {
    auto const both = rota::structure<E>::combine(e_m, e_r);
    return !rota::mentions(storage<E, rota::structure<E>>::read(both), b);
  }
};
template <class E>
void one_model_for_each_law_of_cycles() {
  EXPECT_EQ((broken(cycle_laws<E, asks_for_everybody<E>>())), "silent_about_b");
  EXPECT_EQ((broken(cycle_laws<E, forgets_that_empty_is_no_event<E>>())), "empty_message_is_no_event");
  EXPECT_EQ((broken(cycle_theorems<E, asks_for_everybody<E>>())), "restores_b_s_part");
}
TEST(wrong_cycle, one_model_for_each_law) { one_model_for_each_law_of_cycles<event>(); }
TEST(wrong_cycle, one_model_for_each_law_of_dense_events) { one_model_for_each_law_of_cycles<dense_event>(); }
TEST(wrong_cycle, one_model_for_each_law_of_foreign_events) { one_model_for_each_law_of_cycles<map_event>(); }

}  // namespace team_test
