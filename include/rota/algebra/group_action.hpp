#pragma once

#include <rota/algebra/group.hpp>

namespace rota {

/// How G acts on X, from the left and totally. Opting in is explicit: specialise with `static X act(G const&, X const&)`.
template <class G, class X>
struct action;

/// A group that moves the points of a set.
///
/// Laws: identity·x = x, (g·h)·x = g·(h·x); hence each g is a bijection of X, undone by inverse(g).
/// Refuses `event` and allocations: an event need not be applicable, and events are no group. Under `apply` the laws hold
/// where both sides exist.
template <class G, class X>
concept group_action = group<G> && std::regular<X> && requires(G const& g, X const& x) {
  { action<G, X>::act(g, x) } -> std::same_as<X>;
};

}  // namespace rota
