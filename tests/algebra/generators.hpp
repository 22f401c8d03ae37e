#pragma once
/// rapidcheck generators over `universe`: few atoms, so that they collide; never tamed by the growing size.

#include "algebra/universe.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace universe {

template <class T>
rc::Gen<T> untamed(rc::Gen<T> gen) {
  return rc::gen::resize(100, std::move(gen));
}

/// How many atoms there are. Twenty-four make events leave their inline storage of eight entries.
inline rc::Gen<std::size_t> atom_count() { return rc::gen::element<std::size_t>(1, 2, 3, 6, 6, 24); }

/// For each atom one of {low, …, high}, zero with a probability that differs from case to case, often never.
inline rc::Gen<std::vector<int>> values(std::size_t atoms, int low, int high,
                                        std::vector<std::size_t> zeros_per_two = {0, 1, 2, 6}) {
  std::vector<int> nonzero;
  for (int x = low; x <= high; ++x)
    if (x != 0) nonzero.push_back(x);
  return rc::gen::mapcat(rc::gen::elementOf(std::move(zeros_per_two)), [=](std::size_t zeros) {
    return rc::gen::container<std::vector<int>>(
        atoms, rc::gen::weightedOneOf<int>({{zeros, rc::gen::just(0)}, {2, rc::gen::elementOf(nonzero)}}));
  });
}

inline rc::Gen<event> event_over(std::size_t atoms) { return rc::gen::map(values(atoms, -1, 1), event_of); }
inline rc::Gen<atom_set> set_over(std::size_t atoms) { return rc::gen::map(values(atoms, 0, 1), set_of); }
inline rc::Gen<delta> delta_over(std::size_t atoms) {
  return rc::gen::map(values(atoms, -4, 4), delta_of<std::int64_t>);
}

/// The k-th of a fixed sequence of generated values: for counting how often a generator reaches what it should.
template <class T>
T sample(rc::Gen<T> const& gen, int k) {
  return gen(rc::Random(static_cast<std::uint64_t>(k)), 100).value();
}

}  // namespace universe
