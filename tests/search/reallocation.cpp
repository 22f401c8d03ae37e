#include "allocation/reading.hpp"
#include "support/allocation_counter.hpp"

#include <rota/allocation/validate.hpp>
#include <rota/search/reallocate.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <map>

namespace reallocation_test {

namespace {

using namespace small_world;
using reason = rota::reallocation_reason;

/// What should happen, by the definition, on plain data.
struct expectation {
  facts atoms;
  rota::reallocation_reason reason{};
};

bool executes(facts const& c, raw_plan const& p) {
  return std::any_of(c.begin(), c.end(), [&](fact const& x) { return x.plan == p.id; });
}

/// `raw.current` is the running allocation.
expectation expect(raw_problem const& raw, rota::hysteresis const& h) {
  auto const& current = raw.current;
  auto const best = reading::enumerate(raw);
  std::optional<double> standing;
  double margin = 0;
  for (auto const& p : raw.plans) {
    if (!current.empty() && !executes(current, p)) continue;
    if (!reading::judge(raw, p, current, !current.empty()).valid()) continue;
    if (standing && value_of(raw, p, current) <= *standing) continue;
    standing = value_of(raw, p, current);
    margin = current.empty() ? 0 : p.hysteresis;
  }
  margin = h.absolute.value_or(margin) + h.relative * std::abs(standing.value_or(0));
  if (standing && best.plan != nullptr && best.objective <= *standing + margin)
    return {current, best.utility > *standing ? reason::kept_hysteresis : reason::kept_optimal};
  if (best.plan == nullptr) return {{}, reason::no_valid_allocation};
  return {best.atoms, current.empty() ? reason::first : standing ? reason::adopted_better : reason::current_invalid};
}

/// Whether some plan pays a bonus for leaving: then a team never rests.
bool restless(raw_problem const& raw) {
  return std::any_of(raw.plans.begin(), raw.plans.end(), [](raw_plan const& p) { return p.sum && p.sum->staying < 0; });
}

TEST(reallocate, keeps_what_is_valid_and_good_enough) {
  std::map<reason, int> reached;
  int cases = 0;
  int entry = 0;
  int costly = 0;
  int relative = 0;
  int violated = 0;
  rota::workspace work;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    auto raw = random_problem(d, {.agents = *between(0, 4).as("agents"),
                                  .tasks = 2,
                                  .plans = 2,
                                  .levels = 4,
                                  .general = true,
                                  .preconditions = d.chance(50),
                                  .sums = d.chance(50)});
    if (d.chance(40)) raw.change_cost = 0.25 * d.below(5);
    built const b(raw);
    rota::problem problem{b.type, b.team, b.beliefs, b.participants,
                          raw.idle ? rota::idling::allowed : rota::idling::forbidden};
    problem.change_cost = raw.change_cost;
    for (int i = 0; i < 4; ++i) {
      auto const& p = raw.plans[d.bits() % raw.plans.size()];
      // Often a valid one, sometimes a random or empty one.
      facts current = d.chance(15) ? facts{} : random_facts(d, raw, p);
      if (d.chance(70)) {
        auto const salt = d.bits();
        auto const some = reading::enumerate(raw, p, [&](raw_plan const& q, facts const& c) {
          return reading::judge(raw, q, c, true).valid() &&
                 (salt >> (c.size() + static_cast<std::size_t>(value_of(raw, q, c) + 32) % 32) & 1u) != 0;
        });
        if (some.plan != nullptr) current = some.atoms;
      }
      rota::hysteresis h;
      if (d.chance(30)) h.absolute = 0.25 * d.below(8);
      if (d.chance(30)) h.relative = 0.125 * d.below(4);
      raw.current = current;
      auto const expected = expect(raw, h);
      auto const before = to_atoms(current);
      auto const ask = problem.running(before);
      auto const got = reallocate(ask, h, work);
      RC_ASSERT(got.reason == expected.reason);
      RC_ASSERT(to_facts(got.atoms) == expected.atoms);
      RC_ASSERT(got.proved);
      // It says why: what the running allocation violates, and why no plan has another.
      auto const* const ran = reading::find_plan(raw, current.empty() ? -1 : current.begin()->plan);
      bool const broken = !current.empty() && (ran == nullptr || !reading::judge(raw, *ran, current, true).valid());
      RC_ASSERT(got.violated.has_value() == broken);
      if (broken && ran != nullptr)
        RC_ASSERT(*got.violated ==
                  *validate(ask, *b.type.find(names::plan(ran->id)), before, rota::plan_phase::running).begin());
      RC_ASSERT(got.refusals.size() == (best_allocation(ask, work) ? 0 : raw.plans.size()));
      violated += broken;
      auto same = reallocate(ask, h, best_allocation(ask, work));
      same.work = got.work;
      RC_ASSERT(same == got);
      RC_ASSERT(got.event == rota::difference(before, got.atoms));
      RC_ASSERT(rota::apply(got.event, before).value() == got.atoms);
      if (got.plan) {
        auto const* q = reading::find_plan(raw, static_cast<int>(*got.plan));
        RC_ASSERT(got.utility == value_of(raw, *q, expected.atoms));
        RC_ASSERT(got.changes == static_cast<std::size_t>(changes(raw, expected.atoms)));
        costly += raw.change_cost > 0 && got.changes > 0;
        relative += h.relative > 0 && got.reason == reason::kept_hysteresis;
        RC_ASSERT(reading::judge(raw, *q, expected.atoms, executes(current, *q)).valid());
        entry += q->entry_only && !reading::judge(raw, *q, expected.atoms, false).valid();
      }
      // A second call changes nothing, unless a precondition counted on entry and does not count any more.
      auto const again = reallocate(problem.running(got.atoms), h, work);
      bool const entered = got.plan && reading::find_plan(raw, static_cast<int>(*got.plan))->entry_only;
      if (!entered && !restless(raw)) RC_ASSERT(again.event.empty());
      ++cases;
      ++reached[got.reason];
    }
  }));
  for (auto r : {reason::first, reason::adopted_better, reason::current_invalid, reason::kept_optimal,
                 reason::kept_hysteresis, reason::no_valid_allocation})
    EXPECT_GE(reached[r] * 100, cases * 2) << static_cast<int>(r) << ": " << reached[r] << "/" << cases;
  EXPECT_GE(entry, 10);
  EXPECT_GE(costly * 100, cases);
  EXPECT_GE(relative, 20);
  EXPECT_GE(violated * 100, cases * 10);
}

