#pragma once

#include <rota/algebra/action.hpp>
#include <rota/algebra/delta.hpp>

#include <utility>

namespace rota {

/// Refusal: two arrows that do not meet, and an atom on which the target of the first and the source of the second differ.
template <ordered_atom Atom>
struct arrows_do_not_meet {
  Atom witness{};
  friend bool operator==(arrows_do_not_meet const&, arrows_do_not_meet const&) = default;
};

/// An arrow C → C′ of the pair groupoid of atom sets: what an allocation was, and what it became.
///
/// Any two sets are joined by exactly one arrow. Composition is partial: the target of the first must be the source of
/// the second. It is associative where defined, every arrow is invertible, and there is an identity per set; this is a
/// groupoid, not a group. `event_of` is its shadow in the events, `delta_of` a functor to the group of deltas.
template <ordered_atom Atom>
class transition {
public:
  using atom_type = Atom;

  /// The identity of ∅.
  constexpr transition() = default;
  constexpr transition(atom_set<Atom> source, atom_set<Atom> target)
      : source_(std::move(source)), target_(std::move(target)) {}
  /// C → C.
  [[nodiscard]] static constexpr transition identity(atom_set<Atom> const& c) { return {c, c}; }
  /// C → e·C, or the least atom at which e is not applicable. O(|e| + |C|).
  [[nodiscard]] static constexpr result<transition, inapplicable<Atom>> make(atom_set<Atom> const& c,
                                                                             event<Atom> const& e) {
    auto target = apply(e, c);
    if (!target) return refused{target.error()};
    return transition{c, *std::move(target)};
  }

  [[nodiscard]] constexpr atom_set<Atom> const& source() const noexcept { return source_; }
  [[nodiscard]] constexpr atom_set<Atom> const& target() const noexcept { return target_; }

  friend bool operator==(transition const&, transition const&) = default;

private:
  atom_set<Atom> source_;
  atom_set<Atom> target_;
};

/// Whether `compose(t, u)` is defined: target(t) = source(u).
template <ordered_atom Atom>
[[nodiscard]] constexpr bool composable(transition<Atom> const& t, transition<Atom> const& u) {
  return t.target() == u.source();
}

/// (C → C′), (C′ → C″) ↦ (C → C″). @pre `composable(t, u)`
template <ordered_atom Atom>
[[nodiscard]] constexpr transition<Atom> compose(transition<Atom> const& t, transition<Atom> const& u) {
  ROTA_ASSERT(composable(t, u));
  return {t.source(), u.target()};
}

/// As `compose`, refusing arrows that do not meet. O(|C′|).
template <ordered_atom Atom>
[[nodiscard]] constexpr result<transition<Atom>, arrows_do_not_meet<Atom>> checked_compose(transition<Atom> const& t,
                                                                                           transition<Atom> const& u) {
  auto const gap = difference(t.target(), u.source());
  if (!gap.empty()) return refused{arrows_do_not_meet<Atom>{gap.begin()->atom}};
  return compose(t, u);
}

/// C′ → C.
template <ordered_atom Atom>
[[nodiscard]] constexpr transition<Atom> inverse(transition<Atom> const& t) {
  return {t.target(), t.source()};
}

/// diff(C, C′), the event that the arrow is. Laws: compose(event_of(t), event_of(u)) = event_of(compose(t, u)).
template <ordered_atom Atom>
[[nodiscard]] constexpr event<Atom> event_of(transition<Atom> const& t) {
  return difference(t.source(), t.target());
}

/// χ(C′) − χ(C): the functor to the group of deltas, so delta_of(compose(t, u)) = delta_of(t) + delta_of(u).
template <ordered_atom Atom>
[[nodiscard]] constexpr delta<Atom> delta_of(transition<Atom> const& t) {
  return delta<Atom>(event_of(t));
}

}  // namespace rota
