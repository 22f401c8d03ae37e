#pragma once
/// rapidcheck generators over the first n atoms of `universe`. Unlike those of rota/testing/, they take n: the operands
/// of a test share it, it may be as large as a dense universe, and 24 atoms already leave inline storage.
///
/// Defined in a unit of their own, because generators cost more to compile than properties.

#include "algebra/universe.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <rota/testing/values.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace universe {

using rota::testing::integer;

/// How many atoms there are.
rc::Gen<std::size_t> atom_count();

rc::Gen<std::vector<int>> integers(std::size_t count, int low, int high);

/// One of {low, …, high} for each atom. How often it is zero differs from case to case, and is often never.
rc::Gen<std::vector<int>> values(std::size_t atoms, int low, int high);

rc::Gen<event> event_over(std::size_t atoms);
rc::Gen<atom_set> set_over(std::size_t atoms);
rc::Gen<delta> delta_over(std::size_t atoms);
rc::Gen<std::vector<event>> events_over(std::size_t atoms, std::size_t count);

/// The k-th of a fixed sequence of generated values, for counting how often a generator reaches interesting ones.
template <class T>
T sample(rc::Gen<T> const& gen, int k) {
  return gen(rc::Random(static_cast<std::uint64_t>(k)), 100).value();
}

}  // namespace universe
