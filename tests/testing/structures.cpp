// One wrong model per law of magmas, groups and modules.

#include "testing/digits.hpp"

#include <rota/testing/module_laws.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

namespace structures_test {

using namespace rota::testing;

TEST(wrong_structure, the_integers_are_right) {
  EXPECT_EQ(broken(abelian_group_laws<digit, integers>()), "");
  EXPECT_EQ(broken(group_theorems<digit, integers>()), "");
}

/// Sums leave the range.
struct leaves_the_range : integers {
  static bool valid(digit x) { return std::abs(x.value) <= 4; }
};
TEST(wrong_structure, closed) { EXPECT_EQ(broken(abelian_group_laws<digit, leaves_the_range>()), "closed"); }

/// A number with a mark that equality ignores.
struct marked {
  int value = 0;
  bool mark = false;
  friend bool operator==(marked x, marked y) { return x.value == y.value; }
  friend std::ostream& operator<<(std::ostream& out, marked x) { return out << x.value << (x.mark ? "!" : ""); }
};
/// The operation does not ignore the mark.
struct reads_the_mark {
  static marked combine(marked x, marked y) { return {x.value + y.value + (x.mark && y.mark ? 1 : 0), false}; }
  static marked identity() { return {}; }
  static marked inverse(marked x) { return {-x.value, false}; }
};

}  // namespace structures_test

template <>
struct rc::Arbitrary<structures_test::marked> {
  using marked = structures_test::marked;
  static Gen<marked> arbitrary() {
    return gen::map(rota::testing::integer(-4, 5), [](int n) { return marked{n / 2, n % 2 != 0}; });
  }
};

namespace structures_test {

TEST(wrong_structure, well_defined) {
  EXPECT_EQ(broken(commutative_magma_laws<marked, reads_the_mark>()), "well_defined");
  EXPECT_EQ(broken(invertible_magma_laws<marked, reads_the_mark>()), "well_defined");
}

struct nothing_comes_first : integers {
  static digit combine(digit x, digit y) { return x.value == 0 ? x : integers::combine(x, y); }
};
struct nothing_comes_last : integers {
  static digit combine(digit x, digit y) { return y.value == 0 ? y : integers::combine(x, y); }
};
/// Every sum is one too large.
struct counts_the_messenger : integers {
  static digit combine(digit x, digit y) { return {x.value + y.value + 1}; }
  static digit inverse(digit x) { return {-x.value - 1}; }
};
TEST(wrong_structure, identity) {
  EXPECT_EQ(broken(unital_magma_laws<digit, nothing_comes_first>()), "left_identity");
  EXPECT_EQ(broken(unital_magma_laws<digit, nothing_comes_last>()), "right_identity");
  EXPECT_EQ(broken(abelian_group_laws<digit, counts_the_messenger>()), "left_identity right_identity")
      << "where all commutes they are one law";
}

/// Saturates, as Def. 4 does at 1. Only associativity breaks.
struct saturates : integers {
  static digit combine(digit x, digit y) { return {std::clamp(x.value + y.value, -4, 4)}; }
};
TEST(wrong_structure, associative) {
  EXPECT_EQ(broken(monoid_laws<digit, saturates>()), "associative");
  EXPECT_EQ(broken(abelian_group_laws<digit, saturates>()), "associative");
}
TEST(wrong_structure, events_under_definition_4_are_no_group_for_want_of_associativity_alone) {
  EXPECT_EQ(broken(abelian_group_laws<sample::event>()), "associative");
  EXPECT_EQ(broken(group_theorems<sample::event>()), "cancellative only_identity_is_idempotent");
}

struct forgets_to_invert : integers {
  static digit inverse(digit x) { return x; }
};
/// Ignores the invariant "no count zero": sums are right at each atom, but atoms that cancel stay.
struct counts {
  std::map<int, int> of;
  friend bool operator==(counts const&, counts const&) = default;
};
struct keeps_zero_counts {
  static counts combine(counts x, counts const& y) {
    for (auto const& [atom, n] : y.of) x.of[atom] += n;
    return x;
  }
  static counts identity() { return {}; }
  static counts inverse(counts x) {
    for (auto& [atom, n] : x.of) n = -n;
    return x;
  }
};

}  // namespace structures_test

template <>
struct rc::Arbitrary<structures_test::counts> {
  using counts = structures_test::counts;
  static Gen<counts> arbitrary() {
    return gen::map(rota::testing::values(-2, 2), [](std::vector<int> const& v) {
      counts x;
      for (std::size_t i = 0; i < v.size(); ++i)
        if (v[i] != 0) x.of[static_cast<int>(i)] = v[i];
      return x;
    });
  }
};

