// Fingerprints collide as often as if the codes of atoms were random. The laws are in tests/testing/maps.cpp.

#include <rota/algebra/fingerprint.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <unordered_map>
#include <vector>

namespace fingerprint_test {

using atom = std::uint32_t;

TEST(fingerprint, multiples_of_a_power_of_two_vanish_as_often_as_stated) {
  // 2^v·x is not zero, but a share of 2^(v−64) of these fingerprints is.
  constexpr atom atoms = 1 << 16;
  for (int const v : {54, 58, 60, 62, 63}) {
    // −2⁶³ if it is too large, which is the same modulo 2⁶⁴.
    auto const n = static_cast<std::int64_t>(std::uint64_t{1} << v);
    int vanish = 0;
    for (atom x = 0; x < atoms; ++x) vanish += fingerprint_of(rota::delta<atom>(x, n)) == rota::fingerprint{};
    double const expected = atoms / static_cast<double>(std::uint64_t{1} << (64 - v));
    EXPECT_NEAR(vanish, expected, 5 * std::sqrt(expected)) << "v = " << v;
  }
}

TEST(fingerprint, of_unequal_sets_meet_in_any_sixteen_bits_as_often_as_random_ones) {
  constexpr std::uint64_t sets = 4096;
  std::mt19937_64 random(20110301);
  std::vector<rota::fingerprint> seen;
  for (std::uint64_t i = 0; i < sets; ++i) {
    rota::atom_set<atom> c;
    auto const members = random();
    for (atom x = 0; x < 64; ++x)
      if ((members >> x & 1) != 0) c.insert(x);
    seen.push_back(fingerprint_of(c));
  }
  double const expected = sets * (sets - 1) / 2.0 / 65536;  // 128 pairs
  for (int const shift : {0, 16, 32, 48}) {
    std::unordered_map<std::uint64_t, int> count;
    int pairs = 0;
    for (auto const h : seen) pairs += count[h.value >> shift & 0xffff]++;
    EXPECT_NEAR(pairs, expected, 5 * std::sqrt(expected)) << "bits from " << shift;
  }
}

}  // namespace fingerprint_test