// Every set of In-atoms of two agents, a stranger, two plans and two tasks: valid or not, mixed, or of two tasks for one agent.
TEST(reallocate, judges_a_running_allocation_by_what_the_search_knows_as_validate_judges_it) {
  raw_problem raw;
  raw.members = {0, 1, 2};
  raw.participants = {0, 1};
  raw_plan p;
  p.tasks = {{0, 0, 1}, {1, 0, 2}};
  p.u[0] = {1, 2};
  p.u[1] = {-4, std::nullopt};
  raw.plans = {p, p};
  raw.plans[1].id = 1;
  raw.plans[1].u[1] = {3, 5};
  raw.forbidden[0][1] = true;
  built const b(raw);
  rota::problem const problem{b.type, b.team, b.beliefs, b.participants};
  facts all;
  for (int agent : {0, 1, 2})
    for (int plan : {0, 1})
      for (int task : {0, 1}) all.push_back({agent, plan, task});

  rota::workspace work;
  int valid = 0;
  for (unsigned chosen = 0; chosen < 1u << all.size(); ++chosen) {
    facts current;
    for (std::size_t i = 0; i < all.size(); ++i)
      if ((chosen >> i & 1u) != 0) current.push_back(all[i]);
    auto const running = to_atoms(current);
    auto const ask = problem.running(running);
    auto const got = reallocate(ask, {}, work);
    auto judged = reallocate(ask, {}, best_allocation(ask, work));
    judged.work = got.work;
    EXPECT_TRUE(got == judged) << chosen;
    valid += got.gain.has_value();
  }
  // Nothing; agent 0 on task 0 of either plan; agent 1 on either task of plan 1, or on task 1 beside agent 0.
  EXPECT_EQ(valid, 6);
}

