#include <rota/allocation/print.hpp>

#include <gtest/gtest.h>

#include <clocale>
#include <set>
#include <string>

namespace print_test {

struct names {
  enum class agent { left = 1, right };
  enum class plan_type { only };
  enum class plan { normal };
  enum class task { attack, defend };
  enum class state { first };
  friend char const* to_string(agent a) { return a == agent::left ? "left" : "right"; }
  friend char const* to_string(plan) { return "normal"; }
  friend char const* to_string(task t) { return t == task::attack ? "attack" : "defend"; }
};

/// Every value from 0 to `last` has words of its own.
template <class E>
void expect_words(E last) {
  std::set<std::string> words;
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    auto const text = to_string(static_cast<E>(i));
    EXPECT_NE(text, "?");
    EXPECT_FALSE(text.empty());
    EXPECT_TRUE(words.insert(text).second) << text;
  }
}

TEST(print, every_value_of_an_enumeration_has_words_of_its_own) {
  expect_words(rota::precondition_scope::entry_only);
  expect_words(rota::possibility::certain);
  expect_words(rota::idling::forbidden);
  expect_words(rota::plan_phase::running);
  expect_words(rota::clause::idle_forbidden);
  expect_words(rota::utility_fault::negative);
}

TEST(print, a_defect_is_a_sentence_with_names_and_a_reason_without) {
  using defect = rota::plan_defect<names>;
  using kind = defect::kind;
  std::set<std::string> sentences, reasons;
  for (int i = 0; i <= static_cast<int>(kind::empty_team_size); ++i) {
    defect const d{static_cast<kind>(i), names::task::defend, {3, 1}};
    EXPECT_TRUE(sentences.insert(describe(d)).second);
    EXPECT_TRUE(reasons.insert(reason_of(d)).second);
    EXPECT_NE(describe(d), "?");
    EXPECT_NE(std::string(reason_of(d)), "?");
  }
  EXPECT_EQ(describe(defect{kind::empty_cardinality, names::task::defend, {3, 1}}),
            "task defend wants 3..1 agents, which is impossible");
  using type_defect = rota::plan_type_defect<names>;
  EXPECT_EQ(describe(type_defect{type_defect::kind::repeated_plan, names::plan::normal}),
            "plan normal is listed twice");
  EXPECT_EQ(describe(type_defect{type_defect::kind::no_plan, {}}), "the plan type has no plan");
}

TEST(print, numbers_do_not_depend_on_the_locale) {
  std::string const before = std::setlocale(LC_ALL, nullptr);
  for (char const* name : {"C", "de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    rota::violation<names> v;
    v.what = rota::clause::utility;
    v.fault = rota::utility_fault::negative;
    v.value = -1234.5;
    EXPECT_EQ(describe(v), "the utility of plan normal is -1234.5") << name;
    EXPECT_EQ(to_string(rota::fixed_utility{-(std::int64_t{3} << 19)}), "-1.5") << name;
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(print, a_faulty_utility_says_whose_it_is) {
  using refusal = rota::utility_refusal<names>;
  rota::in<names> const x{names::agent::left, names::plan::normal, names::task::attack};
  rota::in<names> const y{names::agent::right, names::plan::normal, names::task::defend};
  auto const nan = rota::utility_fault::not_a_number;
  EXPECT_EQ(describe(refusal{nan, {}, {}}), "the utility is not a number");
  EXPECT_EQ(describe(refusal{nan, x, {}}), "the utility of agent left on task attack is not a number");
  EXPECT_EQ(describe(refusal{nan, x, y}),
            "the utility of agent left on task attack together with agent right on task defend is not a number");
}

}  // namespace print_test
