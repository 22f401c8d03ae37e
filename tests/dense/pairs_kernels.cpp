// The inner loops of the pairwise solver: plain loops, loops on vectors, and those chosen for this machine compute the same.
#include "support/dice.hpp"

#include <rota/dense/pairs/detail/lane_kernels.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace pairs_kernels_test {

using namespace rota::dense::detail;
using rota_test::any_seed;
using rota_test::dice;
using lanes = std::vector<lane>;
using floats = std::vector<float>;

lanes draw(dice& d, std::size_t count, int range) {
  lanes v(count);
  for (lane& x : v) x = static_cast<lane>(d.below(2 * range) - range);
  return v;
}

// Each kernel in all variants that this machine has.

std::vector<child_kernel> child_kernels(std::size_t stride, bool floored) {
  std::vector<child_kernel> all{choose_child_kernel(stride, floored),
                                floored ? &plain_lanes::child_maxima<true> : &plain_lanes::child_maxima<false>};
#if ROTA_SIMD
  all.push_back(floored ? &vector_lanes::child_maxima_by_8<true> : &vector_lanes::child_maxima_by_8<false>);
#endif
  return all;
}

std::vector<columns_kernel> const columns_kernels{
    choose_columns_kernel(),
    &plain_lanes::columns,
#if ROTA_SIMD
    &vector_lanes::columns_by_8,
#endif
};
std::vector<transport_kernel> const transport_kernels{
    choose_transport_kernel(),
    &plain_lanes::transport,
#if ROTA_SIMD
    &vector_lanes::transport_by_8,
#endif
};

TEST(pair_kernels, a_node_is_seen_as_defined) {
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    std::size_t const slots = 1 + d.bits() % 9;
    std::size_t const stride = lane_stride(1 + d.bits() % 64);
    auto const fields = draw(d, slots * stride, 8000);
    auto const table = draw(d, slots * stride, 8000);
    auto const prices = draw(d, slots, 8000);
    bool const floored = d.chance(50);
    lane_node const node{fields.data(), slots, stride, d.bits() % (stride + 1),
                         floored ? lane{-9000} : std::numeric_limits<lane>::min()};
    std::int32_t sum = 0;
    lanes below(slots * stride);
    std::vector<std::int32_t> wanted(slots, 0);
    for (std::size_t l = node.first; l < stride; ++l) {
      int greatest = std::numeric_limits<int>::min();
      std::size_t at = 0;
      for (std::size_t y = 0; y < slots; ++y) {
        int const v = std::max<int>(fields[y * stride + l] + table[y * stride + l], node.floor);
        below[y * stride + l] = static_cast<lane>(v);
        if (v - prices[y] > greatest) greatest = v - prices[y], at = y;
      }
      sum += greatest;
      ++wanted[at];
    }
    lane_child const child{table.data(), prices.data()};
    for (child_kernel const kernel : child_kernels(stride, floored)) {
      lane_child const twice[] = {child, child};
      std::int32_t got[] = {0, 0};
      kernel(node, twice, 2, got);
      RC_ASSERT(got[0] == sum && got[1] == sum);
    }
    for (auto const placing : {&place, &plain_lanes::place, &basic_lanes::place}) {
      lanes got(slots * stride);
      placing(node, table.data(), got.data());
      for (std::size_t y = 0; y < slots; ++y)
        for (std::size_t l = node.first; l < stride; ++l) RC_ASSERT(got[y * stride + l] == below[y * stride + l]);
    }
    lane_node const placed{below.data(), slots, stride, node.first, node.floor};
    for (auto const demand : {&lane_demand, &plain_lanes::demand, &basic_lanes::demand}) {
      std::vector<std::int32_t> got(slots, 7);
      RC_ASSERT(demand(placed, prices.data(), got.data()) == sum);
      RC_ASSERT(got == wanted);
    }
  }));
}

/// For each slot a state, no two the same; or none.
std::vector<std::uint32_t> draw_next(dice& d, std::size_t slots, std::size_t states) {
  std::vector<std::uint32_t> next(states);
  for (std::size_t i = 0; i < states; ++i) next[i] = static_cast<std::uint32_t>(i);
  d.shuffle(next);
  next.resize(slots);
  for (auto& n : next)
    if (d.chance(30)) n = ~std::uint32_t{0};
  return next;
}

