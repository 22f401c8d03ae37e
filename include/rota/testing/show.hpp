#pragma once
/// @file
/// How rapidcheck shows the algebra's values in counterexamples. Found by argument-dependent lookup.

#include <rota/algebra/dense_event.hpp>
#include <rota/algebra/fingerprint.hpp>
#include <rota/algebra/transition.hpp>
#include <rota/model/allocation.hpp>

#include <rapidcheck.h>

#include <ostream>
#include <type_traits>

namespace rota {

namespace testing {

/// A name as its number, if it is one.
template <class Name>
void show_name(Name const& name, std::ostream& out) {
  if constexpr (std::is_enum_v<Name> || std::is_integral_v<Name>)
    out << static_cast<long long>(name);
  else
    rc::show(name, out);
}
template <class Range>
void show_all(char const* open, Range const& range, char const* close, std::ostream& out) {
  out << open;
  char const* separator = "";
  for (auto const& x : range) {
    out << separator;
    rc::show(x, out);
    separator = ", ";
  }
  out << close;
}

}  // namespace testing

template <class Tag, class Rep>
void showValue(strong_id<Tag, Rep> const& id, std::ostream& out) {
  testing::show_name(id.value, out);
}
template <vocabulary V>
void showValue(in<V> const& x, std::ostream& out) {
  out << "In(";
  testing::show_name(x.agent, out);
  out << ", ";
  testing::show_name(x.plan, out);
  out << ", ";
  testing::show_name(x.task, out);
  out << ")";
}
/// {In(1, 0, 1), In(2, 0, 0)}
template <ordered_atom Atom>
void showValue(atom_set<Atom> const& c, std::ostream& out) {
  testing::show_all("{", c, "}", out);
}
template <atom_universe U>
void showValue(dense_atom_set<U> const& c, std::ostream& out) {
  showValue(to_sparse(c), out);
}
/// +In(1, 0, 1)
template <ordered_atom Atom>
void showValue(signed_atom<Atom> const& x, std::ostream& out) {
  out << (x.value == sign::plus ? "+" : x.value == sign::minus ? "-" : "0 ");
  rc::show(x.atom, out);
}
template <ordered_atom Atom>
void showValue(event<Atom> const& e, std::ostream& out) {
  testing::show_all("(", e, ")", out);
}
template <atom_universe U>
void showValue(dense_event<U> const& e, std::ostream& out) {
  showValue(to_sparse(e), out);
}
/// 2 In(1, 0, 1)
template <ordered_atom Atom, class Coefficient>
void showValue(multiple<Atom, Coefficient> const& x, std::ostream& out) {
  testing::show_name(x.count, out);
  out << " ";
  rc::show(x.atom, out);
}
template <ordered_atom Atom, integer_coefficient Coefficient>
void showValue(delta<Atom, Coefficient> const& d, std::ostream& out) {
  testing::show_all("(", d, ")", out);
}
inline void showValue(fingerprint h, std::ostream& out) { out << h.value; }
template <allocation_set Set>
void showValue(transition<Set> const& t, std::ostream& out) {
  rc::show(t.source(), out);
  out << " -> ";
  rc::show(t.target(), out);
}
template <vocabulary V>
void showValue(allocation<V> const& c, std::ostream& out) {
  out << "of type ";
  testing::show_name(c.type, out);
  out << " ";
  rc::show(c.atoms, out);
}
template <class T, class Refusal>
void showValue(result<T, Refusal> const& r, std::ostream& out) {
  if (r.has_value())
    rc::show(*r, out);
  else
    out << "refused";
}

}  // namespace rota
