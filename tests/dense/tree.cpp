// Branch and bound: its account adds up, its bound holds within any limit, and a bound that lies is found out.
#include "dense/dense_world.hpp"
#include "support/allocation_counter.hpp"

#include <rota/dense/tree/solver.hpp>
#include <rota/search/best_allocation.hpp>
#include <rota/search/reallocate.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace general_test {

using namespace dense_world;
using rota::dense::instance;
using rota::dense::slot;
using rota::dense::tree_account;
using rota::dense::tree_options;
using rota::dense::tree_outcome;
using rota::dense::tree_solver;

constexpr std::int64_t nothing = std::numeric_limits<std::int64_t>::min();

/// Any function of assignments, its exact suffix optima as bounds, loosened or falsified on demand.
struct oracle final : rota::dense::tree_oracle {
  std::size_t slots = 1;
  std::uint64_t salt = 0;
  int levels = 5;
  int admissible = 100;    // per cent
  std::int64_t slack = 0;  // negative: a lie
  bool bounded = true;
  bool foreseeing = false;  // `hopeless` is exact
  bool sorted = false;      // the value depends on how many agents are in each slot only
  instance const* in = nullptr;
  std::map<std::vector<slot>, std::int64_t> best_below;  // `nothing` where nothing is admissible

  std::int64_t value(std::span<slot const> x) const {
    std::uint64_t h = salt;
    if (sorted) {
      std::vector<std::uint64_t> count(slots, 0);
      for (auto const s : x) ++count[s];
      for (auto const c : count) h = mixed(h ^ c);
    } else {
      for (auto const s : x) h = mixed(h ^ (s + 1));
    }
    if (static_cast<int>(h % 100) >= admissible) return nothing;
    return static_cast<std::int64_t>((h >> 20) % static_cast<std::uint64_t>(levels));
  }
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
    return x ^ (x >> 29);
  }
  std::optional<std::int64_t> leaf(std::span<slot const> x, std::int64_t, std::optional<std::int64_t>) override {
    auto const v = value(x);
    return v == nothing ? std::nullopt : std::optional{v};
  }
  std::int64_t bound(std::span<slot const> prefix, std::int64_t) override {
    if (!bounded) return rota::dense::no_bound;
    auto const best = best_below.at({prefix.begin(), prefix.end()});
    return best == nothing ? best : best + slack;
  }
  bool hopeless(std::span<slot const> prefix) override {
    return foreseeing && best_below.at({prefix.begin(), prefix.end()}) == nothing;
  }

  /// Enumerates all assignments within the bounds below each prefix.
  std::int64_t explore(std::vector<slot>& prefix) {
    std::int64_t best = nothing;
    if (prefix.size() == in->agents) {
      std::vector<unsigned> count(slots, 0);
      for (auto const s : prefix) ++count[s];
      bool valid = true;
      for (std::size_t s = 0; s < slots; ++s)
        valid &= count[s] >= in->bounds[s].lower && count[s] <= in->bounds[s].upper;
      if (valid) best = value(prefix);
    } else {
      for (slot s = 0; s < slots; ++s) {
        if (!in->present(prefix.size(), s)) continue;
        prefix.push_back(s);
        best = std::max(best, explore(prefix));
        prefix.pop_back();
      }
    }
    best_below[prefix] = best;
    return best;
  }
};

/// A problem with its oracle; `first` is the lexicographically smallest optimum.
struct setting {
  std::vector<std::int64_t> utility;
  std::vector<rota::dense::slot_bounds> bounds;
  instance in;
  oracle asked;
  std::int64_t best = nothing;

  setting(dice& d, int agents, int slots) {
    auto const p = random_problem(d, {.agents = agents, .slots = slots});
    for (auto const& u : p.utility) utility.push_back(u ? 0 : rota::dense::absent);
    for (auto const& [lower, upper] : p.bounds) bounds.push_back({lower, upper});
    in = instance{p.agents, utility, bounds};
    asked.slots = p.slots;
    asked.salt = d.bits();
    asked.levels = d.chance(50) ? 3 : 1000;
    asked.admissible = d.chance(50) ? 100 : d.below(60);
  }
  setting(setting const&) = delete;
  void explore() {
    asked.in = &in;
    std::vector<slot> prefix;
    best = asked.explore(prefix);
  }
  [[nodiscard]] std::vector<slot> first() const {
    std::vector<slot> x;
    while (x.size() < in.agents) {
      slot s = 0;
      for (;; ++s) {
        auto y = x;
        y.push_back(s);
        auto const found = asked.best_below.find(y);
        if (found != asked.best_below.end() && found->second == best) break;
      }
      x.push_back(s);
    }
    return x;
  }
  [[nodiscard]] std::uint64_t all() const {  // m^n modulo the modulus
    std::uint64_t product = 1;
    for (std::size_t a = 0; a < in.agents; ++a) product = product * asked.slots % tree_account::modulus;
    return product;
  }
};

