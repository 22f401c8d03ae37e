// Arguments as confidences: monotone and saturating, two in one, and stamps of them are totally ordered whatever they are.
#include <gtest/gtest.h>

#include <rota/team/confidence.hpp>
#include <rota/team/message.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace confidence_test {

namespace {

using namespace rota;
using limits = std::numeric_limits<double>;

/// Ascending, with everything that is awkward.
std::vector<double> const& numbers() {
  static std::vector<double> const all = {-limits::infinity(),
                                          -(limits::max)(),
                                          -1,
                                          -limits::denorm_min(),
                                          0,
                                          limits::denorm_min(),
                                          0.25,
                                          std::nextafter(1.0, 0.0),
                                          1,
                                          std::nextafter(1.0, 2.0),
                                          21.6,
                                          256,
                                          1e300,
                                          (limits::max)(),
                                          limits::infinity()};
  return all;
}

using measure = std::function<std::uint32_t(double, double, double)>;

/// The law: never smaller for a greater x, 0 up to the least, the greatest from the most on, and not a number is the least.
bool lawful(measure const& m) {
  for (auto const& [least, most] :
       {std::pair(0.0, 1.0), std::pair(-1.0, 256.0), std::pair(-(limits::max)(), (limits::max)()),
        std::pair(0.0, limits::denorm_min())}) {
    std::uint32_t before = 0;
    for (double const& x : numbers()) {
      auto const y = m(x, least, most);
      if (y < before || (x <= least && y != 0) || (x >= most && y != UINT32_MAX)) return false;
      before = y;
    }
    if (m(limits::quiet_NaN(), least, most) != 0) return false;
  }
  return true;
}

TEST(confidence, is_monotone_and_saturates) {
  EXPECT_TRUE(lawful([](double x, double least, double most) { return confidence_of(x, least, most); }));
  EXPECT_EQ(confidence_of(0.5, 0, 1, 10), 5u);
  EXPECT_EQ(confidence_of(2, 0, 1, 10), 10u);
  static_assert(confidence_of(1.5, 1, 2, 100) == 50);
}

TEST(confidence, the_law_rejects_what_robots_must_not_do) {
  auto const part = [](double x, double least, double most) { return (x - least) / (most - least); };
  EXPECT_FALSE(lawful([&](double x, double a, double b) {  // wraps, as casting a saturated 64-bit number does
    auto const p = part(x, a, b);
    return p > 0 ? static_cast<std::uint32_t>(static_cast<std::uint64_t>((std::min)(p, 1e9) * 4294967295.0)) : 0U;
  }));
  EXPECT_FALSE(lawful([&](double x, double a, double b) {  // not a number is the most
    auto const p = part(x, a, b);
    return p <= 0 ? 0U : p < 1 ? static_cast<std::uint32_t>(p * 4294967295.0) : UINT32_MAX;
  }));
  EXPECT_FALSE(lawful([&](double x, double a, double b) {  // the farther the better
    return UINT32_MAX - confidence_of(x, a, b);
  }));
}

TEST(confidence, of_two_arguments_the_first_decides) {
  std::vector<std::uint32_t> const firsts = {0, 1, 2, 254, 255}, seconds = {0, 1, 1u << 23, greatest_second};
  std::vector<std::uint32_t> inorder;
  for (auto const a : firsts)
    for (auto const b : seconds) inorder.push_back(first_then(a, b));
  EXPECT_TRUE(std::is_sorted(inorder.begin(), inorder.end(), std::less_equal<>())) << "ascending, no two equal";
  EXPECT_EQ(first_then(256, 0), first_then(255, 0));
  EXPECT_EQ(first_then(0, UINT32_MAX), first_then(0, greatest_second)) << "the second never counts as the first";
  EXPECT_LT(first_then(0, UINT32_MAX), first_then(1, 0));
}

TEST(confidence, stamps_of_any_numbers_are_totally_ordered) {
  std::vector<claim_stamp<>> stamps;
  for (double const& x : numbers())
    for (std::uint64_t id = 1; id <= 3; ++id)
      for (std::uint32_t const mates : {0u, 3u, 1000u})
        stamps.push_back({first_then(mates, confidence_of(x, 0, 256, greatest_second)), {id}});
  stamps.push_back({confidence_of(limits::quiet_NaN(), 0, 1), {1}});
  for (auto const& a : stamps)
    for (auto const& b : stamps) {
      EXPECT_EQ((a < b) + (b < a) + (a == b), 1) << "trichotomy";
      if (a.id != b.id) {
        EXPECT_NE(a, b) << "of two robots one leads";
      }
    }
  std::sort(stamps.begin(), stamps.end());
  for (std::size_t i = 0; i < stamps.size(); ++i)
    for (std::size_t j = i; j < stamps.size(); ++j) EXPECT_LE(stamps[i], stamps[j]) << "transitive";
}

}  // namespace

}  // namespace confidence_test
