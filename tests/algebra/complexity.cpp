#include <gtest/gtest.h>

#include <rota/algebra/apply.hpp>
#include <rota/algebra/delta.hpp>

#include <compare>
#include <cstdint>
#include <vector>

namespace complexity_test {

namespace {

/// An atom that counts how often it is compared.
struct counted {
  int value = 0;
  static inline std::uint64_t comparisons = 0;

  friend bool operator==(counted a, counted b) {
    ++comparisons;
    return a.value == b.value;
  }
  friend std::strong_ordering operator<=>(counted a, counted b) {
    ++comparisons;
    return a.value <=> b.value;
  }
};

using atoms = rota::atom_set<counted>;
using event = rota::event<counted>;

atoms every(int step, int n) {
  std::vector<counted> v;
  for (int i = 0; i < n; ++i) v.push_back({i * step});
  return {v.begin(), v.end()};
}

template <class F>
std::uint64_t cost(F f) {
  auto const before = counted::comparisons;
  f();
  return counted::comparisons - before;
}

/// One merge composes two events, with at most five comparisons per entry at any size. (ALICA's composition is
/// quadratic.)
TEST(complexity, compose_difference_sum_and_apply_are_linear) {
  for (int n : {100, 1000, 10000}) {
    auto const e = *event::make(every(6, n), atoms{});
    auto const f = *event::make(atoms{}, every(4, n));
    auto const bound = static_cast<std::uint64_t>(5 * 2 * n);
    EXPECT_LE(cost([&] { (void)compose(e, f); }), bound);
    EXPECT_LE(cost([&] { (void)(rota::delta(e) + rota::delta(f)); }), bound);
    auto const before = every(6, n), after = every(4, n);
    EXPECT_LE(cost([&] { (void)rota::difference(before, after); }), bound);
    auto const change = rota::difference(before, after);
    EXPECT_LE(cost([&] { (void)rota::apply(change, before); }), 2 * bound);
  }
}

/// One change to a large event takes a binary search, so hardly more comparisons as the event grows.
TEST(complexity, composing_with_a_small_event_searches) {
  auto const one = event::addition(counted{12345});
  std::uint64_t last = 0;
  for (int n : {1000, 10000, 100000}) {
    auto const e = *event::make(every(2, n), atoms{});
    last = cost([&] { (void)compose(e, one); });
    EXPECT_LE(last, 40u);
    EXPECT_LE(cost([&] { (void)compose(one, e); }), 40u);
  }
  EXPECT_GT(last, 0u);
}

/// A control: the naive composition, which looks up each atom in sets, exceeds the same bound.
TEST(complexity, the_bound_rejects_a_quadratic_composition) {
  int const n = 100;
  auto const a = every(6, n), b = every(4, n);
  auto const quadratic = cost([&] {
    for (auto const& x : a)
      for (auto const& y : b) (void)(x == y);
  });
  EXPECT_GT(quadratic, static_cast<std::uint64_t>(5 * 2 * n));
}

}  // namespace

}  // namespace complexity_test
