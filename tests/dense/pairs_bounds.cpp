// Bounds by counts on the last agents: no assignment exceeds its bound, and bounds that are not rounded are reached.
#include "dense/pairs_world.hpp"

#include <rota/dense/pairs/detail/model.hpp>
#include <rota/dense/pairs/detail/suffix_bounds.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pairs_bounds_test {

using namespace pairs_world;
using namespace rota::dense::detail;

constexpr auto unreachable = std::numeric_limits<std::int32_t>::min();

/// Calls f(slots of the last agents from `first` on, what they are worth among themselves) for each way to place them.
template <class F>
void each_suffix(pair_model const& model, problem const& p, std::size_t first, F&& f) {
  std::vector<std::size_t> at(p.agents - first);
  for (std::uint64_t code = 0; code < power(p.slots, at.size()); ++code) {
    std::uint64_t rest = code;
    for (auto& x : at) {
      x = rest % p.slots;
      rest /= p.slots;
    }
    std::int32_t value = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      value += model.share(first + i, at[i]);
      for (std::size_t j = i + 1; j < at.size(); ++j) value += model.pair(first + i, at[i], first + j, at[j]);
    }
    f(at, value);
  }
}

/// The greatest values, as `suffix_bounds` orders them.
struct exact_suffix {
  std::vector<std::int32_t> best;     // [state]
  std::vector<std::int32_t> by_slot;  // [state, slot of the first]
};

exact_suffix enumerate_suffix(pair_model const& model, count_space const& space, problem const& p, std::size_t first) {
  std::size_t const states = space.size(p.agents - first);
  exact_suffix exact{std::vector(states, unreachable), std::vector(states * p.slots, unreachable)};
  each_suffix(model, p, first, [&](std::vector<std::size_t> const& at, std::int32_t value) {
    packed_counts counts = 0;
    for (std::size_t const x : at) counts += space.unit(x);
    for (std::size_t s = 0; s < p.slots; ++s)
      if (space.count(counts, s) > p.bounds[s].upper) return;
    std::size_t const state = space.rank(counts, at.size());
    exact.best[state] = std::max(exact.best[state], value);
    std::int32_t& by_slot = exact.by_slot[state * p.slots + at[0]];
    by_slot = std::max(by_slot, value);
  });
  return exact;
}

struct seen {
  int counted = 0, exact = 0, loose = 0, without_counts = 0;
};

void compare(suffix_bounds const& suffix, pair_model const& model, problem const& p, std::size_t d, bool tight,
             seen& s) {
  auto const exact = enumerate_suffix(model, suffix.space(), p, d);
  for (std::size_t i = 0; i < exact.best.size(); ++i) {
    RC_ASSERT(exact.best[i] <= suffix.greatest(d));
    if (exact.best[i] == unreachable) continue;
    RC_ASSERT(suffix.best(d)[i] >= static_cast<float>(exact.best[i]));
    for (std::size_t x = 0; x < p.slots; ++x) {
      auto const here = exact.by_slot[i * p.slots + x];
      float const bound = suffix.by_slot(d)[i * suffix.width() + x];
      if (here == unreachable) continue;
      RC_ASSERT(bound >= static_cast<float>(here));
      RC_ASSERT(bound <= suffix.best(d)[i]);
      if (tight) RC_ASSERT(bound == static_cast<float>(here));
      ++(bound == static_cast<float>(here) ? s.exact : s.loose);
    }
    if (tight) RC_ASSERT(suffix.best(d)[i] == static_cast<float>(exact.best[i]));
    ++s.counted;
  }
}

TEST(suffix_bounds, no_assignment_exceeds_its_bound) {
  seen s;
  suffix_bounds suffix;
  pair_model model;
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    std::size_t const n = 3 + d.bits() % 4;
    std::size_t const m = 2 + d.bits() % 3;
    flavour f{.levels = d.chance(50) ? 10 : 1 << 20, .coupled = d.chance(50) ? 100 : 40};
    if (d.chance(30)) f.absent_pairs = 10;
    if (d.chance(30)) f.absent_slots = 20;
    problem p = random_problem(d, n, m, f);
    for (auto& b : p.bounds) b = {0, static_cast<std::uint32_t>(1 + d.bits() % n)};
    std::vector<std::uint32_t> upper;
    std::uint32_t room = 0;
    for (auto const b : p.bounds) upper.push_back(b.upper), room += b.upper;
    if (room < n) return;
    model.prepare(p.view(), true);
    suffix_plan const plan{1 + d.bits() % 4, d.bits() % 4};
    suffix.prepare(model, upper, plan, {});
    for (std::size_t first = 0; first < n; ++first) {
      if (!suffix.counted(first)) {
        ++s.without_counts;
        std::vector<std::uint32_t> count;
        each_suffix(model, p, first, [&](std::vector<std::size_t> const& at, std::int32_t value) {
          count.assign(m, 0);
          bool valid = true;
          for (std::size_t const x : at) valid &= ++count[x] <= upper[x];
          if (valid) RC_ASSERT(value <= suffix.greatest(first));
        });
        continue;
      }
      // The bounds of one or two agents are not rounded.
      compare(suffix, model, p, first, n - first <= std::min<std::size_t>(plan.enumerated, 2), s);
    }
  }));
  EXPECT_GE(s.counted, 10000);
  EXPECT_GE(s.exact, s.loose);
  EXPECT_GE(s.loose, 500);
  EXPECT_GE(s.without_counts, 500);
}

}  // namespace pairs_bounds_test
