#include <gtest/gtest.h>

#include <rota/search/print.hpp>

#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace assign_test {

using rota::assign;
using rota::assign_fault;
using rota::assignment;
using rota::cardinality;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr auto idle = assignment::idle;

struct question {
  std::size_t agents = 0;
  std::vector<cardinality> bounds;
  std::vector<double> matrix;
  rota::assign_options options;

  [[nodiscard]] double at(std::size_t a, std::size_t k) const { return matrix[a * bounds.size() + k]; }
  [[nodiscard]] bool may(std::size_t a, std::size_t k) const { return !std::isnan(at(a, k)); }
};

/// Everybody's task, and the total: by trying all.
struct found {
  std::vector<std::size_t> tasks;
  double total = 0;
};
std::optional<found> enumerate(question const& q) {
  std::optional<found> best;
  auto const idlers = [](std::vector<std::size_t> const& x) { return std::count(x.begin(), x.end(), idle); };
  std::vector<std::size_t> x(q.agents);
  std::function<void(std::size_t, double)> const place = [&](std::size_t a, double total) {
    if (a == q.agents) {
      for (std::size_t k = 0; k < q.bounds.size(); ++k)
        if (!q.bounds[k].admits(static_cast<std::size_t>(std::count(x.begin(), x.end(), k)))) return;
      bool better = !best;
      if (best && q.options.minimise)
        better = std::pair(idlers(x), total) < std::pair(idlers(best->tasks), best->total);
      else if (best)
        better = total > best->total;
      if (better) best = found{x, total};
      return;
    }
    for (std::size_t k = 0; k < q.bounds.size(); ++k) {
      if (!q.may(a, k)) continue;
      x[a] = k;
      place(a + 1, total + q.at(a, k));
    }
    if (q.options.idle == rota::idling::forbidden) return;
    x[a] = idle;
    place(a + 1, total);
  };
  place(0, 0);
  return best;
}

/// Weak duality written out once more, and the bounds of the proof: each must follow from those given.
void check_proof(question const& q, assignment const& x) {
  std::size_t const m = q.bounds.size();
  auto const n = static_cast<std::int64_t>(q.agents);
  double const sign = q.options.minimise ? -1 : 1;
  std::vector<std::pair<std::int64_t, std::int64_t>> given;
  for (auto const& b : q.bounds) given.emplace_back(b.lower(), std::min<std::int64_t>(b.upper(), n));
  std::int64_t most = 0;
  for (auto const& [lower, upper] : given) most += upper;
  auto const none = q.options.idle == rota::idling::forbidden;
  // When minimising without a price on idling, nobody idles who need not.
  auto const fewest = std::max<std::int64_t>(0, n - most);
  bool const fixed = q.options.minimise && x.proof.idle_counts == 0;
  given.emplace_back(none ? 0 : fewest, none ? 0 : fixed ? fewest : n);
  double bound = 0;
  std::int64_t least_sum = 0, most_sum = 0;
  for (auto const& [lower, upper] : given) least_sum += lower, most_sum += upper;
  for (std::size_t k = 0; k <= m; ++k) {
    auto const [lower, upper] = given[k];
    std::int64_t const low = x.proof.bounds[k].lower(), high = x.proof.bounds[k].upper();
    RC_ASSERT(low <= std::max(lower, n - (most_sum - upper)));
    RC_ASSERT(high >= std::min(upper, n - (least_sum - lower)));
    bound += x.proof.prices[k] * static_cast<double>(x.proof.prices[k] > 0 ? high : low);
  }
  std::int64_t idlers = 0;
  for (std::size_t a = 0; a < q.agents; ++a) {
    double most_here = given[m].second == 0 ? -infinity : -x.proof.idle_counts - x.proof.prices[m];
    for (std::size_t k = 0; k < m; ++k)
      if (q.may(a, k)) most_here = std::max(most_here, sign * q.at(a, k) - x.proof.prices[k]);
    bound += most_here;
    idlers += x.tasks[a] == idle;
  }
  double const value = sign * x.total - x.proof.idle_counts * static_cast<double>(idlers);
  RC_ASSERT(bound == value);
  RC_ASSERT(rota::proven_bound(q.matrix, x, q.options) == x.total);
}

