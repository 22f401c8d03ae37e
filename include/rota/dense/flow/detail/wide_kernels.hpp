#pragma once

#include <rota/core/simd.hpp>
#include <rota/dense/flow/detail/row_entry.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rota::dense::detail {
namespace simd = rota::detail::simd;
}

#if ROTA_SIMD_AVX2

/// The kernels of kernels.hpp for AVX2, four numbers at a time. @pre simd::has_avx2(), n ≥ 4
namespace rota::dense::detail::kernel::wide {

using simd::lanes_at;
inline constexpr std::size_t width = 4;
using numbers = simd::lanes<std::int64_t, width>::vector;

ROTA_FOR_AVX2 numbers all(std::int64_t x) { return numbers{x, x, x, x}; }

/// Where the second of two is less, or equal and earlier, it replaces the first.
ROTA_FOR_AVX2 void lesser(numbers& value, numbers& at, numbers other, numbers other_at) {
  auto const less = (other < value) | ((other == value) & (other_at < at));
  value = less ? other : value;
  at = less ? other_at : at;
}
/// The least of what the lanes have seen, if it is less than `e`; where equal, the first. Without branches, since nothing
/// predicts which lane it is in.
ROTA_FOR_AVX2 void reduce(numbers value, numbers at, row_entry& e) {
  lesser(value, at, ROTA_SIMD_PERMUTE(value, 2, 3, 0, 1), ROTA_SIMD_PERMUTE(at, 2, 3, 0, 1));
  lesser(value, at, ROTA_SIMD_PERMUTE(value, 1, 0, 3, 2), ROTA_SIMD_PERMUTE(at, 1, 0, 3, 2));
  if (value[0] < e.value) e = {value[0], static_cast<std::size_t>(at[0])};
}

// g++ keeps the members of a structure of vectors in memory, at half the speed: so the variables below stand by
// themselves, and the loop is unrolled by hand.

ROTA_FOR_AVX2 row_entry relax(std::int64_t base, std::int64_t const* price, std::int64_t const* gain, std::int64_t link,
                              std::int64_t* label, std::int64_t* via, std::size_t n, std::int64_t limit) {
  numbers const bases = all(base), links = all(link);
  numbers index = {0, 1, 2, 3};
  numbers value0 = all(limit), at0 = all(-1);  // two, so that neither waits for the other
  numbers value1 = value0, at1 = at0;
  std::size_t k = 0;
  for (; k + 2 * width <= n; k += 2 * width) {
    numbers label0 = lanes_at<width>(label + k).v, via0 = lanes_at<width>(via + k).v;
    numbers const offered0 = bases + lanes_at<width>(price + k).v - lanes_at<width>(gain + k).v;
    auto const less0 = offered0 < label0;
    label0 = less0 ? offered0 : label0;
    via0 = less0 ? links : via0;
    lanes_at<width>(label + k).v = label0;
    lanes_at<width>(via + k).v = via0;
    auto const least0 = label0 < value0;
    value0 = least0 ? label0 : value0;
    at0 = least0 ? index : at0;
    index += 4;
    numbers label1 = lanes_at<width>(label + k + width).v, via1 = lanes_at<width>(via + k + width).v;
    numbers const offered1 = bases + lanes_at<width>(price + k + width).v - lanes_at<width>(gain + k + width).v;
    auto const less1 = offered1 < label1;
    label1 = less1 ? offered1 : label1;
    via1 = less1 ? links : via1;
    lanes_at<width>(label + k + width).v = label1;
    lanes_at<width>(via + k + width).v = via1;
    auto const least1 = label1 < value1;
    value1 = least1 ? label1 : value1;
    at1 = least1 ? index : at1;
    index += 4;
  }
  row_entry e{limit, n};
  lesser(value0, at0, value1, at1);
  reduce(value0, at0, e);
  for (; k < n; ++k) {
    std::int64_t const offered = base + price[k] - gain[k];
    if (offered < label[k]) label[k] = offered, via[k] = link;
    if (label[k] < e.value) e = {label[k], k};
  }
  return e;
}

ROTA_FOR_AVX2 row_entry least(std::int64_t const* label, std::size_t n, std::int64_t limit) {
  numbers index = {0, 1, 2, 3};
  numbers value = all(limit), at = all(-1);
  std::size_t k = 0;
  for (; k + width <= n; k += width) {
    numbers const x = lanes_at<width>(label + k).v;
    auto const less = x < value;
    value = less ? x : value;
    at = less ? index : at;
    index += 4;
  }
  row_entry e{limit, n};
  reduce(value, at, e);
  for (; k < n; ++k)
    if (label[k] < e.value) e = {label[k], k};
  return e;
}

ROTA_FOR_AVX2 std::size_t best(std::int64_t const* worth, std::int64_t const* price, std::size_t n) {
  numbers index = {0, 1, 2, 3};
  numbers value = lanes_at<width>(price).v - lanes_at<width>(worth).v, at = index;
  std::size_t k = width;
  for (; k + width <= n; k += width) {
    index += 4;
    numbers const x = lanes_at<width>(price + k).v - lanes_at<width>(worth + k).v;
    auto const less = x < value;
    value = less ? x : value;
    at = less ? index : at;
  }
  row_entry e{(std::numeric_limits<std::int64_t>::max)(), 0};
  reduce(value, at, e);
  for (; k < n; ++k)
    if (price[k] - worth[k] < e.value) e = {price[k] - worth[k], k};
  return e.at;
}

ROTA_FOR_AVX2 row_leaders best_two(std::int64_t const* worth, std::int64_t const* price, std::size_t n) {
  numbers index = {0, 1, 2, 3};
  numbers value = lanes_at<width>(price).v - lanes_at<width>(worth).v, at = index, second = all(-row_leaders::nothing);
  std::size_t k = width;
  for (; k + width <= n; k += width) {
    index += 4;
    numbers const x = lanes_at<width>(price + k).v - lanes_at<width>(worth + k).v;
    auto const less = x < value;
    numbers const loser = less ? value : x;
    value = less ? x : value;
    at = less ? index : at;
    auto const closer = loser < second;
    second = closer ? loser : second;
  }
  row_entry e{(std::numeric_limits<std::int64_t>::max)(), 0};
  reduce(value, at, e);
  numbers others = at == all(static_cast<std::int64_t>(e.at)) ? all(-row_leaders::nothing) : value;
  others = second < others ? second : others;
  std::int64_t other = (std::min)((std::min)(others[0], others[1]), (std::min)(others[2], others[3]));
  for (; k < n; ++k) {
    std::int64_t const x = price[k] - worth[k];
    other = (std::min)(other, (std::max)(x, e.value));
    if (x < e.value) e = {x, k};
  }
  return {-e.value, -other, e.at};
}

/// Where x exceeds y: y ← x, who ← link. x is `row` less `base`.
ROTA_FOR_AVX2 void raise(std::int64_t const* row, std::int64_t base, std::int64_t link, std::int64_t* most,
                         std::int64_t* who, std::size_t n) {
  numbers const bases = all(base), links = all(link);
  std::size_t k = 0;
  for (; k + width <= n; k += width) {
    numbers const x = lanes_at<width>(row + k).v - bases;
    numbers const old = lanes_at<width>(most + k).v;
    auto const more = x > old;
    lanes_at<width>(most + k).v = more ? x : old;
    lanes_at<width>(who + k).v = more ? links : lanes_at<width>(who + k).v;
  }
  for (; k < n; ++k)
    if (row[k] - base > most[k]) most[k] = row[k] - base, who[k] = link;
}

ROTA_FOR_AVX2 std::size_t first_tight(std::int64_t const* gain, std::int64_t price_here, std::int64_t const* price,
                                      std::size_t k, std::size_t n) {
  numbers const here = all(price_here);
  // Most rows have none, and looking at one lane costs as much as a comparison: four vectors at once.
  for (; k + 4 * width <= n; k += 4 * width) {
    auto any = lanes_at<width>(gain + k).v + here >= lanes_at<width>(price + k).v;
    for (std::size_t i = width; i < 4 * width; i += width)
      any |= lanes_at<width>(gain + k + i).v + here >= lanes_at<width>(price + k + i).v;
    any |= ROTA_SIMD_PERMUTE(any, 2, 3, 0, 1);
    if ((any[0] | any[1]) != 0) break;
  }
  while (k < n && gain[k] + price_here < price[k]) ++k;
  return k;
}

}  // namespace rota::dense::detail::kernel::wide

#endif
