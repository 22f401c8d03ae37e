#pragma once

#include <rota/algebra/apply.hpp>
#include <rota/algebra/dense_atom_set.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace rota {

/// An allocation event of Def. 3 over a finite universe, in two bit planes: e⁺ and e⁻.
///
/// It has the same laws and results as `event`, in another storage. Class invariant: no bit is in both planes. If the
/// type determines the universe, up to 64 atoms take two words, and `compose` six bit operations. If the universe is
/// known only at run time, up to 256 atoms live inside the object, more in one allocation. Operations take O(|U| / 64).
///
/// Laws under `compose` (Def. 4): closed, identity, unique inverses, commutative; not associative, not cancellative.
/// Operations on two events, or on an event and a set: @pre both are over the same universe.
template <atom_universe U>
class dense_event {
public:
  using atom_type = typename U::atom_type;
  using universe_type = U;
  using set_type = dense_atom_set<U>;
  using planes = detail::bit_planes<U, 2>;

  /// The identity (∅, ∅), over the empty universe if the type does not determine one.
  constexpr dense_event() = default;
  /// (∅, ∅) over this universe.
  constexpr explicit dense_event(U const& universe) : bits_(universe) {}

  /// (ϑ⁺, ϑ⁻), or the least atom that is in both.
  [[nodiscard]] static constexpr result<dense_event, overlap<atom_type>> make(set_type const& additions,
                                                                              set_type const& subtractions) {
    ROTA_ASSERT(additions.universe() == subtractions.universe());
    auto const p = additions.words();
    auto const m = subtractions.words();
    auto const both = detail::lowest_bit(p.size(), [&](std::size_t i) { return p[i] & m[i]; });
    if (both < 64 * p.size()) return refused{overlap<atom_type>{additions.universe().atom_at(both)}};
    return from_words(additions.universe(), [&](std::size_t i) { return std::array{p[i], m[i]}; });
  }
  /// ({x}, ∅), or x if it is outside the universe.
  [[nodiscard]] static constexpr result<dense_event, outside_universe<atom_type>> addition(atom_type const& x,
                                                                                           U const& universe = {}) {
    return single(x, sign::plus, universe);
  }
  /// (∅, {x}), or x if it is outside the universe.
  [[nodiscard]] static constexpr result<dense_event, outside_universe<atom_type>> subtraction(atom_type const& x,
                                                                                              U const& universe = {}) {
    return single(x, sign::minus, universe);
  }

  [[nodiscard]] constexpr U const& universe() const noexcept { return bits_.universe(); }
  /// The number of atoms with a sign.
  [[nodiscard]] constexpr std::size_t size() const noexcept {
    return detail::count_bits(bits_.plane(0), 2 * bits_.words());
  }
  [[nodiscard]] constexpr bool empty() const noexcept { return detail::all_zero(bits_.plane(0), 2 * bits_.words()); }

  /// e(x); zero outside the universe. O(1) and one `index_of`.
  [[nodiscard]] constexpr sign operator()(atom_type const& x) const {
    auto const i = universe().index_of(x);
    if (!i) return sign::zero;
    return bits_.test(0, *i) ? sign::plus : bits_.test(1, *i) ? sign::minus : sign::zero;
  }
  /// ϑ⁺.
  [[nodiscard]] constexpr set_type additions() const { return part(plus()); }
  /// ϑ⁻.
  [[nodiscard]] constexpr set_type subtractions() const { return part(minus()); }
  /// The words of ϑ⁺: bit i % 64 of word i / 64 stands for the i-th atom.
  [[nodiscard]] constexpr std::span<std::uint64_t const> plus() const noexcept {
    return {bits_.plane(0), bits_.words()};
  }
  /// The words of ϑ⁻.
  [[nodiscard]] constexpr std::span<std::uint64_t const> minus() const noexcept {
    return {bits_.plane(1), bits_.words()};
  }

  friend bool operator==(dense_event const&, dense_event const&) = default;

  /// The event whose words i are `words_at(i)`: {of ϑ⁺, of ϑ⁻}. @pre disjoint, no bit beyond the universe
  template <std::invocable<std::size_t> F>
  [[nodiscard]] static constexpr dense_event from_words(U const& universe, F&& words_at) {
    dense_event e(universe, words_at);
    for (std::size_t i = 0; i < e.plus().size(); ++i) ROTA_ASSERT((e.plus()[i] & e.minus()[i]) == 0);
    ROTA_ASSERT(e.bits_.within_universe());
    return e;
  }

private:
  // Constructed in place: the planes of a fixed universe may be large, and moving copies them.
  template <std::invocable<std::size_t> F>
  constexpr dense_event(U const& universe, F& words_at) : bits_(universe, words_at) {}
  static constexpr result<dense_event, outside_universe<atom_type>> single(atom_type const& x, sign s,
                                                                           U const& universe) {
    auto const i = universe.index_of(x);
    if (!i) return refused{i.error()};
    dense_event e(universe);
    e.bits_.set(s == sign::plus ? 0 : 1, *i, true);
    return e;
  }
  constexpr set_type part(std::span<std::uint64_t const> words) const {
    return set_type::from_words(universe(), [&](std::size_t i) { return words[i]; });
  }

  planes bits_;
};

/// e as a dense event, or its least atom outside the universe. O(|e|) look-ups.
template <atom_universe U>
[[nodiscard]] constexpr result<dense_event<U>, outside_universe<typename U::atom_type>>
to_dense(event<typename U::atom_type> const& e, U const& universe) {
  dense_atom_set<U> plus(universe), minus(universe);
  for (auto const& x : e)
    if (auto const inserted = (x.value == sign::plus ? plus : minus).insert(x.atom); !inserted)
      return refused{inserted.error()};
  return dense_event<U>::from_words(
      universe, [p = plus.words().data(), m = minus.words().data()](std::size_t i) { return std::array{p[i], m[i]}; });
}

