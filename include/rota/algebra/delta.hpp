#pragma once

#include <rota/algebra/event.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace rota {

/// Refusal: the multiplicity of this atom would leave the range of the coefficient type. It is never clamped to it.
template <ordered_atom Atom>
struct coefficient_overflow {
  Atom witness{};
  friend bool operator==(coefficient_overflow const&, coefficient_overflow const&) = default;
};

/// One entry of a delta. The stored multiplicity is never zero.
template <ordered_atom Atom, class Coefficient>
struct multiple {
  Atom atom{};
  Coefficient count{};

  friend auto operator<=>(multiple const&, multiple const&) = default;
};

/// A type that represents ℤ: a signed integer, or an exact big integer with an order, sums and products.
///
/// Refuses unsigned types, which have no −1, so ι would wrap; floating point, whose sums depend on the brackets; text,
/// pointers and enumerations, which do not multiply; and bounded integers that are not C++ integers, such as __int128
/// in strict mode, because their overflow cannot be checked.
template <class T>
concept integer_coefficient =
    std::regular<T> && std::totally_ordered<T> && !std::unsigned_integral<T> && !std::floating_point<T> &&
    (std::signed_integral<T> || std::is_class_v<T>) && requires(T const& a, T const& b) {
      T{-1};
      { a + b } -> std::convertible_to<T>;
      requires std::convertible_to<decltype(a * b), T>;
    };

/// An integer n by which deltas are multiplied. It is never narrowed to the coefficient type; only the products must fit.
///
/// Refuses floating point, whose fraction would be lost.
template <class N, class Coefficient>
concept integer_multiplier =
    integer_coefficient<Coefficient> && !std::floating_point<N> && !std::same_as<N, bool> &&
    (std::integral<Coefficient> ? std::integral<N> : std::convertible_to<N const&, Coefficient>);

namespace detail {

/// out = a + b; returns false if that is out of range. Types that are not C++ integers are exact and have no range.
template <integer_coefficient T>
constexpr bool add(T const& a, T const& b, T& out) {
  if constexpr (std::integral<T>) {
    return !__builtin_add_overflow(a, b, &out);
  } else {
    out = a + b;
    return true;
  }
}
/// out = a − b, likewise.
template <integer_coefficient T>
constexpr bool subtract(T const& a, T const& b, T& out) {
  if constexpr (std::integral<T>) {
    return !__builtin_sub_overflow(a, b, &out);
  } else {
    out = a + b * T{-1};
    return true;
  }
}
/// out = n·b, likewise.
template <integer_coefficient T, integer_multiplier<T> N>
constexpr bool multiply(N const& n, T const& b, T& out) {
  if constexpr (std::integral<T>) {
    return !__builtin_mul_overflow(n, b, &out);
  } else {
    out = static_cast<T>(n) * b;
    return true;
  }
}

}  // namespace detail

/// A finitely supported function Atoms → ℤ: an element of the free abelian group ℤ^(Atoms).
///
/// This is the abelian group of allocation events. The paper's events (Def. 3) are its elements with values in
/// {−1, 0, +1}, and the paper's composition (Def. 4) is its sum, clamped to them. Class invariant: entries strictly
/// ascending by atom, no count zero.
///
/// Laws: abelian group under `+` with identity `{}`; ℤ-module under `*`. @pre of `+`, `−`, `*`: no coefficient of the
/// result overflows; `checked_sum`, `checked_difference`, `checked_negation` and `checked_product` refuse instead.
/// Sums take O(|d| + |e|), and allocate only if |d| + |e| > 8.
template <ordered_atom Atom, integer_coefficient Coefficient = std::int64_t>
class delta {
public:
  using atom_type = Atom;
  using coefficient_type = Coefficient;
  using entry = multiple<Atom, Coefficient>;

  /// The identity 0.
  constexpr delta() = default;

