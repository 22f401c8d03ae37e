// Two event types that rota does not know, put under the laws from outside: one trait, one generator, one line each.
//
//   ./your_own_types --gtest_list_tests            every law by name
//   RC_PARAMS="seed=7" ./your_own_types            another seed; a refutation says which one it was found with

#include <rota/testing/gtest.hpp>
#include <rota/testing/values.hpp>

#include <boost/container/flat_map.hpp>

#include <bitset>
#include <cstdio>
#include <map>
#include <ostream>
#include <string>

/// Signs in a Boost.Container map from names of tasks.
struct task_event {
  boost::container::flat_map<std::string, int> signs;

  friend bool operator==(task_event const&, task_event const&) = default;
  friend std::ostream& operator<<(std::ostream& out, task_event const& e) {
    for (auto const& [task, s] : e.signs) out << (s > 0 ? "+" : "-") << task << " ";
    return out;
  }
};

template <>
struct rota::structure<task_event> {
  static task_event combine(task_event e, task_event const& f) {
    for (auto const& [task, s] : f.signs) {
      auto const [where, is_new] = e.signs.emplace(task, s);
      if (!is_new && where->second != s) e.signs.erase(where);  // + and − cancel, + and + is +
    }
    return e;
  }
  static task_event identity() { return {}; }
  static task_event inverse(task_event e) {
    for (auto&& entry : e.signs) entry.second = -entry.second;
    return e;
  }
  static constexpr bool commutative = true;  // and not associative: no event is

  // What makes it an event: the class invariant, and the sign function.
  static bool valid(task_event const& e) {
    for (auto const& [task, s] : e.signs)
      if (s != 1 && s != -1) return false;
    return true;
  }
  static std::map<std::string, int> signs(task_event const& e) { return {e.signs.begin(), e.signs.end()}; }
};

template <>
struct rc::Arbitrary<task_event> {
  static Gen<task_event> arbitrary() {
    return rota::testing::made_of<task_event>(-1, 1, [](std::vector<int> const& signs) {
      task_event e;
      for (std::size_t i = 0; i < signs.size(); ++i)
        if (signs[i] != 0) e.signs.emplace("t" + std::to_string(i), signs[i]);
      return e;
    });
  }
};

/// Signs in two bit sets over 24 atoms.
struct bit_event {
  std::bitset<24> plus, minus;

  friend bool operator==(bit_event const&, bit_event const&) = default;
  friend std::ostream& operator<<(std::ostream& out, bit_event const& e) { return out << e.plus << "/" << e.minus; }
};

template <>
struct rota::structure<bit_event> {
  static bit_event combine(bit_event const& e, bit_event const& f) {
    return {(e.plus & ~f.minus) | (f.plus & ~e.minus), (e.minus & ~f.plus) | (f.minus & ~e.plus)};
  }
  static bit_event identity() { return {}; }
  static bit_event inverse(bit_event const& e) { return {e.minus, e.plus}; }
  static constexpr bool commutative = true;

  static bool valid(bit_event const& e) { return (e.plus & e.minus).none(); }
  static std::map<std::size_t, int> signs(bit_event const& e) {
    std::map<std::size_t, int> r;
    for (std::size_t i = 0; i < 24; ++i)
      if (e.plus[i] || e.minus[i]) r[i] = e.plus[i] ? 1 : -1;
    return r;
  }
};

template <>
struct rc::Arbitrary<bit_event> {
  static Gen<bit_event> arbitrary() {
    return rota::testing::made_of<bit_event>(-1, 1, [](std::vector<int> const& signs) {
      bit_event e;
      for (std::size_t i = 0; i < signs.size(); ++i) {
        e.plus[i] = signs[i] > 0;
        e.minus[i] = signs[i] < 0;
      }
      return e;
    });
  }
};

// Every law that these two claim, each a test of its own: task_event.allocation_event.idempotent and so on.
auto const task_laws = rota::testing::register_laws<task_event>("task_event");
auto const bit_laws = rota::testing::register_laws<bit_event>("bit_event");

// Neither is a group. A bundle can be asked without GoogleTest, too: the answer maps each broken law to a counterexample.
TEST(task_event, is_no_group_and_this_is_why) {
  auto const broken = rota::testing::broken_laws(rota::testing::abelian_group_laws<task_event>());
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_EQ(broken.begin()->first, "associative");
  std::printf("%s\n", broken.begin()->second.c_str());
}

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
