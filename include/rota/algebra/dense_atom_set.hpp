#pragma once

#include <rota/algebra/detail/bit_planes.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace rota {

/// A set of atoms of a finite universe, one bit per atom. Use it instead of `atom_set` if the universe is small or the
/// sets are large.
///
/// If the type determines the universe, up to 64 atoms take one word. Every operation takes O(|U| / 64).
/// Operations on two sets: @pre both are over the same universe.
template <atom_universe U>
class dense_atom_set {
public:
  using atom_type = typename U::atom_type;
  using universe_type = U;
  using planes = detail::bit_planes<U, 1>;

  /// ∅, over the empty universe if the type does not determine one.
  constexpr dense_atom_set() = default;
  /// ∅ over this universe.
  constexpr explicit dense_atom_set(U const& universe) : bits_(universe) {}

  [[nodiscard]] constexpr U const& universe() const noexcept { return bits_.universe(); }
  [[nodiscard]] constexpr std::size_t size() const noexcept {
    return detail::count_bits(words().data(), words().size());
  }
  [[nodiscard]] constexpr bool empty() const noexcept { return detail::all_zero(words().data(), words().size()); }
  /// Bit i % 64 of word i / 64 tells whether the i-th atom is in the set.
  [[nodiscard]] constexpr std::span<std::uint64_t const> words() const noexcept {
    return {bits_.plane(0), bits_.words()};
  }

  /// x ∈ C; false outside the universe. O(1) and one `index_of`, like the two below.
  [[nodiscard]] constexpr bool contains(atom_type const& x) const {
    auto const i = universe().index_of(x);
    return i.has_value() && bits_.test(0, *i);
  }
  /// C ← C ∪ {x}; whether x was new. Refused if x is outside the universe.
  constexpr result<bool, outside_universe<atom_type>> insert(atom_type const& x) { return put(x, true); }
  /// C ← C ∖ {x}; whether x was there.
  constexpr bool erase(atom_type const& x) {
    auto const changed = put(x, false);
    return changed.has_value() && *changed;
  }

  friend bool operator==(dense_atom_set const&, dense_atom_set const&) = default;

  /// The set whose word i is `word_at(i)`. @pre no word has a bit beyond the universe
  template <std::invocable<std::size_t> F>
  [[nodiscard]] static constexpr dense_atom_set from_words(U const& universe, F&& word_at) {
    auto const words_at = [&](std::size_t i) { return std::array{word_at(i)}; };
    dense_atom_set c(universe, words_at);
    ROTA_ASSERT(c.bits_.within_universe());
    return c;
  }

private:
  // Constructed in place, like `dense_event`.
  template <std::invocable<std::size_t> F>
  constexpr dense_atom_set(U const& universe, F& words_at) : bits_(universe, words_at) {}
  constexpr result<bool, outside_universe<atom_type>> put(atom_type const& x, bool value) {
    auto const i = universe().index_of(x);
    if (!i) return refused{i.error()};
    bool const changed = bits_.test(0, *i) != value;
    bits_.set(0, *i, value);
    return changed;
  }

  planes bits_;
};

/// C as a dense set, or its least atom outside the universe. O(|C|) look-ups.
template <atom_universe U>
[[nodiscard]] constexpr result<dense_atom_set<U>, outside_universe<typename U::atom_type>>
to_dense(atom_set<typename U::atom_type> const& c, U const& universe) {
  dense_atom_set<U> r(universe);
  for (auto const& x : c)
    if (auto const inserted = r.insert(x); !inserted) return refused{inserted.error()};
  return r;
}

/// The same set as an `atom_set`. O(|C| + |U| / 64).
template <atom_universe U>
[[nodiscard]] constexpr atom_set<typename U::atom_type> to_sparse(dense_atom_set<U> const& c) {
  small_vector<typename U::atom_type, 8> atoms;
  auto const words = c.words();
  detail::for_each_bit(
      words.size(), [&](std::size_t i) { return words[i]; },
      [&](std::size_t i) { atoms.push_back(c.universe().atom_at(i)); });
  return atom_set<typename U::atom_type>::from_ascending(std::move(atoms));
}

/// C ∪ D.
template <atom_universe U>
[[nodiscard]] constexpr dense_atom_set<U> unite(dense_atom_set<U> const& c, dense_atom_set<U> const& d) {
  ROTA_ASSERT(c.universe() == d.universe());
  return dense_atom_set<U>::from_words(
      c.universe(), [a = c.words().data(), b = d.words().data()](std::size_t i) { return a[i] | b[i]; });
}
/// C ∩ D.
template <atom_universe U>
[[nodiscard]] constexpr dense_atom_set<U> intersect(dense_atom_set<U> const& c, dense_atom_set<U> const& d) {
  ROTA_ASSERT(c.universe() == d.universe());
  return dense_atom_set<U>::from_words(
      c.universe(), [a = c.words().data(), b = d.words().data()](std::size_t i) { return a[i] & b[i]; });
}
/// C ∖ D.
template <atom_universe U>
[[nodiscard]] constexpr dense_atom_set<U> subtract(dense_atom_set<U> const& c, dense_atom_set<U> const& d) {
  ROTA_ASSERT(c.universe() == d.universe());
  return dense_atom_set<U>::from_words(
      c.universe(), [a = c.words().data(), b = d.words().data()](std::size_t i) { return a[i] & ~b[i]; });
}
/// C ⊆ D.
template <atom_universe U>
[[nodiscard]] constexpr bool is_subset(dense_atom_set<U> const& c, dense_atom_set<U> const& d) {
  ROTA_ASSERT(c.universe() == d.universe());
  std::uint64_t missing = 0;
  for (std::size_t i = 0; i < c.words().size(); ++i) missing |= c.words()[i] & ~d.words()[i];
  return missing == 0;
}

}  // namespace rota