question random_question(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  auto const below = [&](std::uint64_t n) { return random() % n; };
  question q;
  q.agents = below(6);
  std::size_t const tasks = 1 + below(3);
  for (std::size_t k = 0; k < tasks; ++k) {
    auto const lower = static_cast<std::uint32_t>(below(3) == 0 ? below(3) : 0);
    q.bounds.emplace_back(lower, below(4) == 0 ? cardinality::unbounded : lower + static_cast<std::uint32_t>(below(3)));
  }
  auto const levels = below(2) == 0 ? 3u : 1000u;
  double const scale = std::ldexp(1.0, static_cast<int>(below(3)) * 30 - 30);
  auto const forbidding = below(2) == 0 ? 0u : 30u;
  bool const negative = below(2) == 0;
  for (std::size_t i = 0; i < q.agents * tasks; ++i) {
    double const size = static_cast<double>(below(levels)) * scale;
    q.matrix.push_back(below(100) < forbidding ? std::nan("") : negative && below(2) == 0 ? -size : size);
  }
  if (scale > 1)
    for (double& x : q.matrix) x = std::ldexp(x, -18);  // within range
  q.options = {below(2) == 0, below(2) == 0 ? rota::idling::allowed : rota::idling::forbidden, std::nan("")};
  return q;
}

RC_GTEST_PROP(assign, is_what_enumeration_finds_best_and_its_prices_prove_it, ()) {
  auto const q =
      random_question(*rc::gen::noShrink(rc::gen::resize(100, rc::gen::arbitrary<std::uint64_t>())).as("seed"));
  auto const best = enumerate(q);
  auto const got = assign(q.matrix, q.bounds, q.options);
  RC_ASSERT(got.has_value() == best.has_value());
  RC_CLASSIFY(!got, "refused");
  RC_CLASSIFY(got && q.options.minimise, "minimised");
  RC_CLASSIFY(got && got->proof.idle_counts > 0, "idling priced");
  if (!got) {
    auto const why = got.error().reason;
    RC_ASSERT(why == assign_fault::task_short || why == assign_fault::agent_stuck);
    RC_ASSERT((why == assign_fault::task_short ? got.error().task < q.bounds.size() : got.error().agent < q.agents));
    return;
  }
  RC_ASSERT(got->total == best->total);
  RC_ASSERT(got->tasks == best->tasks);
  check_proof(q, *got);
}

