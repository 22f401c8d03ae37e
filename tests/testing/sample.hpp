#pragma once
/// The atoms of a small vocabulary, and a coefficient that is not a built-in integer.

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

/// A universe that holds the atoms that are drawn and many more, so that they are in three words.
template <class Name, int... Numbers>
using numbered = rota::name_list<Name{Numbers}...>;
using wide_universe = rota::in_universe<names, numbered<names::agent, 0, 1, 2, 3, 4, 5>, numbered<names::plan, 0, 1>,
                                        numbered<names::task, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11>>;
using dense_set = rota::dense_atom_set<wide_universe>;
using dense_event = rota::dense_event<wide_universe>;

/// An integer type that is not std::integral, like big integers; wide enough here to be exact.
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
