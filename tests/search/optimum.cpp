#include "allocation/reading.hpp"

#include <rota/allocation/validate.hpp>
#include <rota/search/best_allocation.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

namespace optimum_test {

namespace {

using namespace small_world;

rota::idling idling_of(raw_problem const& raw) { return raw.idle ? rota::idling::allowed : rota::idling::forbidden; }

struct shares {
  int cases = 0, found = 0, general = 0, tied = 0, lower = 0, team = 0, forbidden = 0, no_idle = 0, runner_up = 0,
      without_lower_bounds = 0, tree = 0, sums = 0, pairs = 0, staying = 0, costly = 0;
};

bool running(raw_problem const& raw, raw_plan const& p) {
  return std::any_of(raw.current.begin(), raw.current.end(), [&](fact const& x) { return x.plan == p.id; });
}

/// Compares the library with enumeration on one random problem.
void agree(raw_problem const& raw, rota::workspace& work, shares& s) {
  built const b(raw);
  rota::problem problem{b.type, b.team, b.beliefs, b.participants, idling_of(raw)};
  problem.current = b.current.atoms();
  problem.change_cost = raw.change_cost;
  auto const expected = reading::enumerate(raw);
  auto const got = best_allocation(problem, work);
  RC_ASSERT(got.has_value() == (expected.plan != nullptr));
  ++s.cases;
  if (!got) {
    RC_ASSERT(got.error().proved());
    RC_ASSERT(got.error().plans.size() == raw.plans.size());
    for (auto const& refusal : got.error().plans)
      RC_ASSERT(reading::enumerate(raw, *reading::find_plan(raw, static_cast<int>(refusal.plan)),
                                   [&](raw_plan const& p, facts const& c) {
                                     return reading::judge(raw, p, c, running(raw, p)).valid();
                                   })
                    .plan == nullptr);
    return;
  }
  RC_ASSERT(got->proved);
  RC_ASSERT(got->utility == expected.utility);
  RC_ASSERT(got->plan == names::plan(expected.plan->id));
  RC_ASSERT(to_facts(got->atoms) == expected.atoms);
  RC_ASSERT(rota::to_double(got->objective) == expected.objective);
  RC_ASSERT(got->gap == 0);
  RC_ASSERT(!got->lie);
  RC_ASSERT(got->changes == static_cast<std::size_t>(changes(raw, expected.atoms)));
  auto const phase = running(raw, *expected.plan) ? rota::plan_phase::running : rota::plan_phase::entering;
  RC_ASSERT(validate(problem, *b.type.find(got->plan), got->atoms, phase).valid());
  RC_ASSERT(!got->ignored);

  // The runner-up is the best of the other plans.
  reading::best second;
  for (auto const& p : raw.plans) {
    if (p.id == expected.plan->id) continue;
    auto const other = reading::enumerate(
        raw, p, [&](raw_plan const& q, facts const& c) { return reading::judge(raw, q, c, running(raw, q)).valid(); });
    if (other.plan != nullptr && (second.plan == nullptr || other.objective > second.objective ||
                                  (other.objective == second.objective && other.plan->id < second.plan->id)))
      second = other;
  }
  RC_ASSERT(got->runner_up.has_value() == (second.plan != nullptr));
  if (second.plan != nullptr) {
    RC_ASSERT(got->runner_up->plan == names::plan(second.plan->id));
    RC_ASSERT(got->runner_up->utility == second.utility);
    RC_ASSERT(got->runner_up->distance == expected.objective - second.objective);
  }

  ++s.found;
  s.general += expected.plan->general;
  if (expected.plan->sum) {
    ++s.sums;
    s.pairs += expected.plan->sum->pairs != 0;
    s.staying += expected.plan->sum->staying != 0 && !raw.current.empty();
  }
  s.costly += raw.change_cost > 0 && got->changes > 0;
  s.no_idle += !raw.idle;
  s.runner_up += second.plan != nullptr;
  s.tree += got->work.nodes > 0;
  int optima = 0;
  (void)reading::enumerate(raw, *expected.plan, [&](raw_plan const& p, facts const& c) {
    bool const valid = reading::judge(raw, p, c, running(raw, p)).valid();
    optima += valid && value_of(raw, p, c) - raw.change_cost * changes(raw, c) == expected.objective;
    return valid;
  });
  s.tied += optima > 1;
  s.lower +=
      std::any_of(expected.plan->tasks.begin(), expected.plan->tasks.end(), [](auto const& t) { return t.min > 0; });
  s.team += expected.plan->team_min > 0 || expected.plan->team_max != unlimited;
  // A wrong model that ignores lower bounds must give another answer.
  auto lax = raw;
  for (auto& p : lax.plans) {
    p.team_min = 0;
    for (auto& t : p.tasks) t.min = 0;
  }
  s.without_lower_bounds += reading::enumerate(lax).atoms != expected.atoms;
}

shares compare(flavour const& f) {
  shares s;
  rota::workspace work;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    auto g = f;
    g.agents = *between(0, f.agents).as("agents");
    agree(random_problem(d, g), work, s);
  }));
  return s;
}

