// What each type claims to be, what no type may claim, and the parts of the algebra that hold in constant expressions.

#include "algebra/universe.hpp"

#include <rota/algebra/associativity.hpp>
#include <rota/algebra/claimed_structures.hpp>
#include <rota/algebra/runs.hpp>

#include <gtest/gtest.h>

#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

namespace structures_test {

namespace {

using universe::atom;
using universe::atom_set;
using universe::delta;
using universe::event;
using universe::nth;
using transition = rota::transition<atom_set>;

// The claim of the paper, and what is true instead.
static_assert(!rota::abelian_group<event> && !rota::group<event> && !rota::monoid<event>);
static_assert(rota::invertible_magma<event> && rota::commutative_magma<event>);
static_assert(rota::abelian_group<delta> && rota::abelian_group<rota::fingerprint>);
static_assert(rota::groupoid<transition> && !rota::magma<transition> && !rota::groupoid<delta>);
static_assert(rota::group_action<delta, rota::fingerprint>);
static_assert(!rota::group_action<event, atom_set> && !rota::group_action<event, rota::fingerprint>);
// No type has a structure before `structure` is specialised for it.
static_assert(!rota::magma<int> && !rota::magma<std::string> && !rota::magma<atom_set>);

}  // namespace

// Each concept refuses types that have only what its weaker neighbour asks.
struct text {
  std::string value;
  friend bool operator==(text const&, text const&) = default;
};
struct greatest {
  int value = 0;
  friend bool operator==(greatest, greatest) = default;
};
struct mean {
  double value = 0;
  friend bool operator==(mean, mean) = default;
};
struct turn {  // of three things, either way round, or a swap
  int rotation = 0;
  bool swap = false;
  friend bool operator==(turn, turn) = default;
};

}  // namespace structures_test

/// Concatenation.
template <>
struct rota::structure<structures_test::text> {
  using T = structures_test::text;
  static T combine(T const& x, T const& y) { return {x.value + y.value}; }
  static T identity() { return {}; }
  static constexpr bool associative = true;
};
/// There is no least integer, so there is no identity.
template <>
struct rota::structure<structures_test::greatest> {
  using T = structures_test::greatest;
  static T combine(T x, T y) { return x.value < y.value ? y : x; }
  static constexpr bool associative = true;
  static constexpr bool commutative = true;
};
/// Commutes, but does not associate.
template <>
struct rota::structure<structures_test::mean> {
  using T = structures_test::mean;
  static T combine(T x, T y) { return {(x.value + y.value) / 2}; }
  static constexpr bool associative = false;
  static constexpr bool commutative = true;
};
/// The symmetries of a triangle.
template <>
struct rota::structure<structures_test::turn> {
  using T = structures_test::turn;
  static T combine(T x, T y) { return {(x.rotation + (x.swap ? 3 - y.rotation : y.rotation)) % 3, x.swap != y.swap}; }
  static T identity() { return {}; }
  static T inverse(T x) { return {x.swap ? x.rotation : (3 - x.rotation) % 3, x.swap}; }
  static constexpr bool associative = true;
};

