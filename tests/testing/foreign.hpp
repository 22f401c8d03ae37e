#pragma once
/// Events in a std::map that act on std::sets: a storage that the library does not know.

#include "testing/sample.hpp"

#include <rota/core/result.hpp>

#include <algorithm>
#include <map>
#include <ostream>
#include <set>

namespace sample {

struct map_event {
  std::map<atom, int> of;
  friend bool operator==(map_event const&, map_event const&) = default;
  friend void showValue(map_event const& e, std::ostream& out) { rc::show(e.of, out); }
};

}  // namespace sample

template <>
struct rota::structure<sample::map_event> {
  using E = sample::map_event;
  using atom = sample::atom;
  using set_type = std::set<atom>;
  using signs_type = std::map<atom, int>;

  static E combine(E e, E const& f) {
    for (auto const& [x, s] : f.of)
      if ((e.of[x] += s) == 0) e.of.erase(x);
    for (auto& [x, s] : e.of) s = std::clamp(s, -1, 1);
    return e;
  }
  static E identity() { return {}; }
  static E inverse(E e) {
    for (auto& [x, s] : e.of) s = -s;
    return e;
  }
  static constexpr bool commutative = true;

  static E difference(set_type const& before, set_type const& after) {
    E e;
    for (auto const& x : before)
      if (!after.contains(x)) e.of[x] = -1;
    for (auto const& x : after)
      if (!before.contains(x)) e.of[x] = 1;
    return e;
  }
  static bool applicable(E const& e, set_type const& c) { return apply(e, c).has_value(); }
  static result<set_type, inapplicable<atom>> apply(E const& e, set_type c) {
    for (auto const& [x, s] : e.of)
      if (s > 0 ? !c.insert(x).second : c.erase(x) == 0) return refused{inapplicable<atom>{x}};
    return c;
  }
  static bool is_cycle(E const& e_m, E const& e_r, sample::names::agent b) {
    auto const both = combine(e_m, e_r).of;
    return !e_m.of.empty() &&
           std::none_of(both.begin(), both.end(), [&](auto const& entry) { return entry.first.agent == b; });
  }

  static signs_type signs(E const& e) { return e.of; }
  static E event_with(signs_type const& signs) { return {signs}; }
  static set_type set_with(set_type const& members) { return members; }
  static set_type members(set_type const& c) { return c; }
};

template <>
struct rc::Arbitrary<sample::map_event> {
  static Gen<sample::map_event> arbitrary() {
    return rota::testing::made_of<sample::map_event>(-1, 1, [](std::vector<int> const& v) {
      sample::map_event e;
      for (std::size_t i = 0; i < v.size(); ++i)
        if (v[i] != 0) e.of[rota::testing::nth_atom<sample::atom>(i)] = v[i];
      return e;
    });
  }
};
