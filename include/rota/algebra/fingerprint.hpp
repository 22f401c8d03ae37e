#pragma once

#include <rota/algebra/delta.hpp>
#include <rota/core/atom.hpp>

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rota {

/// An element of ℤ/2⁶⁴, written additively: the value of `fingerprint_of`.
struct fingerprint {
  std::uint64_t value = 0;

  friend auto operator<=>(fingerprint, fingerprint) = default;
  friend constexpr fingerprint operator+(fingerprint a, fingerprint b) noexcept { return {a.value + b.value}; }
  friend constexpr fingerprint operator-(fingerprint a, fingerprint b) noexcept { return {a.value - b.value}; }
  friend constexpr fingerprint operator-(fingerprint a) noexcept { return {0 - a.value}; }
  friend constexpr fingerprint operator*(std::int64_t n, fingerprint a) noexcept {
    return {static_cast<std::uint64_t>(n) * a.value};
  }
};

namespace detail {

/// The SplitMix64 finaliser, a bijection of 64-bit words.
[[nodiscard]] constexpr std::uint64_t mix(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace detail

/// Turns a name or number into words, from which the code of an atom is made. Enumerations, integers and `strong_id`s
/// of these have one. For other identifiers, specialise it with `static constexpr void feed(T const&, auto&& sink)`,
/// which calls `sink(std::uint64_t)` for each word. The words of one value must not begin the words of another, so that
/// the words of several names in a row still tell the names apart: if the length varies, feed it first.
template <class T>
struct atom_encoding;

/// A name, number or atom that has an `atom_encoding`.
template <class T>
concept encodable = requires(T const& x, void (*sink)(std::uint64_t)) { atom_encoding<T>::feed(x, sink); };

template <class T>
  requires(std::integral<T> || std::is_enum_v<T>) && (sizeof(T) <= sizeof(std::uint64_t))
struct atom_encoding<T> {
  static constexpr void feed(T const& x, auto&& sink) { sink(static_cast<std::uint64_t>(x)); }
};
template <class Tag, encodable Rep>
struct atom_encoding<strong_id<Tag, Rep>> {
  static constexpr void feed(strong_id<Tag, Rep> const& x, auto&& sink) { atom_encoding<Rep>::feed(x.value, sink); }
};
template <vocabulary V>
  requires encodable<typename V::agent> && encodable<typename V::plan> && encodable<typename V::task>
struct atom_encoding<in<V>> {
  static constexpr void feed(in<V> const& x, auto&& sink) {
    atom_encoding<typename V::agent>::feed(x.agent, sink);
    atom_encoding<typename V::plan>::feed(x.plan, sink);
    atom_encoding<typename V::task>::feed(x.task, sink);
  }
};

/// An atom that has an `atom_encoding`.
template <class T>
concept encodable_atom = ordered_atom<T> && encodable<T>;

/// r(x), the code of the atom x: a fixed mix of its words, never 0.
template <encodable_atom Atom>
[[nodiscard]] constexpr fingerprint code(Atom const& x) {
  std::uint64_t r = 0x9e3779b97f4a7c15u;
  atom_encoding<Atom>::feed(x, [&](std::uint64_t word) { r = detail::mix(r ^ word) + 0x9e3779b97f4a7c15u; });
  r = detail::mix(r);
  return {r != 0 ? r : 1};
}

/// h(δ) = Σ δ(x)·r(x), a homomorphism delta → ℤ/2⁶⁴: h(δ + ε) = h(δ) + h(ε). So events update it, in any order.
///
/// Eight bytes that tell allocations apart. If r were uniform and independent, two unequal allocations would have one
/// fingerprint with probability 2⁻⁶⁴, and a delta whose coefficients are all multiples of 2^v the fingerprint 0 with
/// probability 2^(v−64). But r is fixed and public, so this is a heuristic and no defence against an adversary. O(|δ|).
template <encodable_atom Atom, std::signed_integral Coefficient>
[[nodiscard]] constexpr fingerprint fingerprint_of(delta<Atom, Coefficient> const& d) {
  fingerprint h;
  for (auto const& x : d) h = h + static_cast<std::int64_t>(x.count) * code(x.atom);
  return h;
}
/// h(ι(e)). O(|e|); allocates nothing.
template <encodable_atom Atom>
[[nodiscard]] constexpr fingerprint fingerprint_of(event<Atom> const& e) {
  fingerprint h;
  for (auto const& x : e) h = x.value == sign::plus ? h + code(x.atom) : h - code(x.atom);
  return h;
}
/// h(χ(C)). Law: h(e·C) = h(C) + h(e) if e is applicable at C. O(|C|); allocates nothing.
template <encodable_atom Atom>
[[nodiscard]] constexpr fingerprint fingerprint_of(atom_set<Atom> const& c) {
  fingerprint h;
  for (auto const& x : c) h = h + code(x);
  return h;
}
/// The same for an event or a set in another storage.
template <class X>
  requires requires(X const& x) { fingerprint_of(to_sparse(x)); }
[[nodiscard]] constexpr fingerprint fingerprint_of(X const& x) {
  return fingerprint_of(to_sparse(x));
}

}  // namespace rota
