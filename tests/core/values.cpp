// The plain values of core: results, time, identifiers, atoms.

#include <rota/core/atom.hpp>
#include <rota/core/chrono.hpp>
#include <rota/core/result.hpp>
#include <rota/core/time.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <compare>
#include <concepts>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace values_test {

namespace {

// Result --------------------------------------------------------------------------------------------------------------

struct empty_name {
  int column = 0;
  friend constexpr bool operator==(empty_name const&, empty_name const&) = default;
};
using parsed = rota::result<int, empty_name>;

static_assert(parsed{3}.has_value() && *parsed{3} == 3);
static_assert(!parsed{rota::refused{empty_name{7}}} && parsed{rota::refused{empty_name{7}}}.error().column == 7);
static_assert(parsed{3} == parsed{3} && parsed{3} != parsed{4});
static_assert(parsed{0} != parsed{rota::refused{empty_name{0}}});
static_assert(!std::convertible_to<empty_name, parsed>, "a refusal has to be marked as one");
static_assert(!std::convertible_to<parsed, bool>, "only explicitly: a result is no truth value");

TEST(result, value_and_refusal_of_one_type_stay_apart) {
  rota::result<int, int> const value = 1;
  rota::result<int, int> const refusal = rota::refused{1};
  EXPECT_TRUE(value.has_value());
  EXPECT_FALSE(refusal.has_value());
  EXPECT_EQ(*value, 1);
  EXPECT_EQ(refusal.error(), 1);
  EXPECT_NE(value, refusal);
}

TEST(result, carries_what_can_only_be_moved) {
  rota::result<std::unique_ptr<int>, std::string> r = std::make_unique<int>(5);
  ASSERT_TRUE(r);
  EXPECT_EQ(**r, 5);
  std::unique_ptr<int> const taken = *std::move(r);
  EXPECT_EQ(*taken, 5);
  rota::result<std::unique_ptr<int>, std::string> const no = rota::refused{std::string("no")};
  EXPECT_EQ(no.error(), "no");
}

TEST(result, gives_access_to_the_value_it_holds) {
  rota::result<std::string, int> r = std::string("left");
  r->push_back('!');
  r.value() += '!';
  EXPECT_EQ(*r, "left!!");
  EXPECT_EQ(std::as_const(r)->size(), 6u);
  r = rota::refused{4};
  EXPECT_FALSE(r);
  EXPECT_EQ(r.error(), 4);
}

/// Counts the living objects, and checks that each is destroyed where it was made.
struct counted {
  static inline int alive = 0;
  int id;
  counted const* self = this;

  explicit counted(int n) : id(n) { ++alive; }
  counted(counted const& other) : id(other.id) { ++alive; }
  counted& operator=(counted const& other) {
    id = other.id;
    return *this;
  }
  ~counted() {
    EXPECT_EQ(self, this);
    --alive;
  }
  friend bool operator==(counted const& a, counted const& b) { return a.id == b.id; }
};

TEST(result, destroys_exactly_what_it_holds) {
  using either = rota::result<counted, std::string>;
  auto const value = [](int n) { return either(counted(n)); };
  auto const refusal = [] { return either(rota::refused{std::string("a text too long to live inside the string")}); };
  {
    auto a = value(1);
    auto b = refusal();
    EXPECT_EQ(counted::alive, 1);
    auto c = a;
    auto d = b;
    EXPECT_EQ(counted::alive, 2);
    c = d;  // a value becomes a refusal
    EXPECT_EQ(counted::alive, 1);
    EXPECT_EQ(c, b);
    d = a;  // a refusal becomes a value
    EXPECT_EQ(counted::alive, 2);
    EXPECT_EQ(d, a);
    d = value(7);  // a value another value
    EXPECT_EQ(d->id, 7);
    c = refusal();
    EXPECT_EQ(c, b);
    auto const& same = d;
    d = same;
    EXPECT_EQ(d->id, 7);
    std::swap(c, d);
    EXPECT_EQ(c->id, 7);
    EXPECT_FALSE(d);
    auto const moved = std::move(c);
    EXPECT_EQ(moved->id, 7);
  }
  EXPECT_EQ(counted::alive, 0);
}

static_assert(std::is_trivially_copyable_v<rota::result<int, char>> && sizeof(rota::result<int, char>) == 8);
static_assert(std::is_nothrow_move_constructible_v<rota::result<std::string, int>> &&
              !std::copy_constructible<rota::result<std::unique_ptr<int>, int>>);

}  // namespace

namespace core_values {

enum class fault { none, missing_utility };
constexpr char const* reason_of(fault f) { return f == fault::missing_utility ? "missing_utility" : "none"; }

}  // namespace core_values

