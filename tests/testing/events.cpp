// Def. 3 and 4. Each law is a test of its own, such as event.definition_4.unique_inverse. Then one wrong model per law.

#include "testing/wrong.hpp"

#include <rota/testing/arbitrary.hpp>
#include <rota/testing/event_laws.hpp>
#include <rota/testing/gtest.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <vector>

namespace events_test {

using namespace rota::testing;
using sample::atom;
using sample::event;
using dense_event = rota::dense_event<rota::index_universe<70>>;

[[maybe_unused]] bool const registered =
    register_laws("event", event_laws<event>()) && register_laws("event", associator_laws<event>()) &&
    register_laws("event", sign_function_laws<event>()) && register_laws("dense_event", event_laws<dense_event>()) &&
    register_laws("dense_event", associator_laws<dense_event>()) &&
    register_laws("dense_event", sign_function_laws<dense_event>());

/// Def. 4 with another table of signs instead of the clamped sum.
template <int (*Table)(int, int)>
struct by_table : rota::structure<event> {
  static event combine(event const& e, event const& f) {
    std::vector<int> signs;
    for (std::size_t i = 0; i < 24; ++i)
      signs.push_back(Table(to_int(e(nth_atom<atom>(i))), to_int(f(nth_atom<atom>(i)))));
    return event_with<atom>(signs);
  }
};
int clamped(int s, int t) { return std::clamp(s + t, -1, 1); }
/// Unmatched entries come out with the sign swapped.
int swapped_alone(int s, int t) { return s == 0 || t == 0 ? -(s + t) : clamped(s, t); }
/// Wraps around instead of clamping: the group ℤ/3.
int wrapped(int s, int t) { return (s + t + 4) % 3 - 1; }
/// Subtracts atoms that both events add.
int withdrawn(int s, int t) { return s == 1 && t == 1 ? -1 : clamped(s, t); }

struct inverse_does_not_swap : rota::structure<event> {
  static event inverse(event const& e) { return e; }
};

/// Signs in a map, where equality ignores zeros.
struct padded {
  std::map<int, int> of;
  friend bool operator==(padded const& x, padded const& y) { return x.bare() == y.bare(); }
  [[nodiscard]] std::map<int, int> bare() const {
    auto m = of;
    std::erase_if(m, [](auto const& entry) { return entry.second == 0; });
    return m;
  }
};
/// Right as a function, but atoms that cancel stay with sign zero.
struct keeps_zero_signs {
  static bool valid(padded const& e) { return e.of == e.bare(); }
  static padded combine(padded e, padded const& f) {
    for (auto const& [x, s] : f.of) e.of[x] = clamped(e.of[x], s);
    return e;
  }
  static padded identity() { return {}; }
  static padded inverse(padded e) {
    for (auto& [x, s] : e.of) s = -s;
    return e;
  }
};

/// A statement about one agent that has two tasks: nothing, +1, −1, +2, −2.
struct statement {
  int value = 0;
  friend bool operator==(statement, statement) = default;
};
struct later_wins {
  static statement combine(statement e, statement f) {
    return e.value == -f.value ? statement{} : f.value == 0 ? e : f;
  }
  static statement identity() { return {}; }
  static statement inverse(statement e) { return {-e.value}; }
};
/// Cancels by agent and forgets the task.
struct cancels_by_agent : later_wins {
  static statement combine(statement e, statement f) {
    if (e.value * f.value < 0) return {};
    return std::abs(e.value) > std::abs(f.value) ? e : f;
  }
};

/// An event and a note, which equality should not see.
struct noted {
  event e;
  int note = 0;
  friend bool operator==(noted const&, noted const&) = default;
};
struct compares_notes {
  static noted combine(noted const& x, noted const& y) { return {compose(x.e, y.e), 0}; }
  static noted identity() { return {}; }
  static noted inverse(noted const& x) { return {rota::inverse(x.e), 0}; }
  static auto signs(noted const& x) { return signs_of<compares_notes>(x.e); }
};

}  // namespace events_test

