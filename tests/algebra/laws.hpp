#pragma once
/// The laws as predicates over a model, and checkers that name those a model breaks on a whole small universe.
///
/// Properties use the predicates on generated values; wrong_models.cpp uses the checkers to show that each law can fail.

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace laws {

using law_names = std::set<std::string>;

template <class M, class T>
bool same(T const& a, T const& b) {
  if constexpr (requires { M::equal(a, b); })
    return M::equal(a, b);
  else
    return a == b;
}

// One commutative operation: M::compose, M::identity, M::inverse, M::valid ---------------------------------------------

template <class M, class E>
bool closed(E const& a, E const& b) {
  return M::valid(M::identity()) && M::valid(M::inverse(a)) && M::valid(M::compose(a, b));
}
template <class M, class E>
bool identity(E const& a) {
  return same<M>(M::compose(a, M::identity()), a) && same<M>(M::compose(M::identity(), a), a);
}
template <class M, class E>
bool commutative(E const& a, E const& b) {
  return same<M>(M::compose(a, b), M::compose(b, a));
}
template <class M, class E>
bool associative(E const& a, E const& b, E const& c) {
  return same<M>(M::compose(M::compose(a, b), c), M::compose(a, M::compose(b, c)));
}
template <class M, class E>
bool inverse(E const& a) {
  return same<M>(M::compose(a, M::inverse(a)), M::identity()) && same<M>(M::compose(M::inverse(a), a), M::identity());
}
/// a∘b = 0 = a∘c ⇒ b = c; whether `inverse` finds it is another law.
template <class M, class E>
bool unique_inverse(E const& a, E const& b, E const& c) {
  auto const inverts = [&](E const& x) { return same<M>(M::compose(a, x), M::identity()); };
  return !inverts(b) || !inverts(c) || same<M>(b, c);
}
template <class M, class E>
bool idempotent(E const& a) {
  return same<M>(M::compose(a, a), a);
}
/// a∘b = a∘c ⇒ b = c.
template <class M, class E>
bool cancellative(E const& a, E const& b, E const& c) {
  return !same<M>(M::compose(a, b), M::compose(a, c)) || same<M>(b, c);
}

inline law_names const event_laws{"closed", "identity", "commutative", "inverse", "unique_inverse", "idempotent"};
inline law_names const abelian_group_axioms{"closed", "identity", "commutative", "associative", "inverse"};
/// With what follows from the axioms, and falls with them.
inline law_names const abelian_group_laws{"closed",  "identity",       "commutative", "associative",
                                          "inverse", "unique_inverse", "cancellative"};

/// Those of the `claimed` laws that fail somewhere on M::elements().
template <class M>
law_names broken(law_names const& claimed) {
  law_names all;
  auto const check = [&](char const* name, bool holds) {
    if (!holds && claimed.contains(name)) all.insert(name);
  };
  auto const elements = M::elements();
  for (auto const& a : elements) {
    check("identity", identity<M>(a));
    check("inverse", inverse<M>(a));
    check("idempotent", idempotent<M>(a));
    for (auto const& b : elements) {
      check("closed", closed<M>(a, b));
      check("commutative", commutative<M>(a, b));
      for (auto const& c : elements) {
        check("associative", associative<M>(a, b, c));
        check("unique_inverse", unique_inverse<M>(a, b, c));
        check("cancellative", cancellative<M>(a, b, c));
      }
    }
  }
  return all;
}

// Scaling by integers: M::scale beside the above -----------------------------------------------------------------------

template <class M, class E>
bool scale_unit(E const& a) {
  return same<M>(M::scale(1, a), a);
}
template <class M, class E>
bool scale_adds_scalars(int m, int n, E const& a) {
  return same<M>(M::scale(m + n, a), M::compose(M::scale(m, a), M::scale(n, a)));
}
template <class M, class E>
bool scale_adds_elements(int n, E const& a, E const& b) {
  return same<M>(M::scale(n, M::compose(a, b)), M::compose(M::scale(n, a), M::scale(n, b)));
}
template <class M, class E>
bool scale_multiplies(int m, int n, E const& a) {
  return same<M>(M::scale(m * n, a), M::scale(m, M::scale(n, a)));
}

template <class M>
law_names broken_module_laws() {
  law_names all;
  auto const check = [&](char const* name, bool holds) {
    if (!holds) all.insert(name);
  };
  auto const elements = M::elements();
  for (auto const& a : elements) {
    check("scale_unit", scale_unit<M>(a));
    for (int n = -3; n <= 3; ++n) {
      for (int m = -3; m <= 3; ++m) {
        check("scale_adds_scalars", scale_adds_scalars<M>(m, n, a));
        check("scale_multiplies", scale_multiplies<M>(m, n, a));
      }
      for (auto const& b : elements) check("scale_adds_elements", scale_adds_elements<M>(n, a, b));
    }
  }
  return all;
}

// ι and ρ: M::embed, M::clamp, M::compose of events --------------------------------------------------------------------

template <class M, class E>
bool clamp_retracts_embed(E const& e) {
  return M::clamp(M::embed(e)) == e;
}
template <class M, class E>
bool compose_is_clamped_sum(E const& e, E const& f) {
  return M::compose(e, f) == M::clamp(M::embed(e) + M::embed(f));
}

template <class M>
law_names broken_embedding_laws() {
  law_names all;
  auto const elements = M::elements();
  for (auto const& e : elements) {
    if (!clamp_retracts_embed<M>(e)) all.insert("clamp_retracts_embed");
    for (auto const& f : elements)
      if (!compose_is_clamped_sum<M>(e, f)) all.insert("compose_is_clamped_sum");
  }
  return all;
}

// The universal property: M::extend(d, f, zero), for a map f of atoms into an abelian group --------------------------

template <class M, class D, class F, class G>
bool extend_agrees_on_generators(typename D::atom_type const& x, F const& f, G const& zero) {
  return M::extend(D(x, 1), f, zero) == zero + f(x);
}
template <class M, class D, class F, class G>
bool extend_is_additive(D const& d, D const& e, F const& f, G const& zero) {
  return M::extend(d + e, f, zero) == M::extend(d, f, zero) + M::extend(e, f, zero);
}

// Events acting on sets: M::difference, M::applicable, M::apply, M::characteristic, M::compose -------------------------

/// {e | e applicable at c, e·c = d} = {diff(c, d)}, among all events of the universe.
template <class M, class E, class C>
bool unique_applicable_event(std::vector<E> const& events, C const& c, C const& d) {
  std::vector<E> found;
  for (auto const& e : events)
    if (M::applicable(e, c) && M::apply(e, c).has_value() && *M::apply(e, c) == d) found.push_back(e);
  return found == std::vector<E>{M::difference(c, d)};
}
/// χ(e·c) = χ(c) + ι(e) where e is applicable.
template <class M, class E, class C>
bool characteristic_adds(E const& e, C const& c) {
  if (!M::applicable(e, c)) return true;
  auto const after = M::apply(e, c);
  return after.has_value() && M::characteristic(*after) == M::characteristic(c) + M::embed(e);
}

/// Refused iff some multiplicity of χ(c) + ι(e) lies outside {0, 1}; `applicable` says the same.
template <class M, class D, class E, class C>
bool refuses_iff_it_leaves_the_sets(E const& e, C const& c) {
  auto const target = D(c) + D(e);
  bool stays = true;
  for (auto const& x : target) stays = stays && x.count == 1;
  return M::apply(e, c).has_value() == stays && M::applicable(e, c) == stays;
}
/// The refusal names the least atom at which χ(c) + ι(e) leaves {0, 1}.
template <class M, class D, class E, class C>
bool refusal_names_the_least_atom(E const& e, C const& c) {
  auto const r = M::apply(e, c);
  if (r.has_value()) return true;
  for (auto const& x : D(c) + D(e))
    if (x.count != 1) return r.error().witness == x.atom;
  return true;  // nothing offends: refusing at all is what the law above forbids
}
template <class M, class C>
bool difference_is_a_functor(C const& c, C const& d, C const& e) {
  return M::compose(M::difference(c, d), M::difference(d, e)) == M::difference(c, e) && M::difference(c, c).empty();
}
/// f·(e·c) = compose(e, f)·c where e is applicable at c, and f at e·c.
template <class M, class E, class C>
bool apply_is_compatible_with_compose(E const& e, E const& f, C const& c) {
  if (!M::applicable(e, c)) return true;
  auto const once = M::apply(e, c);
  if (!once.has_value()) return false;
  if (!M::applicable(f, *once)) return true;
  return M::apply(f, *once).has_value() && M::apply(M::compose(e, f), c) == M::apply(f, *once);
}

template <class M, class D, class E, class C>
law_names broken_action_laws(std::vector<E> const& events, std::vector<C> const& sets) {
  law_names all;
  auto const check = [&](char const* name, bool holds) {
    if (!holds) all.insert(name);
  };
  for (auto const& c : sets) {
    for (auto const& e : events) {
      check("characteristic_adds", characteristic_adds<M>(e, c));
      check("refuses_iff_it_leaves_the_sets", refuses_iff_it_leaves_the_sets<M, D>(e, c));
      check("refusal_names_the_least_atom", refusal_names_the_least_atom<M, D>(e, c));
      for (auto const& f : events)
        check("apply_is_compatible_with_compose", apply_is_compatible_with_compose<M>(e, f, c));
    }
    for (auto const& d : sets) {
      check("unique_applicable_event", unique_applicable_event<M>(events, c, d));
      for (auto const& e : sets) check("difference_is_a_functor", difference_is_a_functor<M>(c, d, e));
    }
  }
  return all;
}

// Runs: M::compose, M::clamped_sum of a sequence of events -------------------------------------------------------------

/// What the bracketings of e₁∘…∘eₙ come to. Every one of them, so keep n small.
template <class M, class E>
std::vector<E> every_bracketing(std::vector<E> const& run, std::size_t first, std::size_t last) {
  if (last - first == 1) return {run[first]};
  std::vector<E> results;
  for (std::size_t cut = first + 1; cut < last; ++cut)
    for (auto const& left : every_bracketing<M>(run, first, cut))
      for (auto const& right : every_bracketing<M>(run, cut, last)) results.push_back(M::compose(left, right));
  return results;
}
template <class M, class E>
bool brackets_do_not_matter(std::vector<E> const& run) {
  auto const all = every_bracketing<M>(run, 0, run.size());
  for (auto const& e : all)
    if (!(e == all.front())) return false;
  return true;
}
template <class M, class E>
bool left_fold_is_clamped_sum(std::vector<E> const& run) {
  E folded;
  for (auto const& e : run) folded = M::compose(folded, e);
  return folded == M::clamped_sum(run);
}

}  // namespace laws
