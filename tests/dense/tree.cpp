// Branch and bound: its account adds up, its bound holds within any limit, and a bound that lies is found out.
#include "dense/dense_world.hpp"

#include <rota/dense/tree/solver.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace tree_test {

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

TEST(tree_solver, finds_what_enumeration_finds_first_and_accounts_for_all) {
  int found = 0;
  int cut = 0;
  int hopeless = 0;
  int pairs = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    setting s(d, 5, 4);
    s.asked.slack = d.chance(50) ? 0 : d.below(3);
    s.asked.bounded = d.chance(80);
    s.asked.foreseeing = d.chance(50);
    s.explore();
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
    dice d(*any_seed().as("seed"));
    setting s(d, 5, 4);
    s.asked.slack = d.below(3);
    s.explore();
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
    dice d(*any_seed().as("seed"));
    setting s(d, 5, 3);
    s.explore();
    if (s.best == nothing) return;
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

TEST(tree_solver, ends_at_the_first_assignment_that_is_worth_enough) {
  int sooner = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    setting s(d, 5, 3);
    s.asked.bounded = false;
    s.explore();
    if (s.best == nothing) return;
    tree_solver solver;
    auto const all = solver.solve(s.in, s.asked);
    auto const got = solver.solve(s.in, s.asked, {.enough = s.best});
    RC_ASSERT(got.proved());
    RC_ASSERT(got.value == s.best);
    auto const first = s.first();
    RC_ASSERT(std::equal(first.begin(), first.end(), got.assignment.begin(), got.assignment.end()));
    sooner += got.account.nodes < all.account.nodes;
  }));
  EXPECT_GE(sooner, 200);
}

TEST(tree_solver, interchangeable_agents_are_tried_in_one_order_only) {
  int mirrored = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    setting s(d, 5, 3);
    auto const m = s.asked.slots;
    for (std::size_t i = m; i < s.utility.size(); ++i) s.utility[i] = s.utility[i % m];  // equal rows
    s.asked.sorted = true;
    s.asked.bounded = d.chance(50);
    s.explore();
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
    dice d(*any_seed().as("seed"));
    setting s(d, 5, 3);
    s.asked.slack = -1 - d.below(3);
    s.explore();
    if (s.best == nothing || s.in.agents < 2) return;
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

TEST(tree_solver, a_bound_that_denies_what_is_known_lies) {
  int lies = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    setting s(d, 5, 3);
    s.asked.slack = -1 - d.below(3);
    s.explore();
    if (s.best == nothing || s.in.agents < 2) return;
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

}  // namespace tree_test
