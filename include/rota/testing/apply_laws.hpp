#pragma once
/// @file
/// The laws of `difference` and `apply`, and of runs, for events E and sets in any storage. The structure S names the
/// functions. storage.hpp says what else a type of your own needs.

#include <rota/algebra/apply.hpp>
#include <rota/algebra/runs.hpp>
#include <rota/testing/storage.hpp>

#include <span>
#include <vector>

namespace rota::testing {

namespace detail {

/// The event that leads from c to d, built as Def. 3 says.
template <class Atom>
[[nodiscard]] event<Atom> leading(atom_set<Atom> const& c, atom_set<Atom> const& d) {
  return event<Atom>::make(subtract(d, c), subtract(c, d)).value();
}

/// The atoms at which χ(c) + ι(e) leaves {0, 1}, found by counting.
template <class Atom>
[[nodiscard]] atom_set<Atom> offending(event<Atom> const& e, atom_set<Atom> const& c) {
  atom_set<Atom> atoms;
  for (auto const& x : e) {
    int const count = (c.contains(x.atom) ? 1 : 0) + to_int(x.value);
    if (count < 0 || count > 1) atoms.insert(x.atom);
  }
  return atoms;
}

/// A set C and an event that is often applicable at it, each as drawn and as stored.
template <class E, class S>
struct event_at_set {
  using as = storage<E, S>;
  typename as::sparse_set sparse_c = draw<typename as::sparse_set>("C");
  typename as::sparse_event sparse_e = *event_at(sparse_c).as("e");
  typename as::set_type c = as::stored(sparse_c);
  E e = as::stored(sparse_e);
};

}  // namespace detail

/// unique_applicable_event, characteristic_adds, refuses_iff_it_leaves_the_sets, refusal_names_the_least_atom,
/// compatible_with_compose.
template <class E, class S = structure<E>>
  requires acts_on_sets<E, S>
[[nodiscard]] bundle apply_laws() {
  using as = storage<E, S>;
  using drawn = detail::event_at_set<E, S>;
  using Atom = typename as::atom_type;
  bundle laws("apply");
  laws.add("unique_applicable_event", "e applicable at C and e·C = C′ ⇔ e = diff(C, C′)", [] {
    auto const [sparse_c, sparse_e, c, e] = drawn();
    auto const d = as::stored(*set_beside(sparse_c).as("C′"));
    auto const there = S::difference(c, d);
    auto const arrived = S::apply(there, c);
    holds(S::applicable(there, c) && arrived, "diff(C, C′) is applicable at C");
    as::same("diff(C, C′)·C", *arrived, "C′", d);
    if (auto const to = S::apply(e, c); S::applicable(e, c) && to)
      as::same("diff(C, e·C)", S::difference(c, *to), "e", e);
  });
  laws.add("characteristic_adds", "χ(e·C) = χ(C) + ι(e) where e is applicable",
           [] {
             auto const [sparse_c, sparse_e, c, e] = drawn();
             auto const to = S::apply(e, c);
             bool const applies = S::applicable(e, c) && to;
             interesting(applies && !sparse_e.empty(), "applicable, and changes something");
             if (applies)
               testing::same("χ(e·C)", delta<Atom>(as::read(*to)), "χ(C) + ι(e)",
                             delta<Atom>(as::read(c)) + delta<Atom>(as::read(e)));
           },
           {{"applicable, and changes something"}});
  laws.add("refuses_iff_it_leaves_the_sets", "e·C is refused ⇔ e is not applicable ⇔ e⁺ ∩ C ≠ ∅ or e⁻ ⊈ C",
           [] {
             auto const [sparse_c, sparse_e, c, e] = drawn();
             bool const stays = detail::offending(sparse_e, sparse_c).empty();
             interesting(!stays, "not applicable");
             holds(S::apply(e, c).has_value() == stays, "e·C exists iff χ(C) + ι(e) stays in {0, 1}");
             holds(S::applicable(e, c) == stays, "e is called applicable iff χ(C) + ι(e) stays in {0, 1}");
           },
           {{"not applicable"}});
  laws.add("refusal_names_the_least_atom", "e·C refused ⇒ its witness is the least atom at which χ(C) + ι(e) ∉ {0, 1}",
           [] {
             auto const [sparse_c, sparse_e, c, e] = drawn();
             auto const bad = detail::offending(sparse_e, sparse_c);
             interesting(bad.size() > 1, "several atoms offend");
             if (auto const to = S::apply(e, c); !to && !bad.empty())
               testing::same<Atom>("the witness", to.error().witness, "the least offending atom", *bad.begin());
           },
           {{"several atoms offend"}});
  laws.add("compatible_with_compose", "f·(e·C) = (e∘f)·C where the left side exists",
           [] {
             auto const from = draw<typename as::sparse_set>("C");
             auto const over = *set_beside(from).as("e·C");
             auto const to = *set_beside(over).as("f·(e·C)");
             auto const c = as::stored(from);
             auto const e = as::stored(detail::leading(from, over));
             auto const f = as::stored(detail::leading(over, to));
             auto const once = S::apply(e, c);
             if (!once) return;
             auto const twice = S::apply(f, *once);
             if (!twice) return;
             interesting(from != over && over != to, "both change something");
             auto const e_f = S::combine(e, f);
             auto const at_once = S::apply(e_f, c);
             if (!at_once) refute("e∘f is " + rc::toString(as::read(e_f)) + ", which is not applicable at C");
             as::same("(e∘f)·C", *at_once, "f·(e·C)", *twice);
           },
           {{"both change something"}});
  return laws;
}
/// difference_is_a_functor. It follows from unique_applicable_event and compatible_with_compose.
template <class E, class S = structure<E>>
  requires acts_on_sets<E, S>
[[nodiscard]] bundle apply_theorems() {
  using as = storage<E, S>;
  bundle laws("apply_theorems");
  laws.add("difference_is_a_functor", "diff(C, C′)∘diff(C′, C″) = diff(C, C″), diff(C, C) = ∅", [] {
    auto const from = draw<typename as::sparse_set>("C");
    auto const over = *set_beside(from).as("C′");
    auto const c = as::stored(from);
    auto const d = as::stored(over);
    auto const e = as::stored(*set_beside(over).as("C″"));
    as::same("diff(C, C′)∘diff(C′, C″)", S::combine(S::difference(c, d), S::difference(d, e)), "diff(C, C″)",
             S::difference(c, e));
    as::same("diff(C, C)", S::difference(c, c), "∅", S::identity());
  });
  return laws;
}

/// The results of all bracketings of e₁∘…∘eₙ under S. There are Catalan(n − 1), so keep n small. @pre n ≥ 1
template <class S, class E>
[[nodiscard]] std::vector<E> every_bracketing(std::span<E const> events) {
  if (events.size() == 1) return {events[0]};
  std::vector<E> results;
  for (std::size_t cut = 1; cut < events.size(); ++cut)
    for (auto const& left : every_bracketing<S, E>(events.first(cut)))
      for (auto const& right : every_bracketing<S, E>(events.subspan(cut))) results.push_back(S::combine(left, right));
  return results;
}

namespace detail {

/// (…(e₁∘e₂)∘…)∘eₙ.
template <class S, class E>
[[nodiscard]] E left_fold(std::vector<E> const& run) {
  E folded = run.front();
  for (std::size_t i = 1; i < run.size(); ++i) folded = S::combine(folded, run[i]);
  return folded;
}

/// By `S::compose_run` if there is one, else by the library's.
template <class S, class E>
[[nodiscard]] auto composed_run(std::vector<E> const& events) {
  if constexpr (requires { S::compose_run(std::span<E const>(events)); })
    return S::compose_run(std::span<E const>(events));
  else
    return rota::compose_run(std::span<E const>(events));
}
template <class E, class S>
concept composes_runs = allocation_event<E> || requires(std::span<E const> events) { S::compose_run(events); };

/// Events that lead from one drawn set to the next.
template <class Atom>
[[nodiscard]] std::vector<event<Atom>> draw_run() {
  static constexpr char const* steps[] = {"e₁ leads to", "e₂ leads to", "e₃ leads to", "e₄ leads to", "e₅ leads to"};
  auto c = draw<atom_set<Atom>>("from");
  auto const length = static_cast<std::size_t>(*integer(3, 5).as("length"));
  std::vector<event<Atom>> run;
  for (std::size_t i = 0; i < length; ++i) {
    auto const d = *set_flipped(c).as(steps[i]);
    run.push_back(leading(c, d));
    c = d;
  }
  return run;
}
template <class E, class S>
[[nodiscard]] std::vector<E> all_stored(std::vector<typename storage<E, S>::sparse_event> const& events) {
  std::vector<E> r;
  for (auto const& e : events) r.push_back(storage<E, S>::stored(e));
  return r;
}

/// Whether the nonzero signs alternate at each atom.
template <class Atom>
[[nodiscard]] bool alternates(std::vector<event<Atom>> const& events) {
  std::vector<Atom> mentioned;
  for (auto const& e : events)
    for (auto const& x : e) mentioned.push_back(x.atom);
  for (auto const& x : mentioned) {
    sign last = sign::zero;
    for (auto const& e : events) {
      sign const s = e(x);
      if (s != sign::zero && s == last) return false;
      if (s != sign::zero) last = s;
    }
  }
  return true;
}

/// Whether three of the events mention one atom.
template <class Atom>
[[nodiscard]] bool comes_and_goes(std::vector<event<Atom>> const& events) {
  for (auto const& e : events)
    for (auto const& x : e)
      if (std::count_if(events.begin(), events.end(), [&](auto const& f) { return f(x.atom) != sign::zero; }) >= 3)
        return true;
  return false;
}

}  // namespace detail

/// brackets_do_not_matter, left_fold_is_the_sum. If there is a `compose_run`, also compose_run_is_the_left_fold and
/// compose_run_refuses_the_rest.
template <class E, class S = structure<E>>
  requires acts_on_sets<E, S>
[[nodiscard]] bundle run_laws() {
  using as = storage<E, S>;
  using Atom = typename as::atom_type;
  bundle laws("run");
  laws.add("brackets_do_not_matter", "every bracketing of a run e₁∘…∘eₙ is the same",
           [] {
             auto const run = detail::draw_run<Atom>();
             interesting(detail::comes_and_goes(run), "an atom moves three times");
             auto const all = every_bracketing<S, E>(detail::all_stored<E, S>(run));
             for (auto const& e : all) as::same("one bracketing", e, "another", all.front());
           },
           {{"an atom moves three times"}});
  laws.add("left_fold_is_the_sum", "ι(e₁∘…∘eₙ) = Σ ι(eᵢ), for a run: no clamp is needed", [] {
    auto const run = detail::draw_run<Atom>();
    delta<Atom> sum;
    for (auto const& e : run) sum += delta<Atom>(e);
    auto const folded = detail::left_fold<S>(detail::all_stored<E, S>(run));
    testing::same("ι((…(e₁∘e₂)∘…)∘eₙ)", delta<Atom>(as::read(folded)), "Σ ι(eᵢ)", sum);
  });
  if constexpr (detail::composes_runs<E, S>) {
    laws.add("compose_run_is_the_left_fold", "compose_run(e₁, …, eₙ) = (…(e₁∘e₂)∘…)∘eₙ, for a run", [] {
      auto const run = detail::all_stored<E, S>(detail::draw_run<Atom>());
      auto const composed = detail::composed_run<S>(run);
      if (!composed) refute("compose_run refuses a run");
      as::same("compose_run(e₁, …, eₙ)", *composed, "(…(e₁∘e₂)∘…)∘eₙ", detail::left_fold<S>(run));
    });
    laws.add("compose_run_refuses_the_rest",
             "compose_run refuses ⇔ at some atom the nonzero signs do not alternate; it says where",
             [] {
               using sparse_event = event<Atom>;
               std::vector<sparse_event> const events{draw<sparse_event>("e₁"), draw<sparse_event>("e₂"),
                                                      draw<sparse_event>("e₃")};
               bool const is_run = detail::alternates(events);
               interesting(!is_run, "no run");
               interesting(is_run && !events[0].empty() && !events[1].empty() && !events[2].empty(),
                           "a run of three events");
               auto const composed = detail::composed_run<S>(detail::all_stored<E, S>(events));
               if (is_run) return;  // whether it accepts is the law above
               if (composed) refute("composed to " + rc::toString(as::read(*composed)) + " although it is no run");
               auto const& why = composed.error();
               holds(why.first < why.second && why.second < events.size(),
                     "the refusal names an earlier and a later event");
               auto const s = events[why.first](why.witness);
               holds(s != sign::zero && s == events[why.second](why.witness), "both have the same sign at the witness");
               for (auto i = why.first + 1; i < why.second; ++i)
                 holds(events[i](why.witness) == sign::zero, "no event between them mentions the witness");
             },
             {{"no run"}, {"a run of three events", 5}});
  }
  return laws;
}

}  // namespace rota::testing
