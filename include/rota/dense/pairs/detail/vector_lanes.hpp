#pragma once

#include <rota/core/simd.hpp>
#include <rota/dense/pairs/detail/lanes.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rota::dense::detail {
namespace simd = rota::detail::simd;
}

#if ROTA_SIMD

/// The kernels of lane_kernels.hpp on vectors: of eight lanes, which any processor has, and of sixteen for AVX2.
namespace rota::dense::detail::vector_lanes {

template <std::size_t Width>
using vector = typename simd::lanes<lane, Width>::vector;
template <std::size_t Width>
using pairs_of = typename simd::lanes<std::int32_t, Width / 2>::vector;

/// Lanes from lane_block on are kept, and those before are not.
alignas(64) inline constexpr lane masks[2 * lane_block] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};

template <std::size_t Width, std::size_t Slots, bool Floored>
ROTA_SIMD_INLINE void child_maxima(lane_node const& node, lane_child const* child, std::size_t count,
                                   std::int32_t* sums) {
  std::size_t const slot_count = Slots != 0 ? Slots : node.slot_count;
  std::size_t const begin = node.first / Width * Width;
  vector<Width> const mask = simd::lanes_at<Width>(masks + lane_block - (node.first - begin)).v;
  vector<Width> const floor = vector<Width>{} + node.floor;
  for (std::size_t c = 0; c < count; ++c) {
    lane const* const prices = child[c].prices;
    pairs_of<Width> sum{};
    vector<Width> keep = mask;
    for (std::size_t b = begin; b < node.stride; b += Width) {
      vector<Width> best = vector<Width>{} + (std::numeric_limits<lane>::min)();
      lane const* field = node.fields + b;
      lane const* table = child[c].table + b;
      for (std::size_t y = 0; y < slot_count; ++y, field += node.stride, table += node.stride) {
        vector<Width> v = simd::lanes_at<Width>(field).v + simd::lanes_at<Width>(table).v;
        if constexpr (Floored) v = v > floor ? v : floor;
        v -= prices[y];
        best = best > v ? best : v;
      }
      best &= keep;
      keep = vector<Width>{} - 1;
      auto const pairs = reinterpret_cast<pairs_of<Width>>(best);
      sum += ((pairs << 16) >> 16) + (pairs >> 16);
    }
    if constexpr (Width == 16) {
      sum += ROTA_SIMD_PERMUTE(sum, 4, 5, 6, 7, 0, 1, 2, 3);
      sum += ROTA_SIMD_PERMUTE(sum, 2, 3, 0, 1, 6, 7, 4, 5);
      sum += ROTA_SIMD_PERMUTE(sum, 1, 0, 3, 2, 5, 4, 7, 6);
    } else {
      sum += ROTA_SIMD_PERMUTE(sum, 2, 3, 0, 1);
      sum += ROTA_SIMD_PERMUTE(sum, 1, 0, 3, 2);
    }
    sums[c] = sum[0];
  }
}

/// The usual numbers of slots are known to the compiler.
template <std::size_t Width, bool Floored>
ROTA_SIMD_INLINE void child_maxima_by_slots(lane_node const& node, lane_child const* child, std::size_t count,
                                            std::int32_t* sums) {
  switch (node.slot_count) {
  case 3: return child_maxima<Width, 3, Floored>(node, child, count, sums);
  case 4: return child_maxima<Width, 4, Floored>(node, child, count, sums);
  case 5: return child_maxima<Width, 5, Floored>(node, child, count, sums);
  case 6: return child_maxima<Width, 6, Floored>(node, child, count, sums);
  case 7: return child_maxima<Width, 7, Floored>(node, child, count, sums);
  default: return child_maxima<Width, 0, Floored>(node, child, count, sums);
  }
}

template <std::size_t Width>
ROTA_SIMD_INLINE void columns(lane_columns const& job) {
  std::array<lane*, 32> smallest;
  std::array<lane const*, 32> added;
  std::array<lane, 32> prefix;
  std::size_t count = 0;
  for (std::size_t x = 0; x < job.slot_count; ++x) {
    if (job.next_state[x] == ~std::uint32_t{0}) continue;
    smallest[count] = job.smallest + x * job.per_slot + job.next_state[x] * job.columns;
    added[count] = job.added_losses + x * 2 * job.columns;
    prefix[count++] = rounded_loss(job.prefix_loss + job.own_losses[x], job.floor, job.unit_shift);
  }
  for (std::size_t c = 0; c < job.columns; c += Width) {
    vector<Width> const one_way = simd::lanes_at<Width>(job.column_losses + c).v;
    vector<Width> const other_way = simd::lanes_at<Width>(job.column_losses + job.columns + c).v;
    for (std::size_t i = 0; i < count; ++i) {
      vector<Width> const one = one_way + simd::lanes_at<Width>(added[i] + c).v;
      vector<Width> const other = other_way + simd::lanes_at<Width>(added[i] + job.columns + c).v;
      vector<Width> const loss = (one > other ? one : other) + prefix[i];
      vector<Width> const least = simd::lanes_at<Width>(smallest[i] + c).v;
      simd::lanes_at<Width>(smallest[i] + c).v = loss > least ? loss : least;
    }
  }
}