namespace {

TEST(result_death, the_value_of_a_refused_one_names_the_refusal) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  rota::result<int, core_values::fault> const with_words = rota::refused{core_values::fault::missing_utility};
  rota::result<int, empty_name> const without_words = rota::refused{empty_name{3}};
  EXPECT_DEATH((void)*with_words, "refused: missing_utility");
  EXPECT_DEATH((void)without_words.value(), "refused: .*empty_name");
  rota::result<int, int> const value = 1;
  EXPECT_DEATH((void)value.error(), "there is no refusal");
#ifndef NDEBUG
  EXPECT_DEATH((void)without_words.value(), "has_value");
  EXPECT_DEATH((void)value.error(), "!has_value");
#endif
}

// Time ----------------------------------------------------------------------------------------------------------------

template <class A, class B>
concept addable = requires(A a, B b) { a + b; };
template <class A, class B>
concept comparable = requires(A a, B b) { a == b; };

static_assert(addable<rota::instant, rota::duration> && !addable<rota::instant, rota::instant>,
              "instants are a torsor, not a group");
static_assert(!comparable<rota::instant, rota::duration>);
static_assert(!std::convertible_to<std::int64_t, rota::duration> &&
              !std::convertible_to<rota::duration, rota::instant>);
static_assert(std::totally_ordered<rota::instant> && std::totally_ordered<rota::duration>);
static_assert(rota::duration{} == rota::nanoseconds(0) && rota::nanoseconds(1'000) == rota::microseconds(1));
static_assert(rota::microseconds(1'000) == rota::milliseconds(1) && rota::milliseconds(1'000) == rota::seconds(1));
static_assert(rota::seconds(1).ns == 1'000'000'000);
static_assert(rota::to_seconds(rota::milliseconds(1500)) == 1.5 &&
              rota::to_milliseconds(rota::microseconds(-500)) == -.5);
static_assert(rota::never.ns == std::numeric_limits<std::int64_t>::max());
static_assert(rota::never > rota::instant{} + rota::seconds(292LL * 365 * 24 * 3600));

constexpr std::array<std::int64_t, 8> moments{-4'000'000'000'000'000'000, -30'000'000, -1, 0, 1, 30, 2'000'000'000,
                                              2'000'000'000'000'000'000};

TEST(time, durations_are_a_free_group_on_one_generator) {
  for (auto const a : moments)
    for (auto const b : moments) {
      rota::duration const d{a};
      rota::duration const e{b};
      EXPECT_EQ(d + e, e + d);
      EXPECT_EQ((d + e).ns, a + b);
      EXPECT_EQ((d + e) - e, d);
      EXPECT_EQ(d + -d, rota::duration{});
      EXPECT_EQ(d <=> e, a <=> b);
      auto sum = d;
      EXPECT_EQ(sum += e, d + e);
      EXPECT_EQ(sum -= e, d);
      for (std::int64_t const n : {-2, -1, 0, 1, 2}) {
        EXPECT_EQ(n * d, d * n);
        EXPECT_EQ((n * d).ns, n * a);
      }
    }
}

TEST(time, durations_act_on_instants) {
  for (auto const a : moments)
    for (auto const b : moments) {
      rota::instant const t{a};
      rota::duration const d{b};
      EXPECT_EQ((t + d) - t, d);
      EXPECT_EQ((t + d) - d, t);
      EXPECT_EQ(t - d, t + -d);
      EXPECT_EQ(t + rota::duration{}, t);
      EXPECT_EQ((t + d) + rota::seconds(1), t + (d + rota::seconds(1)));
      EXPECT_EQ(t + d > t, d > rota::duration{});
      auto moved = t;
      EXPECT_EQ(moved += d, t + d);
      EXPECT_EQ(moved -= d, t);
    }
}

TEST(time, the_chrono_bridge_loses_nothing_down_to_nanoseconds) {
  using namespace std::chrono_literals;
  static_assert(rota::from_chrono(30ms) == rota::milliseconds(30));
  static_assert(rota::to_chrono(rota::seconds(-2)) == -2s);
  static_assert(rota::from_chrono(1.5s) == rota::milliseconds(1500));
  for (auto const a : moments) EXPECT_EQ(rota::from_chrono(rota::to_chrono(rota::duration{a})), rota::duration{a});
  auto const now = std::chrono::steady_clock::now();
  EXPECT_EQ(rota::from_chrono(now + 100ms) - rota::from_chrono(now), rota::milliseconds(100));
}

// Identifiers ---------------------------------------------------------------------------------------------------------

}  // namespace

// Named, because in an unnamed one clang reports operators that are used only in unevaluated operands.
namespace core_values {

enum class colour { red, green };
struct unordered {
  int value;
  friend bool operator==(unordered const&, unordered const&) = default;
};
/// An identifier from before C++20: it has all six comparisons, and no <=>.
struct legacy {
  int value;
  friend constexpr bool operator==(legacy a, legacy b) { return a.value == b.value; }
  friend constexpr bool operator!=(legacy a, legacy b) { return !(a == b); }
  friend constexpr bool operator<(legacy a, legacy b) { return a.value < b.value; }
  friend constexpr bool operator>(legacy a, legacy b) { return b < a; }
  friend constexpr bool operator<=(legacy a, legacy b) { return !(b < a); }
  friend constexpr bool operator>=(legacy a, legacy b) { return !(a < b); }
};
struct legacy_vocabulary {
  using agent = legacy;
  using plan_type = int;
  using plan = colour;
  using task = legacy;
  using state = legacy;
};

}  // namespace core_values

namespace {

using core_values::colour;
using core_values::legacy;
using core_values::legacy_vocabulary;
using core_values::unordered;
using agent = rota::runtime_vocabulary::agent;
using task = rota::runtime_vocabulary::task;
using uuid = rota::strong_id<struct uuid_tag, std::array<std::uint8_t, 16>>;

static_assert(rota::identifier<int> && rota::identifier<colour> && rota::identifier<agent> && rota::identifier<uuid>);
static_assert(rota::identifier<legacy> && rota::vocabulary<legacy_vocabulary>);
static_assert(!rota::identifier<double> && !rota::identifier<float>);
static_assert(!rota::identifier<std::string>, "not trivially copyable");
static_assert(!rota::identifier<unordered>);
static_assert(!rota::vocabulary<colour> && !rota::vocabulary<int>);

static_assert(std::same_as<agent, agent> && !std::same_as<agent, task>);
static_assert(!std::convertible_to<agent, task> && !std::constructible_from<task, agent> &&
              !std::assignable_from<agent&, task>);
static_assert(!comparable<agent, task> && !comparable<agent, std::uint64_t>);
static_assert(!std::convertible_to<std::uint64_t, agent> && !std::convertible_to<agent, std::uint64_t>);
static_assert(agent{1} < agent{2} && agent{2} == agent{2} && agent{} == agent{0});
static_assert(uuid{{1, 0}} < uuid{{1, 1}} && uuid{{2}} > uuid{{1, 255}});

// Atoms ---------------------------------------------------------------------------------------------------------------

struct soccer {
  enum class agent : std::uint8_t { keeper = 1, left, right };
  enum class plan_type : std::uint8_t { play };
  enum class plan : std::uint8_t { normal, kickoff };
  enum class task : std::uint8_t { attack, defend };
  enum class state : std::uint8_t { get_ball, dribble };
};

template <class Atom>
auto key(Atom const& x) {
  return std::tuple(x.agent, x.plan, x.task);
}

constexpr std::array soccer_agents{soccer::agent::keeper, soccer::agent::left, soccer::agent::right};
constexpr std::array soccer_plans{soccer::plan::normal, soccer::plan::kickoff};
constexpr std::array soccer_tasks{soccer::task::attack, soccer::task::defend};
constexpr std::array soccer_states{soccer::state::get_ball, soccer::state::dribble};

std::vector<rota::in_state<soccer>> every_atom_with_state() {
  std::vector<rota::in_state<soccer>> all;
  for (auto z : soccer_states)
    for (auto t : soccer_tasks)
      for (auto p : soccer_plans)
        for (auto a : soccer_agents) all.push_back({a, p, t, z});
  return all;
}

TEST(atom, order_is_lexicographic_by_agent_plan_task) {
  for (auto const& x : every_atom_with_state())
    for (auto const& y : every_atom_with_state()) {
      auto const px = project(x);
      auto const py = project(y);
      EXPECT_EQ(px <=> py, key(px) <=> key(py));
      EXPECT_EQ(px == py, key(px) == key(py));
      EXPECT_EQ(x <=> y, std::tuple_cat(key(x), std::tuple(x.state)) <=> std::tuple_cat(key(y), std::tuple(y.state)));
    }
}

TEST(atom, projection_forgets_the_state_alone_and_is_monotone) {
  for (auto const& x : every_atom_with_state()) {
    EXPECT_EQ(key(project(x)), key(x));
    for (auto const& y : every_atom_with_state()) EXPECT_TRUE(!(x <= y) || project(x) <= project(y));
  }
}

TEST(atom, one_agents_part_of_a_sorted_range_is_contiguous) {
  auto all = every_atom_with_state();
  std::sort(all.begin(), all.end());
  auto const changes = [&] {
    int n = 0;
    for (std::size_t i = 1; i < all.size(); ++i) n += all[i].agent != all[i - 1].agent;
    return n;
  }();
  EXPECT_EQ(changes, 2);
}

static_assert(std::totally_ordered<rota::in<soccer>> && std::three_way_comparable<rota::in<soccer>>);
static_assert(std::totally_ordered<rota::in<>> && std::totally_ordered<rota::in_state<>>);
static_assert(std::totally_ordered<rota::in<legacy_vocabulary>> &&
                  std::totally_ordered<rota::in_state<legacy_vocabulary>>,
              "whatever the concept admits as a name must make an ordered atom");
static_assert(rota::in<legacy_vocabulary>{{1}, colour::red, {9}} <
              rota::in<legacy_vocabulary>{{1}, colour::green, {0}});
static_assert(std::is_trivially_copyable_v<rota::in<soccer>> && sizeof(rota::in<soccer>) == 3);
static_assert(!comparable<rota::in<soccer>, rota::in_state<soccer>>, "project first");

}  // namespace

}  // namespace values_test
