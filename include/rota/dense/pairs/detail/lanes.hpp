#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

// Compilers with GNU vector extensions get kernels on vectors, others loops; on x86-64 copies for AVX2 besides.
// g++ 11 has the vectors, but not the shuffle.
#ifdef __has_builtin
#if __has_builtin(__builtin_shufflevector)
#define ROTA_LANES_VECTORS 1
#define ROTA_LANES_INLINE [[gnu::always_inline]] inline
#endif
#endif
#ifndef ROTA_LANES_VECTORS
#define ROTA_LANES_VECTORS 0
#define ROTA_LANES_INLINE inline
#endif
#if ROTA_LANES_VECTORS && defined(__x86_64__)
#define ROTA_LANES_AVX2 1
#else
#define ROTA_LANES_AVX2 0
#endif

namespace rota::dense::detail {

/// A utility in quanta. One agent per lane, so that slots are compared agent by agent, all agents at once.
using lane = std::int16_t;

inline constexpr std::size_t lane_block = 16;

/// What is lost, in units of 2^unit_shift: rounded towards 0, and raised to the floor. @pre value ≤ 0
constexpr lane rounded_loss(std::int32_t value, lane floor, unsigned unit_shift = 0) {
  return static_cast<lane>(std::max<std::int32_t>(-(-value >> unit_shift), floor));
}

/// The lanes that n agents take: eight, or whole blocks.
constexpr std::size_t lane_stride(std::size_t n) { return n <= 8 ? 8 : (n + lane_block - 1) / lane_block * lane_block; }

/// A search node as the kernels see it. Rows are slots of `stride` lanes; lanes before `first` hold nothing.
struct lane_node {
  lane const* fields = nullptr;  ///< what each unplaced agent gets in each slot: its own, and from those placed
  std::size_t slot_count = 0;
  std::size_t stride = 0;
  std::size_t first = 0;  ///< the first lane of an agent that stays unplaced
  lane floor = 0;         ///< lower sums are raised to it: only where combinations are forbidden
};

/// A child: what placing one agent adds to the fields, and what the slots are priced at.
struct lane_child {
  lane const* table = nullptr;
  lane const* prices = nullptr;
};

/// Two agents side by side: a column is a pair of slots, once one way round (first `width` lanes), once the other.
struct lane_columns {
  lane const* sums = nullptr;                 ///< [2·width]
  lane const* adds = nullptr;                 ///< [slot][2·width]: what another agent in that slot adds
  std::int32_t const* values = nullptr;       ///< [slot]: what that agent is worth itself, as a loss
  std::uint32_t const* next_state = nullptr;  ///< [slot]: the state it leads to, or ~0
  lane* to = nullptr;                         ///< [state][width]
  std::size_t apart = 0;                      ///< … and so much farther per slot
  std::size_t width = 0;                      ///< a multiple of 16
  std::size_t slot_count = 0;                 ///< at most 32
  std::int32_t value = 0;  ///< to be added to all values, which are then divided by 2^coarse, rounded up,
  std::int32_t floor = 0;  ///< and raised to this
  unsigned coarse = 0;
};

/// One agent more to be counted, for many cases at once, one per lane: from counts to counts.
struct lane_transport {
  lane const* from = nullptr;                 ///< [state][width]
  lane const* gains = nullptr;                ///< [slot][width]
  lane* to = nullptr;                         ///< [state][width]
  std::uint32_t const* next_state = nullptr;  ///< [state][slot]: the state with one agent more in that slot, or ~0
  std::size_t states = 0;
  std::size_t slot_count = 0;
  std::size_t width = 0;  ///< a multiple of 16
};

namespace lanes {

#if ROTA_LANES_VECTORS

template <std::size_t Width>
struct of {
  typedef lane vector __attribute__((vector_size(Width * sizeof(lane))));
  typedef lane memory __attribute__((vector_size(Width * sizeof(lane)), may_alias, aligned(2)));
  typedef std::int32_t wide __attribute__((vector_size(Width * sizeof(lane))));
};

alignas(64) inline constexpr lane masks[2 * lane_block] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};

template <std::size_t Width, std::size_t Slots, bool Floored>
ROTA_LANES_INLINE void maxima(lane_node const& node, lane_child const* child, std::size_t count, std::int32_t* sums) {
  using vector = typename of<Width>::vector;
  using memory = typename of<Width>::memory;
  using wide = typename of<Width>::wide;
  std::size_t const slot_count = Slots != 0 ? Slots : node.slot_count;
  std::size_t const begin = node.first / Width * Width;
  vector const mask = *reinterpret_cast<memory const*>(masks + lane_block - (node.first - begin));
  vector const floor = vector{} + node.floor;
  for (std::size_t c = 0; c < count; ++c) {
    lane const* const prices = child[c].prices;
    wide total{};
    vector keep = mask;
    for (std::size_t b = begin; b < node.stride; b += Width) {
      vector best = vector{} + (std::numeric_limits<lane>::min)();
      lane const* field = node.fields + b;
      lane const* table = child[c].table + b;
      for (std::size_t y = 0; y < slot_count; ++y, field += node.stride, table += node.stride) {
        vector v = *reinterpret_cast<memory const*>(field) + *reinterpret_cast<memory const*>(table);
        if constexpr (Floored) v = v > floor ? v : floor;
        v -= prices[y];
        best = best > v ? best : v;
      }
      best &= keep;
      keep = vector{} - 1;
      auto const pairs = reinterpret_cast<wide>(best);
      total += ((pairs << 16) >> 16) + (pairs >> 16);
    }
    if constexpr (Width == 16) total += __builtin_shufflevector(total, total, 4, 5, 6, 7, 0, 1, 2, 3);
    if constexpr (Width == 16) {
      total += __builtin_shufflevector(total, total, 2, 3, 0, 1, 6, 7, 4, 5);
      total += __builtin_shufflevector(total, total, 1, 0, 3, 2, 5, 4, 7, 6);
    } else {
      total += __builtin_shufflevector(total, total, 2, 3, 0, 1);
      total += __builtin_shufflevector(total, total, 1, 0, 3, 2);
    }
    sums[c] = total[0];
  }
}

template <std::size_t Width, bool Floored>
ROTA_LANES_INLINE void maxima_by_slots(lane_node const& node, lane_child const* child, std::size_t count,
                                       std::int32_t* sums) {
  switch (node.slot_count) {
  case 3: return maxima<Width, 3, Floored>(node, child, count, sums);
  case 4: return maxima<Width, 4, Floored>(node, child, count, sums);
  case 5: return maxima<Width, 5, Floored>(node, child, count, sums);
  case 6: return maxima<Width, 6, Floored>(node, child, count, sums);
  case 7: return maxima<Width, 7, Floored>(node, child, count, sums);
  default: return maxima<Width, 0, Floored>(node, child, count, sums);
  }
}

template <std::size_t Width>
ROTA_LANES_INLINE void columns(lane_columns const& job) {
  using vector = typename of<Width>::vector;
  using memory = typename of<Width>::memory;
  lane* to[32];
  lane const* add[32];
  lane value[32];
  std::size_t count = 0;
  for (std::size_t x = 0; x < job.slot_count; ++x) {
    if (job.next_state[x] == ~std::uint32_t{0}) continue;
    to[count] = job.to + x * job.apart + job.next_state[x] * job.width;
    add[count] = job.adds + x * 2 * job.width;
    value[count++] = static_cast<lane>((std::max)(-(-(job.value + job.values[x]) >> job.coarse), job.floor));
  }
  for (std::size_t c = 0; c < job.width; c += Width) {
    vector const one = *reinterpret_cast<memory const*>(job.sums + c);
    vector const two = *reinterpret_cast<memory const*>(job.sums + job.width + c);
    for (std::size_t i = 0; i < count; ++i) {
      vector either = *reinterpret_cast<memory const*>(add[i] + c);
      vector other = *reinterpret_cast<memory const*>(add[i] + job.width + c);
      either += one;
      other += two;
      vector const most = (either > other ? either : other) + value[i];
      memory& here = *reinterpret_cast<memory*>(to[i] + c);
      here = most > here ? most : here;
    }
  }
}

template <std::size_t Width>
ROTA_LANES_INLINE void transport(lane_transport const& job) {
  using vector = typename of<Width>::vector;
  using memory = typename of<Width>::memory;
  std::uint32_t const* more = job.next_state;
  for (std::size_t i = 0; i < job.states; ++i)
    for (std::size_t x = 0; x < job.slot_count; ++x, ++more) {
      if (*more == ~std::uint32_t{0}) continue;
      lane const* const from = job.from + i * job.width;
      lane const* const gain = job.gains + x * job.width;
      lane* const to = job.to + *more * job.width;
      for (std::size_t l = 0; l < job.width; l += Width) {
        vector const v = *reinterpret_cast<memory const*>(from + l) + *reinterpret_cast<memory const*>(gain + l);
        memory& here = *reinterpret_cast<memory*>(to + l);
        here = v > here ? v : here;
      }
    }
}

/// See lane_demand.
inline std::int32_t demand(lane_node const& node, lane const* prices, std::int32_t* wanted) {
  using vector = of<8>::vector;
  using memory = of<8>::memory;
  using wide = of<8>::wide;
  std::size_t const begin = node.first / 8 * 8;
  vector keep = *reinterpret_cast<memory const*>(masks + lane_block - (node.first - begin));
  wide total{};
  for (std::size_t y = 0; y < node.slot_count; ++y) wanted[y] = 0;
  for (std::size_t b = begin; b < node.stride; b += 8) {
    vector best = vector{} + (std::numeric_limits<lane>::min)();
    for (std::size_t y = 0; y < node.slot_count; ++y) {
      vector const v = *reinterpret_cast<memory const*>(node.fields + y * node.stride + b) - prices[y];
      best = best > v ? best : v;
    }
    vector open = keep;
    for (std::size_t y = 0; y < node.slot_count; ++y) {
      vector const v = *reinterpret_cast<memory const*>(node.fields + y * node.stride + b) - prices[y];
      vector const here = (v == best) & open;
      open &= ~here;
      auto const pairs = reinterpret_cast<wide>(here);
      wide const ones = ((pairs << 16) >> 16) + (pairs >> 16);
      wanted[y] -= ones[0] + ones[1] + ones[2] + ones[3];
    }
    best &= keep;
    keep = vector{} - 1;
    auto const pairs = reinterpret_cast<wide>(best);
    total += ((pairs << 16) >> 16) + (pairs >> 16);
  }
  return total[0] + total[1] + total[2] + total[3];
}

inline void place(lane_node const& node, lane const* table, lane* child) {
  using vector = of<8>::vector;
  using memory = of<8>::memory;
  vector const floor = vector{} + node.floor;
  lane const* field = node.fields;
  for (std::size_t b = node.first / 8 * 8; b < node.stride; b += 8) {
    std::size_t at = b;
    for (std::size_t y = 0; y < node.slot_count; ++y, at += node.stride) {
      vector const v = *reinterpret_cast<memory const*>(field + at) + *reinterpret_cast<memory const*>(table + at);
      *reinterpret_cast<memory*>(child + at) = v > floor ? v : floor;
    }
  }
}

template <bool Floored>
void maxima_portable(lane_node const& node, lane_child const* child, std::size_t count, std::int32_t* sums) {
  maxima_by_slots<8, Floored>(node, child, count, sums);
}

inline void columns_portable(lane_columns const& job) { columns<8>(job); }
inline void transport_portable(lane_transport const& job) { transport<8>(job); }

#if ROTA_LANES_AVX2
[[gnu::target("avx2")]] inline void columns_avx2(lane_columns const& job) { columns<16>(job); }
[[gnu::target("avx2")]] inline void transport_avx2(lane_transport const& job) { transport<16>(job); }
template <bool Floored>
[[gnu::target("avx2")]] void maxima_avx2(lane_node const& node, lane_child const* child, std::size_t count,
                                         std::int32_t* sums) {
  maxima_by_slots<16, Floored>(node, child, count, sums);
}
#endif

#else

inline void columns_portable(lane_columns const& job) {
  for (std::size_t x = 0; x < job.slot_count; ++x) {
    if (job.next_state[x] == ~std::uint32_t{0}) continue;
    lane* const to = job.to + x * job.apart + job.next_state[x] * job.width;
    lane const* const add = job.adds + x * 2 * job.width;
    int const value = (std::max)(-(-(job.value + job.values[x]) >> job.coarse), job.floor);
    for (std::size_t c = 0; c < job.width; ++c) {
      int const most = (std::max)(job.sums[c] + add[c], job.sums[job.width + c] + add[job.width + c]) + value;
      to[c] = (std::max)(to[c], static_cast<lane>(most));
    }
  }
}

inline void transport_portable(lane_transport const& job) {
  std::uint32_t const* more = job.next_state;
  for (std::size_t i = 0; i < job.states; ++i)
    for (std::size_t x = 0; x < job.slot_count; ++x, ++more)
      for (std::size_t l = 0; l < job.width && *more != ~std::uint32_t{0}; ++l) {
        lane& here = job.to[*more * job.width + l];
        here = (std::max)(here, static_cast<lane>(job.from[i * job.width + l] + job.gains[x * job.width + l]));
      }
}

template <bool Floored>
void maxima_portable(lane_node const& node, lane_child const* child, std::size_t count, std::int32_t* sums) {
  for (std::size_t c = 0; c < count; ++c) {
    sums[c] = 0;
    for (std::size_t l = node.first; l < node.stride; ++l) {
      int best = (std::numeric_limits<lane>::min)();
      for (std::size_t y = 0; y < node.slot_count; ++y) {
        int v = node.fields[y * node.stride + l] + child[c].table[y * node.stride + l];
        if constexpr (Floored) v = std::max<int>(v, node.floor);
        best = (std::max)(best, v - child[c].prices[y]);
      }
      sums[c] += best;
    }
  }
}

inline void place(lane_node const& node, lane const* table, lane* child) {
  for (std::size_t y = 0; y < node.slot_count; ++y)
    for (std::size_t l = y * node.stride + node.first; l < (y + 1) * node.stride; ++l)
      child[l] = (std::max)(static_cast<lane>(node.fields[l] + table[l]), node.floor);
}

inline std::int32_t demand(lane_node const& node, lane const* prices, std::int32_t* wanted) {
  for (std::size_t y = 0; y < node.slot_count; ++y) wanted[y] = 0;
  std::int32_t total = 0;
  for (std::size_t l = node.first; l < node.stride; ++l) {
    int best = (std::numeric_limits<int>::min)();
    std::size_t at = 0;
    for (std::size_t y = 0; y < node.slot_count; ++y) {
      int const v = node.fields[y * node.stride + l] - prices[y];
      if (v > best) best = v, at = y;
    }
    total += best;
    ++wanted[at];
  }
  return total;
}

#endif

}  // namespace lanes

