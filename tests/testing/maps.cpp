// Transitions, fingerprints, and the maps between them. Each law is a test of its own, such as
// transition.groupoid.associative. Then one wrong model per law of homomorphisms, groupoids, functors and actions.

#include "testing/digits.hpp"

#include <rota/testing/groupoid_laws.hpp>
#include <rota/testing/gtest.hpp>
#include <rota/testing/homomorphism_laws.hpp>

#include <algorithm>
#include <cstdlib>

namespace maps_test {

using namespace rota::testing;
using rota::fingerprint;
using sample::delta;
using sample::event;
using transition = rota::transition<sample::atom_set>;
using dense_transition = rota::transition<sample::dense_set>;

[[maybe_unused]] bool const registered =
    register_laws<transition>("transition") &&
    register_laws("delta_of_transition", functor_laws<transition, delta>(&rota::delta_of<sample::atom_set>)) &&
    register_laws<dense_transition>("dense_transition") &&
    register_laws("delta_of_dense_transition",
                  functor_laws<dense_transition, delta>(&rota::delta_of<sample::dense_set>)) &&
    register_laws<fingerprint>("fingerprint") &&
    register_laws("fingerprint_of_delta",
                  homomorphism_laws<delta, fingerprint>([](delta const& d) { return fingerprint_of(d); })) &&
    register_laws<delta, fingerprint>("delta_on_fingerprint") &&
    register_laws("delta_on_fingerprint", group_action_theorems<delta, fingerprint>());

struct forgets_to_invert : integers {
  static digit inverse(digit x) { return x; }
};

// Homomorphisms -------------------------------------------------------------------------------------------------------

TEST(wrong_homomorphism, preserves_product) {
  EXPECT_EQ((broken(homomorphism_laws<event, delta>([](event const& e) { return delta(e); }))), "preserves_product")
      << "the embedding of events";
  EXPECT_EQ((broken(homomorphism_laws<delta, event>([](delta const& d) { return clamp(d); }))), "preserves_product")
      << "and the clamp";
}
/// The maximum of two numbers, where each number claims to be its own inverse.
struct maxima : integers {
  static digit combine(digit x, digit y) { return {std::max(x.value, y.value)}; }
  static digit inverse(digit x) { return x; }
};
TEST(wrong_homomorphism, preserves_identity) {
  EXPECT_EQ((broken(homomorphism_laws<digit, digit, integers, maxima>([](digit) { return digit{1}; }))),
            "preserves_identity");
}
TEST(wrong_homomorphism, preserves_inverse) {
  EXPECT_EQ((broken(homomorphism_laws<digit, digit, integers, forgets_to_invert>([](digit x) { return x; }))),
            "preserves_inverse");
}

// Groupoids -----------------------------------------------------------------------------------------------------------

/// An arrow between two objects that carries a number.
struct arrow {
  bool from = false;
  bool to = false;
  int label = 0;
  friend bool operator==(arrow, arrow) = default;
  friend std::ostream& operator<<(std::ostream& out, arrow t) {
    return out << t.from << " -" << t.label << "-> " << t.to;
  }
};
/// Labels add up. Each wrong model changes one thing.
struct labels_add {
  static bool source(arrow t) { return t.from; }
  static bool target(arrow t) { return t.to; }
  static arrow identity(bool o) { return {o, o, 0}; }
  static arrow compose(arrow t, arrow u) { return {t.from, u.to, t.label + u.label}; }
  static arrow inverse(arrow t) { return {t.to, t.from, -t.label}; }
};
/// Def. 4 as the label.
struct labels_are_clamped : labels_add {
  static arrow compose(arrow t, arrow u) { return {t.from, u.to, std::clamp(t.label + u.label, -1, 1)}; }
};
struct labels_count_the_messenger : labels_add {
  static arrow compose(arrow t, arrow u) { return {t.from, u.to, t.label + u.label + 1}; }
  static arrow inverse(arrow t) { return {t.to, t.from, -t.label - 1}; }
};
struct inverse_keeps_the_label : labels_add {
  static arrow inverse(arrow t) { return {t.to, t.from, t.label}; }
};
/// A group whose arrows all claim to start at one object, and end anywhere.
struct ends_anywhere : labels_add {
  static bool source(arrow) { return false; }
  static bool target(arrow t) { return t.label == 1; }
  static arrow identity(bool) { return {}; }
  static arrow compose(arrow t, arrow u) { return {t.from != u.from, t.to != u.to, t.label + u.label}; }
  static arrow inverse(arrow t) { return {t.from, t.to, -t.label}; }
};

}  // namespace maps_test

template <>
struct rota::testing::arrows<maps_test::arrow> {
  using arrow = maps_test::arrow;
  static rc::Gen<arrow> from(bool o) {
    return rc::gen::map(integer(-1, 4), [o](int n) { return arrow{o, n % 2 != 0, n / 2}; });
  }
};
template <>
struct rc::Arbitrary<maps_test::arrow> {
  using arrow = maps_test::arrow;
  static Gen<arrow> arbitrary() {
    return gen::map(rota::testing::integer(0, 11), [](int n) { return arrow{n % 2 != 0, n / 2 % 2 != 0, n / 4 - 1}; });
  }
};

namespace maps_test {

TEST(wrong_groupoid, one_model_for_each_law) {
  EXPECT_EQ(broken(groupoid_laws<arrow, labels_add>()), "");
  EXPECT_EQ(broken(groupoid_laws<arrow, labels_are_clamped>()), "associative");
  EXPECT_EQ(broken(groupoid_laws<arrow, labels_count_the_messenger>()), "identity");
  EXPECT_EQ(broken(groupoid_laws<arrow, inverse_keeps_the_label>()), "inverse");
  EXPECT_EQ(broken(groupoid_laws<arrow, ends_anywhere>()), "ends");
}
TEST(wrong_functor, preserves_composition) {
  auto const label = [](arrow const& t) { return digit{t.label}; };
  auto const steps = [](arrow const& t) { return digit{std::abs(t.label)}; };
  EXPECT_EQ((broken(functor_laws<arrow, digit, labels_add, integers>(label))), "");
  EXPECT_EQ((broken(functor_laws<arrow, digit, labels_add, integers>(steps))), "preserves_composition");
}

// Group actions -------------------------------------------------------------------------------------------------------

struct moves {
  static digit act(digit g, digit x) { return {g.value + x.value}; }
};
struct moves_all_to_one_place {
  static digit act(digit, digit) { return {3}; }
};
struct moves_forwards_only {
  static digit act(digit g, digit x) { return {std::abs(g.value) + x.value}; }
};
TEST(wrong_action, one_model_for_each_law) {
  EXPECT_EQ((broken(group_action_laws<digit, digit, moves, integers>())), "");
  EXPECT_EQ((broken(group_action_laws<digit, digit, moves_all_to_one_place, integers>())), "identity");
  EXPECT_EQ((broken(group_action_laws<digit, digit, moves_forwards_only, integers>())), "compatible");
  EXPECT_EQ((broken(group_action_theorems<digit, digit, moves_forwards_only, integers>())), "inverse_undoes");
}

}  // namespace maps_test
