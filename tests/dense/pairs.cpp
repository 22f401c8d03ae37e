// The pairwise solver finds the same as enumeration, and as solvers of special cases.
#include "dense/pairs_world.hpp"

#include <rota/dense/flow/solver.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

namespace pairs_test {

using namespace pairs_world;

struct shares {
  int cases = 0, found = 0, none = 0, tied = 0, no_slots = 0, no_pairs = 0, lower = 0, upper = 0, twins = 0,
      settled = 0;
};

/// Compares the solvers with enumeration.
void agree(problem const& p, std::initializer_list<pair_solver*> solvers, shares& reached) {
  optimum const best = enumerate(p);
  bool twins = false;
  bool settled = false;
  for (pair_solver* s : solvers) {
    pair_outcome const got = s->solve(p.view());
    RC_ASSERT(got.proved());
    RC_ASSERT(got.found() == best.value.has_value());
    RC_ASSERT(accounted(*s, p) == power(p.slots, p.agents));
    if (!best.value) {
      RC_ASSERT(got.bound == rota::dense::no_value);
      RC_ASSERT(got.assignment.empty());
      continue;
    }
    RC_ASSERT(got.value == *best.value);
    RC_ASSERT(got.bound == *best.value);
    RC_ASSERT(chosen(got) == best.first);
    settled |= got.tie_nodes > 0;
    for (auto const& t : s->account()) twins |= t.by_symmetry > 0;
  }
  auto const has_absent = [](std::vector<std::int64_t> const& v) { return std::count(v.begin(), v.end(), absent) > 0; };
  ++reached.cases;
  reached.found += best.value.has_value();
  reached.none += !best.value;
  reached.tied += best.equals > 1;
  reached.twins += twins;
  reached.settled += settled;
  reached.no_slots += has_absent(p.unary);
  reached.no_pairs +=
      std::any_of(p.tables.begin(), p.tables.end(), [&](table const& t) { return has_absent(t.worth); });
  reached.lower += std::any_of(p.bounds.begin(), p.bounds.end(), [](auto b) { return b.lower > 0; });
  reached.upper += std::any_of(p.bounds.begin(), p.bounds.end(), [&](auto b) { return b.upper < p.agents; });
}

TEST(pair_solver, agrees_with_enumeration_ties_included) {
  shares r;
  pair_solver small;
  pair_solver large;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    for (int i = 0; i < 4; ++i) {
      large.effort = any_effort(d);
      agree(any_problem(d, i == 0 ? 15000 : 3000), {&small, &large}, r);
    }
  }));
  for (int const n : {r.found, r.none, r.tied, r.no_slots, r.no_pairs, r.lower, r.upper, r.twins, r.settled})
    EXPECT_GE(n * 100, r.cases * 10) << n << " of " << r.cases;
}

/// The same problem with agents and slots renamed: agent a is now agent[a], slot s is now slots[s].
problem renamed(problem const& p, std::vector<std::size_t> const& agent, std::vector<std::size_t> const& to) {
  problem q = p;
  for (std::size_t a = 0; a < p.agents; ++a)
    for (std::size_t x = 0; x < p.slots; ++x) q.unary[agent[a] * p.slots + to[x]] = p.unary[a * p.slots + x];
  for (std::size_t s = 0; s < p.slots; ++s) q.bounds[to[s]] = p.bounds[s];
  for (std::size_t i = 0; i < p.tables.size(); ++i) {
    q.tables[i].first = static_cast<std::uint32_t>(agent[p.tables[i].first]);
    q.tables[i].second = static_cast<std::uint32_t>(agent[p.tables[i].second]);
    for (std::size_t x = 0; x < p.slots; ++x)
      for (std::size_t y = 0; y < p.slots; ++y)
        q.tables[i].worth[to[x] * p.slots + to[y]] = p.tables[i].worth[x * p.slots + y];
  }
  return q;
}

TEST(pair_solver, renaming_agents_and_slots_changes_no_value) {
  pair_solver s;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    std::size_t const n = 7 + d.bits() % 4;
    std::size_t const m = 2 + d.bits() % 4;
    flavour f{.levels = d.chance(50) ? 10 : 1 << 20, .coupled = d.chance(50) ? 100 : 40, .kinds = d.chance(20)};
    if (d.chance(30)) f.absent_pairs = 5;
    problem const p = random_problem(d, n, m, f);
    auto const before = s.solve(p.view());
    RC_ASSERT(before.proved());
    if (before.found()) RC_ASSERT(value_of(p, chosen(before)) == before.value);
    std::vector<std::size_t> agent;
    std::vector<std::size_t> to;
    for (std::size_t a = 0; a < n; ++a) agent.push_back(a);
    for (std::size_t x = 0; x < m; ++x) to.push_back(x);
    d.shuffle(agent);
    d.shuffle(to);
    problem const q = renamed(p, agent, to);
    auto const after = s.solve(q.view());
    RC_ASSERT(after.proved());
    RC_ASSERT(after.found() == before.found());
    RC_ASSERT(after.value == before.value);
    if (after.found()) RC_ASSERT(value_of(q, chosen(after)) == after.value);
  }));
}

