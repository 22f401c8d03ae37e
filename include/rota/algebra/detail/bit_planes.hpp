#pragma once

#include <rota/algebra/universe.hpp>
#include <rota/core/simd.hpp>
#include <rota/core/small_vector.hpp>

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

namespace rota::detail {

using word = std::uint64_t;

constexpr std::size_t words_for(std::size_t atoms) noexcept { return atoms / 64 + (atoms % 64 != 0); }

/// An array of words if the type says how many; else words inside the object up to 256 atoms, in one allocation beyond.
template <atom_universe U, std::size_t Planes>
struct plane_storage {
  using type = small_vector<word, 4 * Planes>;
};
template <fixed_universe U, std::size_t Planes>
struct plane_storage<U, Planes> {
  using type = std::array<word, Planes * words_for(U::size())>;
};

/// The universe of a value. Moving from it leaves the empty universe. Stores nothing if the type says which it is.
template <atom_universe U>
struct held_universe {
  U value{};

  constexpr explicit held_universe(U const& u) : value(u) {}
  held_universe(held_universe const&) = default;
  held_universe& operator=(held_universe const&) = default;
  constexpr held_universe(held_universe&& other) noexcept : value(std::exchange(other.value, U{})) {}
  constexpr held_universe& operator=(held_universe&& other) noexcept {
    value = std::exchange(other.value, U{});
    return *this;
  }
  friend bool operator==(held_universe const&, held_universe const&) = default;
};
template <fixed_universe U>
struct held_universe<U> {
  static constexpr U value{};

  constexpr explicit held_universe(U const&) {}
  friend bool operator==(held_universe const&, held_universe const&) = default;
};

/// Writes planes of n words, one after the other. `words_at(i)` returns word i of each plane.
template <std::size_t Planes, class F>
[[gnu::always_inline]] constexpr void write_planes(word* out, std::size_t n, F& words_at) {
  for (std::size_t i = 0; i < n; ++i) {
    std::array<word, Planes> const w = words_at(i);
    for (std::size_t plane = 0; plane < Planes; ++plane) out[plane * n + i] = w[plane];
  }
}

#if ROTA_SIMD_AVX2
/// The same loop, compiled for registers of 256 bits. `out` never aliases the inputs. @pre simd::has_avx2()
template <std::size_t Planes, class F>
ROTA_FOR_AVX2 void write_planes_widely(word* __restrict out, std::size_t n, F& words_at) {
  write_planes<Planes>(out, n, words_at);
}
#endif

/// `Planes` subsets of a universe: bit i % 64 of word i / 64 of a plane tells whether atom i is in it.
///
/// Class invariant: bits beyond the universe are zero. If the universe is known only at run time, moving from a value
/// leaves it over the empty one.
template <atom_universe U, std::size_t Planes>
class bit_planes {
public:
  /// All empty.
  constexpr explicit bit_planes(U const& universe = {})
      : bit_planes(universe, [](std::size_t) { return std::array<word, Planes>{}; }) {}
  /// `words_at(i)` returns word i of each plane. @pre no word has a bit beyond the universe
  template <std::invocable<std::size_t> F>
  constexpr bit_planes(U const& universe, F&& words_at) : universe_{universe} {
    std::size_t const n = words();
    auto const fill = [&](word* out) {
#if ROTA_SIMD_AVX2
      if (!std::is_constant_evaluated() && n >= 16 && simd::has_avx2()) {  // below, asking costs more than it gains
        write_planes_widely<Planes>(out, n, words_at);
        return out + Planes * n;
      }
#endif
      write_planes<Planes>(out, n, words_at);
      return out + Planes * n;
    };
    if constexpr (fixed_universe<U>) {
      fill(words_.data());
    } else {
      words_.append(Planes * n, fill);
    }
  }

  [[nodiscard]] constexpr U const& universe() const noexcept { return universe_.value; }
  /// The number of words of one plane.
  [[nodiscard]] constexpr std::size_t words() const noexcept { return words_for(universe().size()); }
  [[nodiscard]] constexpr word const* plane(std::size_t which) const noexcept {
    return words_.data() + which * words();
  }
  /// Whether no plane has a bit beyond the universe.
  [[nodiscard]] constexpr bool within_universe() const noexcept {
    std::size_t const used = universe().size() % 64;
    if (used == 0) return true;
    for (std::size_t which = 0; which < Planes; ++which)
      if (plane(which)[words() - 1] >> used != 0) return false;
    return true;
  }
  [[nodiscard]] constexpr bool test(std::size_t which, std::size_t i) const noexcept {
    return (plane(which)[i / 64] >> (i % 64) & 1) != 0;
  }
  constexpr void set(std::size_t which, std::size_t i, bool value) noexcept {
    word& w = words_.data()[which * words() + i / 64];
    word const bit = word{1} << (i % 64);
    w = value ? w | bit : w & ~bit;
  }

  friend bool operator==(bit_planes const&, bit_planes const&) = default;

private:
  [[no_unique_address]] held_universe<U> universe_;
  typename plane_storage<U, Planes>::type words_;  // every constructor fills it
};

/// The index of the lowest bit of the n words `word_at(i)`, or 64·n if all are zero.
template <class F>
constexpr std::size_t lowest_bit(std::size_t n, F&& word_at) {
  for (std::size_t i = 0; i < n; ++i)
    if (word const w = word_at(i); w != 0) return 64 * i + static_cast<std::size_t>(std::countr_zero(w));
  return 64 * n;
}

/// Calls `visit(i)` for each bit i of the n words `word_at(i)`, ascending.
template <class F, class Visit>
constexpr void for_each_bit(std::size_t n, F&& word_at, Visit&& visit) {
  for (std::size_t i = 0; i < n; ++i)
    for (word w = word_at(i); w != 0; w &= w - 1) visit(64 * i + static_cast<std::size_t>(std::countr_zero(w)));
}

constexpr bool all_zero(word const* words, std::size_t n) noexcept {
  word any = 0;
  for (std::size_t i = 0; i < n; ++i) any |= words[i];
  return any == 0;
}

constexpr std::size_t count_bits(word const* words, std::size_t n) noexcept {
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) count += static_cast<std::size_t>(std::popcount(words[i]));
  return count;
}

}  // namespace rota::detail
