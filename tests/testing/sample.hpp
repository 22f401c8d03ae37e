#pragma once
/// What the laws are tested on: atoms of a small vocabulary, and a coefficient that is no built-in integer.

#include <rota/testing/arbitrary.hpp>

#include <cstdint>

namespace sample {

struct names {
  enum class agent : std::uint8_t {};
  enum class plan_type : std::uint8_t {};
  enum class plan : std::uint8_t {};
  enum class task : std::uint8_t {};
  enum class state : std::uint8_t {};
};
using atom = rota::in<names>;
using atom_set = rota::atom_set<atom>;
using event = rota::event<atom>;
using delta = rota::delta<atom>;

/// An integer type that is no std::integral, as big integers are: wide enough here to be exact.
struct exact {
  __extension__ using wide = __int128;
  wide value = 0;
  constexpr exact() = default;
  constexpr exact(int v) : value(v) {}
  friend constexpr auto operator<=>(exact, exact) = default;
  friend constexpr exact operator+(exact a, exact b) { return of(a.value + b.value); }
  friend constexpr exact operator*(exact a, exact b) { return of(a.value * b.value); }
  static constexpr exact of(wide v) {
    exact r;
    r.value = v;
    return r;
  }
  friend void showValue(exact x, std::ostream& out) { out << static_cast<long long>(x.value); }
};
using exact_delta = rota::delta<atom, exact>;

}  // namespace sample
