#pragma once
/// @file
/// `std::hash` of names, atoms, times, sets, events, deltas, fingerprints and allocations, for unordered containers. Equal
/// values have equal hashes; one value has the same hash in every run on one platform. No defence against an adversary.

#include <rota/algebra/dense_event.hpp>
#include <rota/algebra/fingerprint.hpp>
#include <rota/algebra/transition.hpp>
#include <rota/core/size.hpp>
#include <rota/core/time.hpp>
#include <rota/model/allocation.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <type_traits>

namespace rota::detail {

template <class T>
concept hashed_by_std = requires(T const& x) {
  { std::hash<T>{}(x) } -> std::convertible_to<std::size_t>;
};
template <class T>
concept hashed_by_elements = requires(T const& x) {
  x.size();
  requires hashed_by_std<std::remove_cvref_t<decltype(*x.begin())>>;
};
/// A name, number, atom or text; or a sequence of such, as a UUID is.
template <class T>
concept hashable = encodable<T> || hashed_by_std<T> || hashed_by_elements<T>;

/// Mixes words into one, each by a bijection of what came before.
class hash_sink {
public:
  constexpr void operator()(std::uint64_t next) noexcept { state_ = mix(state_ ^ next) + 0x9e3779b97f4a7c15u; }

  template <hashable T>
  constexpr hash_sink& operator<<(T const& x) {
    if constexpr (encodable<T>) {
      atom_encoding<T>::feed(x, *this);
    } else if constexpr (hashed_by_std<T>) {
      (*this)(std::hash<T>{}(x));
    } else {
      (*this)(x.size());
      for (auto const& element : x) *this << element;
    }
    return *this;
  }
  [[nodiscard]] constexpr std::size_t value() const noexcept { return to_size(mix(state_)); }

private:
  std::uint64_t state_ = 0;
};

[[nodiscard]] constexpr std::size_t hash_all(auto const&... parts) {
  hash_sink sink;
  (sink << ... << parts);
  return sink.value();
}
/// `feed(sink, x)` for each x, and how many there are.
[[nodiscard]] constexpr std::size_t hash_each(auto const& range, auto&& feed) {
  hash_sink sink;
  sink(range.size());
  for (auto const& x : range) feed(sink, x);
  return sink.value();
}

}  // namespace rota::detail

template <class Tag, rota::detail::hashable Rep>
struct std::hash<rota::strong_id<Tag, Rep>> {
  std::size_t operator()(rota::strong_id<Tag, Rep> const& x) const { return rota::detail::hash_all(x.value); }
};
template <rota::vocabulary V>
  requires rota::detail::hashable<typename V::agent> && rota::detail::hashable<typename V::plan> &&
           rota::detail::hashable<typename V::task>
struct std::hash<rota::in<V>> {
  std::size_t operator()(rota::in<V> const& x) const { return rota::detail::hash_all(x.agent, x.plan, x.task); }
};
template <rota::vocabulary V>
  requires rota::detail::hashable<rota::in<V>> && rota::detail::hashable<typename V::state>
struct std::hash<rota::in_state<V>> {
  std::size_t operator()(rota::in_state<V> const& x) const { return rota::detail::hash_all(project(x), x.state); }
};

template <>
struct std::hash<rota::duration> {
  std::size_t operator()(rota::duration x) const noexcept { return rota::detail::hash_all(x.ns); }
};
template <>
struct std::hash<rota::instant> {
  std::size_t operator()(rota::instant x) const noexcept { return rota::detail::hash_all(x.ns); }
};
template <>
struct std::hash<rota::fingerprint> {
  std::size_t operator()(rota::fingerprint x) const noexcept { return rota::detail::hash_all(x.value); }
};

/// O(|C|).
template <rota::detail::hashable Atom>
struct std::hash<rota::atom_set<Atom>> {
  std::size_t operator()(rota::atom_set<Atom> const& c) const {
    return rota::detail::hash_each(c, [](auto& sink, Atom const& x) { sink << x; });
  }
};
/// O(|e|).
template <rota::detail::hashable Atom>
struct std::hash<rota::event<Atom>> {
  std::size_t operator()(rota::event<Atom> const& e) const {
    return rota::detail::hash_each(e, [](auto& sink, auto const& x) { sink << x.atom << x.value; });
  }
};
/// O(|d|).
template <rota::detail::hashable Atom, rota::detail::hashable Coefficient>
struct std::hash<rota::delta<Atom, Coefficient>> {
  std::size_t operator()(rota::delta<Atom, Coefficient> const& d) const {
    return rota::detail::hash_each(d, [](auto& sink, auto const& x) { sink << x.atom << x.count; });
  }
};
/// O(|U| / 64). The universe is left out: sets over different ones are unequal, and may have one hash.
template <rota::atom_universe U>
struct std::hash<rota::dense_atom_set<U>> {
  std::size_t operator()(rota::dense_atom_set<U> const& c) const { return rota::detail::hash_all(c.words()); }
};
template <rota::atom_universe U>
struct std::hash<rota::dense_event<U>> {
  std::size_t operator()(rota::dense_event<U> const& e) const { return rota::detail::hash_all(e.plus(), e.minus()); }
};
template <rota::detail::hashable Set>
struct std::hash<rota::transition<Set>> {
  std::size_t operator()(rota::transition<Set> const& t) const {
    return rota::detail::hash_all(t.source(), t.target());
  }
};

template <rota::vocabulary V>
  requires rota::detail::hashable<typename V::plan_type> && rota::detail::hashable<rota::in<V>>
struct std::hash<rota::allocation<V>> {
  std::size_t operator()(rota::allocation<V> const& c) const { return rota::detail::hash_all(c.type, c.atoms); }
};
