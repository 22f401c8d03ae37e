#pragma once

#include <rota/algebra/allocation_event.hpp>
#include <rota/algebra/delta.hpp>

#include <utility>

namespace rota {

/// Refusal: two arrows do not meet. The witness is the least atom in which the target of the first and the source of
/// the second differ.
template <ordered_atom Atom>
struct arrows_do_not_meet {
  Atom witness{};
  friend bool operator==(arrows_do_not_meet const&, arrows_do_not_meet const&) = default;
};

/// An arrow C → C′ of the pair groupoid of atom sets: an allocation before and after a change. The sets may be
/// `atom_set`, `dense_atom_set` or another `allocation_set`.
///
/// Exactly one arrow leads from one set to another. Composition is partial: the target of the first must be the source
/// of the second. It is associative where it is defined, every arrow is invertible, and each set has an identity. So
/// this is a groupoid and not a group. `event_of` maps arrows to events, `delta_of` is a functor to the group of
/// deltas. Sets over a finite universe: @pre both are over the same universe.
template <allocation_set Set>
class transition {
public:
  using set_type = Set;
  using event_type = event_on<Set>;
  using atom_type = typename event_type::atom_type;

  /// The identity of ∅.
  constexpr transition() = default;
  constexpr transition(Set source, Set target) : source_(std::move(source)), target_(std::move(target)) {}
  /// C → C.
  [[nodiscard]] static constexpr transition identity(Set const& c) { return {c, c}; }
  /// C → e·C, or the least atom at which e is not applicable. As fast as `apply`.
  [[nodiscard]] static constexpr result<transition, inapplicable<atom_type>> make(Set const& c, event_type const& e) {
    auto target = apply(e, c);
    if (!target) return refused{target.error()};
    return transition{c, *std::move(target)};
  }

  [[nodiscard]] constexpr Set const& source() const noexcept { return source_; }
  [[nodiscard]] constexpr Set const& target() const noexcept { return target_; }

  friend bool operator==(transition const&, transition const&) = default;

private:
  Set source_;
  Set target_;
};

/// Whether `compose(t, u)` is defined: target(t) = source(u).
template <allocation_set Set>
[[nodiscard]] constexpr bool composable(transition<Set> const& t, transition<Set> const& u) {
  return t.target() == u.source();
}

/// (C → C′), (C′ → C″) ↦ (C → C″). @pre `composable(t, u)`
template <allocation_set Set>
[[nodiscard]] constexpr transition<Set> compose(transition<Set> const& t, transition<Set> const& u) {
  ROTA_ASSERT(composable(t, u));
  return {t.source(), u.target()};
}

/// As `compose`, but refuses arrows that do not meet. O(|C′|).
template <allocation_set Set>
[[nodiscard]] constexpr result<transition<Set>, arrows_do_not_meet<typename transition<Set>::atom_type>>
checked_compose(transition<Set> const& t, transition<Set> const& u) {
  // The event leads from one set to the other. At the other set, it is not applicable at any of its atoms.
  auto const meet = apply(difference(t.target(), u.source()), u.source());
  if (!meet) return refused{arrows_do_not_meet<typename transition<Set>::atom_type>{meet.error().witness}};
  return compose(t, u);
}

/// C′ → C.
template <allocation_set Set>
[[nodiscard]] constexpr transition<Set> inverse(transition<Set> const& t) {
  return {t.target(), t.source()};
}

/// diff(C, C′), the event along the arrow. Laws: compose(event_of(t), event_of(u)) = event_of(compose(t, u)).
template <allocation_set Set>
[[nodiscard]] constexpr event_on<Set> event_of(transition<Set> const& t) {
  return difference(t.source(), t.target());
}

/// χ(C′) − χ(C): the functor to the group of deltas, so delta_of(compose(t, u)) = delta_of(t) + delta_of(u).
template <allocation_set Set>
[[nodiscard]] constexpr delta<typename transition<Set>::atom_type> delta_of(transition<Set> const& t) {
  return delta<typename transition<Set>::atom_type>(event_of(t));
}

}  // namespace rota