/// Nobody at all: whether lower bounds are met is left to the caller.
bool degenerate(setting const& s) { return s.in.agents == 0; }

TEST(tree_solver, finds_what_enumeration_finds_first_and_accounts_for_all) {
  int found = 0;
  int cut = 0;
  int hopeless = 0;
  int pairs = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*small_world::any_seed().as("seed"));
    setting s(d, 5, 4);
    s.asked.slack = d.chance(50) ? 0 : d.below(3);
    s.asked.bounded = d.chance(80);
    s.asked.foreseeing = d.chance(50);
    s.explore();
    if (degenerate(s)) return;
    tree_solver solver;
    auto const got = solver.solve(s.in, s.asked, {.audit = true});
    RC_ASSERT(got.proved());
    RC_ASSERT(!got.lie);
    RC_ASSERT(got.found() == (s.best != nothing));
    RC_ASSERT(got.account.covered == s.all());
    cut += got.account.bounded > 0;
    hopeless += got.account.hopeless > 0;
    pairs += got.account.pairs > 0;
    if (!got.found()) return;
    ++found;
    RC_ASSERT(got.value == s.best);
    RC_ASSERT(got.bound == s.best);
    auto const first = s.first();
    RC_ASSERT(std::equal(first.begin(), first.end(), got.assignment.begin(), got.assignment.end()));
  }));
  EXPECT_GE(found, 300);
  EXPECT_GE(cut, 200);
  EXPECT_GE(hopeless, 100);
  EXPECT_GE(pairs, 300);
}

TEST(tree_solver, within_any_limit_its_bound_holds) {
  int interrupted = 0;
  int narrowed = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*small_world::any_seed().as("seed"));
    setting s(d, 5, 4);
    s.asked.slack = d.below(3);
    s.explore();
    if (degenerate(s)) return;
    tree_solver solver;
    auto const got = solver.solve(s.in, s.asked, {.limit = {static_cast<std::uint64_t>(d.below(60)), {}}});
    if (got.proved()) return;
    ++interrupted;
    RC_ASSERT(got.bound >= s.best);
    RC_ASSERT(!got.found() || got.value <= s.best);
    RC_ASSERT(got.account.covered != s.all());
    narrowed += got.bound < s.best + s.asked.slack + 1 && got.bound != rota::dense::no_bound;
  }));
  EXPECT_GE(interrupted, 100);
  EXPECT_GE(narrowed, 60);
}

TEST(tree_solver, improves_on_what_is_known_or_keeps_its_first) {
  int kept = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*small_world::any_seed().as("seed"));
    setting s(d, 5, 3);
    s.explore();
    if (degenerate(s) || s.best == nothing) return;
    std::vector<std::vector<slot>> complete;
    for (auto const& [x, v] : s.asked.best_below)
      if (x.size() == s.in.agents && v != nothing) complete.push_back(x);
    auto const& known = complete[d.bits() % complete.size()];
    tree_solver solver;
    tree_options options;
    options.known = known;
    options.known_value = s.asked.best_below.at(known);
    auto const got = solver.solve(s.in, s.asked, options);
    RC_ASSERT(got.value == s.best);
    auto const first = s.first();
    RC_ASSERT(std::equal(first.begin(), first.end(), got.assignment.begin(), got.assignment.end()));
    kept += options.known_value == s.best;
  }));
  EXPECT_GE(kept, 100);
}