template <std::size_t Width>
ROTA_SIMD_INLINE void transport(lane_transport const& job) {
  std::uint32_t const* next_state = job.next_state;
  for (std::size_t i = 0; i < job.states; ++i)
    for (std::size_t x = 0; x < job.slot_count; ++x, ++next_state) {
      if (*next_state == ~std::uint32_t{0}) continue;
      lane const* const losses = job.losses + i * job.lanes;
      lane const* const added = job.added_losses + x * job.lanes;
      lane* const next = job.next_losses + *next_state * job.lanes;
      for (std::size_t l = 0; l < job.lanes; l += Width) {
        vector<Width> const loss = simd::lanes_at<Width>(losses + l).v + simd::lanes_at<Width>(added + l).v;
        vector<Width> const least = simd::lanes_at<Width>(next + l).v;
        simd::lanes_at<Width>(next + l).v = loss > least ? loss : least;
      }
    }
}

template <bool Floored>
void child_maxima_by_8(lane_node const& node, lane_child const* child, std::size_t count, std::int32_t* sums) {
  child_maxima_by_slots<8, Floored>(node, child, count, sums);
}
inline void columns_by_8(lane_columns const& job) { columns<8>(job); }
inline void transport_by_8(lane_transport const& job) { transport<8>(job); }

#if ROTA_SIMD_AVX2
template <bool Floored>
ROTA_FOR_AVX2 void child_maxima_by_avx2(lane_node const& node, lane_child const* child, std::size_t count,
                                        std::int32_t* sums) {
  child_maxima_by_slots<16, Floored>(node, child, count, sums);
}
ROTA_FOR_AVX2 void columns_by_avx2(lane_columns const& job) { columns<16>(job); }
ROTA_FOR_AVX2 void transport_by_avx2(lane_transport const& job) { transport<16>(job); }
#endif

inline std::int32_t demand(lane_node const& node, lane const* prices, std::int32_t* wanted) {
  std::size_t const begin = node.first / 8 * 8;
  vector<8> keep = simd::lanes_at<8>(masks + lane_block - (node.first - begin)).v;
  pairs_of<8> sum{};
  for (std::size_t y = 0; y < node.slot_count; ++y) wanted[y] = 0;
  for (std::size_t b = begin; b < node.stride; b += 8) {
    vector<8> best = vector<8>{} + (std::numeric_limits<lane>::min)();
    for (std::size_t y = 0; y < node.slot_count; ++y) {
      vector<8> const v = simd::lanes_at<8>(node.fields + y * node.stride + b).v - prices[y];
      best = best > v ? best : v;
    }
    vector<8> open = keep;
    for (std::size_t y = 0; y < node.slot_count; ++y) {
      vector<8> const v = simd::lanes_at<8>(node.fields + y * node.stride + b).v - prices[y];
      vector<8> const here = (v == best) & open;
      open &= ~here;
      auto const pairs = reinterpret_cast<pairs_of<8>>(here);
      pairs_of<8> const ones = ((pairs << 16) >> 16) + (pairs >> 16);
      wanted[y] -= ones[0] + ones[1] + ones[2] + ones[3];
    }
    best &= keep;
    keep = vector<8>{} - 1;
    auto const pairs = reinterpret_cast<pairs_of<8>>(best);
    sum += ((pairs << 16) >> 16) + (pairs >> 16);
  }
  return sum[0] + sum[1] + sum[2] + sum[3];
}

inline void place(lane_node const& node, lane const* table, lane* child) {
  vector<8> const floor = vector<8>{} + node.floor;
  for (std::size_t b = node.first / 8 * 8; b < node.stride; b += 8) {
    std::size_t at = b;
    for (std::size_t y = 0; y < node.slot_count; ++y, at += node.stride) {
      vector<8> const v = simd::lanes_at<8>(node.fields + at).v + simd::lanes_at<8>(table + at).v;
      simd::lanes_at<8>(child + at).v = v > floor ? v : floor;
    }
  }
}

using floats = simd::lanes<float, 4>::vector;

inline float add_products(float const* components, std::size_t width, lane const* factors, std::size_t count,
                          float* values) {
  floats all[16];
  for (std::size_t y = 0; y < count; ++y) all[y] = floats{} + factors[y];
  floats greatest = floats{} + (std::numeric_limits<float>::lowest)();
  for (std::size_t i = 0; i < width; i += 4) {
    floats sum = simd::lanes_at<4>(values + i).v;
    float const* component = components + i;
    for (std::size_t y = 0; y < count; ++y, component += width) sum += all[y] * simd::lanes_at<4>(component).v;
    simd::lanes_at<4>(values + i).v = sum;
    greatest = sum > greatest ? sum : greatest;
  }
  return (std::max)((std::max)(greatest[0], greatest[1]), (std::max)(greatest[2], greatest[3]));
}

inline void raise_by_rows(float_rows const& job, float* greatest) {
  floats best[4];
  for (std::size_t b = 0; b < job.width / 4; ++b) best[b] = simd::lanes_at<4>(greatest + 4 * b).v;
  for (std::size_t i = 0; i < job.count; ++i) {
    float const* const row = job.rows + job.numbers[i] * job.width;
    floats const added = floats{} + job.added[job.which_added[i]];
    for (std::size_t b = 0; b < job.width / 4; ++b) {
      floats const v = simd::lanes_at<4>(row + 4 * b).v + added;
      best[b] = v > best[b] ? v : best[b];
    }
  }
  for (std::size_t b = 0; b < job.width / 4; ++b) simd::lanes_at<4>(greatest + 4 * b).v = best[b];
}

}  // namespace rota::dense::detail::vector_lanes

#endif
