// Instances of special shapes: nobody, nothing possible, all equal, forbidden again and again.
#include "dense/pairs_world.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pairs_shapes_test {

using namespace pairs_world;

TEST(pair_solver, nobody_nowhere_and_nothing_possible_have_an_answer) {
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

TEST(pair_solver, where_all_are_equal_the_first_assignment_is_chosen) {
  problem p;
  p.agents = 12;
  p.slots = 4;
  p.unary.assign(48, 0);
  p.bounds = {{0, 3}, {1, 3}, {2, 4}, {0, 12}};
  pair_solver s;
  auto const got = s.solve(p.view());
  EXPECT_TRUE(got.proved());
  EXPECT_EQ(chosen(got), (choice{0, 0, 0, 1, 1, 1, 2, 2, 2, 2, 3, 3}));
  // No two agents are interchangeable, yet all assignments are worth the same: rows and columns cancel.
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

// A combination that many tables forbid counts as forbidden once: otherwise sums would overflow.
TEST(pair_solver, forbidden_often_is_forbidden) {
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

}  // namespace pairs_shapes_test
