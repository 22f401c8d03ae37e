// Two event types that rota does not know, and the sets that they act on, tested by its laws. Each needs one trait, one
// generator and one line.
//
//   ./your_own_types --gtest_list_tests            every law by name
//   RC_PARAMS="seed=7" ./your_own_types            another seed; a refutation says which seed found it

#include <rota/testing/gtest.hpp>
#include <rota/testing/values.hpp>

#include <boost/container/flat_map.hpp>
#include <boost/container/flat_set.hpp>

#include <bitset>
#include <compare>
#include <cstdio>
#include <map>
#include <ostream>
#include <set>
#include <string>

/// An atom: who does what.
struct post {
  std::string robot;
  std::string task;
  friend auto operator<=>(post const&, post const&) = default;
  friend std::ostream& operator<<(std::ostream& out, post const& x) { return out << x.robot << ":" << x.task; }
};

/// The 24 atoms that the laws draw, ascending: four of each robot.
template <>
struct rota::testing::sample_atoms<post> {
  static post nth(std::size_t i) { return {"robot " + std::to_string(i / 4), "task " + std::to_string(i % 4)}; }
};

/// Signs in a Boost.Container map; they act on sets of the same library.
struct post_event {
  boost::container::flat_map<post, int> signs;
  friend bool operator==(post_event const&, post_event const&) = default;
};
using posts = boost::container::flat_set<post>;

template <>
struct rota::structure<post_event> {
  static post_event combine(post_event e, post_event const& f) {
    for (auto const& [x, s] : f.signs) {
      auto const [where, is_new] = e.signs.emplace(x, s);
      if (!is_new && where->second != s) e.signs.erase(where);  // + and − cancel, + and + is +
    }
    return e;
  }
  static post_event identity() { return {}; }
  static post_event inverse(post_event e) {
    for (auto&& entry : e.signs) entry.second = -entry.second;
    return e;
  }
  static constexpr bool commutative = true;  // and not associative: no event is

  // The class invariant and the sign function make it an event.
  static bool valid(post_event const& e) {
    for (auto const& [x, s] : e.signs)
      if (s != 1 && s != -1) return false;
    return true;
  }
  static std::map<post, int> signs(post_event const& e) { return {e.signs.begin(), e.signs.end()}; }

  // How it acts on sets.
  using set_type = posts;
  static post_event difference(posts const& before, posts const& after) {
    post_event e;
    for (auto const& x : after) e.signs.emplace(x, 1);
    for (auto const& x : before)
      if (!e.signs.emplace(x, -1).second) e.signs.erase(x);
    return e;
  }
  static bool applicable(post_event const& e, posts const& c) { return apply(e, c).has_value(); }
  static rota::result<posts, rota::inapplicable<post>> apply(post_event const& e, posts c) {
    for (auto const& [x, s] : e.signs)
      if (s > 0 ? !c.insert(x).second : c.erase(x) == 0) return rota::refused{rota::inapplicable<post>{x}};
    return c;
  }
  // Def. 5.
  static std::string agent(post const& x) { return x.robot; }
  static bool is_cycle(post_event const& e_m, post_event const& e_r, std::string const& b) {
    auto const both = combine(e_m, e_r).signs;
    auto const about_b = both.lower_bound(post{b, ""});
    return !e_m.signs.empty() && (about_b == both.end() || about_b->first.robot != b);
  }

  // How the laws make and read both.
  static post_event event_with(std::map<post, int> const& signs) { return {{signs.begin(), signs.end()}}; }
  static posts set_with(std::set<post> const& members) { return {members.begin(), members.end()}; }
  static std::set<post> members(posts const& c) { return {c.begin(), c.end()}; }
};

template <>
struct rc::Arbitrary<post_event> {
  static Gen<post_event> arbitrary() {
    return rota::testing::made_of<post_event>(-1, 1, [](std::vector<int> const& signs) {
      post_event e;
      for (std::size_t i = 0; i < signs.size(); ++i)
        if (signs[i] != 0) e.signs.emplace(rota::testing::nth_atom<post>(i), signs[i]);
      return e;
    });
  }
};
namespace rc {
void showValue(post_event const& e, std::ostream& out) {
  for (auto const& [x, s] : e.signs) out << (s > 0 ? "+" : "-") << x << " ";
}
}  // namespace rc

/// Signs in two bit sets over 24 atoms, which are numbers; four of them to a robot.
using bits = std::bitset<24>;
struct bit_event {
  bits plus, minus;

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
    for (std::size_t const x : members(e.plus)) r[x] = 1;
    for (std::size_t const x : members(e.minus)) r[x] = -1;
    return r;
  }

  using set_type = bits;
  static bit_event difference(bits const& before, bits const& after) { return {after & ~before, before & ~after}; }
  static bits offending(bit_event const& e, bits const& c) { return (e.plus & c) | (e.minus & ~c); }
  static bool applicable(bit_event const& e, bits const& c) { return offending(e, c).none(); }
  static rota::result<bits, rota::inapplicable<std::size_t>> apply(bit_event const& e, bits const& c) {
    if (!applicable(e, c)) return rota::refused{rota::inapplicable<std::size_t>{offending(e, c)._Find_first()}};
    return (c & ~e.minus) | e.plus;
  }
  static std::size_t agent(std::size_t x) { return x / 4; }
  static bool is_cycle(bit_event const& e_m, bit_event const& e_r, std::size_t b) {
    auto const both = combine(e_m, e_r);
    return e_m != bit_event{} && ((both.plus | both.minus) >> (4 * b) & bits(15)).none();
  }

  static bit_event event_with(std::map<std::size_t, int> const& signs) {
    bit_event e;
    for (auto const& [x, s] : signs) (s > 0 ? e.plus : e.minus).set(x);
    return e;
  }
  static bits set_with(std::set<std::size_t> const& members) {
    bits c;
    for (std::size_t const x : members) c.set(x);
    return c;
  }
  static std::set<std::size_t> members(bits const& c) {
    std::set<std::size_t> r;
    for (std::size_t i = 0; i < c.size(); ++i)
      if (c[i]) r.insert(i);
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

// Every law that these two claim becomes a test, such as post_event.allocation_event.idempotent: the laws of Def. 3 and
// 4, of apply, of runs, and of Def. 5.
auto const post_laws = rota::testing::register_laws<post_event>("post_event");
auto const bit_laws = rota::testing::register_laws<bit_event>("bit_event");

// Neither is a group. `broken_laws` runs a bundle without GoogleTest and maps each broken law to a counterexample.
TEST(post_event, is_no_group_and_this_is_why) {
  auto const broken = rota::testing::broken_laws(rota::testing::abelian_group_laws<post_event>());
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_EQ(broken.begin()->first, "associative");
  std::printf("%s\n", broken.begin()->second.c_str());
}

// Bundles notice mistakes: if events were applied without asking whether they are applicable, one law would fail.
struct applies_anyway : rota::structure<bit_event> {
  static rota::result<bits, rota::inapplicable<std::size_t>> apply(bit_event const& e, bits const& c) {
    return (c & ~e.minus) | e.plus;
  }
};
TEST(bit_event, must_be_refused_where_it_is_not_applicable) {
  auto const broken = rota::testing::broken_laws(rota::testing::apply_laws<bit_event, applies_anyway>());
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_EQ(broken.begin()->first, "refuses_iff_it_leaves_the_sets");
}

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
