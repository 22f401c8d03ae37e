// The additive solver against enumeration and GLPK: optimum, canonical choice, certificate; warm against cold; limits.
#include "dense/dense_world.hpp"
#include "dense/owned_instance.hpp"
#include "support/allocation_counter.hpp"

#include <rota/dense/flow/solver.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace additive_test {

using namespace dense_world;
using rota::dense::flow_obstacle;
using rota::dense::flow_outcome;
using rota::dense::flow_solver;
using rota::dense::instance;
using rota::dense::row_index;
using rota::dense::slot;
using rota::dense::slot_bounds;
using rota::dense::status;

/// The total of an assignment within the bounds, or nothing.
std::optional<std::int64_t> valid_total(problem const& p, std::vector<int> const& x) {
  std::vector<unsigned> count(p.slots, 0);
  std::int64_t total = 0;
  for (std::size_t a = 0; a < p.agents; ++a) {
    if ((x[a] >= 0) != (p.part[a] != 0)) return std::nullopt;
    if (x[a] < 0) continue;
    auto const& u = p.at(a, static_cast<std::size_t>(x[a]));
    if (!u) return std::nullopt;
    total += *u;
    ++count[static_cast<std::size_t>(x[a])];
  }
  for (std::size_t s = 0; s < p.slots; ++s)
    if (count[s] < p.bounds[s].first || count[s] > p.bounds[s].second) return std::nullopt;
  return total;
}

/// What the prices prove that nothing can exceed: Σ_a max_k (u − p) + Σ_k (p_k > 0 ? p_k·upper : p_k·lower).
long double proven(problem const& p, flow_solver const& solver) {
  auto const price = solver.prices();
  long double most = 0;  // 64 bits of mantissa: exact for what is drawn here
  for (std::size_t a = 0; a < p.agents; ++a) {
    if (!p.part[a]) continue;
    auto best = std::numeric_limits<long double>::lowest();
    for (std::size_t s = 0; s < p.slots; ++s)
      if (p.at(a, s)) best = std::max(best, static_cast<long double>(*p.at(a, s)) - static_cast<long double>(price[s]));
    most += best;
  }
  for (std::size_t s = 0; s < p.slots; ++s)
    most += static_cast<long double>(price[s]) * (price[s] > 0 ? solver.bounds(s).upper : solver.bounds(s).lower);
  return most;
}

/// The bounds that prices are certified with exclude no valid assignment: they are what the problem's imply for the number of
/// agents, who all go somewhere, or looser.
void check_bounds(problem const& p, flow_solver const& solver) {
  std::int64_t const n = std::count_if(p.part.begin(), p.part.end(), [](auto x) { return x != 0; });
  for (std::size_t s = 0; s < p.slots; ++s) {
    std::int64_t elsewhere_at_least = 0;
    std::int64_t elsewhere_at_most = 0;
    for (std::size_t t = 0; t < p.slots; ++t)
      if (t != s) elsewhere_at_least += p.bounds[t].first, elsewhere_at_most += p.bounds[t].second;
    RC_ASSERT(solver.bounds(s).lower <= std::max<std::int64_t>(p.bounds[s].first, n - elsewhere_at_most));
    RC_ASSERT(solver.bounds(s).upper >= std::min<std::int64_t>(p.bounds[s].second, n - elsewhere_at_least));
  }
}

void mutate(dice& d, flavour const& f, problem& p, std::vector<row_index>& changed) {
  changed.clear();
  int const one_in = 1 + d.below(12);
  for (std::size_t a = 0; a < p.agents; ++a) {
    if (d.below(one_in) != 0) continue;
    changed.push_back(static_cast<row_index>(a));
    for (std::size_t s = 0; s < p.slots; ++s)
      if (d.chance(50)) p.utility[a * p.slots + s] = draw_utility(d, f);
    if (d.chance(20)) p.part[a] ^= 1;
  }
  if (d.chance(30)) {
    auto const lower = static_cast<unsigned>(d.below(3));
    p.bounds[static_cast<std::size_t>(d.below(static_cast<int>(p.slots)))] = {
        lower, lower + static_cast<unsigned>(d.below(6 + static_cast<int>(p.agents / p.slots)))};
  }
}

