#pragma once
/// @file
/// Random test data from a seed that rapidcheck draws and prints.

#include <rapidcheck.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rota_test {

/// Numbers from a seed: rapidcheck picks the seed and the sizes, so that sizes shrink and a case costs one draw.
class dice {
public:
  explicit dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
  bool chance(int percent) { return below(100) < percent; }
  template <class T>
  void shuffle(std::vector<T>& v) {
    for (std::size_t i = v.size(); i > 1; --i) std::swap(v[i - 1], v[bits() % i]);
  }
  /// k distinct numbers below n, ascending.
  std::vector<int> some(int k, int n) {
    std::vector<int> all;
    for (int i = 0; i < n; ++i) all.push_back(i);
    shuffle(all);
    all.resize(static_cast<std::size_t>(k));
    std::sort(all.begin(), all.end());
    return all;
  }

private:
  std::uint64_t state_;
};

/// A seed and a number of [low, high] at full size from the first case on: rapidcheck's own grow with the case number, so
/// that small cases would repeat and large ones be rare.
inline auto any_seed() { return rc::gen::noShrink(rc::gen::resize(100, rc::gen::arbitrary<std::uint64_t>())); }
inline auto between(int low, int high) { return rc::gen::resize(100, rc::gen::inRange(low, high + 1)); }

}  // namespace rota_test
