#pragma once

#include "additive.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace peers {

/// Maximise the sum of a utility per agent and one per pair of agents; every agent takes exactly one slot.
struct pairwise_instance {
  std::size_t agents = 0;
  cardinalities bounds;
  std::vector<std::int64_t> unary;  ///< row per agent
  std::vector<std::int64_t>
      pairs;  ///< a table per pair (a, b), b < a, in lexicographic order; in it a row per slot of a

  pairwise_instance(std::size_t n, cardinalities c)
      : agents(n), bounds(std::move(c)), unary(n * slots()), pairs(n * (n - 1) / 2 * slots() * slots()) {}

  std::size_t slots() const { return bounds.slots(); }
  std::int64_t at(std::size_t a, std::size_t s) const { return unary[a * slots() + s]; }

  /// Where the table of a pair begins.
  ///
  /// @pre b < a
  std::size_t table(std::size_t a, std::size_t b) const { return (a * (a - 1) / 2 + b) * slots() * slots(); }
  /// What agent a in slot s and agent b in slot t are worth together.
  std::int64_t pair(std::size_t a, std::size_t s, std::size_t b, std::size_t t) const {
    return pairs[table(a, b) + s * slots() + t];
  }
  std::int64_t& pair(std::size_t a, std::size_t s, std::size_t b, std::size_t t) {
    return pairs[table(a, b) + s * slots() + t];
  }
};

}  // namespace peers
