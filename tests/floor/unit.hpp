#pragma once

#include <cstdint>

/// What a unit computes. Both must say the same, whichever's inline functions the linker has kept.
struct answers {
  std::uint64_t of_additive = 0;
  std::uint64_t of_pairs = 0;
  bool audits = false;

  friend bool operator==(answers const&, answers const&) = default;
};

answers one();
answers two();