TEST(best_allocation, additive_is_what_enumeration_finds_first) {
  auto const s = compare({.agents = 5, .tasks = 3, .plans = 2, .levels = 40, .negative = true});
  EXPECT_GE(s.found * 100, s.cases * 30) << s.found;
  EXPECT_GE(s.lower * 100, s.found * 20) << s.lower;
  EXPECT_GE(s.team * 100, s.found * 20) << s.team;
  EXPECT_GE(s.no_idle * 100, s.found * 10) << s.no_idle;
  EXPECT_GE(s.runner_up * 100, s.found * 10) << s.runner_up;
  EXPECT_GE(s.without_lower_bounds * 100, s.found * 5) << s.without_lower_bounds;
  EXPECT_EQ(s.tree, 0);
}

TEST(best_allocation, ties_go_to_the_lexicographically_smallest) {
  auto const s = compare({.agents = 5, .tasks = 3, .plans = 3, .levels = 2});
  EXPECT_GE(s.tied * 100, s.found * 30) << s.tied << "/" << s.found;
}

TEST(best_allocation, general_utilities_and_preconditions_too) {
  auto const s = compare({.agents = 4, .tasks = 3, .plans = 2, .levels = 3, .general = true, .preconditions = true});
  EXPECT_GE(s.general * 100, s.found * 20) << s.general << "/" << s.found;
  EXPECT_GE(s.tied * 100, s.found * 20) << s.tied;
  EXPECT_GE(s.tree * 100, s.found * 30) << s.tree;
}

TEST(best_allocation, negative_totals_are_invalid) {
  auto const s = compare(
      {.agents = 4, .tasks = 2, .plans = 2, .levels = 4, .general = true, .preconditions = true, .negative = true});
  EXPECT_GE((s.cases - s.found) * 100, s.cases * 20) << s.found << "/" << s.cases;
}

TEST(best_allocation, of_sums_of_all_kinds_of_parts) {
  auto const s =
      compare({.agents = 4, .tasks = 3, .plans = 2, .levels = 3, .general = true, .preconditions = true, .sums = true});
  EXPECT_GE(s.sums * 100, s.found * 50) << s.sums;
  EXPECT_GE(s.pairs * 100, s.found * 20) << s.pairs;
  EXPECT_GE(s.tied * 100, s.found * 10) << s.tied;
}

TEST(best_allocation, beside_a_current_one_that_is_costly_to_leave) {
  auto const s = compare({.agents = 4,
                          .tasks = 3,
                          .plans = 2,
                          .levels = 4,
                          .general = true,
                          .preconditions = true,
                          .negative = true,
                          .sums = true,
                          .running = true});
  EXPECT_GE(s.costly * 100, s.found * 20) << s.costly;
  EXPECT_GE(s.staying * 100, s.found * 10) << s.staying;
}