  /// ι : event → delta, the embedding. Not a homomorphism: ι(s∘s) = ι(s) ≠ 2ι(s). O(|e|).
  constexpr explicit delta(event<Atom> const& e) {
    entries_.reserve(e.size());
    for (auto const& x : e) entries_.push_back({x.atom, static_cast<Coefficient>(to_int(x.value))});
  }
  /// χ(C), the characteristic function of a set. O(|C|).
  constexpr explicit delta(atom_set<Atom> const& c) {
    entries_.reserve(c.size());
    for (auto const& x : c) entries_.push_back({x, Coefficient{1}});
  }
  /// ι of an event, or χ of a set, in another storage: converted with `to_sparse` first.
  template <class X>
    requires requires(X const& x) { delta(to_sparse(x)); }
  constexpr explicit delta(X const& x) : delta(to_sparse(x)) {}
  /// The generator n·x.
  constexpr delta(Atom const& x, Coefficient n) {
    if (n != Coefficient{}) entries_.push_back({x, n});
  }

  [[nodiscard]] constexpr entry const* begin() const noexcept { return entries_.begin(); }
  [[nodiscard]] constexpr entry const* end() const noexcept { return entries_.end(); }
  /// The number of atoms with nonzero multiplicity.
  [[nodiscard]] constexpr std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] constexpr bool empty() const noexcept { return entries_.empty(); }

  /// δ(x). O(log n).
  [[nodiscard]] constexpr Coefficient operator()(Atom const& x) const {
    auto const* where =
        std::lower_bound(begin(), end(), x, [](entry const& y, Atom const& key) { return y.atom < key; });
    return where != end() && where->atom == x ? where->count : Coefficient{};
  }

  friend bool operator==(delta const&, delta const&) = default;
  /// A total order (lexicographic by entries), for keys only.
  friend auto operator<=>(delta const&, delta const&) = default;

  [[nodiscard]] friend constexpr delta operator+(delta const& d, delta const& e) { return checked(checked_sum(d, e)); }
  [[nodiscard]] friend constexpr delta operator-(delta const& d) { return checked(checked_negation(d)); }
  [[nodiscard]] friend constexpr delta operator-(delta const& d, delta const& e) {
    return checked(checked_difference(d, e));
  }
  template <integer_multiplier<Coefficient> N>
  [[nodiscard]] friend constexpr delta operator*(N const& n, delta const& d) {
    return checked(checked_product(n, d));
  }
  template <integer_multiplier<Coefficient> N>
  [[nodiscard]] friend constexpr delta operator*(delta const& d, N const& n) {
    return n * d;
  }
  constexpr delta& operator+=(delta const& e) { return *this = *this + e; }
  constexpr delta& operator-=(delta const& e) { return *this = *this - e; }

  /// The delta with these entries. @pre strictly ascending by atom, no count zero
  [[nodiscard]] static constexpr delta from_entries(small_vector<entry, 8> entries) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      ROTA_ASSERT(entries[i].count != Coefficient{});
      ROTA_ASSERT(i == 0 || entries[i - 1].atom < entries[i].atom);
    }
    delta d;
    d.entries_ = std::move(entries);
    return d;
  }

private:
  static constexpr delta checked(result<delta, coefficient_overflow<Atom>> r) {
    ROTA_ASSERT(r.has_value());
    return *std::move(r);
  }

  small_vector<entry, 8> entries_;
};

template <ordered_atom Atom>
delta(event<Atom>) -> delta<Atom>;
template <ordered_atom Atom>
delta(atom_set<Atom>) -> delta<Atom>;
template <class X>
  requires requires(X const& x) { to_sparse(x); }
delta(X) -> delta<typename X::atom_type>;