TEST(tree_solver, interchangeable_agents_are_tried_in_one_order_only) {
  int mirrored = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*small_world::any_seed().as("seed"));
    setting s(d, 5, 3);
    auto const m = s.asked.slots;
    for (std::size_t i = m; i < s.utility.size(); ++i) s.utility[i] = s.utility[i % m];  // equal rows
    s.asked.sorted = true;
    s.asked.bounded = d.chance(50);
    s.explore();
    if (degenerate(s)) return;
    std::vector<rota::dense::row_index> twin(s.in.agents);
    for (std::size_t a = 0; a < twin.size(); ++a) twin[a] = static_cast<rota::dense::row_index>(a == 0 ? 0 : a - 1);
    tree_solver solver;
    auto const plain = solver.solve(s.in, s.asked);
    tree_options options;
    options.twin = twin;
    auto const got = solver.solve(s.in, s.asked, options);
    RC_ASSERT(got.found() == plain.found());
    RC_ASSERT(got.account.nodes <= plain.account.nodes);
    RC_ASSERT(got.account.covered == s.all());
    mirrored += got.account.mirrored > 0;
    if (!got.found()) return;
    RC_ASSERT(got.value == s.best);
    auto const first = s.first();
    RC_ASSERT(std::equal(first.begin(), first.end(), got.assignment.begin(), got.assignment.end()));
  }));
  EXPECT_GE(mirrored, 150);
}

TEST(tree_solver, a_bound_that_lies_is_found_out) {
  int lies = 0;
  int audited = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*small_world::any_seed().as("seed"));
    setting s(d, 5, 3);
    s.asked.slack = -1 - d.below(3);
    s.explore();
    if (degenerate(s) || s.best == nothing || s.in.agents < 2) return;
    tree_solver solver;
    auto const plain = solver.solve(s.in, s.asked);
    // Whatever leaf is seen first refutes the bound of some prefix of it, for these are exact but for the slack.
    auto const got = solver.solve(s.in, s.asked, {.audit = true});
    audited += got.lie && !plain.lie;
    if (!got.lie) return;
    ++lies;
    auto const refuter = got.lie->assignment;
    RC_ASSERT(s.asked.value(refuter) == got.lie->value);
    RC_ASSERT(got.lie->bound < got.lie->value);
    RC_ASSERT(s.asked.bound(refuter.first(got.lie->depth), 0) == got.lie->bound);
  }));
  EXPECT_GE(lies, 200);
}

TEST(tree_solver, stops_when_asked_to) {
  std::vector<std::int64_t> const utility(12 * 4, 0);
  std::vector<rota::dense::slot_bounds> const bounds(4, {0, 12});
  oracle asked;
  asked.slots = 4;
  asked.bounded = false;
  int calls = 0;
  auto const soon = [&] { return ++calls > 2; };
  tree_solver solver;
  auto const got = solver.solve({12, utility, bounds}, asked, {.limit = {~std::uint64_t{0}, soon}});
  EXPECT_FALSE(got.proved());
  EXPECT_TRUE(got.found());
  EXPECT_EQ(got.bound, rota::dense::no_bound);
  EXPECT_LE(got.account.nodes, 4096u);
}

// What becomes of it in a problem -----------------------------------------------------------------------------------------

using small_world::names;
using plan_t = rota::plan<names, rota::no_beliefs>;
using view_t = rota::allocation_view<names>;
using rest_t = std::span<names::agent const>;

struct team_of {
  explicit team_of(int n) {
    for (int a = 0; a < n; ++a) members.add(names::agent(a));
  }
  rota::solution<names> solve(rota::plan_description<names, rota::no_beliefs> d, rota::search_budget budget = {}) {
    auto const type = rota::plan_type<names>::make({}, {plan_t::make(std::move(d)).value()}).value();
    auto const found = best_allocation(rota::problem{type, members}, space, budget);
    EXPECT_TRUE(found);
    return found ? *found : rota::solution<names>{};
  }
  rota::team<names> members;
  rota::workspace space;
};

rota::plan_description<names, rota::no_beliefs> three_tasks() {
  rota::plan_description<names, rota::no_beliefs> d;
  for (int t = 0; t < 3; ++t) d.tasks.push_back({names::task(t), {0, 3}, {}});
  return d;
}

/// One for each task that is served by an odd number of agents.
double odd_tasks(view_t c) {
  std::ptrdiff_t odd = 0;
  for (int t = 0; t < 3; ++t)
    odd += std::count_if(c.begin(), c.end(), [&](auto const& x) { return x.task == names::task(t); }) % 2;
  return static_cast<double>(odd);
}

TEST(best_allocation, reports_a_lying_bound_with_the_partial_allocation) {
  auto d = three_tasks();
  d.utility = rota::general_utility<names, rota::no_beliefs>{
      [](auto, view_t c) { return odd_tasks(c); }, [](auto, view_t, rest_t rest) { return rest.empty() ? 3.0 : 0.5; }};
  auto const s = team_of(5).solve(d, {.audit = true});
  ASSERT_TRUE(s.lie);
  EXPECT_FALSE(s.optimal);
  EXPECT_EQ(s.gap, std::numeric_limits<double>::infinity());
  EXPECT_EQ(s.lie->bound, 0.5);
  EXPECT_GE(s.lie->value, 1.0);
  EXPECT_EQ(s.lie->partial.size() + s.lie->undecided, 5u) << "in this one, nobody that is decided is idle";
  EXPECT_TRUE(is_subset(s.lie->partial, s.lie->complete));
  EXPECT_EQ(odd_tasks(s.lie->complete.atoms()), s.lie->value);
  EXPECT_EQ(odd_tasks(s.atoms.atoms()), s.utility) << "what it returns is valid all the same";
}

