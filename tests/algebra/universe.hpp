#pragma once
/// The atoms, sets, events and deltas of these tests, and functions that enumerate all of them over a small universe.

#include <rota/algebra/apply.hpp>
#include <rota/algebra/delta.hpp>
#include <rota/core/atom.hpp>

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <vector>

namespace universe {

struct names {
  enum class agent : std::uint8_t {};
  enum class plan_type : std::uint8_t {};
  enum class plan : std::uint8_t { normal, kickoff };
  enum class task : std::uint8_t { attack, defend };
  enum class state : std::uint8_t {};
};

using atom = rota::in<names>;
using atom_set = rota::atom_set<atom>;
using event = rota::event<atom>;
using delta = rota::delta<atom>;

/// The i-th atom in ascending order. Four in a row share an agent, so that in small universes an agent has several
/// tasks.
constexpr atom nth(std::size_t i) {
  return {static_cast<names::agent>(i / 4), static_cast<names::plan>(i / 2 % 2), static_cast<names::task>(i % 2)};
}

constexpr rota::sign to_sign(int s) { return s > 0 ? rota::sign::plus : s < 0 ? rota::sign::minus : rota::sign::zero; }

/// Built from the two sets of Def. 3, so without `compose` and `difference`.
inline event event_of(std::vector<int> const& signs) {
  atom_set additions;
  atom_set subtractions;
  for (std::size_t i = 0; i < signs.size(); ++i) {
    if (signs[i] > 0) additions.insert(nth(i));
    if (signs[i] < 0) subtractions.insert(nth(i));
  }
  return event::make(additions, subtractions).value();
}

inline atom_set set_of(std::vector<int> const& member) {
  atom_set c;
  for (std::size_t i = 0; i < member.size(); ++i)
    if (member[i] != 0) c.insert(nth(i));
  return c;
}

template <class Coefficient = std::int64_t>
rota::delta<atom, Coefficient> delta_of(std::vector<int> const& counts) {
  rota::delta<atom, Coefficient> d;
  for (std::size_t i = 0; i < counts.size(); ++i) d += {nth(i), static_cast<Coefficient>(counts[i])};
  return d;
}

/// Every vector over {low, …, high} of this length.
inline std::vector<std::vector<int>> every_vector(std::size_t length, int low, int high) {
  std::vector<std::vector<int>> all{{}};
  for (std::size_t i = 0; i < length; ++i) {
    std::vector<std::vector<int>> longer;
    for (auto const& v : all)
      for (int x = low; x <= high; ++x) {
        longer.push_back(v);
        longer.back().push_back(x);
      }
    all = std::move(longer);
  }
  return all;
}

template <class Make>
auto every(std::size_t length, int low, int high, Make make) {
  std::vector<decltype(make(std::vector<int>{}))> all;
  for (auto const& v : every_vector(length, low, high)) all.push_back(make(v));
  return all;
}

inline std::vector<event> every_event(std::size_t atoms) { return every(atoms, -1, 1, event_of); }
inline std::vector<atom_set> every_set(std::size_t atoms) { return every(atoms, 0, 1, set_of); }
inline std::vector<delta> every_delta(std::size_t atoms, int bound) {
  return every(atoms, -bound, bound, delta_of<std::int64_t>);
}

inline std::ostream& operator<<(std::ostream& out, atom const& x) {
  return out << "In(" << int(x.agent) << "," << int(x.plan) << "," << int(x.task) << ")";
}
inline std::ostream& operator<<(std::ostream& out, atom_set const& c) {
  out << "{";
  for (auto const& x : c) out << " " << x;
  return out << " }";
}
inline std::ostream& operator<<(std::ostream& out, event const& e) {
  out << "(";
  for (auto const& x : e) out << (x.value == rota::sign::plus ? " +" : " -") << x.atom;
  return out << " )";
}
template <class Coefficient>
std::ostream& operator<<(std::ostream& out, rota::delta<atom, Coefficient> const& d) {
  out << "(";
  for (auto const& x : d) out << " " << +x.count << "*" << x.atom;
  return out << " )";
}

}  // namespace universe