#if ROTA_LANES_VECTORS
/// Four floats at once.
struct floats4 {
  typedef float vector __attribute__((vector_size(16)));
  typedef float memory __attribute__((vector_size(16), may_alias, aligned(4)));
  vector v{};
  static floats4 load(float const* p) { return {*reinterpret_cast<memory const*>(p)}; }
  static floats4 all(float x) { return {vector{} + x}; }
  void store(float* p) const { *reinterpret_cast<memory*>(p) = v; }
  friend floats4 operator+(floats4 a, floats4 b) { return {a.v + b.v}; }
  friend floats4 operator*(floats4 a, floats4 b) { return {a.v * b.v}; }
  friend floats4 greater(floats4 a, floats4 b) { return {a.v > b.v ? a.v : b.v}; }
};
#else
struct floats4 {
  float v[4] = {};
  static floats4 load(float const* p) { return {{p[0], p[1], p[2], p[3]}}; }
  static floats4 all(float x) { return {{x, x, x, x}}; }
  void store(float* p) const { std::copy_n(v, 4, p); }
  friend floats4 operator+(floats4 a, floats4 b) {
    return {{a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2], a.v[3] + b.v[3]}};
  }
  friend floats4 operator*(floats4 a, floats4 b) {
    return {{a.v[0] * b.v[0], a.v[1] * b.v[1], a.v[2] * b.v[2], a.v[3] * b.v[3]}};
  }
  friend floats4 greater(floats4 a, floats4 b) {
    for (std::size_t i = 0; i < 4; ++i) a.v[i] = (std::max)(a.v[i], b.v[i]);
    return a;
  }
};
#endif