TEST(assign, minimising_gives_a_task_to_as_many_as_can_have_one) {
  std::array const costs{4.0, 1.0, 3.0,   //
                         2.0, 0.0, 5.0,   //
                         3.0, 2.0, 2.0};  // the example of scipy.optimize.linear_sum_assignment
  auto const three = assign(costs, {{0, 1}, {0, 1}, {0, 1}}, {.minimise = true});
  ASSERT_TRUE(three);
  EXPECT_EQ(three->total, 5);
  EXPECT_EQ(three->tasks, (std::vector<std::size_t>{1, 0, 2}));
  // One task for two agents: the dearer one idles.
  auto const one = assign(std::array{4.0, 1.0}, {{0, 1}}, {.minimise = true});
  EXPECT_EQ(one->tasks, (std::vector<std::size_t>{idle, 0}));
  EXPECT_EQ(one->total, 1);
  // Utilities of the same numbers, negated by hand, are another question: idling is worth more than any of them.
  EXPECT_EQ(assign(std::array{-4.0, -1.0}, {{0, 1}})->tasks, (std::vector{idle, idle}));
  // Nobody is left out because it is dear.
  auto const dear =
      assign(std::array{1.0, infinity, 1.0, 1000000.0}, {{0, 1}, {0, 1}}, {.minimise = true, .forbidden = infinity});
  EXPECT_EQ(dear->tasks, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(dear->total, 1000001);
}

TEST(assign, forbidden_pairs_may_leave_agents_idle_at_a_price) {
  // Both can do the first task only.
  std::array const costs{5.0, infinity, 3.0, infinity};
  rota::assign_options const options{.minimise = true, .forbidden = infinity};
  auto const some = assign(costs, {{0, 1}, {0, 1}}, options);
  ASSERT_TRUE(some);
  EXPECT_EQ(some->tasks, (std::vector<std::size_t>{idle, 0}));
  EXPECT_EQ(some->total, 3);
  EXPECT_GT(some->proof.idle_counts, 5);
  EXPECT_EQ(rota::proven_bound(costs, *some, options), 3);
  auto none = options;
  none.idle = rota::idling::forbidden;
  EXPECT_EQ(assign(costs, {{0, 1}, {0, 1}}, none).error().reason, assign_fault::agent_stuck);
}

TEST(assign, a_false_proof_does_not_reach_the_total) {
  std::array const utilities{3.0, 1.0, 2.0, 2.0};
  auto best = *assign(utilities, {{0, 1}, {0, 1}});
  EXPECT_EQ(rota::proven_bound(utilities, best), best.total);
  for (double& p : best.proof.prices) {
    auto const right = p;
    p += 10;
    EXPECT_GT(rota::proven_bound(utilities, best), best.total);
    p = right;
  }
}

TEST(assign, every_fault_has_words) {
  std::set<std::string> words, sentences, reasons;
  for (int i = 0; i <= static_cast<int>(assign_fault::agent_stuck); ++i) {
    rota::assign_refusal const r{static_cast<assign_fault>(i), 1, 2};
    EXPECT_TRUE(words.insert(to_string(r.reason)).second);
    EXPECT_TRUE(sentences.insert(describe(r)).second);
    EXPECT_TRUE(reasons.insert(reason_of(r)).second);
  }
  EXPECT_FALSE(words.contains("?") || sentences.contains("?") || reasons.contains("?"));
  EXPECT_EQ(describe(rota::assign_refusal{assign_fault::infinite, 1, 2}),
            "the entry of agent 1 and task 2 is infinite");
}

TEST(assign, what_is_no_question_is_refused_with_its_place) {
  auto const why = [](std::vector<double> const& m, std::vector<cardinality> const& b, rota::assign_options o = {}) {
    return assign(m, b, o).error();
  };
  using refusal = rota::assign_refusal;
  EXPECT_EQ(why({1, 2, 3}, {{}, {}}).reason, assign_fault::sizes_differ);
  EXPECT_EQ(why({1}, {}).reason, assign_fault::sizes_differ);
  EXPECT_EQ(why({1, 2}, {{}, {3, 1}}), (refusal{assign_fault::empty_bounds, 0, 1}));
  EXPECT_EQ(why({1, 2, 3, std::nan("")}, {{}, {}}), (refusal{assign_fault::not_a_number, 1, 1}));
  EXPECT_EQ(why({1, infinity}, {{}, {}}), (refusal{assign_fault::infinite, 0, 1}));
  EXPECT_EQ(why({-infinity, 1}, {{}, {}}, {.forbidden = infinity}), (refusal{assign_fault::infinite, 0, 0}));
  EXPECT_EQ(why({infinity, 1}, {{}, {}}, {.forbidden = std::nan("")}), (refusal{assign_fault::infinite, 0, 0}));
  EXPECT_EQ(why({1, 2, 3e9 + 0.1, 3}, {{}, {}}), (refusal{assign_fault::too_large, 1, 0}))
      << "a fraction would be lost";
  EXPECT_TRUE(assign(std::array{1.0, 2.0, 3e9, 3.0}, {{}, {}}));
  EXPECT_EQ(why({1, 2, 1e300, 3}, {{}, {}}), (refusal{assign_fault::too_large, 1, 0}));
  EXPECT_EQ(why({1, 2}, {{3, 4}, {}}), (refusal{assign_fault::task_short, 0, 0}));
  EXPECT_EQ(why({1, 2, 3, 4}, {{0, 1}, {0, 0}}, {.idle = rota::idling::forbidden}).reason, assign_fault::agent_stuck);
  auto const nobody = assign(std::span<double const>{}, {{0, 1}});
  ASSERT_TRUE(nobody);
  EXPECT_TRUE(nobody->tasks.empty());
  EXPECT_EQ(nobody->total, 0);
}

TEST(assign, tiny_and_great_numbers_keep_their_order) {
  for (double const unit : {1e-300, 1e-12, 1.0, 1e6}) {
    std::array const m{2 * unit, unit, unit, 2 * unit};
    for (bool const minimise : {false, true}) {
      auto const x = assign(m, {{1, 1}, {1, 1}}, {.minimise = minimise});
      ASSERT_TRUE(x) << unit;
      EXPECT_EQ(x->tasks, (minimise ? std::vector<std::size_t>{1, 0} : std::vector<std::size_t>{0, 1})) << unit;
      EXPECT_NEAR(x->total / unit, minimise ? 2 : 4, 1e-6);
    }
  }
}

}  // namespace assign_test
