// The additive solver against enumeration and GLPK: optimum, canonical choice, certificate; warm against cold; limits.
#include "dense/dense_world.hpp"
#include "support/allocation_counter.hpp"

#include <rota/dense/flow/solver.hpp>
#include <rota/dense/ties.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
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

/// A problem as the solver wants it. Owns what the instance views.
struct dense {
  explicit dense(problem const& p) : part(p.part), agents(p.agents) {
    for (auto const& u : p.utility) utility.push_back(u.value_or(rota::dense::absent));
    for (auto const& [lower, upper] : p.bounds) bounds.push_back({lower, upper});
  }
  [[nodiscard]] instance view() const {
    instance in{agents, utility, bounds};
    in.taking_part = part;
    return in;
  }

  std::vector<std::int64_t> utility;
  std::vector<slot_bounds> bounds;
  std::vector<unsigned char> part;
  std::size_t agents;
};

std::vector<int> slots_of(flow_outcome const& found) {
  std::vector<int> x;
  for (auto const s : found.assignment) x.push_back(s == rota::dense::no_slot ? -1 : static_cast<int>(s));
  return x;
}

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
  dense const d(p);
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
      dice d(*small_world::any_seed().as("seed"));
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
  dense const d(p);
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
      dice d(*small_world::any_seed().as("seed"));
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
      dice d(*small_world::any_seed().as("seed"));
      auto p = random_problem(d, f);
      (void)warm.solve(dense(p).view());
      std::vector<row_index> changed;
      for (int step = 0; step < 8; ++step) {
        mutate(d, f, p, changed);
        dense const now(p);
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

TEST(flow_solver, permuted_agents_get_the_same_slots) {
  int tied = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*small_world::any_seed().as("seed"));
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
       {flavour{.agents = 60, .slots = 10, .levels = 50}, flavour{.agents = 150, .slots = 8, .levels = 1000}}) {
    shares s;
    EXPECT_TRUE(rc::check([&] {
      dice d(*small_world::any_seed().as("seed"));
      auto const p = random_problem(d, f);
      dense const in(p);
      flow_solver cold, limited;
      auto const best = cold.solve(in.view());
      auto const got = limited.solve(in.view(), {static_cast<std::uint64_t>(d.below(300)), {}});
      RC_ASSERT(got.found() == best.found());
      ++s.cases;
      if (!best.found()) return;
      s.interrupted += got.status == status::feasible;
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
  auto const got = solver.solve(dense(p).view(), {std::numeric_limits<std::uint64_t>::max(), third_time});
  EXPECT_EQ(got.status, status::feasible);
  EXPECT_GT(got.bound, got.value);
  EXPECT_EQ(valid_total(p, slots_of(got)), got.value);
}

// As large as the preconditions allow: sums must neither wrap nor meet what marks an absent pair.
TEST(flow_solver, at_the_limits_of_its_numbers) {
  EXPECT_TRUE(rc::check([&] {
    dice d(*small_world::any_seed().as("seed"));
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
      dense const now(p);
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
    auto const got = turn == 0 ? solver.solve(dense(p).view()) : solver.resolve(dense(p).view(), both);
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
    dense in(p);
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

// Ties -------------------------------------------------------------------------------------------------------------------

TEST(tie_rule, keys_decide_ties_and_nothing_else) {
  int unique = 0;
  int hashed = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*small_world::any_seed().as("seed"));
    auto const p = random_problem(d, {.agents = 6, .slots = 4, .levels = 3});
    auto const scale = std::int64_t{1} << d.below(50);  // the larger, the fewer bits are left
    std::uint64_t greatest = 0;
    dense in(p);
    for (auto& u : in.utility) {
      if (u == rota::dense::absent) continue;
      u *= scale;
      greatest = std::max(greatest, static_cast<std::uint64_t>(u < 0 ? -u : u));
    }
    if (!rota::dense::fits(p.agents, p.slots, greatest)) return;
    rota::dense::tie_rule const rule(p.agents, p.slots, greatest);
    auto keyed = in;
    for (std::size_t a = 0; a < p.agents; ++a)
      rule.keys(a, in.utility.data() + a * p.slots, keyed.utility.data() + a * p.slots);
    for (std::size_t i = 0; i < in.utility.size(); ++i) {
      if (in.utility[i] == rota::dense::absent) {
        RC_ASSERT(keyed.utility[i] == rota::dense::absent);
      } else {
        RC_ASSERT(rule.utility(keyed.utility[i]) == in.utility[i]);
        RC_ASSERT(rule.key(in.utility[i], i / p.slots, i % p.slots) == keyed.utility[i]);
        auto const size = static_cast<std::uint64_t>(keyed.utility[i] < 0 ? -keyed.utility[i] : keyed.utility[i]);
        RC_ASSERT(rota::dense::fits(p.agents, p.slots, size));
      }
    }
    flow_solver plain, by_key;
    auto const expected = plain.solve(in.view());
    auto view = keyed.view();
    view.unique = rule.unique();
    auto const got = by_key.solve(view);
    RC_ASSERT(got.status == expected.status);
    RC_ASSERT(got.obstacle == expected.obstacle);
    if (!got.found()) return;
    RC_ASSERT(rule.utility(got.value) == expected.value);
    if (!rule.unique()) return void(++hashed);
    ++unique;
    RC_ASSERT(slots_of(got) == slots_of(expected));
  }));
  EXPECT_GE(unique, 100);
  EXPECT_GE(hashed, 30);
}

TEST(tie_rule, a_large_team_of_equals_is_told_apart) {
  rota::dense::tie_rule const rule(1000, 20, 1000);
  EXPECT_FALSE(rule.unique());
  std::vector<std::int64_t> const row(20, 7);
  std::vector<std::int64_t> first(20), second(20);
  rule.keys(3, row.data(), first.data());
  rule.keys(4, row.data(), second.data());
  EXPECT_NE(first, second);
  EXPECT_GT(*std::max_element(first.begin(), first.end()), *std::min_element(first.begin(), first.end()));
}

// Kernels ----------------------------------------------------------------------------------------------------------------

#ifdef ROTA_HAS_LANES
TEST(kernel, lanes_compute_what_plain_loops_do) {
  namespace wide = rota::dense::wide;
  if (!wide::pays(8, 8)) GTEST_SKIP() << "this processor has no AVX2";
  EXPECT_TRUE(rc::check([&] {
    dice d(*small_world::any_seed().as("seed"));
    auto const n = static_cast<std::size_t>(8 + d.below(60));
    int const levels = d.chance(50) ? 4 : 1000;
    auto draw = [&] {
      std::vector<std::int64_t> v(n);
      for (auto& x : v) x = d.chance(5) ? rota::dense::absent : d.below(levels) - levels / 2;
      return v;
    };
    auto const worth = draw();
    std::vector<std::int64_t> price(n);
    for (auto& x : price) x = d.below(levels);

    std::size_t best = 0;
    for (std::size_t k = 0; k < n; ++k)
      if (worth[k] - price[k] > worth[best] - price[best]) best = k;
    RC_ASSERT(wide::best(worth.data(), price.data(), n) == best);
    auto second = rota::dense::row_leaders::nothing;
    for (std::size_t k = 0; k < n; ++k)
      if (k != best) second = std::max(second, worth[k] - price[k]);
    auto const leaders = wide::best_two(worth.data(), price.data(), n);
    RC_ASSERT(leaders.at == best);
    RC_ASSERT(leaders.first == worth[best] - price[best]);
    RC_ASSERT(leaders.second == second);

    constexpr std::int64_t limit = std::int64_t{1} << 60;
    std::vector<std::int64_t> label(n, limit), via(n, -1);
    for (std::size_t k = 0; k < n; ++k)
      if (d.chance(50)) label[k] = d.below(levels);
    auto expected_label = label, expected_via = via;
    rota::dense::row_entry least{limit, n};
    for (std::size_t k = 0; k < n; ++k) {
      auto const offered = 5 + price[k] - worth[k];
      if (offered < expected_label[k]) expected_label[k] = offered, expected_via[k] = 42;
      if (expected_label[k] < least.value) least = {expected_label[k], k};
    }
    auto const relaxed = wide::relax(5, price.data(), worth.data(), 42, label.data(), via.data(), n, limit);
    RC_ASSERT(label == expected_label);
    RC_ASSERT(via == expected_via);
    RC_ASSERT(relaxed.value == least.value && (relaxed.value == limit || relaxed.at == least.at));
    auto const found = wide::least(label.data(), n, limit);
    RC_ASSERT(found.value == least.value && (found.value == limit || found.at == least.at));

    auto most = draw();
    std::vector<std::int64_t> who(n, 0);
    auto expected_most = most, expected_who = who;
    for (std::size_t k = 0; k < n; ++k)
      if (worth[k] - 3 > expected_most[k]) expected_most[k] = worth[k] - 3, expected_who[k] = 9;
    wide::raise(worth.data(), 3, 9, most.data(), who.data(), n);
    RC_ASSERT(most == expected_most);
    RC_ASSERT(who == expected_who);

    auto const from = static_cast<std::size_t>(d.below(static_cast<int>(n)));
    auto gap = price[from] - worth[from];
    for (auto k = from; k < n; ++k) gap = std::min(gap, price[k] - worth[k]);
    for (auto const here : {std::int64_t{2}, gap, gap - 1}) {  // some are tight, just one or equal ones are, none is
      auto tight = from;
      while (tight < n && worth[tight] + here < price[tight]) ++tight;
      RC_ASSERT(wide::first_tight(worth.data(), here, price.data(), from, n) == tight);
    }
  }));
}
#endif

}  // namespace additive_test
