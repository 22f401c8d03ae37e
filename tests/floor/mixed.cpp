// A program of two units that were compiled with different flags.
#include "floor/unit.hpp"
#include "search/digest/digest.hpp"

#include <cstdio>

int main() {
  auto const first = one();
  auto const second = two();
  bool const agree =
      first == second && first.of_additive == digest::expected && first.of_pairs == digest::expected_of_pairs;
  std::printf("units of different flags %s\n", agree ? "agree" : "disagree");
  return agree ? 0 : 1;
}