TEST(reallocate, passes_on_what_a_search_complains_of) {
  auto d = three_tasks();
  d.utility = rota::general_utility<names, rota::no_beliefs>{
      [](auto, view_t c) { return c.size() == 5 ? std::nan("") : odd_tasks(c); },
      [](auto, view_t, rest_t rest) { return rest.empty() ? 3.0 : 0.5; }};
  team_of team(5);
  auto const ask = [&] {
    auto const type = rota::plan_type<names>::make({}, {plan_t::make(d).value()}).value();
    return reallocate(rota::problem{type, team.members}, {}, team.space, {.audit = true});
  };
  auto const some = ask();
  EXPECT_TRUE(some.plan);
  EXPECT_FALSE(some.optimal);
  ASSERT_TRUE(some.lie);
  EXPECT_EQ(some.lie->bound, 0.5);
  ASSERT_TRUE(some.ignored);
  EXPECT_EQ(some.ignored->why, rota::utility_fault::not_a_number);
  d.utility = rota::general_utility<names, rota::no_beliefs>{[](auto, view_t) { return -1.0; },
                                                             [](auto, view_t, rest_t) { return -2.0; }};
  auto const none = ask();
  EXPECT_FALSE(none.plan);
  EXPECT_EQ(none.reason, rota::reallocation_reason::search_incomplete);
  ASSERT_TRUE(none.lie);
  EXPECT_EQ(none.lie->value, -1.0);
}

TEST(best_allocation, says_how_far_it_may_be_from_the_optimum) {
  auto d = three_tasks();
  d.utility = rota::general_utility<names, rota::no_beliefs>{[](auto, view_t c) { return odd_tasks(c); },
                                                             [](auto, view_t, rest_t) { return 3.0; }};
  for (auto& t : d.tasks) t.bounds = {0, 4};
  team_of team(7);
  auto const best = team.solve(d, {.nodes = 1u << 20});
  EXPECT_TRUE(best.optimal);
  EXPECT_EQ(best.utility, 3.0);
  EXPECT_EQ(best.gap, 0.0);
  auto const some = team.solve(d, {.nodes = 7});
  EXPECT_FALSE(some.optimal);
  EXPECT_EQ(some.gap, 3.0 - some.utility);
}

TEST(best_allocation, that_is_stopped_at_once_has_an_answer_all_the_same) {
  auto d = three_tasks();
  d.utility = rota::general_utility<names, rota::no_beliefs>{[](auto, view_t c) { return odd_tasks(c); },
                                                             [](auto, view_t, rest_t) { return 3.0; }};
  auto const at_once = [] { return true; };
  rota::search_budget none;
  none.stop = at_once;
  team_of team(5);
  for (auto const& budget : {none, rota::search_budget{.nodes = 0}}) {
    auto const s = team.solve(d, budget);
    EXPECT_EQ(s.work.nodes, 0u);
    EXPECT_FALSE(s.optimal);
    EXPECT_EQ(s.gap, 3.0 - s.utility);
    EXPECT_EQ(odd_tasks(s.atoms.atoms()), s.utility);
  }
  // And it is no worse than what runs, if that is valid.
  auto const type = rota::plan_type<names>::make({}, {plan_t::make(d).value()}).value();
  rota::problem<names, rota::no_beliefs> p{type, team.members};
  rota::allocation_atoms<names> runs;
  for (int a = 0; a < 3; ++a) runs.insert({names::agent(a + 1), {}, names::task(2 - a)});
  p.current = runs.atoms();
  auto const s = best_allocation(p, team.space, none);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->utility, 3.0);
  EXPECT_EQ(s->atoms, runs);
}

