#include "allocation/small_world.hpp"
#include "support/allocation_counter.hpp"

#include <rota/dense/pairs/solver.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pairwise_test {

namespace {

using rota::dense::absent;
using rota::dense::no_slot;
using rota::dense::pair_cut;
using rota::dense::pair_outcome;
using rota::dense::pair_solver;
using rota::dense::slot;
using small_world::any_seed;
using small_world::dice;

using choice = std::vector<slot>;

struct table {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::vector<std::int64_t> worth;
};

/// An instance that owns its numbers.
struct problem {
  std::size_t agents = 0;
  std::size_t slots = 0;
  std::vector<std::int64_t> unary;
  std::vector<table> tables;
  std::vector<rota::dense::slot_bounds> bounds;
  mutable std::vector<rota::dense::coupling> couplings;

  rota::dense::pair_instance view() const {
    couplings.clear();
    for (table const& t : tables) couplings.push_back({t.first, t.second, t.worth});
    return {agents, unary, couplings, bounds};
  }
};

/// The value of an assignment, read off the definition; nothing if it is not valid.
std::optional<std::int64_t> value_of(problem const& p, choice const& x) {
  std::vector<std::uint32_t> count(p.slots, 0);
  std::int64_t sum = 0;
  for (std::size_t a = 0; a < p.agents; ++a) {
    std::int64_t const u = p.unary[a * p.slots + x[a]];
    if (u == absent) return std::nullopt;
    sum += u;
    ++count[x[a]];
  }
  for (std::size_t s = 0; s < p.slots; ++s)
    if (count[s] < p.bounds[s].lower || count[s] > p.bounds[s].upper) return std::nullopt;
  for (table const& t : p.tables) {
    std::int64_t const w = t.worth[x[t.first] * p.slots + x[t.second]];
    if (w == absent) return std::nullopt;
    sum += w;
  }
  return sum;
}

/// Calls f on each completion of the partial assignment, in lexicographic order.
template <class F>
void completions(problem const& p, choice& x, std::size_t a, F&& f) {
  while (a < p.agents && x[a] != no_slot) ++a;
  if (a == p.agents) return f(std::as_const(x));
  for (slot s = 0; s < p.slots; ++s) {
    x[a] = s;
    completions(p, x, a + 1, f);
  }
  x[a] = no_slot;
}

struct optimum {
  std::optional<std::int64_t> value;
  choice first;  // the lexicographically smallest
  int equals = 0;
};

optimum enumerate(problem const& p) {
  optimum best;
  choice x(p.agents, no_slot);
  completions(p, x, 0, [&](choice const& c) {
    auto const v = value_of(p, c);
    if (!v || (best.value && *v < *best.value)) return;
    if (best.value && *v == *best.value) {
      ++best.equals;
      return;
    }
    best = {v, c, 1};
  });
  return best;
}

std::uint64_t power(std::uint64_t base, std::size_t exponent) {
  std::uint64_t r = 1;
  while (exponent-- > 0) r *= base;
  return r;
}

/// Σ over prefixes of what is below them, modulo 2^64.
std::uint64_t accounted(pair_solver const& s, problem const& p) {
  std::uint64_t sum = 0;
  auto const account = s.account();
  for (std::size_t d = 0; d < account.size(); ++d) {
    auto const& t = account[d];
    sum += power(p.slots, p.agents - d) *
           (t.leaves + t.by_bound + t.by_cardinality + t.by_absence + t.by_symmetry + t.open);
  }
  return sum;
}

template <class F>
class observer final : public rota::dense::pair_observer {
public:
  explicit observer(F const& hear) : hear_(hear) {}
  void operator()(std::span<slot const> partial, pair_cut why, std::int64_t bound) override {
    hear_(partial, why, bound);
  }

private:
  F const& hear_;
};

choice chosen(rota::dense::outcome const& found) { return {found.assignment.begin(), found.assignment.end()}; }

struct flavour {
  std::int64_t levels = 10;  // how many different values; few make ties
  int absent_slots = 0;      // per cent
  int absent_pairs = 0;
  int coupled = 100;
  bool negative = true;
  bool kinds = false;  // interchangeable agents
  bool bounded = true;
};

std::int64_t number(dice& d, flavour const& f) {
  auto const v = static_cast<std::int64_t>(d.bits() % static_cast<std::uint64_t>(f.levels));
  return f.negative ? v - f.levels / 2 : v;
}

problem random_problem(dice& d, std::size_t n, std::size_t m, flavour const& f) {
  problem p;
  p.agents = n;
  p.slots = m;
  for (std::size_t i = 0; i < n * m; ++i) p.unary.push_back(d.chance(f.absent_slots) ? absent : number(d, f));
  std::vector<std::size_t> kind(n);
  for (std::size_t a = 0; a < n; ++a) kind[a] = f.kinds ? d.bits() % (1 + n / 3) : a;
  auto const symmetric = [&](std::vector<std::int64_t>& w) {
    for (std::size_t x = 0; x < m; ++x)
      for (std::size_t y = 0; y < x; ++y) w[x * m + y] = w[y * m + x];
  };
  std::vector<std::vector<std::int64_t>> between_kinds(n * n);
  for (std::size_t a = 0; a < n; ++a) {
    if (kind[a] != a)
      for (std::size_t b = 0; b < a; ++b)
        if (kind[b] == kind[a]) {
          // A constant more in every slot changes nothing.
          std::int64_t const more = d.chance(30) ? d.below(5) : 0;
          for (std::size_t x = 0; x < m; ++x) {
            std::int64_t const u = p.unary[b * m + x];
            p.unary[a * m + x] = u == absent ? absent : u + more;
          }
          break;
        }
    for (std::size_t b = 0; b < a; ++b) {
      auto& w = between_kinds[std::min(kind[a], kind[b]) * n + std::max(kind[a], kind[b])];
      if (w.empty() || !f.kinds) {
        w.assign(m * m, 0);
        if (d.chance(f.coupled))
          for (auto& v : w) v = d.chance(f.absent_pairs) ? absent : number(d, f);
        if (kind[a] == kind[b]) symmetric(w);
      }
      bool const zero = std::all_of(w.begin(), w.end(), [](auto v) { return v == 0; });
      if (zero && d.chance(80)) continue;
      // Either way round; the table is for the smaller kind first.
      table t{static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(a), w};
      if (kind[b] > kind[a]) std::swap(t.first, t.second);
      if (d.chance(50)) {
        std::swap(t.first, t.second);
        for (std::size_t x = 0; x < m; ++x)
          for (std::size_t y = 0; y < m; ++y) t.worth[y * m + x] = w[x * m + y];
      }
      p.tables.push_back(t);
      // Named twice, they are added up.
      if (d.chance(10) && std::none_of(w.begin(), w.end(), [](auto v) { return v == absent; })) {
        table half = t;
        for (std::size_t i = 0; i < m * m; ++i) half.worth[i] = number(d, f), p.tables.back().worth[i] -= half.worth[i];
        p.tables.push_back(half);
      }
    }
  }
  d.shuffle(p.tables);
  for (std::size_t s = 0; s < m; ++s) {
    rota::dense::slot_bounds b{0, static_cast<std::uint32_t>(n)};
    if (f.bounded && d.chance(40)) b.lower = static_cast<std::uint32_t>(d.below(3));
    if (f.bounded && d.chance(60)) b.upper = b.lower + static_cast<std::uint32_t>(d.below(1 + static_cast<int>(n) / 2));
    if (d.chance(5)) b.upper = ~std::uint32_t{0};
    p.bounds.push_back(b);
  }
  return p;
}

/// Random sizes with at most `most` assignments, and a random flavour.
problem any_problem(dice& d, std::uint64_t most) {
  std::size_t const m = d.chance(5) ? 1 : 2 + d.bits() % 5;
  std::size_t n = 1;
  while (n < 10 && power(m, n + 1) <= most) ++n;
  if (d.chance(30)) n = 1 + d.bits() % n;
  flavour f;
  std::int64_t const levels[] = {1, 2, 3, 10, 1000, std::int64_t{1} << 20, std::int64_t{1} << 40};
  f.levels = levels[d.bits() % 7];
  if (d.chance(30)) f.absent_slots = d.below(40);
  if (d.chance(30)) f.absent_pairs = d.below(25);
  if (d.chance(40)) f.coupled = d.below(100);
  f.negative = d.chance(60);
  f.kinds = d.chance(30);
  f.bounded = d.chance(80);
  return random_problem(d, n, m, f);
}

/// All ways to divide the work.
rota::dense::pair_effort any_effort(dice& d) {
  rota::dense::pair_effort e;
  e.plain_nodes = d.chance(60) ? 0 : d.chance(50) ? d.bits() % 300 : 16384;
  if (d.chance(80)) e.exact_suffix = d.bits() % 6;
  if (d.chance(80)) e.bounded_suffix = d.bits() % 6;
  return e;
}

struct shares {
  int cases = 0, found = 0, none = 0, tied = 0, no_slots = 0, no_pairs = 0, lower = 0, upper = 0, twins = 0,
      settled = 0;
};

/// The solvers and enumeration on one problem.
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

TEST(pairwise, agrees_with_enumeration_ties_included) {
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

TEST(pairwise, every_cut_is_right_and_nothing_is_forgotten) {
  int cuts[4] = {};
  pair_solver s;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    s.effort = any_effort(d);
    problem const p = any_problem(d, 4000);
    std::vector<char> covered(power(p.slots, p.agents), 0);
    std::int64_t best = absent;
    // What no valid assignment in a cut subtree is worth more than; the best of all may be cut only if it is not alone.
    std::vector<std::pair<choice, std::int64_t>> bounds;
    auto const observe = [&](std::span<slot const> partial, pair_cut why, std::int64_t bound) {
      ++cuts[static_cast<int>(why)];
      choice x(partial.begin(), partial.end());
      completions(p, x, 0, [&](choice const& c) {
        std::size_t i = 0;
        for (slot const a : c) i = i * p.slots + a;
        RC_ASSERT(!covered[i]);
        covered[i] = 1;
        auto const v = value_of(p, c);
        if (!v) return;
        RC_ASSERT(why == pair_cut::bound || why == pair_cut::symmetry);
        if (why == pair_cut::bound) RC_ASSERT(*v <= bound);
        best = std::max(best, *v);
      });
    };
    observer heard(observe);
    auto const got = s.solve(p.view(), {}, &heard);
    std::uint64_t leaves = 0;
    for (auto const& t : s.account()) leaves += t.leaves;
    RC_ASSERT(static_cast<std::uint64_t>(std::count(covered.begin(), covered.end(), 0)) == leaves);
    if (best != absent) RC_ASSERT(got.found() && best <= got.value);
  }));
  for (int const n : cuts) EXPECT_GE(n, 500);
}

