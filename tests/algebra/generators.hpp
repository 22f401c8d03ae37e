#pragma once
/// rapidcheck generators over `universe`: few atoms, so that they collide; never tamed by the growing size.
///
/// Defined in a unit of their own: what generators are made of costs more to compile than the properties.

#include "algebra/universe.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstddef>
#include <cstdint>
#include <ostream>
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

/// Three events that associate about as often as not.
struct triple {
  event e, f, g;
};
rc::Gen<triple> triples();
std::ostream& operator<<(std::ostream& out, triple const& t);

/// An event and a set, applicable about as often as not: flips of some atoms, often with wrong signs thrown in.
struct attempt {
  event e;
  atom_set c;
};
rc::Gen<attempt> attempts();
std::ostream& operator<<(std::ostream& out, attempt const& t);

/// Consecutively applicable events, from `start` on.
struct history {
  atom_set start;
  std::vector<event> run;
};
rc::Gen<history> histories();
std::ostream& operator<<(std::ostream& out, history const& h);

/// The k-th of a fixed sequence of generated values: for counting how often a generator reaches what it should.
template <class T>
T sample(rc::Gen<T> const& gen, int k) {
  return gen(rc::Random(static_cast<std::uint64_t>(k)), 100).value();
}

}  // namespace universe
