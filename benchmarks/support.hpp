#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

/// A benchmark that computes something else than it says is worth nothing: its answer is checked before it is timed.
inline void check(bool right, char const* what) {
  if (right) return;
  std::fprintf(stderr, "wrong answer: %s\n", what);
  std::exit(1);
}

/// The same stream in every run and every benchmark.
inline std::mt19937_64 seeded() { return std::mt19937_64{20090708}; }

/// A number in [0, n), by remainder, since std distributions differ between libraries.
inline std::size_t pick(std::mt19937_64& random, std::size_t n) { return static_cast<std::size_t>(random() % n); }
/// A number in [0, 1).
inline double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Times `f` on each input in turn: branches that have seen an input before are predicted, and flatter branchy code.
template <class Inputs, class F>
void rotate(benchmark::State& state, Inputs const& inputs, F&& f) {
  auto const* const first = inputs.data();
  auto const* const last = first + inputs.size();  // not read again each time, which would be half of the shortest rows
  auto const* input = first;
  for (auto _ : state) {
    auto&& result = f(*input);
    benchmark::DoNotOptimize(result);
    if (++input == last) input = first;
  }
}
