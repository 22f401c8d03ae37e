#pragma once
/// rapidcheck generators over `universe`: few atoms, so that they collide; never tamed by the growing size.
///
/// Defined in a unit of their own: what generators are made of costs more to compile than the properties.

#include "algebra/universe.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace universe {

/// How many atoms there are. Twenty-four make events leave their inline storage of eight entries.
rc::Gen<std::size_t> atom_count();

/// Uniform in {low, …, high}.
rc::Gen<int> integer(int low, int high);
rc::Gen<std::vector<int>> integers(std::size_t count, int low, int high);

/// For each atom one of {low, …, high}, zero with a probability that differs from case to case, often never.
rc::Gen<std::vector<int>> values(std::size_t atoms, int low, int high);

rc::Gen<event> event_over(std::size_t atoms);
rc::Gen<atom_set> set_over(std::size_t atoms);
rc::Gen<delta> delta_over(std::size_t atoms);
rc::Gen<std::vector<event>> events_over(std::size_t atoms, std::size_t count);

/// The k-th of a fixed sequence of generated values: for counting how often a generator reaches what it should.
template <class T>
T sample(rc::Gen<T> const& gen, int k) {
  return gen(rc::Random(static_cast<std::uint64_t>(k)), 100).value();
}

}  // namespace universe