TEST(pairwise, a_symmetric_cut_has_its_like_elsewhere) {
  pair_solver s;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    s.effort = any_effort(d);
    problem const p = random_problem(d, 5, 3, {.levels = 10, .absent_slots = 10, .absent_pairs = 5, .kinds = true});
    auto const observe = [&](std::span<slot const> partial, pair_cut why, std::int64_t) {
      if (why != pair_cut::symmetry) return;
      choice x(partial.begin(), partial.end());
      completions(p, x, 0, [&](choice const& c) {
        // Two agents exchanged give an assignment that comes first and is worth the same.
        bool like = false;
        for (std::size_t a = 0; a < p.agents; ++a)
          for (std::size_t b = a + 1; b < p.agents; ++b) {
            choice e = c;
            std::swap(e[a], e[b]);
            like |= e < c && value_of(p, e) == value_of(p, c);
          }
        RC_ASSERT(like);
      });
    };
    observer heard(observe);
    (void)s.solve(p.view(), {}, &heard);
  }));
}

TEST(pairwise, any_budget_leaves_a_valid_assignment_and_a_bound) {
  int cases = 0, stopped = 0, better = 0;
  pair_solver s;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    s.effort = any_effort(d);
    problem const p = any_problem(d, 3000);
    optimum const best = enumerate(p);
    std::optional<std::int64_t> last;
    for (std::uint64_t budget = 0;; budget = budget * 2 + d.bits() % 3) {
      std::uint64_t const asked = d.chance(50) ? budget : 0;
      std::uint64_t polls = 0;
      auto const impatient = [&] { return ++polls > asked; };
      auto const got = s.solve(p.view(), {budget, impatient});
      ++cases;
      RC_ASSERT(accounted(s, p) == power(p.slots, p.agents));
      if (got.found()) {
        RC_ASSERT(value_of(p, chosen(got)) == got.value);
        RC_ASSERT(got.value <= got.bound);
        better += last && got.value > *last;
        last = got.value;
      } else {
        RC_ASSERT(got.assignment.empty());
      }
      if (best.value) RC_ASSERT(*best.value <= got.bound);
      if (got.found() && got.value == got.bound) RC_ASSERT(got.value == *best.value);
      std::uint64_t open = 0;
      for (auto const& t : s.account()) open += t.open;
      stopped += open > 0;
      if (got.proved()) {
        RC_ASSERT(open == 0u);
        RC_ASSERT(got.found() == best.value.has_value());
        if (got.found()) RC_ASSERT(chosen(got) == best.first);
      }
      if (got.proved() || budget > 100000) break;
    }
  }));
  EXPECT_GE(stopped * 100, cases * 20) << stopped << " of " << cases;
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