template <>
struct rc::Arbitrary<events_test::padded> {
  using padded = events_test::padded;
  static Gen<padded> arbitrary() {
    return rota::testing::made_of<padded>(-1, 1, [](std::vector<int> const& v) {
      padded e;
      for (std::size_t i = 0; i < v.size(); ++i)
        if (v[i] != 0) e.of[static_cast<int>(i)] = v[i];
      return e;
    });
  }
};
template <>
struct rc::Arbitrary<events_test::statement> {
  using statement = events_test::statement;
  static Gen<statement> arbitrary() {
    return gen::map(rota::testing::integer(-2, 2), [](int n) { return statement{n}; });
  }
};
template <>
struct rc::Arbitrary<events_test::noted> {
  using noted = events_test::noted;
  static Gen<noted> arbitrary() {
    return rota::testing::made_of<noted>(-1, 1, [](std::vector<int> const& v) {
      return noted{rota::testing::event_with<sample::atom>(v), static_cast<int>(v.size()) % 2};
    });
  }
};

namespace events_test {

TEST(wrong_event, one_model_for_each_law) {
  EXPECT_EQ(broken(event_laws<event, by_table<clamped>>()), "");
  EXPECT_EQ(broken(event_laws<padded, keeps_zero_signs>()), "closed");
  EXPECT_EQ(broken(event_laws<event, by_table<swapped_alone>>()), "left_identity right_identity");
  EXPECT_EQ(broken(event_laws<statement, later_wins>()), "commutative");
  EXPECT_EQ(broken(event_laws<event, inverse_does_not_swap>()), "left_inverse right_inverse");
  EXPECT_EQ(broken(event_laws<statement, cancels_by_agent>()), "unique_inverse");
  EXPECT_EQ(broken(event_laws<event, by_table<wrapped>>()), "idempotent");
  EXPECT_EQ(broken(event_laws<event, by_table<withdrawn>>()), "idempotent");
}
TEST(wrong_event, criterion_of_associativity) {
  EXPECT_EQ(broken(associator_laws<event, by_table<clamped>>()), "");
  EXPECT_EQ(broken(associator_laws<event, by_table<wrapped>>()), "vanishes_iff_no_bad_sign_triple")
      << "always vanishes";
  EXPECT_EQ(broken(associator_laws<event, by_table<swapped_alone>>()), "vanishes_iff_no_bad_sign_triple")
      << "seldom vanishes";
  EXPECT_EQ(broken(associator_laws<event, by_table<withdrawn>>()), "") << "a different magma with the same criterion";
}
TEST(wrong_event, a_group_law_on_sign_functions_exists_and_is_not_definition_4) {
  EXPECT_EQ(broken(abelian_group_laws<event, by_table<wrapped>>()), "");
}

struct identity_says_something : rota::structure<event> {
  static event identity() { return event::addition(nth_atom<atom>(0)); }
};
TEST(wrong_sign_function, one_model_for_each_law) {
  EXPECT_EQ(broken(sign_function_laws<noted, compares_notes>()), "equality");
  EXPECT_EQ(broken(sign_function_laws<event, identity_says_something>()), "identity");
  EXPECT_EQ(broken(sign_function_laws<event, inverse_does_not_swap>()), "inverse");
  EXPECT_EQ(broken(sign_function_laws<event, by_table<wrapped>>()), "composition");
}

}  // namespace events_test

/// The claim of the paper: Def. 4 is an abelian group.
struct claimed_group {
  rota::event<sample::atom> value;
  friend bool operator==(claimed_group const&, claimed_group const&) = default;
};
template <>
struct rota::structure<claimed_group> {
  static claimed_group combine(claimed_group const& e, claimed_group const& f) { return {compose(e.value, f.value)}; }
  static claimed_group identity() { return {}; }
  static claimed_group inverse(claimed_group const& e) { return {rota::inverse(e.value)}; }
  static constexpr bool associative = true;
  static constexpr bool commutative = true;
  static auto signs(claimed_group const& e) { return rota::testing::signs_of<structure<sample::event>>(e.value); }
};
template <>
struct rc::Arbitrary<claimed_group> {
  static Gen<claimed_group> arbitrary() {
    return gen::map(gen::arbitrary<sample::event>(), [](sample::event const& e) { return claimed_group{e}; });
  }
};
TEST(wrong_claim, that_events_are_a_group_is_refuted_by_associativity_alone) {
  EXPECT_EQ(broken(rota::testing::laws_of<claimed_group>()), "associative");
}