TEST(tree_solver, a_bound_that_denies_what_is_known_lies) {
  int lies = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*small_world::any_seed().as("seed"));
    setting s(d, 5, 3);
    s.asked.slack = -1 - d.below(3);
    s.explore();
    if (degenerate(s) || s.best == nothing || s.in.agents < 2) return;
    auto const known = s.first();
    tree_solver solver;
    tree_options options;
    options.known = known;
    options.known_value = s.best;
    auto const got = solver.solve(s.in, s.asked, options);
    RC_ASSERT(got.lie);
    RC_ASSERT(got.lie->bound < got.lie->value);
    RC_ASSERT(s.asked.value(got.lie->assignment) == got.lie->value);
    RC_ASSERT(s.asked.bound(got.lie->assignment.first(got.lie->depth), 0) == got.lie->bound);
    ++lies;
  }));
  EXPECT_GE(lies, 200);
}

TEST(best_allocation, leaves_what_an_outlook_calls_impossible) {
  auto d = three_tasks();
  d.utility = rota::additive_utility<names, rota::no_beliefs>([](auto a, auto t, auto) {
    return std::optional<double>(static_cast<int>(a) % 3 == static_cast<int>(t) ? 2 : 1);
  });
  auto const crowd = [](view_t c) {  // at most two agents in all
    return c.size() <= 2;
  };
  d.precondition = [=](auto, view_t c) { return crowd(c); };
  team_of team(7);
  auto const blind = team.solve(d);
  d.outlook = [=](auto, view_t c, rest_t) { return crowd(c) ? rota::possibility::perhaps : rota::possibility::no; };
  auto const foreseeing = team.solve(d);
  EXPECT_TRUE(blind.optimal && foreseeing.optimal);
  EXPECT_EQ(blind.utility, 4.0);
  EXPECT_EQ(foreseeing.atoms, blind.atoms);
  EXPECT_LT(foreseeing.work.leaves * 10, blind.work.leaves);
}

TEST(best_allocation, interchangeable_agents_cost_little) {
  auto d = three_tasks();
  rota::general_utility<names, rota::no_beliefs> u{[](auto, view_t c) { return odd_tasks(c); }};
  team_of team(8);
  d.utility = u;
  auto const blind = team.solve(d);
  u.kind = [](auto, auto) { return std::uint64_t{0}; };
  d.utility = u;
  auto const seeing = team.solve(d);
  EXPECT_EQ(seeing.atoms, blind.atoms);
  EXPECT_EQ(seeing.utility, 3.0);
  EXPECT_LT(seeing.work.nodes * 100, blind.work.nodes);
}

TEST(best_allocation, branch_and_bound_in_a_steady_loop_allocates_nothing) {
  auto d = three_tasks();
  double more = 0;
  d.utility = rota::weighted_sum<names, rota::no_beliefs>{
      {1, rota::additive_utility<names, rota::no_beliefs>{[&more](auto a, auto t, auto) {
         return more * static_cast<int>(a) + static_cast<int>(t);
       }}},
      {2, rota::general_utility<names, rota::no_beliefs>{[](auto, view_t c) { return odd_tasks(c); },
                                                         [](auto, view_t, rest_t) { return 3.0; }}}};
  d.precondition = [](auto, view_t c) { return c.size() != 3; };
  auto const type = rota::plan_type<names>::make({}, {plan_t::make(d).value()}).value();
  team_of team(8);
  rota::allocation_atoms<names> runs;
  auto const tick = [&](double u) {
    more = u;
    auto const next = reallocate(rota::problem{type, team.members}.running(runs), {}, team.space);
    EXPECT_GT(next.work.nodes, 0u);
    runs = next.atoms;
  };
  tick(1);
  auto const before = rota_test::allocation_count();
  for (int i = 0; i < 20; ++i) tick(i % 5);
  EXPECT_EQ(rota_test::allocation_count(), before);
}

TEST(best_allocation, a_utility_that_throws_leaves_the_workspace_usable) {
  auto d = three_tasks();
  d.utility = rota::pairwise_utility<names, rota::no_beliefs>{
      {}, [](auto a, auto, auto, auto, auto) -> double { return a == names::agent(0) ? throw 1 : 1.0; }};
  team_of team(4);
  auto const s = team.solve(d);
  ASSERT_TRUE(s.ignored);
  EXPECT_EQ(s.ignored->why, rota::utility_fault::threw);
  EXPECT_TRUE(s.ignored->other);
  EXPECT_EQ(s.utility, 3.0) << "all but the first agent";
  EXPECT_EQ(s.atoms.begin()->agent, names::agent(1));
  d.utility = rota::additive_utility<names, rota::no_beliefs>([](auto, auto, auto) { return 1.0; });
  EXPECT_EQ(team.solve(d).utility, 4.0);
}

}  // namespace general_test