struct shares {
  int cases = 0, feasible = 0, tied = 0, partial = 0, warm = 0, interrupted = 0, stuck = 0, shortage = 0;
};

/// One problem against enumeration.
void agree(problem const& p, flow_solver& solver, shares& s) {
  owned_instance const d(p);
  auto const expected = enumerate(p);
  auto const got = solver.solve(d.view());
  ++s.cases;
  RC_ASSERT(got.found() == expected.has_value());
  s.stuck += got.obstacle == flow_obstacle::agent_stuck;
  s.shortage += got.obstacle == flow_obstacle::slot_short;
  if (!expected) return;
  ++s.feasible;
  s.partial += std::count(p.part.begin(), p.part.end(), 0) > 0;
  RC_ASSERT(got.status == status::optimal);
  RC_ASSERT(got.value == expected->total);
  RC_ASSERT(got.bound == expected->total);
  RC_ASSERT(slots_of(got) == expected->slot);
  RC_ASSERT(proven(p, solver) == static_cast<long double>(expected->total));
  check_bounds(p, solver);
}

TEST(flow_solver, is_what_enumeration_finds_first) {
  for (int levels : {1, 3, 10, 1000}) {
    shares s;
    flow_solver solver;
    EXPECT_TRUE(rc::check([&] {
      dice d(*any_seed().as("seed"));
      agree(random_problem(d, {.agents = 6, .slots = 4, .levels = levels}), solver, s);
    }));
    EXPECT_GE(s.feasible * 100, s.cases * 30);
    EXPECT_GE(s.stuck * 100, s.cases * 5);
    EXPECT_GE(s.shortage * 100, s.cases * 5);
    EXPECT_GE(s.partial * 100, s.feasible * 10);
  }
}

/// One problem too large to enumerate, against GLPK.
void agree_with_glpk(problem const& p, flow_solver& solver, shares& s) {
  owned_instance const d(p);
  auto const expected = greatest_by_glpk(p);
  auto const got = solver.solve(d.view());
  ++s.cases;
  RC_ASSERT(got.found() == expected.has_value());
  if (!expected) return;
  ++s.feasible;
  RC_ASSERT(got.value == *expected);
  RC_ASSERT(valid_total(p, slots_of(got)) == expected);
  RC_ASSERT(proven(p, solver) == static_cast<long double>(*expected));
  check_bounds(p, solver);
}

TEST(flow_solver, is_as_good_as_glpk) {
  for (auto const& f :
       {flavour{.agents = 40, .slots = 12, .levels = 1000}, flavour{.agents = 60, .slots = 3, .levels = 3},
        flavour{.agents = 200, .slots = 6, .levels = 100000}, flavour{.agents = 25, .levels = 50, .squares = true}}) {
    shares s;
    flow_solver solver;
    EXPECT_TRUE(rc::check([&] {
      dice d(*any_seed().as("seed"));
      agree_with_glpk(random_problem(d, f), solver, s);
    }));
    EXPECT_GE(s.feasible * 100, s.cases * 20) << f.agents;
  }
}

TEST(flow_solver, warm_is_cold) {
  for (auto const& f :
       {flavour{.agents = 8, .slots = 5, .levels = 3}, flavour{.agents = 40, .slots = 10, .levels = 10},
        flavour{.agents = 250, .slots = 4, .levels = 1000000}, flavour{.agents = 12, .levels = 4, .squares = true}}) {
    shares s;
    flow_solver warm;
    EXPECT_TRUE(rc::check([&] {
      dice d(*any_seed().as("seed"));
      auto p = random_problem(d, f);
      (void)warm.solve(owned_instance(p).view());
      std::vector<row_index> changed;
      for (int step = 0; step < 8; ++step) {
        mutate(d, f, p, changed);
        owned_instance const now(p);
        auto const got = warm.resolve(now.view(), changed);
        flow_solver cold;
        auto const expected = cold.solve(now.view());
        RC_ASSERT(got.status == expected.status);
        RC_ASSERT(got.obstacle == expected.obstacle);
        RC_ASSERT(got.witness == expected.witness);
        RC_ASSERT(got.value == expected.value);
        ++s.cases;
        s.warm += got.warm;
        if (!got.found()) continue;
        RC_ASSERT(slots_of(got) == slots_of(expected));
        RC_ASSERT(proven(p, warm) == static_cast<long double>(got.value));
        check_bounds(p, warm);
      }
    }));
    EXPECT_GE(s.warm * 100, s.cases * 20) << f.agents;
  }
}

