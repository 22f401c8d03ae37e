#pragma once

#include <rota/algebra/event.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace rota {

/// Refusal: the multiplicity of this atom would leave the range of the coefficient type. Nothing saturates.
template <ordered_atom Atom>
struct coefficient_overflow {
  Atom witness{};
  friend bool operator==(coefficient_overflow const&, coefficient_overflow const&) = default;
};

/// One entry of a delta; the stored multiplicity is never zero.
template <ordered_atom Atom, class Coefficient>
struct multiple {
  Atom atom{};
  Coefficient count{};

  friend auto operator<=>(multiple const&, multiple const&) = default;
};

/// What stands for ℤ: signed integers, or an exact big integer, which has numbers, an order, sums and products.
///
/// Refuses unsigned types, which hold no −1, so that ι would wrap; floating point, whose sums depend on the brackets; text,
/// pointers and enumerations, which do not multiply; and integers that are bounded and no C++ integers, such as __int128
/// in strict mode, whose overflow nobody could check.
template <class T>
concept integer_coefficient =
    std::regular<T> && std::totally_ordered<T> && !std::unsigned_integral<T> && !std::floating_point<T> &&
    (std::signed_integral<T> || std::is_class_v<T>) && requires(T const& a, T const& b) {
      T{-1};
      { a + b } -> std::convertible_to<T>;
      { a* b } -> std::convertible_to<T>;
    };

/// A finitely supported function Atoms → ℤ: an element of the free abelian group ℤ^(Atoms).
///
/// This is the abelian group of allocation events; the paper's events (Def. 3) are its elements with values in {−1, 0, +1},
/// and the paper's composition (Def. 4) is its sum, clamped. Class invariant: entries strictly ascending by atom, no count
/// zero.
///
/// Laws: abelian group under `+` with identity `{}`; ℤ-module under `*`. @pre of `+`, `−`, `*`: no coefficient overflows
/// (those of −e in d − e included); `checked_sum` refuses instead. Sums take O(|d| + |e|).
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

  [[nodiscard]] friend constexpr delta operator+(delta const& d, delta const& e) {
    auto sum = checked_sum(d, e);
    ROTA_ASSERT(sum.has_value());
    return *std::move(sum);
  }
  [[nodiscard]] friend constexpr delta operator-(delta const& d) { return d * Coefficient{-1}; }
  [[nodiscard]] friend constexpr delta operator-(delta const& d, delta const& e) { return d + -e; }
  [[nodiscard]] friend constexpr delta operator*(delta const& d, Coefficient const& n) {
    delta r;
    if (n == Coefficient{}) return r;
    r.entries_.reserve(d.size());
    for (entry const& x : d) {
      ROTA_ASSERT(product_fits(x.count, n));
      r.entries_.push_back({x.atom, static_cast<Coefficient>(x.count * n)});
    }
    return r;
  }
  [[nodiscard]] friend constexpr delta operator*(Coefficient const& n, delta const& d) { return d * n; }
  constexpr delta& operator+=(delta const& e) { return *this = *this + e; }
  constexpr delta& operator-=(delta const& e) { return *this = *this - e; }

  template <ordered_atom A, integer_coefficient C>
  friend constexpr result<delta<A, C>, coefficient_overflow<A>> checked_sum(delta<A, C> const&, delta<A, C> const&);

private:
  static constexpr bool sum_fits(Coefficient const& a, Coefficient const& b) {
    if constexpr (std::integral<Coefficient>) {
      using limits = std::numeric_limits<Coefficient>;
      return b >= 0 ? a <= limits::max() - b : a >= limits::min() - b;
    } else {
      return true;  // an exact integer type
    }
  }
  static constexpr bool product_fits(Coefficient const& a, Coefficient const& b) {
    if constexpr (std::integral<Coefficient>) {
      Coefficient out{};
      return !__builtin_mul_overflow(a, b, &out);
    } else {
      return true;
    }
  }

  small_vector<entry, 8> entries_;
};

template <ordered_atom Atom>
delta(event<Atom>) -> delta<Atom>;
template <ordered_atom Atom>
delta(atom_set<Atom>) -> delta<Atom>;

/// d + e, or the least atom whose multiplicity overflows. O(|d| + |e|).
template <ordered_atom Atom, integer_coefficient Coefficient>
[[nodiscard]] constexpr result<delta<Atom, Coefficient>, coefficient_overflow<Atom>>
checked_sum(delta<Atom, Coefficient> const& d, delta<Atom, Coefficient> const& e) {
  using group = delta<Atom, Coefficient>;
  group r;
  r.entries_.reserve(d.size() + e.size());
  auto x = d.begin();
  auto y = e.begin();
  while (x != d.end() && y != e.end()) {
    if (x->atom < y->atom) {
      r.entries_.push_back(*x++);
    } else if (y->atom < x->atom) {
      r.entries_.push_back(*y++);
    } else {
      if (!group::sum_fits(x->count, y->count)) return refused{coefficient_overflow<Atom>{x->atom}};
      auto const n = static_cast<Coefficient>(x->count + y->count);
      if (n != Coefficient{}) r.entries_.push_back({x->atom, n});
      ++x, ++y;
    }
  }
  for (; x != d.end(); ++x) r.entries_.push_back(*x);
  for (; y != e.end(); ++y) r.entries_.push_back(*y);
  return r;
}

/// ρ : delta → event, the clamp into [−1, +1]. ρ(ι(e)) = e and compose(e, f) = ρ(ι(e) + ι(f)); no homomorphism. O(|d|).
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
