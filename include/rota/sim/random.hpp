#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>

#include <cstdint>

namespace rota::sim {

/// Boost's: equal seeds must give equal bytes, and the distributions of the standard differ between libraries.
using random_engine = boost::random::mt19937_64;

/// The use of a stream of random numbers. Streams never mix, so a change in one use leaves the others as they were.
enum class stream : std::uint64_t { clock = 1, world, perception, network, faults, campaign };

/// The finaliser of SplitMix64: a bijection that scatters neighbouring numbers.
[[nodiscard]] constexpr std::uint64_t scatter(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// The engine of one stream. `index` is the robot or the link, or 0 for the world.
[[nodiscard]] inline random_engine engine_for(std::uint64_t seed, stream what, std::uint64_t index) {
  return random_engine(scatter(scatter(scatter(seed) ^ static_cast<std::uint64_t>(what)) ^ index));
}

/// Uniform in [low, high]. @pre low ≤ high
[[nodiscard]] inline std::int64_t uniform(random_engine& engine, std::int64_t low, std::int64_t high) {
  return boost::random::uniform_int_distribution<std::int64_t>(low, high)(engine);
}

/// True with probability p. Draws once whatever p is, so that runs with different p stay aligned.
[[nodiscard]] inline bool chance(random_engine& engine, double p) {
  return boost::random::uniform_01<double>()(engine) < p;
}

/// Nearly normal: the sum of four uniform numbers, with mean 0 and standard deviation `sigma`, within ±3.5 sigma.
///
/// Takes one draw and computes in integers. A true normal distribution needs logarithms, whose last bits differ between C
/// libraries.
[[nodiscard]] inline std::int64_t noise(random_engine& engine, std::int64_t sigma) {
  std::uint64_t const draw = engine();
  auto const sum =
      static_cast<std::int64_t>((draw & 0xffff) + (draw >> 16 & 0xffff) + (draw >> 32 & 0xffff) + (draw >> 48));
  constexpr std::int64_t mean = 131070;
  constexpr std::int64_t deviation = 37837;  // sqrt(4 (2^32 - 1) / 12)
  return (sum - mean) * sigma / deviation;
}

}  // namespace rota::sim
