#pragma once
/// @file
/// rapidcheck generators for the types of the algebra, over few atoms, so that random values share some; see
/// values.hpp.

#include <rota/algebra/claimed_structures.hpp>
#include <rota/testing/groupoid_laws.hpp>
#include <rota/testing/show.hpp>
#include <rota/testing/structure_laws.hpp>
#include <rota/testing/values.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace rota::testing {

/// The atoms that generators draw: `static Atom nth(std::size_t i)` for i < 24, strictly ascending. It is there for
/// enumerations, integers, `strong_id`s of these and In-atoms made of these. Specialise it for atoms of your own.
template <class Atom>
struct sample_atoms;

template <class Atom>
  requires(std::integral<Atom> && !std::same_as<Atom, bool>) || std::is_enum_v<Atom>
struct sample_atoms<Atom> {
  static constexpr Atom nth(std::size_t i) { return static_cast<Atom>(i); }
};
template <class Tag, class Rep>
struct sample_atoms<strong_id<Tag, Rep>> {
  static constexpr strong_id<Tag, Rep> nth(std::size_t i) { return {sample_atoms<Rep>::nth(i)}; }
};
/// Four atoms per agent, so that few atoms are enough for one agent to have two tasks, or a task in two plans.
template <vocabulary V>
struct sample_atoms<in<V>> {
  static constexpr in<V> nth(std::size_t i) {
    return {sample_atoms<typename V::agent>::nth(i / 4), sample_atoms<typename V::plan>::nth(i / 2 % 2),
            sample_atoms<typename V::task>::nth(i % 2)};
  }
};

template <class Atom>
[[nodiscard]] constexpr Atom nth_atom(std::size_t i) {
  return sample_atoms<Atom>::nth(i);
}

/// One of the first six atoms.
template <class Atom>
[[nodiscard]] rc::Gen<Atom> an_atom() {
  return rc::gen::map(integer(0, 5), [](int i) { return nth_atom<Atom>(static_cast<std::size_t>(i)); });
}

/// The atoms whose entry in `values` is `which`.
template <class Atom>
[[nodiscard]] constexpr atom_set<Atom> atoms_where(std::vector<int> const& values, int which) {
  atom_set<Atom> c;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] == which) c.insert(nth_atom<Atom>(i));
  return c;
}
/// The event with these signs, built from two sets as Def. 3 says, so without `compose` and `difference`.
template <class Atom>
[[nodiscard]] constexpr event<Atom> event_with(std::vector<int> const& signs) {
  return event<Atom>::make(atoms_where<Atom>(signs, 1), atoms_where<Atom>(signs, -1)).value();
}

/// An event that is applicable at c in about half of all cases. In the others it adds atoms of c, or subtracts atoms
/// that are not in c.
template <class Atom>
[[nodiscard]] rc::Gen<event<Atom>> event_at(atom_set<Atom> const& c) {
  return made_of<event<Atom>>(-1, 1, [c](std::vector<int> signs) {
    for (std::size_t i = 0; i < signs.size(); ++i)
      if (c.contains(nth_atom<Atom>(i))) signs[i] = -signs[i];
    return event_with<Atom>(signs);
  });
}
/// c with some atoms flipped: inserted if absent, erased if present.
template <class Atom>
[[nodiscard]] rc::Gen<atom_set<Atom>> set_flipped(atom_set<Atom> const& c) {
  return made_of<atom_set<Atom>>(0, 1, [c](std::vector<int> const& marks) {
    auto d = c;
    for (std::size_t i = 0; i < marks.size(); ++i)
      if (auto const x = nth_atom<Atom>(i); marks[i] != 0 && !d.insert(x)) d.erase(x);
    return d;
  });
}
/// A set that is often equal to c, a subset, a superset, or neither.
template <class Atom>
[[nodiscard]] rc::Gen<atom_set<Atom>> set_beside(atom_set<Atom> const& c) {
  return made_of<atom_set<Atom>>(-1, 2, [c](std::vector<int> const& marks) {
    auto d = c;
    for (std::size_t i = 0; i < marks.size(); ++i) {
      auto const x = nth_atom<Atom>(i);
      bool const inside = marks[i] == 2 ? !c.contains(x) : marks[i] == 0 ? c.contains(x) : marks[i] == 1;
      if (inside) d.insert(x);
      if (!inside) d.erase(x);
    }
    return d;
  });
}

template <ordered_atom Atom>
struct class_invariant<event<Atom>> {
  static bool holds(event<Atom> const& e) {
    auto const entries = [&](auto const& x, auto const& y) { return !(x.atom < y.atom); };
    return std::adjacent_find(e.begin(), e.end(), entries) == e.end() &&
           std::all_of(e.begin(), e.end(),
                       [](auto const& x) { return x.value == sign::plus || x.value == sign::minus; });
  }
};
template <atom_universe U>
struct class_invariant<dense_event<U>> {
  static bool holds(dense_event<U> const& e) {
    std::size_t const used = e.universe().size() % 64;
    for (std::size_t i = 0; i < e.plus().size(); ++i) {
      auto const either = e.plus()[i] | e.minus()[i];
      bool const beyond = used != 0 && i + 1 == e.plus().size() && either >> used != 0;
      if ((e.plus()[i] & e.minus()[i]) != 0 || beyond) return false;
    }
    return true;
  }
};
template <ordered_atom Atom, integer_coefficient Coefficient>
struct class_invariant<delta<Atom, Coefficient>> {
  static bool holds(delta<Atom, Coefficient> const& d) {
    auto const out_of_order = [](auto const& x, auto const& y) { return !(x.atom < y.atom); };
    return std::adjacent_find(d.begin(), d.end(), out_of_order) == d.end() &&
           std::none_of(d.begin(), d.end(), [](auto const& x) { return x.count == Coefficient{}; });
  }
};