TEST(pair_solver, without_couplings_it_is_the_additive_optimum) {
  pair_solver s;
  rota::dense::flow_solver additive;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    std::size_t const n = 1 + d.bits() % 20;
    std::size_t const m = 1 + d.bits() % 6;
    problem p =
        random_problem(d, n, m, {.levels = d.chance(50) ? 5 : 1 << 20, .absent_slots = d.below(20), .coupled = 0});
    p.tables.clear();
    auto const got = s.solve(p.view());
    auto const expected = additive.solve({n, p.unary, p.bounds});
    RC_ASSERT(got.proved());
    RC_ASSERT(got.found() == expected.found());
    if (!got.found()) return;
    RC_ASSERT(got.value == expected.value);
    RC_ASSERT(chosen(got) == chosen(expected));
  }));
}

/// Agents in a row, each coupled with the next: solved slot by slot from the end.
std::int64_t best_chain(problem const& p) {
  std::vector<std::int64_t> rest(p.slots, 0);
  for (std::size_t a = p.agents; a-- > 0;) {
    std::vector<std::int64_t> now(p.slots);
    for (std::size_t x = 0; x < p.slots; ++x) {
      std::int64_t most = a + 1 == p.agents ? 0 : std::numeric_limits<std::int64_t>::min();
      for (std::size_t y = 0; y < p.slots && a + 1 < p.agents; ++y)
        most = std::max(most, p.tables[a].worth[x * p.slots + y] + rest[y]);
      now[x] = p.unary[a * p.slots + x] + most;
    }
    rest = now;
  }
  return *std::max_element(rest.begin(), rest.end());
}

TEST(pair_solver, chains_are_solved_like_chains) {
  pair_solver s;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    std::size_t const n = 2 + d.bits() % 11;
    std::size_t const m = 2 + d.bits() % 3;
    problem p = random_problem(d, n, m, {.levels = 1 << 20, .coupled = 0, .bounded = false});
    p.tables.clear();
    for (std::uint32_t a = 0; a + 1 < n; ++a) {
      table t{a, a + 1, {}};
      for (std::size_t i = 0; i < m * m; ++i) t.worth.push_back(number(d, {.levels = 1 << 20}));
      p.tables.push_back(t);
    }
    auto const got = s.solve(p.view());
    RC_ASSERT(got.proved());
    RC_ASSERT(got.value == best_chain(p));
  }));
}

TEST(pair_solver, the_greatest_numbers_are_added_right) {
  // Σ max|u| + Σ max|w| is the greatest that is accepted.
  pair_solver s;
  for (std::size_t const n : {4u, 6u}) {
    problem p;
    p.agents = n;
    p.slots = 3;
    auto const terms = static_cast<std::int64_t>(n + n * (n - 1) / 2);
    std::int64_t const most = rota::dense::max_pair_total / terms;
    dice d(n);
    auto const extreme = [&] { return d.chance(20) ? absent : d.chance(50) ? most : -most; };
    for (std::size_t i = 0; i < n * 3; ++i) p.unary.push_back(d.chance(50) ? most : -most);
    for (std::uint32_t b = 1; b < n; ++b)
      for (std::uint32_t a = 0; a < b; ++a) {
        p.tables.push_back({a, b, std::vector<std::int64_t>(9)});
        for (auto& w : p.tables.back().worth) w = extreme();
      }
    p.bounds.assign(3, {0, static_cast<std::uint32_t>(n)});
    optimum const best = enumerate(p);
    for (std::uint64_t const plain_nodes : {std::uint64_t{0}, std::uint64_t{2048}}) {
      s.effort.plain_nodes = plain_nodes;
      auto const got = s.solve(p.view());
      ASSERT_EQ(got.found(), best.value.has_value());
      if (got.found()) {
        EXPECT_EQ(got.value, *best.value);
      }
    }
  }
}

TEST(pair_solver, answers_depend_on_nothing_but_the_question) {
  pair_solver used;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    problem const p = dense_problem(seed, 9 + seed % 3, 4);
    pair_solver fresh;
    auto const expected = fresh.solve(p.view());
    auto const got = used.solve(p.view());
    EXPECT_TRUE(got.proved());
    EXPECT_EQ(got.value, expected.value);
    EXPECT_EQ(got.work.nodes, expected.work.nodes);
    EXPECT_EQ(chosen(got), chosen(expected));
    dice d(seed);
    (void)used.solve(any_problem(d, 8000).view());
  }
}

}  // namespace pairs_test
