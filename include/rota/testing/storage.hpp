#pragma once

#include <rota/testing/arbitrary.hpp>
#include <rota/testing/event_laws.hpp>

#include <concepts>
#include <map>
#include <set>
#include <utility>

namespace rota::testing {

namespace detail {

template <class E, class S>
using atom_of = typename decltype(signs_of<S>(std::declval<E const&>()))::key_type;

template <class E, class S>
concept stored_by = requires(std::map<atom_of<E, S>, int> const& signs, std::set<atom_of<E, S>> const& members,
                             typename S::set_type const& c) {
  { S::event_with(signs) } -> std::same_as<E>;
  { S::set_with(members) } -> std::same_as<typename S::set_type>;
  { S::members(c) } -> std::same_as<std::set<atom_of<E, S>>>;
};

}  // namespace detail

/// S says how events E act on sets. Besides `set_type`, it has
/// * `static E difference(set_type const&, set_type const&)`;
/// * `static bool applicable(E const&, set_type const&)`;
/// * `static result<set_type, inapplicable<Atom>> apply(E const&, set_type const&)`, or a result that is used alike.
///
/// Unless E is an `allocation_event`, S also says how both are made and read, where Atom is the key of `signs(e)`:
/// * `static E event_with(std::map<Atom, int> const&)`: the event with these signs, as Def. 3 says;
/// * `static set_type set_with(std::set<Atom> const&)`: the set with these members;
/// * `static std::set<Atom> members(set_type const&)`.
template <class E, class S>
concept acts_on_sets =
    (allocation_event<E> || detail::stored_by<E, S>) && requires(E const& e, typename S::set_type const& c) {
      { S::difference(c, c) } -> std::same_as<E>;
      { S::applicable(e, c) } -> std::same_as<bool>;
      { *S::apply(e, c) } -> std::convertible_to<typename S::set_type>;
      S::apply(e, c).error().witness;
    };

/// Converts between the storage of S and `event` and `atom_set`, in which values are drawn, over the atoms of
/// `sample_atoms<Atom>`.
template <class E, class S>
  requires acts_on_sets<E, S>
struct storage {
  using atom_type = detail::atom_of<E, S>;
  using set_type = typename S::set_type;
  using sparse_event = event<atom_type>;
  using sparse_set = atom_set<atom_type>;

  [[nodiscard]] static E stored(sparse_event const& e) {
    if constexpr (requires(std::map<atom_type, int> const& signs) { S::event_with(signs); }) {
      std::map<atom_type, int> signs;
      for (auto const& x : e) signs.emplace(x.atom, to_int(x.value));
      return S::event_with(signs);
    } else {
      return E::make(stored(e.additions()), stored(e.subtractions())).value();
    }
  }
  [[nodiscard]] static set_type stored(sparse_set const& c) {
    if constexpr (requires(std::set<atom_type> const& members) { S::set_with(members); }) {
      return S::set_with({c.begin(), c.end()});
    } else {
      return stored_as<set_type>(c);
    }
  }

  [[nodiscard]] static sparse_event read(E const& e) {
    sparse_set plus;
    sparse_set minus;
    for (auto const& [x, s] : signs_of<S>(e)) (s > 0 ? plus : minus).insert(x);
    return sparse_event::make(plus, minus).value();
  }
  [[nodiscard]] static sparse_set read(set_type const& c) {
    if constexpr (requires { S::members(c); }) {
      auto const members = S::members(c);
      return sparse_set(members.begin(), members.end());
    } else {
      return sparse(c);
    }
  }

  /// Fails unless the two sides of an equation are equal, and shows both as `event` or `atom_set`.
  template <class T>
  static void same(char const* left_name, T const& left, char const* right_name, T const& right) {
    if (!(left == right))
      detail::refute_equation(left_name, rc::toString(read(left)), right_name, rc::toString(read(right)));
  }
};

}  // namespace rota::testing