/// The same event as an `event`. O(|e| + |U| / 64).
template <atom_universe U>
[[nodiscard]] constexpr event<typename U::atom_type> to_sparse(dense_event<U> const& e) {
  small_vector<signed_atom<typename U::atom_type>, 8> entries;
  auto const p = e.plus();
  auto const m = e.minus();
  detail::for_each_bit(
      p.size(), [&](std::size_t i) { return p[i] | m[i]; },
      [&](std::size_t i) {
        entries.push_back({e.universe().atom_at(i), (p[i / 64] >> (i % 64) & 1) != 0 ? sign::plus : sign::minus});
      });
  return event<typename U::atom_type>::from_entries(std::move(entries));
}

/// e ∘ f of Def. 4: ((e⁺ ∖ f⁻) ∪ (f⁺ ∖ e⁻), (e⁻ ∖ f⁺) ∪ (f⁻ ∖ e⁺)). Brackets matter, so this is no operator.
template <atom_universe U>
[[nodiscard]] constexpr dense_event<U> compose(dense_event<U> const& e, dense_event<U> const& f) {
  ROTA_ASSERT(e.universe() == f.universe());
  auto const composed = [e_plus = e.plus().data(), e_minus = e.minus().data(), f_plus = f.plus().data(),
                         f_minus = f.minus().data()](std::size_t i) {
    // Equal to the definition, and shorter, because neither event has a bit in both planes. There is no complement: for
    // AVX-512, g++ 12 turns two of them into a chain from one composition to the next.
    auto const added = e_plus[i] | f_plus[i];
    auto const subtracted = e_minus[i] | f_minus[i];
    auto const cancelled = added & subtracted;
    return std::array{added ^ cancelled, subtracted ^ cancelled};
  };
  return dense_event<U>::from_words(e.universe(), composed);
}

/// The atoms at which (e∘f)∘g and e∘(f∘g) differ: e and g have opposite signs there, and f has one.
template <atom_universe U>
[[nodiscard]] constexpr dense_atom_set<U> non_associating_atoms(dense_event<U> const& e, dense_event<U> const& f,
                                                                dense_event<U> const& g) {
  ROTA_ASSERT(e.universe() == f.universe() && f.universe() == g.universe());
  return dense_atom_set<U>::from_words(e.universe(), [&](std::size_t i) {
    auto const opposite = (e.plus()[i] & g.minus()[i]) | (e.minus()[i] & g.plus()[i]);
    return opposite & (f.plus()[i] | f.minus()[i]);
  });
}
/// Whether (e∘f)∘g = e∘(f∘g). Decided by the signs, without composing.
template <atom_universe U>
[[nodiscard]] constexpr bool associates(dense_event<U> const& e, dense_event<U> const& f, dense_event<U> const& g) {
  return non_associating_atoms(e, f, g).empty();
}

/// (ϑ⁻, ϑ⁺): the only event that composes with e to the identity.
template <atom_universe U>
[[nodiscard]] constexpr dense_event<U> inverse(dense_event<U> const& e) {
  return dense_event<U>::from_words(
      e.universe(), [p = e.plus().data(), m = e.minus().data()](std::size_t i) { return std::array{m[i], p[i]}; });
}

/// diff(C, C′) = (C′ ∖ C, C ∖ C′): the only event that is applicable at C and turns it into C′.
template <atom_universe U>
[[nodiscard]] constexpr dense_event<U> difference(dense_atom_set<U> const& before, dense_atom_set<U> const& after) {
  ROTA_ASSERT(before.universe() == after.universe());
  return dense_event<U>::from_words(before.universe(),
                                    [b = before.words().data(), a = after.words().data()](std::size_t i) {
                                      return std::array{a[i] & ~b[i], b[i] & ~a[i]};
                                    });
}

namespace detail {

/// The index of the least atom at which e is not applicable at c, or 64 times the number of words if there is none.
template <atom_universe U>
constexpr std::size_t least_offence(dense_event<U> const& e, dense_atom_set<U> const& c) {
  ROTA_ASSERT(e.universe() == c.universe());
  return lowest_bit(c.words().size(), [p = e.plus().data(), m = e.minus().data(), in = c.words().data()](
                                          std::size_t i) { return (p[i] & in[i]) | (m[i] & ~in[i]); });
}

}  // namespace detail

/// Whether e⁺ ∩ C = ∅ and e⁻ ⊆ C.
template <atom_universe U>
[[nodiscard]] constexpr bool applicable(dense_event<U> const& e, dense_atom_set<U> const& c) {
  return detail::least_offence(e, c) == 64 * c.words().size();
}

/// e·C = (C ∖ e⁻) ∪ e⁺ if e is applicable at C, else the least atom at which it is not.
template <atom_universe U>
[[nodiscard]] constexpr result<dense_atom_set<U>, inapplicable<typename U::atom_type>>
apply(dense_event<U> const& e, dense_atom_set<U> const& c) {
  auto const offence = detail::least_offence(e, c);
  if (offence < 64 * c.words().size())
    return refused{inapplicable<typename U::atom_type>{e.universe().atom_at(offence)}};
  return dense_atom_set<U>::from_words(c.universe(), [p = e.plus().data(), m = e.minus().data(), in = c.words().data()](
                                                         std::size_t i) { return (in[i] & ~m[i]) | p[i]; });
}

}  // namespace rota