namespace structures_test {

namespace {

static_assert(rota::monoid<text> && !rota::invertible_magma<text> && !rota::commutative_magma<text>);
static_assert(rota::commutative_magma<greatest> && !rota::unital_magma<greatest> && !rota::monoid<greatest>);
static_assert(rota::magma<mean> && !rota::unital_magma<mean> && !rota::monoid<mean>);
static_assert(rota::group<turn> && !rota::abelian_group<turn> && !rota::groupoid<turn>);
static_assert(!rota::group_action<turn, int> && !rota::group_action<text, text>);

// Which types represent integers, and which do not.
static_assert(rota::integer_coefficient<std::int8_t> && !rota::integer_coefficient<unsigned>);
static_assert(!rota::integer_coefficient<double> && !rota::integer_coefficient<rota::sign>);
static_assert(!rota::integer_coefficient<std::string> && !rota::integer_coefficient<int*>);
// Names without an encoding have no fingerprint, but the headers still compile.
struct call_sign {
  char letters[2] = {};
  friend auto operator<=>(call_sign const&, call_sign const&) = default;
};
struct call_signs : rota::runtime_vocabulary {
  using agent = call_sign;
};
static_assert(!rota::encodable_atom<rota::in<call_signs>> && rota::encodable_atom<atom>);
static_assert(!rota::group_action<rota::delta<rota::in<call_signs>>, rota::fingerprint>);
// A word holds 64 bits. If wider numbers were cut to it, two of them would have one code.
__extension__ using int128 = __int128;
static_assert(rota::encodable<std::uint64_t> && !rota::encodable<int128>);

// The shortest refutation, and the criterion, at compile time.
constexpr auto s = event::addition(nth(0));
constexpr auto u = rota::inverse(s);
static_assert(rota::compose(rota::compose(s, s), u) == event{} && rota::compose(s, rota::compose(s, u)) == s);
static_assert(!rota::associates(s, s, u) && *rota::non_associating_atoms(s, s, u).begin() == nth(0));
static_assert(rota::associates(s, u, s));
// The same three in the group.
static_assert((delta(s) + delta(s)) + delta(u) == delta(s) + (delta(s) + delta(u)));
static_assert(rota::clamp(delta(s) + delta(u)) == event{} && 2 * delta(s) != delta(rota::compose(s, s)));
// A long event and a short one, whose atom is before, within or behind the long one.
constexpr rota::event<int> long_event() {
  rota::small_vector<rota::signed_atom<int>, 8> entries;
  for (int i = 0; i < 40; ++i) entries.push_back({2 * i, rota::sign::plus});
  return rota::event<int>::from_entries(std::move(entries));
}
static_assert(rota::compose(long_event(), rota::event<int>::addition(-1)).size() == 41);
static_assert(rota::compose(long_event(), rota::event<int>::subtraction(40)).size() == 39);
static_assert(rota::compose(long_event(), rota::event<int>::subtraction(78)).size() == 39);
static_assert(rota::compose(long_event(), rota::event<int>::make({101}, {100}).value()).size() == 42);
static_assert(rota::compose(rota::event<int>::addition(101), long_event()).size() == 41);
// A robot changes its mind twice, and is back at its first decision.
constexpr bool a_run_composes() {
  std::array<event, 3> const run{s, u, s};
  std::array<event, 2> const none{s, s};
  return *rota::compose_run<atom>(run) == s &&
         rota::compose_run<atom>(none).error() == rota::no_run<atom>{nth(0), 0, 1};
}
static_assert(a_run_composes());

#ifndef NDEBUG
// A call that breaks a precondition is not a constant expression, so the compiler reports it.
template <auto F>
concept is_constant = requires { typename std::bool_constant<(F(), true)>; };
constexpr transition to_s() { return {atom_set{}, atom_set{nth(0)}}; }
constexpr transition from_s() { return {atom_set{nth(0)}, atom_set{}}; }
using small_delta = rota::delta<atom, std::int8_t>;
constexpr auto meeting = [] { return rota::compose(to_s(), from_s()).target().empty(); };
constexpr auto not_meeting = [] { return rota::compose(to_s(), to_s()).target().empty(); };
constexpr auto within_range = [] { return (small_delta(nth(0), 63) + small_delta(nth(0), 64)).size(); };
constexpr auto out_of_range = [] { return (small_delta(nth(0), 64) + small_delta(nth(0), 64)).size(); };
constexpr auto multiplied_out_of_range = [] { return (2 * small_delta(nth(0), 64)).size(); };
constexpr auto disordered = [] {
  return event::from_entries({{nth(1), rota::sign::plus}, {nth(0), rota::sign::plus}}).size();
};
static_assert(is_constant<meeting> && !is_constant<not_meeting>);
static_assert(is_constant<within_range> && !is_constant<out_of_range> && !is_constant<multiplied_out_of_range>);
static_assert(!is_constant<disordered>);
#endif

}  // namespace

}  // namespace structures_test
