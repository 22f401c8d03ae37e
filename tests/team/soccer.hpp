#pragma once

#include <rota/print.hpp>

#include <rapidcheck.h>

#include <array>
#include <cstdint>
#include <vector>

/// A vocabulary small enough that random names collide all the time.
struct soccer {
  enum class agent : std::uint8_t {};
  enum class plan_type : std::uint8_t { play, defence };
  enum class plan : std::uint8_t { normal, kickoff };
  enum class task : std::uint8_t { attack, defend, support };
  enum class state : std::uint8_t { none, get_ball, protect, help };
};
using atom = rota::in<soccer>;
using atoms = rota::allocation_atoms<soccer>;
using event = rota::event<atom>;
using allocation = rota::allocation<soccer>;

constexpr soccer::agent agent(int n) { return static_cast<soccer::agent>(n); }

/// An atom about one of `agents` robots.
inline rc::Gen<atom> any_atom(int agents) {
  return rc::gen::map(rc::gen::tuple(rc::gen::inRange(1, agents + 1), rc::gen::inRange(0, 2), rc::gen::inRange(0, 3)),
                      [](auto const& t) {
                        return atom{agent(std::get<0>(t)), soccer::plan(std::get<1>(t)), soccer::task(std::get<2>(t))};
                      });
}

/// Any set of up to `size` atoms: it may mix plans and give an agent two tasks, as beliefs about others may.
inline rc::Gen<atoms> any_atoms(int agents, int size) {
  return rc::gen::mapcat(rc::gen::inRange(0, size + 1), [=](int n) {
    return rc::gen::map(rc::gen::container<std::vector<atom>>(static_cast<std::size_t>(n), any_atom(agents)),
                        [](std::vector<atom> const& v) { return atoms(v.begin(), v.end()); });
  });
}

inline rc::Gen<allocation> any_allocation(int agents, int size) {
  return rc::gen::map(any_atoms(agents, size), [](atoms const& c) { return allocation{soccer::plan_type::play, c}; });
}
