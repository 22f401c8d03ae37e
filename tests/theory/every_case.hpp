#pragma once
/// All cases over tiny universes, and the definitions written out at each atom. Nothing is generated, so a law that holds
/// here holds in every case. The script tests/mutations shows that these laws notice a break in any function.

#include <rota/algebra/delta.hpp>
#include <rota/algebra/event.hpp>
#include <rota/core/atom.hpp>
#include <rota/model/allocation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace theory {

// Three agents, two plans, three tasks.
struct names {
  enum class agent : std::uint8_t {};
  enum class plan_type : std::uint8_t { ours, other };
  enum class plan : std::uint8_t {};
  enum class task : std::uint8_t {};
  enum class state : std::uint8_t {};
};
using atom = rota::in<names>;
using atom_set = rota::atom_set<atom>;
using event = rota::event<atom>;
using delta = rota::delta<atom>;
using allocation = rota::allocation<names>;

constexpr std::size_t atoms_per_agent = 6;
constexpr atom nth(std::size_t i) {
  return {static_cast<names::agent>(i / 6), static_cast<names::plan>(i / 3 % 2), static_cast<names::task>(i % 3)};
}

using function = std::map<atom, int>;  ///< finitely supported: atoms of value 0 are left out

template <class T>
inline function values_of(T const& x) {
  function f;
  if constexpr (requires { x.begin()->value; }) {
    for (auto const& entry : x) f[entry.atom] = to_int(entry.value);
  } else if constexpr (requires { x.begin()->count; }) {
    for (auto const& entry : x) f[entry.atom] = static_cast<int>(entry.count);
  } else {
    for (auto const& member : x) f[member] = 1;
  }
  return f;
}
inline function plus(function f, function const& g, int times = 1) {
  for (auto const& [x, n] : g) f[x] += times * n;
  std::erase_if(f, [](auto const& entry) { return entry.second == 0; });
  return f;
}
inline function clamped(function f) {
  for (auto& [x, n] : f) n = std::clamp(n, -1, 1);
  return f;
}
inline event event_from(function const& signs) {
  atom_set additions;
  atom_set subtractions;
  for (auto const& [x, s] : signs) (s > 0 ? additions : subtractions).insert(x);
  return event::make(additions, subtractions).value();
}

/// All functions from these atoms to {low, …, high}.
inline std::vector<function> functions(std::vector<std::size_t> const& atoms, int low, int high) {
  std::vector<function> all{{}};
  for (auto const i : atoms) {
    std::vector<function> longer;
    for (auto const& f : all)
      for (int n = low; n <= high; ++n) longer.push_back(plus(f, {{nth(i), n}}));
    all = std::move(longer);
  }
  return all;
}
inline std::vector<event> events(std::vector<std::size_t> const& atoms) {
  std::vector<event> all;
  for (auto const& f : functions(atoms, -1, 1)) all.push_back(event_from(f));
  return all;
}
inline std::vector<delta> deltas(std::vector<std::size_t> const& atoms, int bound) {
  std::vector<delta> all;
  for (auto const& f : functions(atoms, -bound, bound)) {
    delta d;
    for (auto const& [x, n] : f) d += {x, n};
    all.push_back(d);
  }
  return all;
}

/// All beliefs about the first `agents` agents: each agent has one of six atoms, or none.
inline std::vector<atom_set> beliefs(std::size_t agents) {
  std::vector<atom_set> all{{}};
  for (std::size_t a = 0; a < agents; ++a) {
    std::vector<atom_set> longer = all;
    for (auto const& c : all)
      for (std::size_t i = 0; i < atoms_per_agent; ++i) {
        longer.push_back(c);
        longer.back().insert(nth(a * atoms_per_agent + i));
      }
    all = std::move(longer);
  }
  return all;
}
inline atom_set with_part(atom_set c, names::agent b, atom_set const& part) {
  std::vector<atom> atoms(part.begin(), part.end());
  for (auto const& x : c)
    if (x.agent != b) atoms.push_back(x);
  return {atoms.begin(), atoms.end()};
}
inline std::vector<atom> part(atom_set const& c, names::agent b) {
  std::vector<atom> atoms;
  for (auto const& x : c)
    if (x.agent == b) atoms.push_back(x);
  return atoms;
}

/// Counts the cases that break a law, and shows the first. An EXPECT per case would cost more than the cases.
struct law {
  explicit law(char const* equation) : equation_(equation) {}
  law(law const&) = delete;
  law& operator=(law const&) = delete;
  ~law() {
    EXPECT_EQ(broken_, 0u) << equation_ << " fails in " << broken_ << " of " << cases_ << " cases, first in case "
                           << first_;
    EXPECT_GT(cases_, 0u) << equation_ << ": no case";
  }
  void operator()(bool holds) {
    if (!holds && broken_++ == 0) first_ = cases_;
    ++cases_;
  }

private:
  char const* equation_;
  std::size_t cases_ = 0;
  std::size_t broken_ = 0;
  std::size_t first_ = 0;
};

inline std::vector<std::size_t> const three_atoms{0, 4, 13};

}  // namespace theory
