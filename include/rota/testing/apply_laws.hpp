#pragma once
/// @file
/// The laws of `difference` and `apply`, and of runs. The model M names the functions; the defaults are the library's own.

#include <rota/algebra/action.hpp>
#include <rota/algebra/runs.hpp>
#include <rota/testing/arbitrary.hpp>

#include <span>
#include <vector>

namespace rota::testing {

/// Events acting on sets of atoms.
template <class Atom>
struct apply_model {
  using atom_type = Atom;
  [[nodiscard]] static event<Atom> difference(atom_set<Atom> const& c, atom_set<Atom> const& d) {
    return rota::difference(c, d);
  }
  [[nodiscard]] static bool applicable(event<Atom> const& e, atom_set<Atom> const& c) { return rota::applicable(e, c); }
  static result<atom_set<Atom>, inapplicable<Atom>> apply(event<Atom> const& e, atom_set<Atom> const& c) {
    return rota::apply(e, c);
  }
  [[nodiscard]] static delta<Atom> characteristic(atom_set<Atom> const& c) { return delta<Atom>(c); }
  [[nodiscard]] static delta<Atom> embed(event<Atom> const& e) { return delta<Atom>(e); }
  [[nodiscard]] static event<Atom> compose(event<Atom> const& e, event<Atom> const& f) { return rota::compose(e, f); }
};

namespace detail {

/// The event that leads from c to d, as Def. 3 spells it.
template <class Atom>
[[nodiscard]] event<Atom> leading(atom_set<Atom> const& c, atom_set<Atom> const& d) {
  return event<Atom>::make(subtract(d, c), subtract(c, d)).value();
}

/// The atoms at which χ(c) + ι(e) leaves {0, 1}, by counting.
template <class Atom>
[[nodiscard]] atom_set<Atom> offending(event<Atom> const& e, atom_set<Atom> const& c) {
  atom_set<Atom> atoms;
  for (auto const& x : e) {
    int const count = (c.contains(x.atom) ? 1 : 0) + to_int(x.value);
    if (count < 0 || count > 1) atoms.insert(x.atom);
  }
  return atoms;
}

}  // namespace detail

/// unique_applicable_event, characteristic_adds, refuses_iff_it_leaves_the_sets, refusal_names_the_least_atom,
/// compatible_with_compose.
template <class M>
[[nodiscard]] bundle apply_laws() {
  using Atom = typename M::atom_type;
  using set = atom_set<Atom>;
  bundle laws("apply");
  laws.add("unique_applicable_event", "e applicable at C and e·C = C′ ⇔ e = diff(C, C′)", [] {
    auto const c = draw<set>("C");
    auto const d = *set_beside(c).as("C′");
    auto const e = *event_at(c).as("e");
    auto const there = M::difference(c, d);
    holds(M::applicable(there, c), "diff(C, C′) is applicable at C");
    same("diff(C, C′)·C", M::apply(there, c).value(), "C′", d);
    if (auto const to = M::apply(e, c); M::applicable(e, c) && to) same("diff(C, e·C)", M::difference(c, *to), "e", e);
  });
  laws.add("characteristic_adds", "χ(e·C) = χ(C) + ι(e) where e is applicable",
           [] {
             auto const c = draw<set>("C");
             auto const e = *event_at(c).as("e");
             auto const to = M::apply(e, c);
             bool const applies = M::applicable(e, c) && to;
             interesting(applies && !e.empty(), "applicable, and changes something");
             if (applies) same("χ(e·C)", M::characteristic(*to), "χ(C) + ι(e)", M::characteristic(c) + M::embed(e));
           },
           {{"applicable, and changes something"}});
  laws.add("refuses_iff_it_leaves_the_sets", "e·C is refused ⇔ e is not applicable ⇔ e⁺ ∩ C ≠ ∅ or e⁻ ⊈ C",
           [] {
             auto const c = draw<set>("C");
             auto const e = *event_at(c).as("e");
             bool const stays = detail::offending(e, c).empty();
             interesting(!stays, "not applicable");
             holds(M::apply(e, c).has_value() == stays, "e·C exists iff χ(C) + ι(e) stays in {0, 1}");
             holds(M::applicable(e, c) == stays, "e is called applicable iff χ(C) + ι(e) stays in {0, 1}");
           },
           {{"not applicable"}});
  laws.add("refusal_names_the_least_atom", "e·C refused ⇒ its witness is the least atom at which χ(C) + ι(e) ∉ {0, 1}",
           [] {
             auto const c = draw<set>("C");
             auto const e = *event_at(c).as("e");
             auto const bad = detail::offending(e, c);
             interesting(bad.size() > 1, "several atoms offend");
             if (auto const to = M::apply(e, c); !to && !bad.empty())
               same("the witness", to.error().witness, "the least offending atom", *bad.begin());
           },
           {{"several atoms offend"}});
  laws.add("compatible_with_compose", "f·(e·C) = (e∘f)·C where the left side exists",
           [] {
             auto const c = draw<set>("C");
             auto const e = detail::leading<Atom>(c, *set_beside(c).as("e·C"));
             auto const once = M::apply(e, c);
             if (!once) return;
             auto const f = detail::leading<Atom>(*once, *set_beside(*once).as("f·(e·C)"));
             auto const twice = M::apply(f, *once);
             if (!twice) return;
             interesting(!e.empty() && !f.empty(), "both change something");
             auto const e_f = M::compose(e, f);
             auto const at_once = M::apply(e_f, c);
             if (!at_once) refute("e∘f is " + rc::toString(e_f) + ", which is not applicable at C");
             same("(e∘f)·C", *at_once, "f·(e·C)", *twice);
           },
           {{"both change something"}});
  return laws;
}
/// difference_is_a_functor: follows from the unique event and compatibility.
template <class M>
[[nodiscard]] bundle apply_theorems() {
  using set = atom_set<typename M::atom_type>;
  bundle laws("apply_theorems");
  laws.add("difference_is_a_functor", "diff(C, C′)∘diff(C′, C″) = diff(C, C″), diff(C, C) = ∅", [] {
    auto const c = draw<set>("C");
    auto const d = *set_beside(c).as("C′");
    auto const e = *set_beside(d).as("C″");
    same("diff(C, C′)∘diff(C′, C″)", M::compose(M::difference(c, d), M::difference(d, e)), "diff(C, C″)",
         M::difference(c, e));
    holds(M::difference(c, c).empty(), "diff(C, C) = ∅");
  });
  return laws;
}

/// Composing several events.
template <class Atom>
struct run_model {
  using atom_type = Atom;
  [[nodiscard]] static event<Atom> compose(event<Atom> const& e, event<Atom> const& f) { return rota::compose(e, f); }
  static result<event<Atom>, no_run<Atom>> compose_run(std::span<event<Atom> const> events) {
    return rota::compose_run(events);
  }
  /// Σ ι(eᵢ).
  [[nodiscard]] static delta<Atom> sum(std::span<event<Atom> const> events) {
    delta<Atom> total;
    for (auto const& e : events) total += delta<Atom>(e);
    return total;
  }
};

/// What the bracketings of e₁∘…∘eₙ come to under M::compose: all Catalan(n − 1) of them, so keep n small. @pre n ≥ 1
template <class M, class E>
[[nodiscard]] std::vector<E> every_bracketing(std::span<E const> events) {
  if (events.size() == 1) return {events[0]};
  std::vector<E> results;
  for (std::size_t cut = 1; cut < events.size(); ++cut)
    for (auto const& left : every_bracketing<M, E>(events.first(cut)))
      for (auto const& right : every_bracketing<M, E>(events.subspan(cut))) results.push_back(M::compose(left, right));
  return results;
}

namespace detail {

/// Events that lead from a drawn set on.
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

/// Whether at each atom the nonzero signs alternate.
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

/// Whether some atom moves three times.
template <class Atom>
[[nodiscard]] bool comes_and_goes(std::vector<event<Atom>> const& events) {
  for (auto const& e : events)
    for (auto const& x : e)
      if (std::count_if(events.begin(), events.end(), [&](auto const& f) { return f(x.atom) != sign::zero; }) >= 3)
        return true;
  return false;
}

}  // namespace detail

/// brackets_do_not_matter, left_fold_is_the_sum, compose_run_is_the_left_fold, compose_run_refuses_the_rest.
template <class M>
[[nodiscard]] bundle run_laws() {
  using Atom = typename M::atom_type;
  using E = event<Atom>;
  static constexpr auto fold = [](std::vector<E> const& run) {
    E folded = run.front();
    for (std::size_t i = 1; i < run.size(); ++i) folded = M::compose(folded, run[i]);
    return folded;
  };
  bundle laws("run");
  laws.add("brackets_do_not_matter", "every bracketing of a run e₁∘…∘eₙ is the same",
           [] {
             auto const run = detail::draw_run<Atom>();
             interesting(detail::comes_and_goes(run), "an atom moves three times");
             auto const all = every_bracketing<M, E>(run);
             for (auto const& e : all) same("one bracketing", e, "another", all.front());
           },
           {{"an atom moves three times"}});
  laws.add("left_fold_is_the_sum", "ι(e₁∘…∘eₙ) = Σ ι(eᵢ), for a run: no clamp is needed", [] {
    auto const run = detail::draw_run<Atom>();
    same("ι((…(e₁∘e₂)∘…)∘eₙ)", delta<Atom>(fold(run)), "Σ ι(eᵢ)", M::sum(run));
  });
  laws.add("compose_run_is_the_left_fold", "compose_run(e₁, …, eₙ) = (…(e₁∘e₂)∘…)∘eₙ, for a run", [] {
    auto const run = detail::draw_run<Atom>();
    auto const composed = M::compose_run(run);
    if (!composed) refute("compose_run refuses a run");
    same("compose_run(e₁, …, eₙ)", *composed, "(…(e₁∘e₂)∘…)∘eₙ", fold(run));
  });
  laws.add(
      "compose_run_refuses_the_rest",
      "compose_run refuses ⇔ at some atom the nonzero signs do not alternate; it says where",
      [] {
        std::vector<E> const events{draw<E>("e₁"), draw<E>("e₂"), draw<E>("e₃")};
        bool const is_run = detail::alternates(events);
        interesting(!is_run, "no run");
        interesting(is_run && !events[0].empty() && !events[1].empty() && !events[2].empty(), "a run of three events");
        auto const composed = M::compose_run(events);
        if (is_run) return;  // whether it accepts is the law above
        if (composed) refute("composed to " + rc::toString(*composed) + " although it is no run");
        auto const& why = composed.error();
        holds(why.first < why.second && why.second < events.size(), "the refusal names an earlier and a later event");
        auto const s = events[why.first](why.witness);
        holds(s != sign::zero && s == events[why.second](why.witness), "both have the same sign at the witness");
        for (auto i = why.first + 1; i < why.second; ++i)
          holds(events[i](why.witness) == sign::zero, "no event between them mentions the witness");
      },
      {{"no run"}, {"a run of three events", 5}});
  return laws;
}

}  // namespace rota::testing