TEST(pairwise, renaming_agents_and_slots_changes_no_value) {
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

TEST(pairwise, without_couplings_it_is_the_additive_optimum) {
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

TEST(pairwise, chains_are_solved_like_chains) {
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

/// Dense and large enough for every part of the solver to be used.
problem dense_problem(std::uint64_t seed, std::size_t n, std::size_t m) {
  dice d(seed);
  problem p = random_problem(d, n, m, {.levels = 1 << 20, .bounded = false});
  for (auto& b : p.bounds) b.upper = static_cast<std::uint32_t>((n + m - 1) / m + 1);
  p.bounds[0].lower = 1;
  return p;
}

TEST(pairwise, answers_depend_on_nothing_but_the_question) {
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

TEST(pairwise, a_steady_loop_allocates_nothing) {
  pair_solver s;
  problem const large = dense_problem(1, 11, 4);
  problem const small = dense_problem(2, 5, 3);
  problem tied = dense_problem(3, 8, 3);
  for (auto& u : tied.unary) u /= 1 << 18;
  for (auto& t : tied.tables)
    for (auto& w : t.worth) w /= 1 << 18;
  auto const views = {large.view(), small.view(), tied.view()};
  std::vector<std::int64_t> values;
  for (auto const& v : views) values.push_back(s.solve(v).value);
  auto const before = rota_test::allocation_count();
  for (int i = 0; i < 3; ++i) {
    std::size_t k = 0;
    for (auto const& v : views) ASSERT_EQ(s.solve(v).value, values[k++]);
  }
  EXPECT_EQ(rota_test::allocation_count() - before, 0u);
}

TEST(pairwise, interchangeable_agents_take_non_decreasing_slots_and_save_the_work) {
  // Ten agents of one kind that are better apart, five slots of their own worth.
  problem p;
  p.agents = 10;
  p.slots = 5;
  dice d(7);
  std::vector<std::int64_t> row;
  for (int x = 0; x < 5; ++x) row.push_back(d.below(1 << 20));
  std::vector<std::int64_t> apart(25);
  for (std::size_t x = 0; x < 5; ++x)
    for (std::size_t y = 0; y <= x; ++y) apart[x * 5 + y] = apart[y * 5 + x] = d.below(1 << 20);
  for (std::uint32_t a = 0; a < 10; ++a) {
    p.unary.insert(p.unary.end(), row.begin(), row.end());
    for (std::uint32_t b = 0; b < a; ++b) p.tables.push_back({b, a, apart});
  }
  p.bounds.assign(5, {1, 3});
  pair_solver s;
  auto const alike = s.solve(p.view());
  ASSERT_TRUE(alike.proved());
  choice const c = chosen(alike);
  EXPECT_TRUE(std::is_sorted(c.begin(), c.end()));
  EXPECT_EQ(value_of(p, c), alike.value);
  // A unit here and there, and nobody can be exchanged any more.
  problem q = p;
  for (std::size_t a = 0; a < 10; ++a) q.unary[a * 5 + a % 5] += static_cast<std::int64_t>(a);
  auto const unlike = s.solve(q.view());
  ASSERT_TRUE(unlike.proved());
  EXPECT_NEAR(static_cast<double>(unlike.value), static_cast<double>(alike.value), 100);
  RecordProperty("alike", static_cast<int>(alike.work.nodes));
  RecordProperty("unlike", static_cast<int>(unlike.work.nodes));
}

TEST(pairwise, where_all_are_equal_the_first_assignment_is_chosen) {
  problem p;
  p.agents = 12;
  p.slots = 4;
  p.unary.assign(48, 0);
  p.bounds = {{0, 3}, {1, 3}, {2, 4}, {0, 12}};
  pair_solver s;
  auto const got = s.solve(p.view());
  EXPECT_TRUE(got.proved());
  EXPECT_EQ(chosen(got), (choice{0, 0, 0, 1, 1, 1, 2, 2, 2, 2, 3, 3}));
  // Nobody interchangeable, yet every assignment worth the same: rows and columns that cancel.
  dice d(5);
  for (std::uint32_t b = 1; b < 12; ++b)
    for (std::uint32_t a = 0; a < b; ++a) {
      table t{a, b, std::vector<std::int64_t>(16)};
      for (std::size_t x = 0; x < 4; ++x) {
        std::int64_t const v = d.below(100);
        p.unary[a * 4 + x] -= v;
        for (std::size_t y = 0; y < 4; ++y) t.worth[x * 4 + y] = v;
      }
      p.tables.push_back(t);
    }
  auto const cancelled = s.solve(p.view());
  EXPECT_TRUE(cancelled.proved());
  EXPECT_EQ(cancelled.value, 0);
  EXPECT_EQ(chosen(cancelled), (choice{0, 0, 0, 1, 1, 1, 2, 2, 2, 2, 3, 3}));
}

TEST(pairwise, nobody_nowhere_and_nothing_possible_have_an_answer) {
  pair_solver s;
  problem p;
  auto got = s.solve(p.view());
  EXPECT_TRUE(got.found() && got.proved());
  p.slots = 2;
  p.bounds = {{0, 1}, {1, 2}};
  got = s.solve(p.view());
  EXPECT_TRUE(!got.found() && got.proved());
  p.agents = 3;
  p.unary.assign(6, 1);
  EXPECT_TRUE(s.solve(p.view()).found());
  p.bounds[1].upper = 1;
  for (std::uint64_t const enumerate : {std::uint64_t{0}, std::uint64_t{2048}}) {
    s.effort.plain_nodes = enumerate;
    got = s.solve(p.view());
    EXPECT_TRUE(!got.found() && got.proved());
    EXPECT_EQ(got.bound, rota::dense::no_value);
    EXPECT_EQ(accounted(s, p), 8u);
  }
  p.slots = 0;
  p.unary.clear();
  p.bounds.clear();
  got = s.solve(p.view());
  EXPECT_TRUE(!got.found() && got.proved());
}

TEST(pairwise, the_greatest_numbers_are_added_right) {
  // Σ max|u| + Σ max|w| is just what is accepted.
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

TEST(pairwise, sixty_four_agents_fit_and_stop_when_told) {
  problem const p = dense_problem(1, 64, 8);
  pair_solver s;
  auto const got = s.solve(p.view(), {20000, {}});
  EXPECT_TRUE(got.found());
  EXPECT_FALSE(got.proved());
  EXPECT_EQ(value_of(p, chosen(got)), got.value);
  EXPECT_LT(got.value, got.bound);
  EXPECT_EQ(accounted(s, p), power(8, 64));
}

// A pair that many tables forbid is as far away as one that a single table forbids, not so far that sums come round again.
TEST(pairwise, forbidden_often_is_forbidden) {
  problem p;
  p.agents = 3;
  p.slots = 2;
  p.unary.assign(6, 1);
  p.bounds.assign(2, {0, 3});
  for (int i = 0; i < 1 << 13; ++i) p.tables.push_back({0, 1, {absent, 0, 0, absent}});
  pair_solver s;
  for (std::uint64_t const enumerated : {2048u, 0u}) {
    s.effort.plain_nodes = enumerated;
    auto const got = s.solve(p.view());
    ASSERT_TRUE(got.proved() && got.found());
    EXPECT_EQ(got.value, 3);
    EXPECT_EQ(chosen(got), (choice{0, 1, 0}));
  }
}

// Where anybody may idle there are thousands of ways to fill the slots, and bounds by counts are worth their while.
TEST(pairwise, room_for_everybody_in_one_slot_does_not_undo_the_bounds) {
  problem p = dense_problem(3, 18, 5);
  for (auto& b : p.bounds) b = {0, 6};
  p.bounds.back().upper = 18;
  for (std::size_t a = 0; a < p.agents; ++a) p.unary[(a + 1) * p.slots - 1] = 0;
  for (table& t : p.tables)
    for (std::size_t x = 0; x < p.slots; ++x)
      t.worth[x * p.slots + p.slots - 1] = t.worth[(p.slots - 1) * p.slots + x] = 0;
  pair_solver s;
  auto const got = s.solve(p.view());
  ASSERT_TRUE(got.proved());
  EXPECT_EQ(value_of(p, chosen(got)), got.value);
  auto const best = chosen(got);
  s.effort.exact_suffix = 0;
  auto const without = s.solve(p.view());
  ASSERT_TRUE(without.proved());
  EXPECT_EQ(without.value, got.value);
  EXPECT_EQ(chosen(without), best);
  EXPECT_LT(4 * got.work.nodes, without.work.nodes);
}

// Getting ready is work as well: for twenty agents more than half a tick.
TEST(pairwise, may_be_stopped_before_there_is_anything_to_search) {
  problem large = dense_problem(1, 20, 5);
  for (auto& b : large.bounds) b.upper = 5;
  pair_solver s;
  auto const now = [] { return true; };
  auto const at_once = s.solve(large.view(), {~std::uint64_t{0}, now});
  EXPECT_TRUE(at_once.found());
  EXPECT_LE(at_once.work.nodes, 5000u);

  problem const p = dense_problem(2, 14, 4);
  auto const best = s.solve(p.view());
  ASSERT_TRUE(best.proved());
  auto const chosen_then = chosen(best);
  int stopped = 0;
  for (int patience = 0; patience < 60; ++patience) {
    int polls = 0;
    auto const impatient = [&] { return ++polls > patience; };
    auto const got = s.solve(p.view(), {~std::uint64_t{0}, impatient});
    ASSERT_TRUE(got.found()) << patience;
    EXPECT_EQ(value_of(p, chosen(got)), got.value) << patience;
    EXPECT_LE(got.value, best.value) << patience;
    EXPECT_GE(got.bound, best.value) << patience;
    EXPECT_EQ(accounted(s, p), power(4, 14)) << patience;
    EXPECT_TRUE(!got.proved() || chosen(got) == chosen_then) << patience;
    stopped += !got.proved();
  }
  EXPECT_GE(stopped, 15);
}

TEST(pairwise, kernels_for_this_machine_do_what_the_portable_ones_do) {
  using namespace rota::dense::detail;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    std::size_t const slots = 1 + d.bits() % 9;
    std::size_t const stride = lane_stride(1 + d.bits() % 64);
    auto const some = [&](std::size_t count, int range) {
      std::vector<lane> v(count);
      for (lane& x : v) x = static_cast<lane>(d.below(2 * range) - range);
      return v;
    };
    auto const fields = some(slots * stride, 8000);
    auto const table = some(slots * stride, 8000);
    auto const prices = some(slots, 8000);
    lane_node const node{fields.data(), slots, stride, d.bits() % (stride + 1),
                         static_cast<lane>(d.chance(50) ? -9000 : -32768)};
    bool const floored = node.floor != -32768;
    lane_child const child{table.data(), prices.data()};
    std::int32_t sum = 0;
    choose_lane_kernel(stride, floored)(node, &child, 1, &sum);
    std::int32_t expected = 0;
    std::vector<lane> below(slots * stride);
    place(node, table.data(), below.data());
    std::vector<std::int32_t> wanted(slots, 0);
    for (std::size_t l = node.first; l < stride; ++l) {
      int most = std::numeric_limits<int>::min();
      std::size_t at = 0;
      for (std::size_t y = 0; y < slots; ++y) {
        int const v = std::max<int>(fields[y * stride + l] + table[y * stride + l], node.floor);
        RC_ASSERT(below[y * stride + l] == v);
        if (v - prices[y] > most) most = v - prices[y], at = y;
      }
      expected += most;
      ++wanted[at];
    }
    RC_ASSERT(sum == expected);
    std::vector<std::int32_t> got(slots);
    lane_node const placed{below.data(), slots, stride, node.first, node.floor};
    RC_ASSERT(lane_demand(placed, prices.data(), got.data()) == expected);
    RC_ASSERT(got == wanted);
  }));
}

}  // namespace

}  // namespace pairwise_test