/// c in another storage. @pre if the storage has a universe, c is within it
template <allocation_set Set>
[[nodiscard]] constexpr Set stored_as(atom_set<typename event_on<Set>::atom_type> const& c) {
  Set r;
  for (auto const& x : c) {
    (void)r.insert(x);
    ROTA_ASSERT(r.contains(x));
  }
  return r;
}
/// c as an `atom_set`.
template <allocation_set Set>
[[nodiscard]] constexpr auto sparse(Set const& c) {
  if constexpr (requires { to_sparse(c); })
    return to_sparse(c);
  else
    return c;
}

/// Arrows from c to any set.
template <allocation_set Set>
struct arrows<transition<Set>> {
  [[nodiscard]] static rc::Gen<transition<Set>> from(Set const& c) {
    return rc::gen::map(set_beside(sparse(c)), [c](auto const& d) { return transition<Set>(c, stored_as<Set>(d)); });
  }
};

}  // namespace rota::testing

template <rota::vocabulary V>
struct rc::Arbitrary<rota::in<V>> {
  static Gen<rota::in<V>> arbitrary() { return rota::testing::an_atom<rota::in<V>>(); }
};
template <rota::ordered_atom Atom>
struct rc::Arbitrary<rota::atom_set<Atom>> {
  static Gen<rota::atom_set<Atom>> arbitrary() {
    return rota::testing::made_of<rota::atom_set<Atom>>(
        0, 1, [](std::vector<int> const& v) { return rota::testing::atoms_where<Atom>(v, 1); });
  }
};
template <rota::ordered_atom Atom>
struct rc::Arbitrary<rota::event<Atom>> {
  static Gen<rota::event<Atom>> arbitrary() {
    return rota::testing::made_of<rota::event<Atom>>(-1, 1, &rota::testing::event_with<Atom>);
  }
};
/// Draws from both ends of the universe.
template <rota::fixed_universe U>
struct rc::Arbitrary<rota::dense_event<U>> {
  static Gen<rota::dense_event<U>> arbitrary() {
    return rota::testing::made_of<rota::dense_event<U>>(-1, 1, [](std::vector<int> const& signs) {
      typename rota::dense_event<U>::set_type plus, minus;
      for (std::size_t i = 0; i < (std::min)(signs.size(), U::size()); ++i) {
        auto const x = U::atom_at(i % 2 == 0 ? i / 2 : U::size() - 1 - i / 2);
        if (signs[i] != 0) (void)(signs[i] > 0 ? plus : minus).insert(x);
      }
      return rota::dense_event<U>::make(plus, minus).value();
    });
  }
};
/// Multiplicities from −4 to 4, so that sums of a dozen deltas fit into eight bits.
template <rota::ordered_atom Atom, rota::integer_coefficient Coefficient>
struct rc::Arbitrary<rota::delta<Atom, Coefficient>> {
  static Gen<rota::delta<Atom, Coefficient>> arbitrary() {
    return rota::testing::made_of<rota::delta<Atom, Coefficient>>(-4, 4, [](std::vector<int> const& counts) {
      rota::delta<Atom, Coefficient> d;
      for (std::size_t i = 0; i < counts.size(); ++i)
        d += {rota::testing::nth_atom<Atom>(i), static_cast<Coefficient>(counts[i])};
      return d;
    });
  }
};
/// Any 64 bits, often 0, 1 or −1.
template <>
struct rc::Arbitrary<rota::fingerprint> {
  static Gen<rota::fingerprint> arbitrary() {
    return [](Random const& random, int) {
      auto source = random;
      auto const kind = source.next() % 8;
      auto const bits = source.next();
      return shrinkable::just(rota::fingerprint{kind < 2 ? bits % 3 - 1 : kind == 2 ? std::uint64_t{1} << 63 : bits});
    };
  }
};
/// Each atom is in neither set, in one, or in both. So source and target are often equal, nested, or unrelated.
template <rota::allocation_set Set>
struct rc::Arbitrary<rota::transition<Set>> {
  static Gen<rota::transition<Set>> arbitrary() {
    return rota::testing::made_of<rota::transition<Set>>(0, 3, [](std::vector<int> const& v) {
      auto const of = [&](int which) {
        return rota::testing::atoms_where<typename rota::transition<Set>::atom_type>(v, which);
      };
      auto const both = of(3);
      return rota::transition<Set>(rota::testing::stored_as<Set>(unite(of(1), both)),
                                   rota::testing::stored_as<Set>(unite(of(2), both)));
    });
  }
};
/// Of the first plan type.
template <rota::vocabulary V>
struct rc::Arbitrary<rota::allocation<V>> {
  static Gen<rota::allocation<V>> arbitrary() {
    return gen::map(gen::arbitrary<rota::allocation_atoms<V>>(),
                    [](rota::allocation_atoms<V> const& c) { return rota::allocation<V>{{}, c}; });
  }
};
