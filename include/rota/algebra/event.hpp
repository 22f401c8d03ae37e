#pragma once

#include <rota/algebra/atom_set.hpp>
#include <rota/algebra/detail/merge.hpp>
#include <rota/core/result.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>

namespace rota {

/// The value of an event on one atom: −1 subtracted, 0 not mentioned, +1 added.
enum class sign : std::int8_t { minus = -1, zero = 0, plus = 1 };

[[nodiscard]] constexpr int to_int(sign s) noexcept { return static_cast<int>(s); }

/// n clamped into [−1, +1].
[[nodiscard]] constexpr sign clamp_to_sign(int n) noexcept { return static_cast<sign>((n > 0) - (n < 0)); }

/// clamp(s + t) into [−1, +1]: Def. 4 at one atom. Commutative, with identity and unique inverses; not associative.
[[nodiscard]] constexpr sign clamped_sum(sign s, sign t) noexcept { return clamp_to_sign(to_int(s) + to_int(t)); }

/// One entry of an event. The stored sign is never zero.
template <ordered_atom Atom>
struct signed_atom {
  Atom atom{};
  sign value = sign::plus;

  friend auto operator<=>(signed_atom const&, signed_atom const&) = default;
};

/// Refusal: this atom is both added and subtracted, so the two sets are not an event (Def. 3).
template <ordered_atom Atom>
struct overlap {
  Atom witness{};
  friend bool operator==(overlap const&, overlap const&) = default;
};

template <ordered_atom Atom>
class event;
// Declared before the class, whose friend names one specialisation: clang 16 takes a constrained friend template for
// another function.
template <ordered_atom Atom>
[[nodiscard]] constexpr event<Atom> compose(event<Atom> const& e, event<Atom> const& f);

/// An allocation event e = (ϑ⁺, ϑ⁻) of Def. 3: a finitely supported sign function Atoms → {−1, 0, +1}.
///
/// Class invariant: entries strictly ascending by atom, no sign zero; hence ϑ⁺ ∩ ϑ⁻ = ∅. Up to eight entries are stored
/// inside the object.
///
/// Laws under `compose` (Def. 4): closed; `{}` is the identity; `inverse(e)` is the only f with compose(e, f) = {};
/// commutative. Not associative and not cancellative, since e∘e = e. So events are not a group; `delta` is one.
template <ordered_atom Atom>
class event {
public:
  using atom_type = Atom;
  using set_type = atom_set<Atom>;
  using entry = signed_atom<Atom>;

  /// The identity (∅, ∅).
  constexpr event() = default;

  /// (ϑ⁺, ϑ⁻), or the least atom that is in both. O(|ϑ⁺| + |ϑ⁻|).
  [[nodiscard]] static constexpr result<event, overlap<Atom>> make(atom_set<Atom> const& additions,
                                                                   atom_set<Atom> const& subtractions) {
    event e;
    auto a = additions.begin();
    auto s = subtractions.begin();
    while (a != additions.end() || s != subtractions.end()) {
      if (s == subtractions.end() || (a != additions.end() && *a < *s)) {
        e.entries_.push_back({*a++, sign::plus});
      } else if (a == additions.end() || *s < *a) {
        e.entries_.push_back({*s++, sign::minus});
      } else {
        return refused{overlap<Atom>{*a}};
      }
    }
    return e;
  }

  /// ({x}, ∅).
  [[nodiscard]] static constexpr event addition(Atom const& x) { return single(x, sign::plus); }
  /// (∅, {x}).
  [[nodiscard]] static constexpr event subtraction(Atom const& x) { return single(x, sign::minus); }

  /// The entries, ascending by atom.
  [[nodiscard]] constexpr entry const* begin() const noexcept { return entries_.begin(); }
  [[nodiscard]] constexpr entry const* end() const noexcept { return entries_.end(); }
  [[nodiscard]] constexpr std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] constexpr bool empty() const noexcept { return entries_.empty(); }

  /// e(x). O(log n).
  [[nodiscard]] constexpr sign operator()(Atom const& x) const {
    auto const* where =
        std::lower_bound(begin(), end(), x, [](entry const& y, Atom const& key) { return y.atom < key; });
    return where != end() && where->atom == x ? where->value : sign::zero;
  }
  /// ϑ⁺.
  [[nodiscard]] constexpr atom_set<Atom> additions() const { return part(sign::plus); }
  /// ϑ⁻.
  [[nodiscard]] constexpr atom_set<Atom> subtractions() const { return part(sign::minus); }

  friend bool operator==(event const&, event const&) = default;
  /// A total order (lexicographic by entries), for keys only.
  friend auto operator<=>(event const&, event const&) = default;

  /// The event with these entries. @pre strictly ascending by atom, no sign zero
  [[nodiscard]] static constexpr event from_entries(small_vector<entry, 8> entries) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      ROTA_ASSERT(entries[i].value != sign::zero);
      ROTA_ASSERT(i == 0 || entries[i - 1].atom < entries[i].atom);
    }
    event e;
    e.entries_ = std::move(entries);
    return e;
  }

  friend constexpr event compose<Atom>(event const&, event const&);

private:
  static constexpr event single(Atom const& x, sign s) {
    event e;
    e.entries_.push_back({x, s});
    return e;
  }
  constexpr atom_set<Atom> part(sign s) const {
    small_vector<Atom, 8> atoms;
    for (entry const& x : entries_)
      if (x.value == s) atoms.push_back(x.atom);
    return atom_set<Atom>::from_ascending(std::move(atoms));
  }

  small_vector<entry, 8> entries_;
};

/// e ∘ f of Def. 4, to the letter: at each atom the clamped sum. Not an operator, because brackets matter.
/// O(|e| + |f|). Allocates only if |e| + |f| > 8.
template <ordered_atom Atom>
[[nodiscard]] constexpr event<Atom> compose(event<Atom> const& e, event<Atom> const& f) {
  event<Atom> r;
  r.entries_.append(e.size() + f.size(),
                    [&](signed_atom<Atom>* out) { return detail::merge(e.begin(), e.end(), f.begin(), f.end(), out); });
  return r;
}

/// (ϑ⁻, ϑ⁺): the only event that composes with e to the identity. O(|e|).
template <ordered_atom Atom>
[[nodiscard]] constexpr event<Atom> inverse(event<Atom> const& e) {
  small_vector<signed_atom<Atom>, 8> entries(e.begin(), e.end());
  for (auto& x : entries) x.value = x.value == sign::plus ? sign::minus : sign::plus;
  return event<Atom>::from_entries(std::move(entries));
}

}  // namespace rota