TEST(flow_solver, begins_anew_if_there_are_other_agents_or_slots) {
  std::vector<std::int64_t> const two_by_two{5, 1, 1, 5}, three_by_two{5, 1, 1, 5, 4, 4},
      two_by_three{5, 1, 9, 1, 5, 9};
  std::vector<slot_bounds> const two(2, {0, 2}), three(3, {0, 1}), spacious(2, {0, 9});
  flow_solver solver;
  std::vector<row_index> const all{0, 1, 2};
  EXPECT_FALSE(solver.resolve({2, two_by_two, two}, {}).warm) << "there was no search";
  EXPECT_TRUE(solver.resolve({2, two_by_two, two}, {}).warm);
  EXPECT_FALSE(solver.resolve({3, three_by_two, two}, all).warm);
  EXPECT_FALSE(solver.resolve({2, two_by_three, three}, std::span{all}.first(2)).warm);
  EXPECT_FALSE(solver.resolve({2, two_by_two, two}, std::span{all}.first(2)).warm);
  EXPECT_FALSE(solver.resolve({2, two_by_two, spacious}, {}).warm) << "slots with room for so many keep other books";
  EXPECT_EQ(solver.resolve({2, two_by_two, spacious}, {}).value, 10);
}

TEST(flow_solver, permuted_agents_get_the_same_slots) {
  int tied = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    // Distinct totals, by the rule that breaks ties between agents whatever row they stand in.
    auto const n = static_cast<std::size_t>(2 + d.below(30));
    auto const m = static_cast<std::size_t>(2 + d.below(4));
    std::vector<std::int64_t> keys(n * m);
    for (auto& k : keys) k = d.below(10) * (std::int64_t{1} << 30) + d.below(1 << 20);
    std::vector<slot_bounds> const bounds(m, {0, static_cast<std::uint32_t>(n / m + 1)});
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    d.shuffle(order);
    std::vector<std::int64_t> shuffled;
    for (auto const a : order)
      shuffled.insert(shuffled.end(), keys.begin() + static_cast<std::ptrdiff_t>(a * m),
                      keys.begin() + static_cast<std::ptrdiff_t>((a + 1) * m));
    flow_solver first, second;
    auto const x = first.solve({n, keys, bounds});
    auto const y = second.solve({n, shuffled, bounds});
    RC_ASSERT(x.value == y.value);
    for (std::size_t i = 0; i < n; ++i) RC_ASSERT(y.assignment[i] == x.assignment[order[i]]);
    tied += n > 10;
  }));
  EXPECT_GT(tied, 0);
}

TEST(flow_solver, within_any_limit_is_valid_and_says_how_far_off) {
  for (auto const& f :
       {flavour{.agents = 60, .slots = 10, .levels = 50}, flavour{.agents = 150, .slots = 8, .levels = 1000},
        flavour{.agents = 60, .slots = 8, .levels = 3}}) {
    shares s;
    EXPECT_TRUE(rc::check([&] {
      dice d(*any_seed().as("seed"));
      auto const p = random_problem(d, f);
      owned_instance const in(p);
      flow_solver cold, limited;
      auto const best = cold.solve(in.view());
      auto const got = limited.solve(in.view(), {static_cast<std::uint64_t>(d.below(300)), {}});
      RC_ASSERT(got.found() == best.found());
      ++s.cases;
      if (!best.found()) return;
      s.interrupted += got.status == status::feasible;
      RC_ASSERT((got.value == got.bound) == got.proved());
      if (got.proved()) RC_ASSERT(slots_of(got) == slots_of(best));
      RC_ASSERT(got.value <= best.value);
      RC_ASSERT(got.bound >= best.value);
      RC_ASSERT(valid_total(p, slots_of(got)) == got.value);
      // And it is as good as new.
      auto const again = limited.resolve(in.view(), {});
      RC_ASSERT(again.value == best.value);
      RC_ASSERT(slots_of(again) == slots_of(best));
    }));
    EXPECT_GE(s.interrupted * 100, s.cases * 10) << f.agents;
  }
}