TEST(pair_kernels, columns_keep_the_smallest_loss) {
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    std::size_t const slots = 1 + d.bits() % 8;
    std::size_t const states = slots + d.bits() % 5;
    std::size_t const columns = lane_block * (1 + d.bits() % 3);
    auto const before = draw(d, 2 * columns, 7000);
    auto const added = draw(d, slots * 2 * columns, 2000);
    auto const next = draw_next(d, slots, states);
    std::vector<std::int32_t> own(slots);
    for (auto& v : own) v = -d.below(40000);
    auto const smallest = draw(d, 2 * slots * states * columns, 16000);
    lane_columns job{before.data(), added.data(), own.data(),     next.data(), nullptr, 0,
                     columns,       slots,        -d.below(9000), -14000,      2};
    if (d.chance(50)) job.per_slot = states * columns;
    lanes expected = smallest;
    for (std::size_t x = 0; x < slots; ++x) {
      if (next[x] == ~std::uint32_t{0}) continue;
      int const agents = std::max(-((-job.prefix_loss - own[x]) / 4), -14000);  // units of 2^2, rounded towards 0
      for (std::size_t c = 0; c < columns; ++c) {
        lane const* const more = &added[x * 2 * columns];
        int const either = std::max(before[c] + more[c], before[columns + c] + more[columns + c]);
        lane& to = expected[x * job.per_slot + next[x] * columns + c];
        to = static_cast<lane>(std::max<int>(to, either + agents));
      }
    }
    for (columns_kernel const kernel : columns_kernels) {
      lanes got = smallest;
      job.smallest = got.data();
      kernel(job);
      RC_ASSERT(got == expected);
    }
  }));
}

TEST(pair_kernels, transport_keeps_the_smallest_loss) {
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    std::size_t const slots = 1 + d.bits() % 6;
    std::size_t const states = 1 + d.bits() % 5;
    std::size_t const next_states = slots + d.bits() % 5;
    std::size_t const width = lane_block * (1 + d.bits() % 4);
    auto const losses = draw(d, states * width, 16000);
    auto const added = draw(d, slots * width, 16000);
    auto const next_losses = draw(d, next_states * width, 16000);
    std::vector<std::uint32_t> next;
    for (std::size_t i = 0; i < states; ++i)
      for (auto const n : draw_next(d, slots, next_states)) next.push_back(n);
    lanes expected = next_losses;
    for (std::size_t i = 0; i < states; ++i)
      for (std::size_t x = 0; x < slots; ++x)
        for (std::size_t l = 0; l < width && next[i * slots + x] != ~std::uint32_t{0}; ++l) {
          lane& to = expected[next[i * slots + x] * width + l];
          to = static_cast<lane>(std::max<int>(to, losses[i * width + l] + added[x * width + l]));
        }
    for (transport_kernel const kernel : transport_kernels) {
      lanes got = next_losses;
      kernel({losses.data(), added.data(), got.data(), next.data(), states, slots, width});
      RC_ASSERT(got == expected);
    }
  }));
}

TEST(pair_kernels, floats_are_added_exactly) {
  EXPECT_TRUE(rc::check([&] {
    dice d(*any_seed().as("seed"));
    auto const whole = [&](std::size_t count, int range) {
      floats v(count);
      for (float& x : v) x = static_cast<float>(d.below(2 * range) - range);
      return v;
    };
    std::size_t const width = 4 * (1 + d.bits() % 6);
    std::size_t const count = d.bits() % 17;
    auto const components = whole(count * width, 16);
    auto const factors = draw(d, count, 8192);
    auto const values = whole(width, 100000);
    floats expected = values;
    for (std::size_t y = 0; y < count; ++y)
      for (std::size_t i = 0; i < width; ++i)
        expected[i] += static_cast<float>(factors[y] * static_cast<int>(components[y * width + i]));
    for (auto const add : {&add_products, &plain_lanes::add_products, &basic_lanes::add_products}) {
      floats got = values;
      float const greatest = add(components.data(), width, factors.data(), count, got.data());
      RC_ASSERT(got == expected);
      RC_ASSERT(greatest == *std::max_element(expected.begin(), expected.end()));
    }
    std::size_t const row = 4 * (1 + d.bits() % 4);
    auto const rows = whole(10 * row, 100000);
    auto const added = whole(7, 100000);
    std::vector<std::uint32_t> numbers, which;
    for (std::size_t i = d.bits() % 12; i > 0; --i) {
      numbers.push_back(static_cast<std::uint32_t>(d.below(10)));
      which.push_back(static_cast<std::uint32_t>(d.below(7)));
    }
    auto const start = whole(row, 100000);
    floats most = start;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      for (std::size_t y = 0; y < row; ++y) most[y] = std::max(most[y], rows[numbers[i] * row + y] + added[which[i]]);
    for (auto const raise : {&raise_by_rows, &plain_lanes::raise_by_rows, &basic_lanes::raise_by_rows}) {
      floats got = start;
      raise({rows.data(), row, numbers.data(), added.data(), which.data(), numbers.size()}, got.data());
      RC_ASSERT(got == most);
    }
  }));
}

}  // namespace pairs_kernels_test