namespace detail {

/// x ↦ combine(d(x), e(x)), or the least atom at which it overflows. @pre `combine(n, 0)` is n
template <ordered_atom Atom, integer_coefficient T, class F>
constexpr result<delta<Atom, T>, coefficient_overflow<Atom>> merge(delta<Atom, T> const& d, delta<Atom, T> const& e,
                                                                   F combine) {
  small_vector<multiple<Atom, T>, 8> entries;
  entries.reserve(d.size() + e.size());
  auto x = d.begin();
  for (auto const& y : e) {
    while (x != d.end() && x->atom < y.atom) entries.push_back(*x++);
    bool const both = x != d.end() && !(y.atom < x->atom);
    T n{};
    if (!combine(both ? x->count : T{}, y.count, n)) return refused{coefficient_overflow<Atom>{y.atom}};
    if (n != T{}) entries.push_back({y.atom, n});
    x += both;
  }
  for (; x != d.end(); ++x) entries.push_back(*x);
  return delta<Atom, T>::from_entries(std::move(entries));
}

}  // namespace detail

/// d + e, or the least atom whose multiplicity overflows. O(|d| + |e|).
template <ordered_atom Atom, integer_coefficient T>
[[nodiscard]] constexpr result<delta<Atom, T>, coefficient_overflow<Atom>> checked_sum(delta<Atom, T> const& d,
                                                                                       delta<Atom, T> const& e) {
  return detail::merge(d, e, detail::add<T>);
}
/// d − e, likewise. Refused only if d(x) − e(x) overflows; whether −e(x) does is irrelevant.
template <ordered_atom Atom, integer_coefficient T>
[[nodiscard]] constexpr result<delta<Atom, T>, coefficient_overflow<Atom>> checked_difference(delta<Atom, T> const& d,
                                                                                              delta<Atom, T> const& e) {
  return detail::merge(d, e, detail::subtract<T>);
}
/// −d, likewise: the least number of a bounded type cannot be negated. O(|d|).
template <ordered_atom Atom, integer_coefficient T>
[[nodiscard]] constexpr result<delta<Atom, T>, coefficient_overflow<Atom>> checked_negation(delta<Atom, T> const& d) {
  return checked_difference({}, d);
}
/// n·d, likewise, for any integer n. O(|d|).
template <ordered_atom Atom, integer_coefficient T, integer_multiplier<T> N>
[[nodiscard]] constexpr result<delta<Atom, T>, coefficient_overflow<Atom>> checked_product(N const& n,
                                                                                           delta<Atom, T> const& d) {
  small_vector<multiple<Atom, T>, 8> entries;
  entries.reserve(d.size());
  for (auto const& x : d) {
    T product{};
    if (!detail::multiply(n, x.count, product)) return refused{coefficient_overflow<Atom>{x.atom}};
    if (product != T{}) entries.push_back({x.atom, product});
  }
  return delta<Atom, T>::from_entries(std::move(entries));
}

/// ρ : delta → event, the clamp into [−1, +1]. ρ(ι(e)) = e and compose(e, f) = ρ(ι(e) + ι(f)). Not a homomorphism.
/// O(|d|).
template <ordered_atom Atom, integer_coefficient Coefficient>
[[nodiscard]] constexpr event<Atom> clamp(delta<Atom, Coefficient> const& d) {
  small_vector<signed_atom<Atom>, 8> entries;
  entries.reserve(d.size());
  for (auto const& x : d) entries.push_back({x.atom, x.count > Coefficient{} ? sign::plus : sign::minus});
  return event<Atom>::from_entries(std::move(entries));
}

/// The universal property: the only homomorphism delta → G that sends each generator x to f(x), evaluated at d.
///
/// `G` is an abelian group written with `+` and `count * g`; `zero` is its identity. O(|d|) calls.
template <ordered_atom Atom, integer_coefficient Coefficient, class G, std::invocable<Atom const&> F>
[[nodiscard]] constexpr G extend(delta<Atom, Coefficient> const& d, F&& f, G zero) {
  for (auto const& x : d) zero = zero + x.count * f(x.atom);
  return zero;
}

}  // namespace rota