/// Σ over unplaced agents of max over slots of field + table − price, for each child.
///
/// @pre no sum leaves the range of a lane
using lane_kernel = void (*)(lane_node const&, lane_child const*, std::size_t, std::int32_t*);

/// The kernel for this machine; all give the same sums.
inline lane_kernel choose_lane_kernel(std::size_t stride, bool floored) {
#if ROTA_LANES_AVX2
  if (stride % lane_block == 0 && __builtin_cpu_supports("avx2"))
    return floored ? &lanes::maxima_avx2<true> : &lanes::maxima_avx2<false>;
#endif
  (void)stride;
  return floored ? &lanes::maxima_portable<true> : &lanes::maxima_portable<false>;
}

inline bool lanes_by_avx2() {
#if ROTA_LANES_AVX2
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

/// to[more[x]] ← max(itself, max(either way round) + values[x]), by column, for each slot x that leads somewhere.
///
/// @pre no sum leaves the range of a lane
using columns_kernel = void (*)(lane_columns const&);
inline columns_kernel choose_columns_kernel() {
#if ROTA_LANES_AVX2
  if (lanes_by_avx2()) return &lanes::columns_avx2;
#endif
  return &lanes::columns_portable;
}

/// to[more[i][x]] ← max(itself, from[i] + gains[x]), by lane.
///
/// @pre no sum leaves the range of a lane
using transport_kernel = void (*)(lane_transport const&);
inline transport_kernel choose_transport_kernel() {
#if ROTA_LANES_AVX2
  if (lanes_by_avx2()) return &lanes::transport_avx2;
#endif
  return &lanes::transport_portable;
}

/// wanted[y] ← how many unplaced agents want slot y most at these prices, the first among equals.
/// @return Σ over unplaced agents of max over slots of field − price
inline std::int32_t lane_demand(lane_node const& node, lane const* prices, std::int32_t* wanted) {
  return lanes::demand(node, prices, wanted);
}

/// child ← the fields after placing the agent whose table this is. All rows, all lanes from `first` on.
inline void place(lane_node const& node, lane const* table, lane* child) { lanes::place(node, table, child); }

}  // namespace rota::dense::detail
