// Every subtree that the pairwise solver leaves out is left out for a good reason, and none is forgotten.
#include "dense/pairs_world.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pairs_cuts_test {

using namespace pairs_world;

TEST(pair_solver, every_cut_is_right_and_nothing_is_forgotten) {
  int cuts[4] = {};
  pair_solver s;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    s.effort = any_effort(d);
    problem const p = any_problem(d, 4000);
    std::vector<char> covered(power(p.slots, p.agents), 0);
    std::int64_t best = absent;
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

TEST(pair_solver, a_symmetric_cut_has_its_like_elsewhere) {
  pair_solver s;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    s.effort = any_effort(d);
    problem const p = random_problem(d, 5, 3, {.levels = 10, .absent_slots = 10, .absent_pairs = 5, .kinds = true});
    auto const observe = [&](std::span<slot const> partial, pair_cut why, std::int64_t) {
      if (why != pair_cut::symmetry) return;
      choice x(partial.begin(), partial.end());
      completions(p, x, 0, [&](choice const& c) {
        // Exchanging two agents gives an assignment that comes before and is worth the same.
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

TEST(pair_solver, interchangeable_agents_take_non_decreasing_slots_and_save_the_work) {
  // Ten agents of one kind that had better be apart, and five slots of different worth.
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
  // With a unit more here and there, no two agents can be exchanged.
  problem q = p;
  for (std::size_t a = 0; a < 10; ++a) q.unary[a * 5 + a % 5] += static_cast<std::int64_t>(a);
  auto const unlike = s.solve(q.view());
  ASSERT_TRUE(unlike.proved());
  EXPECT_NEAR(static_cast<double>(unlike.value), static_cast<double>(alike.value), 100);
  RecordProperty("alike", static_cast<int>(alike.work.nodes));
  RecordProperty("unlike", static_cast<int>(unlike.work.nodes));
}

// Where all may idle there are thousands of final counts, and bounds by counts still pay.
TEST(pair_solver, room_for_everybody_in_one_slot_does_not_undo_the_bounds) {
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

}  // namespace pairs_cuts_test
