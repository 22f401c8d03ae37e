#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

/// The loops of kernels.hpp in lanes of four numbers, for processors with AVX2. No intrinsics: the vector types are an
/// extension that g++ and clang share. Where there is none, ROTA_HAS_LANES is not defined.

#if defined(__x86_64__) && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)  // g++ 11 has the vectors, but not the shuffle
#define ROTA_HAS_LANES
#if defined(__AVX2__)
#define ROTA_WIDE inline
#else
#define ROTA_WIDE [[gnu::target("avx2")]] inline
#endif
#endif
#endif

namespace rota::dense {

/// A number of a row and where it stands; of equal ones the first.
struct row_entry {
  std::int64_t value;
  std::size_t at;
};

/// The two greatest numbers of a row, and where the first stands. `second` is `nothing` in a row of one.
struct row_leaders {
  static constexpr std::int64_t nothing = -(std::int64_t{3} << 61);  // less than any number, and can be subtracted
  std::int64_t first;
  std::int64_t second;
  std::size_t at;
};

#ifdef ROTA_HAS_LANES
namespace wide {

inline constexpr std::size_t width = 4;
using lanes = std::int64_t __attribute__((vector_size(width * sizeof(std::int64_t))));

/// Whether rows of this length gain by lanes, and the processor has them.
[[nodiscard]] inline bool pays(std::size_t n, std::size_t from) noexcept {
#if defined(__AVX2__)
  return n >= from;
#else
  return n >= from && __builtin_cpu_supports("avx2") != 0;
#endif
}

ROTA_WIDE lanes load(std::int64_t const* from) {
  lanes x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
ROTA_WIDE void store(std::int64_t* to, lanes x) { std::memcpy(to, &x, sizeof x); }
ROTA_WIDE lanes all(std::int64_t x) { return lanes{x, x, x, x}; }

/// Where the second of two is less, or as little and earlier, it takes the place of the first.
ROTA_WIDE void lesser(lanes& value, lanes& at, lanes other, lanes other_at) {
  auto const less = (other < value) | ((other == value) & (other_at < at));
  value = less ? other : value;
  at = less ? other_at : at;
}
/// The least of what the lanes have seen, if it is less than `e`; where equal, the first. Without branches, since nothing
/// predicts which lane it is in.
ROTA_WIDE void reduce(lanes value, lanes at, row_entry& e) {
  lesser(value, at, __builtin_shufflevector(value, value, 2, 3, 0, 1), __builtin_shufflevector(at, at, 2, 3, 0, 1));
  lesser(value, at, __builtin_shufflevector(value, value, 1, 0, 3, 2), __builtin_shufflevector(at, at, 1, 0, 3, 2));
  if (value[0] < e.value) e = {value[0], static_cast<std::size_t>(at[0])};
}

// The variables below stand by themselves, and the loop is unrolled by hand, since g++ keeps members of a structure of
// lanes in memory: half the speed.

ROTA_WIDE row_entry relax(std::int64_t base, std::int64_t const* price, std::int64_t const* gain, std::int64_t link,
                          std::int64_t* label, std::int64_t* via, std::size_t n, std::int64_t limit) {
  lanes const bases = all(base), links = all(link);
  lanes index = {0, 1, 2, 3};
  lanes value0 = all(limit), at0 = all(-1);  // two, so that neither waits for the other
  lanes value1 = value0, at1 = at0;
  std::size_t k = 0;
  for (; k + 2 * width <= n; k += 2 * width) {
    lanes label0 = load(label + k), via0 = load(via + k);
    lanes const offered0 = bases + load(price + k) - load(gain + k);
    auto const less0 = offered0 < label0;
    label0 = less0 ? offered0 : label0;
    via0 = less0 ? links : via0;
    store(label + k, label0);
    store(via + k, via0);
    auto const least0 = label0 < value0;
    value0 = least0 ? label0 : value0;
    at0 = least0 ? index : at0;
    index += 4;
    lanes label1 = load(label + k + width), via1 = load(via + k + width);
    lanes const offered1 = bases + load(price + k + width) - load(gain + k + width);
    auto const less1 = offered1 < label1;
    label1 = less1 ? offered1 : label1;
    via1 = less1 ? links : via1;
    store(label + k + width, label1);
    store(via + k + width, via1);
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

ROTA_WIDE row_entry least(std::int64_t const* label, std::size_t n, std::int64_t limit) {
  lanes index = {0, 1, 2, 3};
  lanes value = all(limit), at = all(-1);
  std::size_t k = 0;
  for (; k + width <= n; k += width) {
    lanes const x = load(label + k);
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

ROTA_WIDE std::size_t best(std::int64_t const* worth, std::int64_t const* price, std::size_t n) {
  lanes index = {0, 1, 2, 3};
  lanes value = load(price) - load(worth), at = index;
  std::size_t k = width;
  for (; k + width <= n; k += width) {
    index += 4;
    lanes const x = load(price + k) - load(worth + k);
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

ROTA_WIDE row_leaders best_two(std::int64_t const* worth, std::int64_t const* price, std::size_t n) {
  lanes index = {0, 1, 2, 3};
  lanes value = load(price) - load(worth), at = index, second = all(-row_leaders::nothing);
  std::size_t k = width;
  for (; k + width <= n; k += width) {
    index += 4;
    lanes const x = load(price + k) - load(worth + k);
    auto const less = x < value;
    lanes const loser = less ? value : x;
    value = less ? x : value;
    at = less ? index : at;
    auto const closer = loser < second;
    second = closer ? loser : second;
  }
  row_entry e{(std::numeric_limits<std::int64_t>::max)(), 0};
  reduce(value, at, e);
  lanes others = at == all(static_cast<std::int64_t>(e.at)) ? all(-row_leaders::nothing) : value;
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
ROTA_WIDE void raise(std::int64_t const* row, std::int64_t base, std::int64_t link, std::int64_t* most,
                     std::int64_t* who, std::size_t n) {
  lanes const bases = all(base), links = all(link);
  std::size_t k = 0;
  for (; k + width <= n; k += width) {
    lanes const x = load(row + k) - bases;
    lanes const old = load(most + k);
    auto const more = x > old;
    store(most + k, more ? x : old);
    store(who + k, more ? links : load(who + k));
  }
  for (; k < n; ++k)
    if (row[k] - base > most[k]) most[k] = row[k] - base, who[k] = link;
}

ROTA_WIDE std::size_t first_tight(std::int64_t const* gain, std::int64_t price_here, std::int64_t const* price,
                                  std::size_t k, std::size_t n) {
  lanes const here = all(price_here);
  for (; k + 4 * width <= n;
       k += 4 * width) {  // most rows have none, and to look at a lane costs as much as a comparison
    auto any = load(gain + k) + here >= load(price + k);
    for (std::size_t i = width; i < 4 * width; i += width) any |= load(gain + k + i) + here >= load(price + k + i);
    any |= __builtin_shufflevector(any, any, 2, 3, 0, 1);
    if ((any[0] | any[1]) != 0) break;
  }
  while (k < n && gain[k] + price_here < price[k]) ++k;
  return k;
}

}  // namespace wide
#endif

}  // namespace rota::dense

#ifdef ROTA_WIDE
#undef ROTA_WIDE
#endif