TEST(best_allocation, depends_on_no_listing_order_and_no_history) {
  rota::workspace used;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    auto raw = random_problem(d, {.agents = 5,
                                  .tasks = 3,
                                  .plans = 3,
                                  .levels = 3,
                                  .general = true,
                                  .preconditions = true,
                                  .sums = d.chance(50),
                                  .running = d.chance(50)});
    built const first(raw);
    auto solve = [&](built const& b, rota::workspace& w) {
      rota::problem problem{b.type, b.team, b.beliefs, b.participants, idling_of(raw)};
      problem.current = b.current.atoms();
      problem.change_cost = raw.change_cost;
      auto found = best_allocation(problem, w);
      if (found) found->work = {};  // the work may depend on what was searched before
      return found;
    };
    auto const before = solve(first, used);
    d.shuffle(raw.members);
    d.shuffle(raw.plans);
    for (auto& p : raw.plans) d.shuffle(p.tasks);
    built const second(raw);
    rota::workspace fresh;
    auto same = [&](auto const& found) {
      if (found.has_value() != before.has_value()) return false;
      return found ? *found == *before : found.error().plans == before.error().plans;
    };
    RC_ASSERT(same(solve(second, fresh)));
    RC_ASSERT(same(solve(second, used)));
  }));
}

// Problems too large for enumeration: the flow against branch and bound, which shares no code with it.
TEST(best_allocation, flow_and_tree_agree) {
  rota::dense::flow_solver flow;
  rota::dense::tree_solver tree;
  struct plain final : rota::dense::tree_oracle {
    std::vector<std::int64_t> suffix;
    std::optional<std::int64_t> leaf(std::span<rota::dense::slot const>, std::int64_t sum,
                                     std::optional<std::int64_t>) override {
      return sum;
    }
    std::int64_t bound(std::span<rota::dense::slot const> prefix, std::int64_t sum) override {
      return sum + suffix[prefix.size()];
    }
    bool hopeless(std::span<rota::dense::slot const>) override { return false; }
  } oracle;
  int feasible = 0;
  int stuck = 0;
  int shortage = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    auto const n = static_cast<std::size_t>(*between(0, 8).as("agents"));
    auto const m = static_cast<std::size_t>(*between(1, 5).as("slots"));
    int const levels = *rc::gen::elementOf(std::vector<int>{1, 2, 3, 1000}).as("levels");
    int const forbidding = d.chance(50) ? 0 : d.below(60);
    std::vector<std::int64_t> u(n * m);
    std::vector<rota::dense::slot_bounds> bounds(m);
    for (auto& x : u) x = d.chance(forbidding) ? rota::dense::absent : d.below(levels) - d.below(levels);
    for (auto& b : bounds) {
      b.lower = static_cast<std::uint32_t>(d.chance(60) ? 0 : d.below(3));
      b.upper = b.lower + static_cast<std::uint32_t>(d.below(4));
    }
    rota::dense::instance const in{n, u, bounds};
    oracle.suffix.assign(n + 1, 0);
    bool hopeless = false;
    for (std::size_t a = n; a-- > 0;) {
      std::int64_t most = rota::dense::absent;
      for (std::size_t s = 0; s < m; ++s) most = std::max(most, in.at(a, s));
      hopeless |= most == rota::dense::absent;
      oracle.suffix[a] = hopeless ? 0 : oracle.suffix[a + 1] + most;
    }
    auto const fast = flow.solve(in);
    auto const slow = tree.solve(in, oracle);
    // The tree also counts as a leaf the empty assignment, whose lower bounds it leaves to its caller.
    if (n == 0) return;
    RC_ASSERT(slow.proved());
    RC_ASSERT(slow.status == fast.status);
    feasible += slow.found();
    stuck += fast.obstacle == rota::dense::flow_obstacle::agent_stuck;
    shortage += fast.obstacle == rota::dense::flow_obstacle::slot_short;
    if (!slow.found()) return;
    RC_ASSERT(slow.value == fast.value);
    RC_ASSERT(
        std::equal(slow.assignment.begin(), slow.assignment.end(), fast.assignment.begin(), fast.assignment.end()));
  }));
  EXPECT_GE(feasible, 300);
  EXPECT_GE(stuck, 50);
  EXPECT_GE(shortage, 50);
}

}  // namespace

}  // namespace optimum_test
