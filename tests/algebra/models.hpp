#pragma once
/// rota's own types as models of the laws, on the smallest universes that can break them.

#include "algebra/universe.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace models {

using universe::atom;
using universe::atom_set;
using universe::delta;
using universe::event;

inline bool strictly_ascending(auto const& entries) {
  return std::adjacent_find(entries.begin(), entries.end(),
                            [](auto const& x, auto const& y) { return !(x.atom < y.atom); }) == entries.end();
}

/// Def. 3 and 4.
struct events {
  static std::vector<event> elements() { return universe::every_event(2); }
  static bool valid(event const& e) {
    return strictly_ascending(e) && std::none_of(e.begin(), e.end(), [](auto const& x) {
             return x.value != rota::sign::plus && x.value != rota::sign::minus;
           });
  }
  static event identity() { return {}; }
  static event inverse(event const& e) { return rota::inverse(e); }
  static event compose(event const& e, event const& f) { return rota::compose(e, f); }
};

/// The free abelian group.
struct deltas {
  static std::vector<delta> elements() { return universe::every_delta(2, 2); }
  static bool valid(delta const& d) {
    return strictly_ascending(d) && std::none_of(d.begin(), d.end(), [](auto const& x) { return x.count == 0; });
  }
  static delta identity() { return {}; }
  static delta inverse(delta const& d) { return -d; }
  static delta compose(delta const& d, delta const& e) { return d + e; }
  static delta scale(int n, delta const& d) { return n * d; }
};

/// ι and ρ.
struct embedding {
  static std::vector<event> elements() { return universe::every_event(3); }
  static delta embed(event const& e) { return delta(e); }
  static event clamp(delta const& d) { return rota::clamp(d); }
  static event compose(event const& e, event const& f) { return rota::compose(e, f); }
};

/// The universal property.
struct extension {
  template <class F, class G>
  static G extend(delta const& d, F const& f, G const& zero) {
    return rota::extend(d, f, zero);
  }
};

/// Events acting on sets.
struct action {
  static event difference(atom_set const& c, atom_set const& d) { return rota::difference(c, d); }
  static bool applicable(event const& e, atom_set const& c) { return rota::applicable(e, c); }
  static auto apply(event const& e, atom_set const& c) { return rota::apply(e, c); }
  static delta characteristic(atom_set const& c) { return delta(c); }
  static delta embed(event const& e) { return delta(e); }
  static event compose(event const& e, event const& f) { return rota::compose(e, f); }
  static event clamped_sum(std::vector<event> const& run) {
    delta sum;
    for (auto const& e : run) sum += delta(e);
    return rota::clamp(sum);
  }
};

}  // namespace models
