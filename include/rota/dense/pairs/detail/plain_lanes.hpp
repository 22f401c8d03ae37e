#pragma once

#include <rota/dense/pairs/detail/lanes.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

/// The kernels of lane_kernels.hpp as plain loops.
namespace rota::dense::detail::plain_lanes {

template <bool Floored>
void child_maxima(lane_node const& node, lane_child const* child, std::size_t count, std::int32_t* sums) {
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

inline std::int32_t demand(lane_node const& node, lane const* prices, std::int32_t* wanted) {
  std::fill_n(wanted, node.slot_count, 0);
  std::int32_t sum = 0;
  for (std::size_t l = node.first; l < node.stride; ++l) {
    int best = (std::numeric_limits<int>::min)();
    std::size_t at = 0;
    for (std::size_t y = 0; y < node.slot_count; ++y) {
      int const v = node.fields[y * node.stride + l] - prices[y];
      if (v > best) best = v, at = y;
    }
    sum += best;
    ++wanted[at];
  }
  return sum;
}

inline void place(lane_node const& node, lane const* table, lane* child) {
  for (std::size_t y = 0; y < node.slot_count; ++y)
    for (std::size_t l = y * node.stride + node.first; l < (y + 1) * node.stride; ++l)
      child[l] = (std::max)(static_cast<lane>(node.fields[l] + table[l]), node.floor);
}

inline void columns(lane_columns const& job) {
  for (std::size_t x = 0; x < job.slot_count; ++x) {
    if (job.next_state[x] == ~std::uint32_t{0}) continue;
    lane* const smallest = job.smallest + x * job.per_slot + job.next_state[x] * job.columns;
    lane const* const added = job.added_losses + x * 2 * job.columns;
    lane const prefix = rounded_loss(job.prefix_loss + job.own_losses[x], job.floor, job.unit_shift);
    for (std::size_t c = 0; c < job.columns; ++c) {
      int const one_way = job.column_losses[c] + added[c];
      int const other_way = job.column_losses[job.columns + c] + added[job.columns + c];
      smallest[c] = (std::max)(smallest[c], static_cast<lane>((std::max)(one_way, other_way) + prefix));
    }
  }
}

inline void transport(lane_transport const& job) {
  std::uint32_t const* next_state = job.next_state;
  for (std::size_t i = 0; i < job.states; ++i)
    for (std::size_t x = 0; x < job.slot_count; ++x, ++next_state) {
      if (*next_state == ~std::uint32_t{0}) continue;
      lane const* const losses = job.losses + i * job.lanes;
      lane const* const added = job.added_losses + x * job.lanes;
      lane* const next = job.next_losses + *next_state * job.lanes;
      for (std::size_t l = 0; l < job.lanes; ++l)
        next[l] = (std::max)(next[l], static_cast<lane>(losses[l] + added[l]));
    }
}

inline float add_products(float const* components, std::size_t width, lane const* factors, std::size_t count,
                          float* values) {
  float greatest = (std::numeric_limits<float>::lowest)();
  for (std::size_t i = 0; i < width; ++i) {
    float sum = values[i];
    for (std::size_t y = 0; y < count; ++y) sum += static_cast<float>(factors[y]) * components[y * width + i];
    values[i] = sum;
    greatest = (std::max)(greatest, sum);
  }
  return greatest;
}

inline void raise_by_rows(float_rows const& job, float* greatest) {
  for (std::size_t i = 0; i < job.count; ++i) {
    float const* const row = job.rows + job.numbers[i] * job.width;
    float const added = job.added[job.which_added[i]];
    for (std::size_t y = 0; y < job.width; ++y) greatest[y] = (std::max)(greatest[y], row[y] + added);
  }
}

}  // namespace rota::dense::detail::plain_lanes
