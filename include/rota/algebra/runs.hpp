#pragma once

#include <rota/algebra/allocation_event.hpp>
#include <rota/algebra/delta.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace rota {

/// Refusal: two events of a sequence have the same sign at this atom, and no event between them mentions it. So there
/// is no set from which the sequence is applicable.
template <ordered_atom Atom>
struct no_run {
  Atom witness{};
  std::size_t first = 0;   ///< index of the earlier event
  std::size_t second = 0;  ///< index of the later one
  friend bool operator==(no_run const&, no_run const&) = default;
};

/// e₁∘…∘eₙ for a run, that is, for events of which each is applicable where the ones before it lead; else the refusal.
///
/// This is how the paper uses composition, with the condition that makes it sound: at each atom, the nonzero signs
/// alternate. Then every bracketing of Def. 4 gives this event, it is the sum of the ι(eᵢ), and it is applicable
/// wherever the run is. The order of the events matters. O(N log N) for N entries in all.
template <ordered_atom Atom>
[[nodiscard]] constexpr result<event<Atom>, no_run<Atom>> compose_run(std::span<event<Atom> const> events) {
  struct mention {
    Atom atom;
    std::size_t index;
    sign value;
  };
  small_vector<mention, 8> mentions;
  for (std::size_t i = 0; i < events.size(); ++i)
    for (auto const& x : events[i]) mentions.push_back({x.atom, i, x.value});
  std::sort(mentions.begin(), mentions.end(),
            [](mention const& x, mention const& y) { return x.atom == y.atom ? x.index < y.index : x.atom < y.atom; });
  small_vector<signed_atom<Atom>, 8> entries;
  for (auto m = mentions.begin(); m != mentions.end();) {
    auto const first = m;
    for (++m; m != mentions.end() && m->atom == first->atom; ++m)
      if (m->value == (m - 1)->value) return refused{no_run<Atom>{m->atom, (m - 1)->index, m->index}};
    if ((m - first) % 2 != 0) entries.push_back({first->atom, first->value});
  }
  return event<Atom>::from_entries(std::move(entries));
}

/// The same for events in another storage. Of no events: the identity, over the empty universe.
template <allocation_event E>
[[nodiscard]] constexpr result<E, no_run<typename E::atom_type>> compose_run(std::span<E const> events) {
  using sparse = event<typename E::atom_type>;
  std::vector<sparse> same;
  for (E const& e : events) same.push_back(to_sparse(e));
  if (auto const run = compose_run(std::span<sparse const>(same)); !run) return refused{run.error()};
  E composed = events.empty() ? E{} : events.front();
  for (E const& e : events.subspan(events.empty() ? 0 : 1)) composed = compose(composed, e);  // any brackets will do
  return composed;
}

/// δ₁ + … + δₙ. Any order and any brackets give the same sum, if each delta is added exactly once. @pre no partial sum
/// overflows.
/// O(N log n) for N entries in n deltas.
template <ordered_atom Atom, integer_coefficient Coefficient>
[[nodiscard]] constexpr delta<Atom, Coefficient> sum(std::span<delta<Atom, Coefficient> const> deltas) {
  if (deltas.empty()) return {};
  if (deltas.size() == 1) return deltas.front();
  auto const half = deltas.size() / 2;
  return sum(deltas.first(half)) + sum(deltas.subspan(half));
}

}  // namespace rota