TEST(flow_solver, stops_when_asked_to) {
  dice d(7);
  auto p = random_problem(d, {.agents = 200, .slots = 8, .levels = 1000, .forbidden = 0});
  p.agents = 200;
  p.slots = 8;
  p.part.assign(200, 1);
  p.utility.clear();
  for (std::size_t i = 0; i < 1600; ++i) p.utility.push_back(d.below(1000));
  p.bounds.assign(8, {0, 25});
  int asked = 0;
  auto const third_time = [&] { return ++asked >= 3; };
  flow_solver solver;
  auto const got = solver.solve(owned_instance(p).view(), {std::numeric_limits<std::uint64_t>::max(), third_time});
  EXPECT_EQ(got.status, status::feasible);
  EXPECT_GT(got.bound, got.value);
  EXPECT_EQ(valid_total(p, slots_of(got)), got.value);
}

// Two agents, slots for at most one, at most one, and one or two: of the optima, one is canonical.
TEST(flow_solver, without_steps_calls_only_the_canonical_optimum_optimal) {
  std::vector<std::int64_t> const before{2, 2, 0, 2, 2, 0}, now{2, 2, 2, 2, 2, 0};
  std::vector<slot_bounds> const bounds{{0, 1}, {0, 1}, {1, 2}};
  flow_solver unlimited, fresh, used;
  auto const best = unlimited.solve({2, now, bounds});
  (void)used.solve({2, before, bounds});
  std::vector<row_index> const changed{0};
  for (auto const& got : {fresh.solve({2, now, bounds}, {0, {}}), used.resolve({2, now, bounds}, changed, {0, {}})}) {
    EXPECT_EQ(got.bound, best.value);
    EXPECT_EQ(got.proved(), got.value == best.value);
    EXPECT_TRUE(!got.proved() || slots_of(got) == slots_of(best));
  }
}

// 18 s in the past, against 15 ms for a search to the end.
TEST(flow_solver, that_is_stopped_at_once_moves_agents_straight_to_where_there_is_room) {
  constexpr std::size_t agents = 10'000, slots = 100;
  std::vector<std::int64_t> utility;
  dice d(11);
  for (std::size_t i = 0; i < agents * slots; ++i) utility.push_back(d.below(100) + static_cast<int>(i % slots) * 100);
  std::vector<slot_bounds> const bounds(slots, {0, agents / slots});
  auto const at_once = [] { return true; };
  flow_solver solver;
  auto const got = solver.solve({agents, utility, bounds}, {~std::uint64_t{0}, at_once});
  EXPECT_EQ(got.status, status::feasible);
  EXPECT_EQ(got.work.searches, 0u);
  EXPECT_TRUE(rota::dense::value_of({agents, utility, bounds}, got.assignment) == got.value);
}

// As large as the preconditions allow: sums must neither wrap nor meet what marks an absent pair.
TEST(flow_solver, at_the_limits_of_its_numbers) {
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    auto p = random_problem(d, {.agents = 6, .slots = 4, .levels = 3});
    auto const reach = rota::dense::max_reach / static_cast<std::int64_t>(p.slots + 2);
    auto const total = rota::dense::max_total / static_cast<std::int64_t>(std::max<std::size_t>(p.agents, 1));
    for (auto& u : p.utility)
      if (u) *u = *u * std::min(reach, total);
    flow_solver solver;
    shares s;
    agree(p, solver, s);
    std::vector<row_index> changed;
    for (int step = 0; step < 6; ++step) {  // prices must not drift away either
      mutate(d, {.levels = 3}, p, changed);
      for (auto const a : changed)
        for (std::size_t k = 0; k < p.slots; ++k)
          if (auto& u = p.utility[a * p.slots + k]; u && *u > -2 && *u < 2) *u *= std::min(reach, total);
      owned_instance const now(p);
      auto const got = solver.resolve(now.view(), changed);
      auto const expected = enumerate(p);
      RC_ASSERT(got.found() == expected.has_value());
      if (expected) RC_ASSERT(got.value == expected->total);
    }
  }));
}

