#pragma once

#include <rota/dense/flow/detail/row_entry.hpp>
#include <rota/dense/flow/detail/wide_kernels.hpp>

#include <cstddef>
#include <cstdint>

/// The loops over one row of slots in which the additive solver spends its time: plainly, and for AVX2 (wide_kernels.hpp)
/// where the processor has it and the row is long enough to gain by it. Both return the same numbers, ties included.
namespace rota::dense::detail::kernel {

inline constexpr std::size_t long_row = 8;  // measured: shorter rows lose by vectors

namespace plain {

[[nodiscard]] inline row_entry relax(std::int64_t base, std::int64_t const* price, std::int64_t const* gain,
                                     std::int64_t link, std::int64_t* label, std::int64_t* via, std::size_t n,
                                     std::int64_t limit) {
  row_entry e{limit, n};
  for (std::size_t k = 0; k < n; ++k) {
    std::int64_t const offered = base + price[k] - gain[k];
    if (offered < label[k]) label[k] = offered, via[k] = link;
    bool const less = label[k] < e.value;
    e.value = less ? label[k] : e.value;
    e.at = less ? k : e.at;
  }
  return e;
}

[[nodiscard]] inline row_entry least(std::int64_t const* label, std::size_t n, std::int64_t limit) {
  row_entry e{limit, n};
  for (std::size_t k = 0; k < n; ++k) {
    bool const less = label[k] < e.value;
    e.value = less ? label[k] : e.value;
    e.at = less ? k : e.at;
  }
  return e;
}

[[nodiscard]] inline std::size_t best(std::int64_t const* worth, std::int64_t const* price, std::size_t n) {
  row_entry e{worth[0] - price[0], 0};
  for (std::size_t k = 1; k < n; ++k) {
    std::int64_t const x = worth[k] - price[k];
    bool const more = x > e.value;
    e.value = more ? x : e.value;
    e.at = more ? k : e.at;
  }
  return e.at;
}

[[nodiscard]] inline row_leaders best_two(std::int64_t const* worth, std::int64_t const* price, std::size_t n) {
  row_leaders l{worth[0] - price[0], row_leaders::nothing, 0};
  for (std::size_t k = 1; k < n; ++k) {
    std::int64_t const x = worth[k] - price[k];
    bool const more = x > l.first;
    std::int64_t const loser = more ? l.first : x;
    l.second = loser > l.second ? loser : l.second;
    l.first = more ? x : l.first;
    l.at = more ? k : l.at;
  }
  return l;
}

inline void raise(std::int64_t const* row, std::int64_t base, std::int64_t link, std::int64_t* most, std::int64_t* who,
                  std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    std::int64_t const x = row[k] - base;
    bool const more = x > most[k];
    most[k] = more ? x : most[k];
    who[k] = more ? link : who[k];
  }
}

[[nodiscard]] inline std::size_t first_tight(std::int64_t const* gain, std::int64_t here, std::int64_t const* price,
                                             std::size_t from, std::size_t n) {
  while (from < n && gain[from] + here < price[from]) ++from;
  return from;
}

}  // namespace plain

#if !ROTA_SIMD_AVX2
namespace wide = plain;
#endif

/// label[k] ← min(label[k], base + price[k] − gain[k]), and via[k] ← link where that is less.
/// @return the least label below `limit`, or {limit, n}
[[nodiscard]] inline row_entry relax(std::int64_t base, std::int64_t const* price, std::int64_t const* gain,
                                     std::int64_t link, std::int64_t* label, std::int64_t* via, std::size_t n,
                                     std::int64_t limit) {
  return n >= long_row && simd::has_avx2() ? wide::relax(base, price, gain, link, label, via, n, limit)
                                           : plain::relax(base, price, gain, link, label, via, n, limit);
}

/// The least label below `limit`, or {limit, n}.
[[nodiscard]] inline row_entry least(std::int64_t const* label, std::size_t n, std::int64_t limit) {
  return n >= long_row && simd::has_avx2() ? wide::least(label, n, limit) : plain::least(label, n, limit);
}

/// The first k of greatest worth[k] − price[k]. @pre n > 0
[[nodiscard]] inline std::size_t best(std::int64_t const* worth, std::int64_t const* price, std::size_t n) {
  return n >= long_row && simd::has_avx2() ? wide::best(worth, price, n) : plain::best(worth, price, n);
}

/// The two greatest worth[k] − price[k]. @pre n > 0
[[nodiscard]] inline row_leaders best_two(std::int64_t const* worth, std::int64_t const* price, std::size_t n) {
  return n >= 5 * long_row && simd::has_avx2() ? wide::best_two(worth, price, n) : plain::best_two(worth, price, n);
}

/// most[k] ← max(most[k], row[k] − base), and who[k] ← link where that is more.
inline void raise(std::int64_t const* row, std::int64_t base, std::int64_t link, std::int64_t* most, std::int64_t* who,
                  std::size_t n) {
  return n >= long_row && simd::has_avx2() ? wide::raise(row, base, link, most, who, n)
                                           : plain::raise(row, base, link, most, who, n);
}

/// The first k at or after `from` with gain[k] + here ≥ price[k], or n.
[[nodiscard]] inline std::size_t first_tight(std::int64_t const* gain, std::int64_t here, std::int64_t const* price,
                                             std::size_t from, std::size_t n) {
  return n >= long_row && simd::has_avx2() ? wide::first_tight(gain, here, price, from, n)
                                           : plain::first_tight(gain, here, price, from, n);
}

}  // namespace rota::dense::detail::kernel