TEST(reallocate, keeps_what_is_valid_for_ever_under_an_infinite_hysteresis) {
  raw_problem raw;
  raw.members = raw.participants = {0};
  raw_plan p;
  p.tasks = {{0, 0, 1}};
  p.u[0][0] = 5;
  raw.plans = {p};
  built const b(raw);
  rota::problem const idle{b.type, b.team, b.beliefs};
  rota::workspace work;
  auto const infinite = std::numeric_limits<double>::infinity();
  for (rota::hysteresis const h : {rota::hysteresis{.relative = infinite}, rota::hysteresis{.absolute = infinite}}) {
    auto const kept = reallocate(idle, h, work);  // ∅ is worth 0
    EXPECT_EQ(kept.reason, reason::kept_hysteresis);
    EXPECT_TRUE(kept.event.empty());
    EXPECT_EQ(kept.gain, 5);
  }
  EXPECT_EQ(reallocate(idle, {}, work).reason, reason::first);
}

TEST(reallocate, a_steady_loop_allocates_nothing) {
  raw_problem raw;
  raw.members = raw.participants = {0, 1, 2, 3, 4};
  raw_plan p;
  p.tasks = {{0, 1, 1}, {1, 0, 2}, {2, 0, 1}, {3, 1, 2}};
  dice d(7);
  for (auto& row : p.u)
    for (auto& u : row) u = d.below(100);
  p.hysteresis = 1;
  raw.plans = {p};
  built const b(raw);
  rota::problem const problem{b.type, b.team, b.beliefs};
  rota::workspace work;
  auto const current = reallocate(problem, {}, work).atoms;
  auto const before = rota_test::allocation_count();
  for (int i = 0; i < 100; ++i) {
    auto const next = reallocate(problem.running(current), {}, work);
    ASSERT_TRUE(next.event.empty());
    auto const fresh = reallocate(problem, {}, work);
    ASSERT_EQ(fresh.event.size(), current.size());
  }
  EXPECT_EQ(rota_test::allocation_count() - before, 0u);
}

TEST(reallocate, a_spent_budget_keeps_a_valid_allocation_and_says_so) {
  raw_problem raw;
  raw.members = raw.participants = {0, 1, 2, 3, 4, 5};
  raw_plan p;
  p.id = 1;
  p.general = true;
  p.tasks = {{0, 1, 3}, {1, 1, 3}, {2, 0, 2}};
  p.offset = 20;
  dice d(7);
  for (auto& row : p.u)
    for (auto& u : row) u = d.below(20);
  raw.plans = {p};
  built const b(raw);
  rota::problem const problem{b.type, b.team, b.beliefs};
  rota::workspace work;
  auto const best = reallocate(problem, {}, work);
  ASSERT_TRUE(best.proved);
  auto const kept = reallocate(problem.running(best.atoms), {}, work, {10});
  EXPECT_EQ(kept.reason, reason::kept_unproved);
  EXPECT_FALSE(kept.proved);
  EXPECT_TRUE(kept.event.empty());
  EXPECT_LE(kept.work.nodes, 10u);
  atoms_t const invalid{{names::agent(0), names::plan(1), names::task(0)}};
  auto const replaced = reallocate(problem.running(invalid), {}, work, {0});
  EXPECT_EQ(replaced.reason, reason::current_invalid);
  EXPECT_FALSE(replaced.proved);
  EXPECT_TRUE(replaced.plan);
  raw.plans[0].pre = truth::never;
  built const c(raw);
  auto const stopped = reallocate(rota::problem{c.type, c.team, c.beliefs}.running(invalid), {}, work, {3});
  EXPECT_EQ(stopped.reason, reason::search_incomplete);
  EXPECT_TRUE(stopped.atoms.empty());
  EXPECT_FALSE(stopped.plan);
  EXPECT_EQ(stopped.event.size(), 1u);
}

}  // namespace

}  // namespace reallocation_test
