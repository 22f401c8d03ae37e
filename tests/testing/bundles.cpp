// Bundles: a law that arrives by two parents is there once, refutations can be read, tame generators are noticed.

#include "testing/digits.hpp"

#include <rota/testing/gtest.hpp>
#include <rota/testing/homomorphism_laws.hpp>
#include <rota/testing/module_laws.hpp>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace bundles_test {

using namespace rota::testing;

std::string names_of(bundle const& b) {
  std::string names;
  for (law const& l : b.laws()) names += (names.empty() ? "" : " ") + l.name;
  return names;
}

TEST(bundle, a_diamond_has_each_law_once) {
  EXPECT_EQ(names_of(abelian_group_laws<digit, integers>()),
            "well_defined left_identity right_identity associative left_inverse right_inverse inverse_involution "
            "commutative")
      << "magma comes in thrice, unital_magma twice";
}

struct with_invariant : integers {
  static bool valid(digit) { return true; }
};
TEST(bundle, closed_is_a_law_only_where_there_is_an_invariant_to_keep) {
  EXPECT_FALSE((magma_laws<digit, integers>().contains("closed")));
  EXPECT_TRUE((magma_laws<digit, with_invariant>().contains("closed")));
}

struct saturates : integers {
  static digit combine(digit x, digit y) { return {std::clamp(x.value + y.value, -4, 4)}; }
};
TEST(refutation, names_the_law_the_equation_the_shrunk_inputs_and_the_seed) {
  auto const broken = broken_laws(abelian_group_laws<digit, saturates>());
  ASSERT_EQ(broken.size(), 1u);
  auto const& text = broken.at("associative");
  auto const has = [&](std::string const& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  };
  has("law         abelian_group.associative\n");
  has("equation    (x·y)·z = x·(y·z)\n");
  has("refuted by  x = ");
  has("            y = ");
  has("            z = ");
  has("(x·y)·z is ");
  has("x·(y·z) is ");
  has("RC_PARAMS=\"seed=");
  // It was shrunk: no smaller step from −4 or 4 loses what the saturation cut off.
  EXPECT_TRUE(text.find(" = 1\n") != std::string::npos || text.find(" = -1\n") != std::string::npos) << text;
}

TEST(refutation, is_the_same_for_the_same_seed) {
  auto const laws = abelian_group_laws<digit, saturates>();
  EXPECT_EQ(broken_laws(laws), broken_laws(laws));
}

/// Has every structure, but only its identity is ever drawn.
struct nothing {
  friend bool operator==(nothing, nothing) = default;
  friend std::ostream& operator<<(std::ostream& out, nothing) { return out << "nothing"; }
};
struct nothings {
  static nothing combine(nothing, nothing) { return {}; }
  static nothing identity() { return {}; }
  static nothing inverse(nothing) { return {}; }
  static nothing scale(int, nothing) { return {}; }
  static nothing act(nothing, nothing) { return {}; }
  static nothing source(nothing) { return {}; }
  static nothing target(nothing) { return {}; }
  static nothing identity(nothing) { return {}; }
  static nothing compose(nothing, nothing) { return {}; }
};

}  // namespace bundles_test

template <>
struct rc::Arbitrary<bundles_test::nothing> {
  static Gen<bundles_test::nothing> arbitrary() { return gen::just(bundles_test::nothing{}); }
};
template <>
struct rota::testing::arrows<bundles_test::nothing> {
  static rc::Gen<bundles_test::nothing> from(bundles_test::nothing) { return rc::gen::just(bundles_test::nothing{}); }
};

