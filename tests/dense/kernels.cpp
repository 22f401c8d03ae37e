// The inner loops of the flow solver: plain ones, those for AVX2, and what this machine chooses, all give the same numbers.
#include "support/dice.hpp"

#include <rota/dense/flow/detail/kernels.hpp>
#include <rota/dense/instance.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace kernels_test {

namespace kernel = rota::dense::detail::kernel;
using numbers = std::vector<std::int64_t>;
using rota_test::dice;

/// One way to compute each kernel.
struct kernels {
  decltype(&kernel::plain::relax) relax;
  decltype(&kernel::plain::least) least;
  decltype(&kernel::plain::best) best;
  decltype(&kernel::plain::best_two) best_two;
  decltype(&kernel::plain::raise) raise;
  decltype(&kernel::plain::first_tight) first_tight;
};
constexpr kernels plain{&kernel::plain::relax,    &kernel::plain::least, &kernel::plain::best,
                        &kernel::plain::best_two, &kernel::plain::raise, &kernel::plain::first_tight};
constexpr kernels wide{&kernel::wide::relax,    &kernel::wide::least, &kernel::wide::best,
                       &kernel::wide::best_two, &kernel::wide::raise, &kernel::wide::first_tight};
constexpr kernels chosen{&kernel::relax,    &kernel::least, &kernel::best,
                         &kernel::best_two, &kernel::raise, &kernel::first_tight};

constexpr std::int64_t limit = std::int64_t{1} << 60;

numbers draw(dice& d, std::size_t n, int levels) {
  numbers v(n);
  for (auto& x : v) x = d.chance(5) ? rota::dense::absent : d.below(levels) - levels / 2;
  return v;
}

void check_leaders(kernels const& k, numbers const& worth, numbers const& price) {
  auto const n = worth.size();
  std::size_t best = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (worth[i] - price[i] > worth[best] - price[best]) best = i;
  RC_ASSERT(k.best(worth.data(), price.data(), n) == best);
  auto second = rota::dense::detail::row_leaders::nothing;
  for (std::size_t i = 0; i < n; ++i)
    if (i != best) second = std::max(second, worth[i] - price[i]);
  auto const leaders = k.best_two(worth.data(), price.data(), n);
  RC_ASSERT(leaders.at == best);
  RC_ASSERT(leaders.first == worth[best] - price[best]);
  RC_ASSERT(leaders.second == second);
}

void check_labels(kernels const& k, numbers const& worth, numbers const& price, numbers label) {
  auto const n = worth.size();
  numbers via(n, -1);
  auto expected_label = label, expected_via = via;
  rota::dense::detail::row_entry least{limit, n};
  for (std::size_t i = 0; i < n; ++i) {
    auto const offered = 5 + price[i] - worth[i];
    if (offered < expected_label[i]) expected_label[i] = offered, expected_via[i] = 42;
    if (expected_label[i] < least.value) least = {expected_label[i], i};
  }
  auto const relaxed = k.relax(5, price.data(), worth.data(), 42, label.data(), via.data(), n, limit);
  RC_ASSERT(label == expected_label);
  RC_ASSERT(via == expected_via);
  RC_ASSERT(relaxed.value == least.value && (relaxed.value == limit || relaxed.at == least.at));
  auto const found = k.least(label.data(), n, limit);
  RC_ASSERT(found.value == least.value && (found.value == limit || found.at == least.at));
}

void check_raise(kernels const& k, numbers const& worth, numbers most) {
  auto const n = worth.size();
  numbers who(n, 0);
  auto expected_most = most, expected_who = who;
  for (std::size_t i = 0; i < n; ++i)
    if (worth[i] - 3 > expected_most[i]) expected_most[i] = worth[i] - 3, expected_who[i] = 9;
  k.raise(worth.data(), 3, 9, most.data(), who.data(), n);
  RC_ASSERT(most == expected_most);
  RC_ASSERT(who == expected_who);
}

void check_first_tight(kernels const& k, numbers const& worth, numbers const& price, std::size_t from) {
  auto const n = worth.size();
  auto gap = price[from] - worth[from];
  for (auto i = from; i < n; ++i) gap = std::min(gap, price[i] - worth[i]);
  for (auto const here : {std::int64_t{2}, gap, gap - 1}) {  // some are tight, just one or equal ones are, none is
    auto tight = from;
    while (tight < n && worth[tight] + here < price[tight]) ++tight;
    RC_ASSERT(k.first_tight(worth.data(), here, price.data(), from, n) == tight);
  }
}

void check(kernels const& k, std::size_t shortest) {
  EXPECT_TRUE(rc::check([&] {
    dice d(*rota_test::any_seed().as("seed"));
    auto const n = shortest + static_cast<std::size_t>(d.below(60));
    int const levels = d.chance(50) ? 4 : 1000;
    auto const worth = draw(d, n, levels);
    numbers price(n);
    for (auto& x : price) x = d.below(levels);
    check_leaders(k, worth, price);
    numbers label(n, limit);
    for (auto& x : label)
      if (d.chance(50)) x = d.below(levels);
    check_labels(k, worth, price, label);
    check_raise(k, worth, draw(d, n, levels));
    check_first_tight(k, worth, price, static_cast<std::size_t>(d.below(static_cast<int>(n))));
  }));
}

TEST(kernel, plain_loops_compute_what_they_say) { check(plain, 1); }

TEST(kernel, vectors_compute_what_plain_loops_do) {
  if (!rota::detail::simd::has_avx2()) GTEST_SKIP() << "no AVX2 here, or switched off";
  check(wide, 8);
}

TEST(kernel, whatever_is_chosen_computes_it_too) { check(chosen, 1); }

}  // namespace kernels_test
