#pragma once
/// @file
/// The laws of cycles, Def. 5, for events E in any storage.

#include <rota/team/cycle.hpp>
#include <rota/testing/storage.hpp>

#include <concepts>
#include <vector>

namespace rota::testing {

namespace detail {

/// The agent of an atom: `S::agent(x)` if there is one, else a of In(a, p, τ).
template <class S, class Atom>
  requires requires(Atom const& x) { S::agent(x); } || requires(Atom const& x) { x.agent; }
[[nodiscard]] auto agent_of(Atom const& x) {
  if constexpr (requires { S::agent(x); })
    return S::agent(x);
  else
    return x.agent;
}
template <class E, class S>
concept has_own_cycles = requires(E const& e, typename storage<E, S>::atom_type const& x) {
  { S::is_cycle(e, e, agent_of<S>(x)) } -> std::same_as<bool>;
};
/// Whether there is an `is_cycle`: that of S, or that of the library, which is for In-atoms.
template <class E, class S>
concept knows_cycles = has_own_cycles<E, S> || requires(E const& e, typename storage<E, S>::atom_type const& x) {
  rota::is_cycle(e, e, agent_of<S>(x));
};

/// By `S::is_cycle` if there is one, else by the library's.
template <class S, class E, class Agent>
[[nodiscard]] bool says_cycle(E const& e_m, E const& e_r, Agent const& b) {
  if constexpr (requires { S::is_cycle(e_m, e_r, b); })
    return S::is_cycle(e_m, e_r, b);
  else
    return rota::is_cycle(e_m, e_r, b);
}
/// The atoms of c that are about b.
template <class S, class Atom, class Agent>
[[nodiscard]] atom_set<Atom> part_about(atom_set<Atom> const& c, Agent const& b) {
  atom_set<Atom> r;
  for (auto const& x : c)
    if (agent_of<S>(x) == b) r.insert(x);
  return r;
}

}  // namespace detail

/// silent_about_b, empty_message_is_no_event: Def. 5 as printed.
template <class E, class S = structure<E>>
[[nodiscard]] bundle cycle_laws() {
  using as = storage<E, S>;
  using Atom = typename as::atom_type;
  using sparse_event = typename as::sparse_event;
  bundle laws("definition_5");
  laws.add("silent_about_b", "e_m ≠ ∅: a cycle ⇔ e_m∘e_r has no In(b, ·, ·)",
           [] {
             auto const b = detail::agent_of<S>(*an_atom<Atom>().as("an atom of b"));
             auto const e_m = draw<sparse_event>("e_m");
             // e_r often undoes e_m, at all atoms or at some.
             std::vector<int> const undo =
                 *values(-1, 1).as("at the i-th atom e_r: 0 undoes e_m, 1 adds, -1 subtracts");
             std::vector<int> signs(24);
             for (std::size_t i = 0; i < signs.size(); ++i)
               signs[i] = i < undo.size() && undo[i] != 0 ? undo[i] : -to_int(e_m(nth_atom<Atom>(i)));
             if (e_m.empty()) return;
             bool silent = true;
             for (std::size_t i = 0; i < signs.size(); ++i) {
               auto const x = nth_atom<Atom>(i);
               silent &= detail::agent_of<S>(x) != b || to_int(e_m(x)) + signs[i] == 0;
             }
             interesting(silent, "silent about b");
             interesting(!silent, "not silent about b");
             holds(detail::says_cycle<S>(as::stored(e_m), as::stored(event_with<Atom>(signs)), b) == silent,
                   "a cycle iff e_m∘e_r is silent about b");
           },
           {{"silent about b"}, {"not silent about b"}});
  laws.add("empty_message_is_no_event", "e_m = ∅ ⇒ no cycle", [] {
    auto const b = detail::agent_of<S>(*an_atom<Atom>().as("an atom of b"));
    auto const e_r = as::stored(draw<sparse_event>("e_r"));
    holds(!detail::says_cycle<S>(as::stored(sparse_event{}), e_r, b), "the empty event starts no cycle");
  });
  return laws;
}
/// What a cycle means: restores_b_s_part, for e_m applied at C, and e_r right after it.
template <class E, class S = structure<E>>
[[nodiscard]] bundle cycle_theorems() {
  using as = storage<E, S>;
  using Atom = typename as::atom_type;
  using set = typename as::sparse_set;
  bundle laws("definition_5_theorems");
  laws.add("restores_b_s_part", "for adjacent e_m ≠ ∅ and e_r: a cycle ⇔ b's part of C is restored",
           [] {
             auto const x = *an_atom<Atom>().as("an atom of b");
             auto const b = detail::agent_of<S>(x);
             auto const c = draw<set>("C");
             auto const goal = *set_beside(c).as("C after the reallocation");
             auto const part = [&](set const& s) { return detail::part_about<S>(s, b); };
             auto told = unite(subtract(c, part(c)), part(*set_flipped(c).as("C, were the message about all agents")));
             if (told == c && !told.insert(x)) told.erase(x);  // a message that tells something
             auto const e_m = S::difference(as::stored(c), as::stored(told));
             auto const e_r = S::difference(as::stored(told), as::stored(goal));
             bool const restored = part(c) == part(goal);
             interesting(restored, "restored");
             interesting(!restored, "not restored");
             holds(detail::says_cycle<S>(e_m, e_r, b) == restored, "a cycle iff b's part is restored");
           },
           {{"restored"}, {"not restored"}});
  return laws;
}

}  // namespace rota::testing
