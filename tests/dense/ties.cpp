// Keys that decide ties keep the order of totals, fit where utilities fit, and name the lexicographically smallest optimum.
#include "dense/dense_world.hpp"
#include "dense/owned_instance.hpp"

#include <rota/dense/flow/solver.hpp>
#include <rota/dense/ties.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ties_test {

using namespace dense_world;
using rota::dense::flow_solver;

TEST(tie_rule, keys_decide_ties_and_nothing_else) {
  int unique = 0;
  int hashed = 0;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    auto const p = random_problem(d, {.agents = 6, .slots = 4, .levels = 3});
    auto const scale = std::int64_t{1} << d.below(50);  // the larger, the fewer bits are left
    std::uint64_t greatest = 0;
    owned_instance in(p);
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

}  // namespace ties_test
