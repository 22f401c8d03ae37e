#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace rota::dense::detail {

/// A utility in quanta. An agent per lane: slots are compared agent by agent, many agents at once.
using lane = std::int16_t;

inline constexpr std::size_t lane_block = 16;

/// The lanes that n agents take: eight, or whole blocks.
constexpr std::size_t lane_stride(std::size_t n) { return n <= 8 ? 8 : (n + lane_block - 1) / lane_block * lane_block; }

/// What is lost, in units of 2^unit_shift: rounded towards 0, and raised to the floor. @pre value ≤ 0
constexpr lane rounded_loss(std::int32_t value, lane floor, unsigned unit_shift = 0) {
  return static_cast<lane>(std::max<std::int32_t>(-(-value >> unit_shift), floor));
}

// What the kernels work on: see lane_kernels.hpp.

/// A node of the search. Its rows are slots of `stride` lanes; lanes before `first` hold nothing.
struct lane_node {
  lane const* fields = nullptr;  ///< [slot][lane]: how much each unplaced agent gets in each slot
  std::size_t slot_count = 0;
  std::size_t stride = 0;
  std::size_t first = 0;  ///< the first lane of an agent that stays unplaced
  lane floor = 0;         ///< sums below are raised to it; the lowest lane where no combination is forbidden
};

/// A child of a node: the table that placing one agent adds to the fields, and the prices of slots.
struct lane_child {
  lane const* table = nullptr;
  lane const* prices = nullptr;
};

/// The agent before the last two is put into each slot. A column is a pair of slots of the last two; it has two losses, for
/// one way round and for the other.
struct lane_columns {
  lane const* column_losses = nullptr;        ///< [either way round][column]
  lane const* added_losses = nullptr;         ///< [slot][either way round][column]: added by that agent
  std::int32_t const* own_losses = nullptr;   ///< [slot]: of that agent itself and with those before, in quanta
  std::uint32_t const* next_state = nullptr;  ///< [slot]: the state it leads to, or ~0
  lane* smallest = nullptr;                   ///< [state][column]: to be raised
  std::size_t per_slot = 0;                   ///< `smallest` is so much farther for each slot
  std::size_t columns = 0;                    ///< a multiple of a block
  std::size_t slot_count = 0;                 ///< at most 32
  std::int32_t prefix_loss = 0;               ///< of the agents before that one, in quanta
  lane floor = 0;                             ///< losses of that agent and those before are raised to it
  unsigned unit_shift = 0;
};

/// An agent more is counted, for many cases at once, one per lane.
struct lane_transport {
  lane const* losses = nullptr;               ///< [state][lane]: before
  lane const* added_losses = nullptr;         ///< [slot][lane]
  lane* next_losses = nullptr;                ///< [state][lane]: after, to be raised
  std::uint32_t const* next_state = nullptr;  ///< [state][slot]: the state with one agent more in that slot, or ~0
  std::size_t states = 0;
  std::size_t slot_count = 0;
  std::size_t lanes = 0;  ///< a multiple of a block
};

/// Rows of `width` floats, those numbered `numbers[0]`, `numbers[1]`, …: a number each is added to a row as a whole.
struct float_rows {
  float const* rows = nullptr;
  std::size_t width = 0;  ///< a multiple of 4, at most 16
  std::uint32_t const* numbers = nullptr;
  float const* added = nullptr;
  std::uint32_t const* which_added = nullptr;
  std::size_t count = 0;
};

}  // namespace rota::dense::detail
