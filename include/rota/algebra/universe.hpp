#pragma once

#include <rota/algebra/atom_set.hpp>
#include <rota/core/atom.hpp>
#include <rota/core/result.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

namespace rota {

/// Refusal: this atom is not in the universe, so it has no bit.
template <ordered_atom Atom>
struct outside_universe {
  Atom witness{};
  friend bool operator==(outside_universe const&, outside_universe const&) = default;
};

/// A finite set of atoms that knows the index of each, as `dense_event` and `dense_atom_set` need it. Cheap to copy.
///
/// Laws: `index_of` and `atom_at` are inverse bijections between the universe and {0, …, size() − 1}, and keep the
/// order. `index_of(x)` refuses exactly the atoms outside the universe. @pre of `atom_at(i)`: i < size()
template <class U>
concept atom_universe = std::regular<U> && ordered_atom<typename U::atom_type> &&
                        requires(U const& u, typename U::atom_type const& x, std::size_t i) {
                          { u.size() } -> std::same_as<std::size_t>;
                          {
                            u.index_of(x)
                          } -> std::same_as<result<std::size_t, outside_universe<typename U::atom_type>>>;
                          { u.atom_at(i) } -> std::convertible_to<typename U::atom_type>;
                        };

/// A universe that its type determines. Sets and events over it allocate nothing and refer to nothing.
///
/// Refuses `listed_universe`, whose atoms are known only at run time.
template <class U>
concept fixed_universe =
    atom_universe<U> && std::is_empty_v<U> && requires { typename std::integral_constant<std::size_t, U::size()>; };

/// The numbers below N, for atoms that are indices already.
template <std::size_t N>
struct index_universe {
  using atom_type = std::size_t;

  [[nodiscard]] static constexpr std::size_t size() noexcept { return N; }
  [[nodiscard]] static constexpr result<std::size_t, outside_universe<std::size_t>> index_of(std::size_t x) noexcept {
    if (x >= N) return refused{outside_universe<std::size_t>{x}};
    return x;
  }
  [[nodiscard]] static constexpr std::size_t atom_at(std::size_t i) noexcept {
    ROTA_ASSERT(i < N);
    return i;
  }
  friend bool operator==(index_universe const&, index_universe const&) = default;
};

/// Names of one sort, strictly ascending, such as `name_list<task::attack, task::defend>`.
template <auto... Names>
  requires(sizeof...(Names) > 0)
struct name_list {
  static constexpr std::array names{Names...};
  static_assert(std::adjacent_find(names.begin(), names.end(), [](auto const& x, auto const& y) { return !(x < y); }) ==
                    names.end(),
                "the names of a name_list must be strictly ascending");

  [[nodiscard]] static constexpr std::size_t size() noexcept { return sizeof...(Names); }
  /// The place of x among the names, or `size()` if it is not one. O(log size()).
  [[nodiscard]] static constexpr std::size_t place_of(auto const& x) noexcept {
    auto const where = std::lower_bound(names.begin(), names.end(), x);
    return where != names.end() && *where == x ? static_cast<std::size_t>(where - names.begin()) : size();
  }
};

/// Agents × Plans × Tasks: every In(a, p, τ) over the listed names. If there are at most 64, a set takes one word.
template <vocabulary V, class Agents, class Plans, class Tasks>
struct in_universe {
  using atom_type = in<V>;

  [[nodiscard]] static constexpr std::size_t size() noexcept { return Agents::size() * Plans::size() * Tasks::size(); }
  [[nodiscard]] static constexpr result<std::size_t, outside_universe<atom_type>> index_of(atom_type const& x) {
    std::size_t const a = Agents::place_of(x.agent);
    std::size_t const p = Plans::place_of(x.plan);
    std::size_t const t = Tasks::place_of(x.task);
    if (a == Agents::size() || p == Plans::size() || t == Tasks::size()) return refused{outside_universe<atom_type>{x}};
    return (a * Plans::size() + p) * Tasks::size() + t;
  }
  [[nodiscard]] static constexpr atom_type atom_at(std::size_t i) {
    ROTA_ASSERT(i < size());
    return {Agents::names[i / (Plans::size() * Tasks::size())], Plans::names[i / Tasks::size() % Plans::size()],
            Tasks::names[i % Tasks::size()]};
  }
  friend bool operator==(in_universe const&, in_universe const&) = default;
};

/// A view of a set of atoms that is known only at run time, such as the atoms of a team read from plan files.
///
/// @pre the set neither moves nor changes while this universe, or anything over it, is in use
template <ordered_atom Atom>
class listed_universe {
public:
  using atom_type = Atom;

  /// The empty universe.
  constexpr listed_universe() = default;
  constexpr explicit listed_universe(atom_set<Atom> const& atoms) noexcept : atoms_(atoms.atoms()) {}
  listed_universe(atom_set<Atom>&&) = delete;

  [[nodiscard]] constexpr std::size_t size() const noexcept { return atoms_.size(); }
  /// O(log size()).
  [[nodiscard]] constexpr result<std::size_t, outside_universe<Atom>> index_of(Atom const& x) const {
    auto const where = std::lower_bound(atoms_.begin(), atoms_.end(), x);
    if (where == atoms_.end() || !(*where == x)) return refused{outside_universe<Atom>{x}};
    return static_cast<std::size_t>(where - atoms_.begin());
  }
  [[nodiscard]] constexpr Atom const& atom_at(std::size_t i) const {
    ROTA_ASSERT(i < size());
    return atoms_[i];
  }

  /// Whether the atoms are the same. O(1) for two views of one set, else O(size()).
  friend constexpr bool operator==(listed_universe const& u, listed_universe const& v) {
    return u.size() == v.size() &&
           (u.atoms_.data() == v.atoms_.data() || std::equal(u.atoms_.begin(), u.atoms_.end(), v.atoms_.begin()));
  }

private:
  std::span<Atom const> atoms_;
};

}  // namespace rota