namespace bundles_test {

TEST(refutation, finds_a_generator_too_tame) {
  if (detail::parameters().maxSuccess < 1000) GTEST_SKIP() << "so few cases are not judged";
  bundle laws("b");
  laws.add("l", "n ≥ 0", [] { interesting(*integer(0, 9).as("n") == 0, "zero"); }, {{"zero", 5}});
  EXPECT_TRUE(broken_laws(laws).empty()) << "one in ten is more than 5 %";
  laws.add("m", "n ≥ 0", [] { interesting(*integer(0, 9).as("n") == 0, "zero"); }, {{"zero", 20}});
  auto const broken = broken_laws(laws);
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_NE(broken.at("m").find("instead of 20 %: a generator too tame"), std::string::npos) << broken.at("m");
}

TEST(refutation, finds_generators_of_identities_alone_too_tame) {
  if (detail::parameters().maxSuccess < 1000) GTEST_SKIP() << "so few cases are not judged";
  EXPECT_EQ(broken(abelian_group_laws<nothing, nothings>()),
            "associative commutative inverse_involution left_identity left_inverse right_identity right_inverse");
  EXPECT_EQ(broken(group_theorems<nothing, nothings>()), "inverse_of_product");
  EXPECT_EQ(broken(module_laws<nothing, nothings>()), "adds_elements adds_scalars unit");
  EXPECT_EQ(broken(groupoid_laws<nothing, nothings>()), "associative ends identity inverse");
  EXPECT_EQ((broken(functor_laws<nothing, nothing, nothings, nothings>([](nothing x) { return x; }))),
            "preserves_composition");
  EXPECT_EQ((broken(homomorphism_laws<nothing, nothing, nothings, nothings>([](nothing x) { return x; }))),
            "preserves_inverse preserves_product");
  EXPECT_EQ((broken(group_action_laws<nothing, nothing, nothings, nothings>())), "compatible");
}

TEST(refutation, says_if_hardly_any_case_meets_the_premise) {
  bundle laws("b");
  laws.add("l", "false ⇒ anything", [] { RC_PRE(*integer(0, 9).as("n") > 9); });
  EXPECT_NE(broken_laws(laws).at("l").find("gave up"), std::string::npos);
}

TEST(refutation, of_what_throws) {
  bundle laws("b");
  laws.add("l", "n exists", [] {
    if (*integer(0, 9).as("n") == 3) throw std::runtime_error("three");
  });
  auto const text = broken_laws(laws).at("l");
  EXPECT_NE(text.find("n = 3"), std::string::npos) << text;
  EXPECT_NE(text.find("three"), std::string::npos) << text;
}

TEST(values, shrink_to_little_and_are_never_tame) {
  bundle laws("b");
  laws.add("l", "…",
           [] {
             auto const v = *values(-1, 1).as("v");
             interesting(std::all_of(v.begin(), v.end(), [](int x) { return x != 0; }), "dense");
             interesting(std::none_of(v.begin(), v.end(), [](int x) { return x < 0; }), "of one sign");
             interesting(std::all_of(v.begin(), v.end(), [](int x) { return x == 0; }), "nothing");
             interesting(v.size() > 8, "beyond inline storage");
           },
           {{"dense", 20}, {"of one sign", 20}, {"nothing", 3}, {"beyond inline storage", 8}});
  EXPECT_EQ(broken_laws(laws).size(), 0u);
  bundle wrong("w");
  wrong.add("l", "no entry is negative", [] {
    auto const v = *values(-4, 4).as("v");
    holds(std::none_of(v.begin(), v.end(), [](int x) { return x < 0; }), "no entry is negative");
  });
  EXPECT_NE(broken_laws(wrong).at("l").find("-1]\n"), std::string::npos) << broken_laws(wrong).at("l");
}

// GoogleTest lists the registered tests by name.
struct small {
  int value = 0;
  friend bool operator==(small, small) = default;
};

}  // namespace bundles_test

template <>
struct rota::structure<bundles_test::small> {
  using small = bundles_test::small;
  static small combine(small x, small y) { return {std::max(x.value, y.value)}; }
  static small identity() { return {}; }
  static constexpr bool associative = true;
  static constexpr bool commutative = true;
};
template <>
struct rc::Arbitrary<bundles_test::small> {
  using small = bundles_test::small;
  static Gen<small> arbitrary() {
    return gen::map(rota::testing::integer(0, 9), [](int n) { return small{n}; });
  }
};

namespace bundles_test {

[[maybe_unused]] bool const one_line = register_laws<small>("commutative_monoid");

TEST(register_laws, makes_each_claimed_law_a_test_of_its_own) {
  std::vector<std::string> names;
  auto const& all = *::testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i)
    if (auto const& suite = *all.GetTestSuite(i); std::string(suite.name()) == "commutative_monoid")
      for (int k = 0; k < suite.total_test_count(); ++k) names.push_back(suite.GetTestInfo(k)->name());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names,
            (std::vector<std::string>{"structure.associative", "structure.commutative", "structure.left_identity",
                                      "structure.right_identity", "structure.well_defined"}));
}

}  // namespace bundles_test