namespace structures_test {

TEST(wrong_structure, inverse) {
  EXPECT_EQ(broken(abelian_group_laws<digit, forgets_to_invert>()), "left_inverse right_inverse")
      << "for an involution they are one law";
  EXPECT_EQ(broken(abelian_group_laws<counts, keeps_zero_counts>()), "left_inverse right_inverse");
}

/// Any two elements cancel, so each is an inverse of all.
struct everything_cancels : integers {
  static digit combine(digit x, digit y) { return x.value == 0 ? y : y.value == 0 ? x : digit{}; }
  static digit inverse(digit x) { return {x.value == 0 ? 0 : 1}; }
};
TEST(wrong_structure, inverse_involution) {
  EXPECT_EQ(broken(invertible_magma_laws<digit, everything_cancels>()), "inverse_involution");
}
/// Cancels like the above, on one side only.
struct cancels_on_the_right : everything_cancels {
  static digit combine(digit x, digit y) { return x.value == 1 && y.value > 1 ? y : everything_cancels::combine(x, y); }
};
struct cancels_on_the_left : everything_cancels {
  static digit combine(digit x, digit y) { return cancels_on_the_right::combine(y, x); }
};
TEST(wrong_structure, one_sided_inverse) {
  EXPECT_EQ(broken(invertible_magma_laws<digit, cancels_on_the_right>()), "inverse_involution left_inverse");
  EXPECT_EQ(broken(invertible_magma_laws<digit, cancels_on_the_left>()), "inverse_involution right_inverse");
}

/// Permutations of three robots: a group in which the order matters.
struct permutation {
  std::array<int, 3> of{0, 1, 2};
  friend bool operator==(permutation, permutation) = default;
};
struct permutations {
  static permutation combine(permutation x, permutation y) {
    permutation r;
    for (std::size_t i = 0; i < 3; ++i) r.of[i] = x.of[static_cast<std::size_t>(y.of[i])];
    return r;
  }
  static permutation identity() { return {}; }
  static permutation inverse(permutation x) {
    permutation r;
    for (int i = 0; i < 3; ++i) r.of[static_cast<std::size_t>(x.of[static_cast<std::size_t>(i)])] = i;
    return r;
  }
};

}  // namespace structures_test

template <>
struct rc::Arbitrary<structures_test::permutation> {
  using permutation = structures_test::permutation;
  static Gen<permutation> arbitrary() {
    return gen::map(rota::testing::integer(0, 5), [](int n) {
      permutation p;
      for (; n > 0; --n) std::next_permutation(p.of.begin(), p.of.end());
      return p;
    });
  }
};

namespace structures_test {

TEST(wrong_structure, commutative) {
  EXPECT_EQ(broken(group_laws<permutation, permutations>()), "");
  EXPECT_EQ(broken(group_theorems<permutation, permutations>()), "");
  EXPECT_EQ(broken(abelian_group_laws<permutation, permutations>()), "commutative");
}
struct undoes_in_the_wrong_order : permutations {
  static permutation inverse(permutation x) { return x; }
};
TEST(wrong_structure, theorems_fall_with_an_axiom) {
  EXPECT_EQ(broken(group_laws<permutation, undoes_in_the_wrong_order>()), "left_inverse right_inverse");
  EXPECT_EQ(broken(group_theorems<permutation, undoes_in_the_wrong_order>()), "cancellative inverse_of_product");
}

// Modules -------------------------------------------------------------------------------------------------------------

struct times : integers {
  static digit scale(int n, digit x) { return {n * x.value}; }
};
struct scales_to_nothing : integers {
  static digit scale(int, digit) { return {}; }
};
struct loses_the_sign_of_the_scalar : integers {
  static digit scale(int n, digit x) { return {std::abs(n) * x.value}; }
};
struct scales_by_the_successor : integers {
  static digit scale(int n, digit x) { return {(n + 1) * x.value}; }
};
/// Powers, where the order matters.
struct powers : permutations {
  static permutation scale(int n, permutation x) {
    permutation r;
    for (int k = std::abs(n); k > 0; --k) r = combine(r, n < 0 ? inverse(x) : x);
    return r;
  }
};
TEST(wrong_structure, module) {
  EXPECT_EQ(broken(module_laws<digit, times>()), "");
  EXPECT_EQ(broken(module_laws<digit, scales_to_nothing>()), "unit");
  EXPECT_EQ(broken(module_laws<digit, loses_the_sign_of_the_scalar>()), "adds_scalars");
  EXPECT_EQ(broken(module_laws<permutation, powers>()), "adds_elements");
  EXPECT_EQ(broken(module_theorems<digit, scales_by_the_successor>()), "multiplies");
}

}  // namespace structures_test