// Where all bounds are exact nothing trades with the sink, so each turn lifts the prices of the two slots over it.
TEST(flow_solver, prices_that_climb_do_not_go_out_of_range) {
  problem p;
  p.agents = 2;
  p.slots = 2;
  p.part = {1, 1};
  p.bounds = {{1, 1}, {1, 1}};
  auto const much = rota::dense::max_reach / 4;
  flow_solver solver;
  std::vector<row_index> const both{0, 1};
  for (int turn = 0; turn < 200; ++turn) {
    // Everybody would rather be here, then there; agent 1 a little more so.
    if (turn % 2 == 0) p.utility = {much - 1, -much, much, -much};
    if (turn % 2 == 1) p.utility = {-much, much - 1, -much, much};
    auto const got =
        turn == 0 ? solver.solve(owned_instance(p).view()) : solver.resolve(owned_instance(p).view(), both);
    ASSERT_EQ(got.value, enumerate(p)->total) << turn;
    ASSERT_EQ(slots_of(got), enumerate(p)->slot) << turn;
    for (auto const price : solver.prices()) ASSERT_LE(std::abs(price), 4 * rota::dense::max_reach) << turn;
  }
}

TEST(flow_solver, impossible_problems_have_a_witness_and_leave_it_usable) {
  using rota::dense::absent;
  flow_solver solver;
  auto solve = [&](std::vector<std::int64_t> const& u, std::vector<slot_bounds> const& b) {
    return solver.solve({u.size() / b.size(), u, b});
  };
  auto const more_needed = solve({1, 1}, {{2, 2}, {1, 1}});
  EXPECT_EQ(more_needed.obstacle, flow_obstacle::slot_short) << "one agent, three needed";
  EXPECT_EQ(solve({1, 1}, {{2, 1}, {0, 1}}).obstacle, flow_obstacle::slot_short) << "lower above upper";
  auto const forbidden = solve({1, 1, absent, absent}, {{0, 2}, {0, 2}});
  EXPECT_EQ(forbidden.obstacle, flow_obstacle::agent_stuck);
  EXPECT_EQ(forbidden.witness, 1u);
  auto const unreachable = solve({1, absent, 1, absent}, {{0, 2}, {1, 1}});
  EXPECT_EQ(unreachable.obstacle, flow_obstacle::agent_stuck) << "one of them is needed where neither may go";
  EXPECT_EQ(unreachable.witness, 0u);
  EXPECT_EQ(solver.solve({0, {}, {}}).status, status::optimal) << "nobody and nothing";
  auto const fine = solve({1, 2, 5, 3}, {{1, 1}, {1, 1}});
  EXPECT_EQ(fine.status, status::optimal);
  EXPECT_EQ(fine.value, 7);
}

TEST(flow_solver, a_steady_loop_allocates_nothing) {
  for (auto const& f : {flavour{.agents = 5, .slots = 4}, flavour{.agents = 200, .slots = 10}}) {
    dice d(3);
    problem p;
    p.agents = static_cast<std::size_t>(f.agents);
    p.slots = static_cast<std::size_t>(f.slots);
    p.part.assign(p.agents, 1);
    p.bounds.assign(p.slots, {0, static_cast<unsigned>(p.agents / p.slots + 1)});
    for (std::size_t i = 0; i < p.agents * p.slots; ++i) p.utility.push_back(d.below(1000000));
    owned_instance in(p);
    flow_solver solver;
    std::vector<row_index> changed{0};
    auto const loop = [&] {
      for (int step = 0; step < 200; ++step) {
        changed[0] = static_cast<row_index>(d.below(f.agents));
        for (std::size_t s = 0; s < p.slots; ++s) in.utility[changed[0] * p.slots + s] = d.below(1000000);
        ASSERT_TRUE(solver.resolve(in.view(), changed).found());
      }
    };
    ASSERT_TRUE(solver.solve(in.view()).found());
    loop();
    auto const before = rota_test::allocation_count();
    loop();
    ASSERT_TRUE(solver.solve(in.view()).found());
    EXPECT_EQ(rota_test::allocation_count() - before, 0u);
  }
}

}  // namespace additive_test
