#pragma once

#include <rota/dense/pairs/detail/lanes.hpp>
#include <rota/dense/pairs/detail/plain_lanes.hpp>
#include <rota/dense/pairs/detail/vector_lanes.hpp>

#include <cstddef>
#include <cstdint>

/// The loops in which the pairwise solver spends its time: on vectors where the compiler has them, on wider ones where the
/// processor has AVX2. All variants return the same numbers. @pre no sum leaves the range of a lane; floats are whole
/// numbers below 2^24
namespace rota::dense::detail {

#if ROTA_SIMD
namespace basic_lanes = vector_lanes;
#else
namespace basic_lanes = plain_lanes;
#endif

/// For each child, Σ over unplaced agents of max over slots of field + table − price.
using child_kernel = void (*)(lane_node const&, lane_child const*, std::size_t count, std::int32_t* sums);

/// The kernel for this machine. @param floored whether sums may be below the floor of a node
inline child_kernel choose_child_kernel(std::size_t stride, bool floored) {
#if ROTA_SIMD_AVX2
  if (stride % lane_block == 0 && simd::has_avx2())
    return floored ? &vector_lanes::child_maxima_by_avx2<true> : &vector_lanes::child_maxima_by_avx2<false>;
#endif
  (void)stride;
#if ROTA_SIMD
  return floored ? &vector_lanes::child_maxima_by_8<true> : &vector_lanes::child_maxima_by_8<false>;
#else
  return floored ? &plain_lanes::child_maxima<true> : &plain_lanes::child_maxima<false>;
#endif
}

/// For each slot that leads to a state, the smallest loss of each column there: either way round, plus that of the agents
/// before.
using columns_kernel = void (*)(lane_columns const&);
inline columns_kernel choose_columns_kernel() {
#if ROTA_SIMD_AVX2
  if (simd::has_avx2()) return &vector_lanes::columns_by_avx2;
#endif
#if ROTA_SIMD
  return &vector_lanes::columns_by_8;
#else
  return &plain_lanes::columns;
#endif
}

/// For each state and slot, the smallest loss in the state that one agent more in that slot leads to, by lane.
using transport_kernel = void (*)(lane_transport const&);
inline transport_kernel choose_transport_kernel() {
#if ROTA_SIMD_AVX2
  if (simd::has_avx2()) return &vector_lanes::transport_by_avx2;
#endif
#if ROTA_SIMD
  return &vector_lanes::transport_by_8;
#else
  return &plain_lanes::transport;
#endif
}

/// wanted[y] ← how many unplaced agents want slot y most at these prices, the first among equals.
/// @return Σ over unplaced agents of max over slots of field − price
inline std::int32_t lane_demand(lane_node const& node, lane const* prices, std::int32_t* wanted) {
  return basic_lanes::demand(node, prices, wanted);
}

/// child ← the fields after placing the agent whose table this is: all rows, the lanes from `first` on.
inline void place(lane_node const& node, lane const* table, lane* child) { basic_lanes::place(node, table, child); }

/// values[i] += Σ_y factors[y]·components[y·width + i]. @return the greatest value @pre width is a multiple of 4; count ≤ 16
inline float add_products(float const* components, std::size_t width, lane const* factors, std::size_t count,
                          float* values) {
  return basic_lanes::add_products(components, width, factors, count, values);
}

/// greatest[y] ← the greatest of itself and of row[y] + added, over all rows.
inline void raise_by_rows(float_rows const& job, float* greatest) { basic_lanes::raise_by_rows(job, greatest); }

}  // namespace rota::dense::detail
