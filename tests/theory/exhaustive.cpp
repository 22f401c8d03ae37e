// The whole theory over tiny universes, case by case, against the definitions spelt out atom by atom. No generators: what
// holds here holds for every case there is. The script tests/mutations shows that each function is held by these laws.

#include <rota/algebra/apply.hpp>
#include <rota/algebra/associativity.hpp>
#include <rota/algebra/claimed_structures.hpp>
#include <rota/algebra/dense_event.hpp>
#include <rota/algebra/runs.hpp>
#include <rota/core/atom.hpp>
#include <rota/team/conflict.hpp>
#include <rota/team/cycle.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace {

// Three agents, two plans, three tasks.
struct names {
  enum class agent : std::uint8_t {};
  enum class plan_type : std::uint8_t { ours, other };
  enum class plan : std::uint8_t {};
  enum class task : std::uint8_t {};
  enum class state : std::uint8_t {};
};
using atom = rota::in<names>;
using atom_set = rota::atom_set<atom>;
using event = rota::event<atom>;
using delta = rota::delta<atom>;
using allocation = rota::allocation<names>;

constexpr std::size_t atoms_per_agent = 6;
constexpr atom nth(std::size_t i) {
  return {static_cast<names::agent>(i / 6), static_cast<names::plan>(i / 3 % 2), static_cast<names::task>(i % 3)};
}

// The definitions, spelt out --------------------------------------------------------------------------------------------

using function = std::map<atom, int>;  ///< finitely supported: atoms of value 0 are left out

template <class T>
function values_of(T const& x) {
  function f;
  if constexpr (requires { x.begin()->value; }) {
    for (auto const& entry : x) f[entry.atom] = to_int(entry.value);
  } else if constexpr (requires { x.begin()->count; }) {
    for (auto const& entry : x) f[entry.atom] = static_cast<int>(entry.count);
  } else {
    for (auto const& member : x) f[member] = 1;
  }
  return f;
}
function plus(function f, function const& g, int times = 1) {
  for (auto const& [x, n] : g) f[x] += times * n;
  std::erase_if(f, [](auto const& entry) { return entry.second == 0; });
  return f;
}
function clamped(function f) {
  for (auto& [x, n] : f) n = std::clamp(n, -1, 1);
  return f;
}
event event_from(function const& signs) {
  atom_set additions;
  atom_set subtractions;
  for (auto const& [x, s] : signs) (s > 0 ? additions : subtractions).insert(x);
  return event::make(additions, subtractions).value();
}

/// All functions from these atoms to {low, …, high}.
std::vector<function> functions(std::vector<std::size_t> const& atoms, int low, int high) {
  std::vector<function> all{{}};
  for (auto const i : atoms) {
    std::vector<function> longer;
    for (auto const& f : all)
      for (int n = low; n <= high; ++n) longer.push_back(plus(f, {{nth(i), n}}));
    all = std::move(longer);
  }
  return all;
}
std::vector<event> events(std::vector<std::size_t> const& atoms) {
  std::vector<event> all;
  for (auto const& f : functions(atoms, -1, 1)) all.push_back(event_from(f));
  return all;
}
std::vector<delta> deltas(std::vector<std::size_t> const& atoms, int bound) {
  std::vector<delta> all;
  for (auto const& f : functions(atoms, -bound, bound)) {
    delta d;
    for (auto const& [x, n] : f) d += {x, n};
    all.push_back(d);
  }
  return all;
}

/// All beliefs about the first so many agents: each has one of six atoms, or none.
std::vector<atom_set> beliefs(std::size_t agents) {
  std::vector<atom_set> all{{}};
  for (std::size_t a = 0; a < agents; ++a) {
    std::vector<atom_set> longer = all;
    for (auto const& c : all)
      for (std::size_t i = 0; i < atoms_per_agent; ++i) {
        longer.push_back(c);
        longer.back().insert(nth(a * atoms_per_agent + i));
      }
    all = std::move(longer);
  }
  return all;
}
atom_set with_part(atom_set c, names::agent b, atom_set const& part) {
  std::vector<atom> atoms(part.begin(), part.end());
  for (auto const& x : c)
    if (x.agent != b) atoms.push_back(x);
  return {atoms.begin(), atoms.end()};
}
std::vector<atom> part(atom_set const& c, names::agent b) {
  std::vector<atom> atoms;
  for (auto const& x : c)
    if (x.agent == b) atoms.push_back(x);
  return atoms;
}

/// Counts cases that break a law, and shows the first. An EXPECT per case would cost more than the cases.
struct law {
  explicit law(char const* equation) : equation_(equation) {}
  law(law const&) = delete;
  law& operator=(law const&) = delete;
  ~law() {
    EXPECT_EQ(broken_, 0u) << equation_ << " fails in " << broken_ << " of " << cases_ << " cases, first in case "
                           << first_;
    EXPECT_GT(cases_, 0u) << equation_ << ": no case";
  }
  void operator()(bool holds) {
    if (!holds && broken_++ == 0) first_ = cases_;
    ++cases_;
  }

private:
  char const* equation_;
  std::size_t cases_ = 0;
  std::size_t broken_ = 0;
  std::size_t first_ = 0;
};

std::vector<std::size_t> const three_atoms{0, 4, 13};

// The carrier: three values, by the compiler -----------------------------------------------------------------------------

using rota::clamped_sum;
using rota::sign;
constexpr std::array carrier{sign::minus, sign::zero, sign::plus};

constexpr event one_atom_event(sign s) {
  return s == sign::plus ? event::addition(nth(0)) : s == sign::minus ? event::subtraction(nth(0)) : event{};
}
constexpr bool pairs_are_clamped_sums_with_all_laws_but_associativity() {
  for (sign const s : carrier) {
    if (clamped_sum(s, sign::zero) != s || clamped_sum(s, s) != s) return false;
    for (sign const t : carrier) {
      if (to_int(clamped_sum(s, t)) != std::clamp(to_int(s) + to_int(t), -1, 1)) return false;
      if (clamped_sum(s, t) != clamped_sum(t, s)) return false;
      if (compose(one_atom_event(s), one_atom_event(t)) != one_atom_event(clamped_sum(s, t))) return false;
      if ((clamped_sum(s, t) == sign::zero) != (to_int(s) == -to_int(t))) return false;  // one inverse each
    }
  }
  return true;
}
static_assert(pairs_are_clamped_sums_with_all_laws_but_associativity(), "carrier.pairs");

constexpr int failing_triples() {
  int failing = 0;
  for (sign const s : carrier)
    for (sign const t : carrier)
      for (sign const u : carrier) {
        bool const fails = clamped_sum(clamped_sum(s, t), u) != clamped_sum(s, clamped_sum(t, u));
        if (fails != rota::brackets_matter(s, t, u)) return -1;
        auto const e = one_atom_event(s);
        auto const f = one_atom_event(t);
        auto const g = one_atom_event(u);
        if (fails == (compose(compose(e, f), g) == compose(e, compose(f, g)))) return -1;
        failing += fails;
      }
  return failing;
}
static_assert(failing_triples() == 4, "carrier.exactly_four_of_27_triples_fail");

// Def. 3 and 4 -----------------------------------------------------------------------------------------------------------

TEST(compose, is_definition_4) {
  law pointwise("(e∘f)(x) = clamp(e(x) + f(x))");
  law to_the_letter("e∘f = ((e⁺∖f⁻) ∪ (f⁺∖e⁻), (e⁻∖f⁺) ∪ (f⁻∖e⁺))");
  for (auto const& e : events(three_atoms))
    for (auto const& f : events(three_atoms)) {
      auto const r = compose(e, f);
      pointwise(values_of(r) == clamped(plus(values_of(e), values_of(f))));
      to_the_letter(
          r == event::make(unite(subtract(e.additions(), f.subtractions()), subtract(f.additions(), e.subtractions())),
                           unite(subtract(e.subtractions(), f.additions()), subtract(f.subtractions(), e.additions())))
                   .value());
    }
}
TEST(compose, is_a_commutative_unital_magma_of_idempotents) {
  law commutative("e∘f = f∘e");
  law identity("e∘∅ = e");
  law idempotent("e∘e = e");
  for (auto const& e : events(three_atoms)) {
    identity(compose(e, event{}) == e && compose(event{}, e) == e);
    idempotent(compose(e, e) == e);
    for (auto const& f : events(three_atoms)) commutative(compose(e, f) == compose(f, e));
  }
}
TEST(compose, associates_exactly_where_the_criterion_says) {
  law criterion("(e∘f)∘g = e∘(f∘g) ⇔ no bad sign triple");
  law witness("the witnesses are the atoms at which they differ");
  auto const all = events(three_atoms);
  for (auto const& e : all)
    for (auto const& f : all)
      for (auto const& g : all) {
        auto const left = values_of(compose(compose(e, f), g));
        auto const right = values_of(compose(e, compose(f, g)));
        criterion(associates(e, f, g) == (left == right));
        atom_set differ;
        for (auto const& [x, n] : plus(left, right, -1)) differ.insert(x);
        witness(non_associating_atoms(e, f, g) == differ);
      }
}
TEST(inverse, is_the_only_one) {
  law inverts("e∘f = ∅ ⇔ f = e⁻¹");
  law involution("(e⁻¹)⁻¹ = e");
  law swaps("e⁻¹(x) = −e(x)");
  for (auto const& e : events(three_atoms)) {
    involution(inverse(inverse(e)) == e);
    swaps(values_of(inverse(e)) == plus({}, values_of(e), -1));
    for (auto const& f : events(three_atoms)) inverts(compose(e, f).empty() == (f == inverse(e)));
  }
}

// Deltas -----------------------------------------------------------------------------------------------------------------

TEST(delta, is_an_abelian_group) {
  law pointwise("(d + e)(x) = d(x) + e(x)");
  law commutative("d + e = e + d");
  law associative("(d + e) + f = d + (e + f)");
  law inverse("d + −d = 0");
  law scales("(n·d)(x) = n·d(x)");
  auto const all = deltas({2, 9}, 2);
  for (auto const& d : all) {
    inverse((d + -d).empty() && (-d + d).empty() && d - d == delta{});
    for (int n = -3; n <= 3; ++n) scales(values_of(n * d) == plus({}, values_of(d), n));
    for (auto const& e : all) {
      pointwise(values_of(d + e) == plus(values_of(d), values_of(e)));
      commutative(d + e == e + d);
      for (auto const& f : all) associative((d + e) + f == d + (e + f));
    }
  }
}
TEST(delta, holds_the_events) {
  law retraction("ρ(ι(e)) = e");
  law sum("e∘f = ρ(ι(e) + ι(f))");
  for (auto const& e : events(three_atoms)) {
    retraction(clamp(delta(e)) == e && values_of(delta(e)) == values_of(e));
    for (auto const& f : events(three_atoms)) sum(compose(e, f) == clamp(delta(e) + delta(f)));
  }
}
TEST(delta, extends_maps_to_homomorphisms) {
  law values("f̂(1 x) = f(x)");
  law homomorphism("f̂(d + e) = f̂(d) + f̂(e)");
  // ℤ/2⁶⁴ is cyclic and not free, and its elements are many enough to tell all apart.
  auto const f = [](atom const& x) { return code(x) + rota::fingerprint{1}; };
  auto const all = deltas({2, 9}, 2);
  for (std::size_t i = 0; i < 3 * atoms_per_agent; ++i)
    values(extend(delta(nth(i), 1), f, rota::fingerprint{}) == f(nth(i)));
  for (auto const& d : all)
    for (auto const& e : all)
      homomorphism(extend(d + e, f, rota::fingerprint{}) ==
                   extend(d, f, rota::fingerprint{}) + extend(e, f, rota::fingerprint{}));
}
TEST(delta, refuses_what_its_coefficients_cannot_hold) {
  using small = rota::delta<atom, std::int8_t>;
  law sum("checked_sum is exact, or refused");
  law difference("checked_difference is exact, or refused");
  law product("checked_product is exact, or refused");
  law negation("checked_negation is exact, or refused");
  law multiplier("so is checked_product by what is itself no coefficient");
  auto const at = [](int n) { return small(nth(1), static_cast<std::int8_t>(n)); };
  auto const exact = [](auto const& r, int n) {
    bool const fits = n >= -128 && n <= 127;
    return r.has_value() == fits && (fits ? values_of(*r) == plus({}, {{nth(1), n}}) : r.error().witness == nth(1));
  };
  for (int m = -128; m <= 127; ++m) {
    negation(exact(checked_negation(at(m)), -m));
    for (int n = -128; n <= 127; ++n) {
      sum(exact(checked_sum(at(m), at(n)), m + n));
      difference(exact(checked_difference(at(m), at(n)), m - n));
      product(exact(checked_product(static_cast<std::int8_t>(m), at(n)), m * n));
      multiplier(exact(checked_product(4 * m, at(n)), 4 * m * n));
    }
  }
  law least("a refusal names the least atom");
  small const most = at(100) + small(nth(4), 100);
  least(checked_sum(most, most).error().witness == nth(1) && checked_product(3, most).error().witness == nth(1) &&
        checked_difference(at(-100), most).error().witness == nth(1));
  small const later = at(1) + small(nth(4), 100);
  least(checked_sum(later, later).error().witness == nth(4) && checked_product(3, later).error().witness == nth(4));
}

// Events acting on sets ----------------------------------------------------------------------------------------------------

TEST(apply, is_addition_of_characteristic_functions) {
  law applicable_iff("e is applicable at C ⇔ χ(C) + ι(e) ∈ {0, 1}");
  law adds("χ(e·C) = χ(C) + ι(e)");
  law witness("a refusal names the least atom at which it is not");
  for (auto const& signs : functions({1, 3, 6, 12}, -1, 1))
    for (auto const& members : functions({1, 3, 6, 12}, 0, 1)) {
      auto const e = event_from(signs);
      atom_set c;
      for (auto const& [x, n] : members) c.insert(x);
      auto const target = plus(members, signs);
      auto const offends =
          std::find_if(target.begin(), target.end(), [](auto const& entry) { return entry.second != 1; });
      bool const stays = offends == target.end();
      auto const r = apply(e, c);
      applicable_iff(applicable(e, c) == stays && r.has_value() == stays);
      if (r.has_value()) adds(values_of(*r) == target);
      if (!r.has_value() && !stays) witness(r.error().witness == offends->first);
    }
}
TEST(difference, is_the_one_event_that_leads_there) {
  law leads("diff(C, C′)·C = C′");
  law pointwise("ι(diff(C, C′)) = χ(C′) − χ(C)");
  law back("diff(C′, C) = diff(C, C′)⁻¹");
  auto const all = beliefs(3);
  for (auto const& c : all)
    for (auto const& d : all) {
      auto const e = difference(c, d);
      auto const there = apply(e, c);
      leads(there.has_value() && *there == d);
      pointwise(values_of(e) == plus(values_of(d), values_of(c), -1));
      back(difference(d, c) == inverse(e));
    }
}
TEST(difference, is_a_functor) {
  law functor("diff(C, C′) ∘ diff(C′, C″) = diff(C, C″)");
  law sum("ι(diff(C, C′)) + ι(diff(C′, C″)) = ι(diff(C, C″))");
  law arrow("δ(C → C′) = χ(C′) − χ(C)");
  law arrows("transitions compose where they meet, and nowhere else");
  law made("C → e·C, where e is applicable");
  using transition = rota::transition<atom_set>;
  auto const all = beliefs(2);
  for (auto const& c : all)
    for (auto const& d : all) {
      transition const t{c, d};
      made(*transition::make(c, difference(c, d)) == t && inverse(t) == transition{d, c} &&
           (c == d || transition::make(d, difference(c, d)).error() == apply(difference(c, d), d).error()));
      for (auto const& e : all) {
        transition const u{d, e};
        functor(compose(difference(c, d), difference(d, e)) == difference(c, e));
        sum(delta_of(t) + delta_of(u) == delta_of(compose(t, u)) && event_of(compose(t, u)) == difference(c, e));
        arrow(delta_of(u) == delta(e) - delta(d));
        auto const meets = checked_compose(transition{c, d}, transition{e, c});
        arrows(meets.has_value() == (d == e) &&
               (meets ? *meets == transition::identity(c) : meets.error().witness == difference(d, e).begin()->atom));
      }
    }
}

// Fingerprints --------------------------------------------------------------------------------------------------------------

TEST(fingerprint, is_a_homomorphism_that_tells_all_beliefs_apart) {
  law updates("h(χ(C′)) = h(χ(C)) + h(ι(diff(C, C′)))");
  law agrees("h of a set and of an event is h of its delta");
  std::set<std::uint64_t> seen;
  auto const all = beliefs(3);
  for (auto const& c : all) {
    seen.insert(fingerprint_of(c).value);
    agrees(fingerprint_of(c) == fingerprint_of(delta(c)));
    for (auto const& d : all) {
      auto const e = difference(c, d);
      updates(fingerprint_of(d) == fingerprint_of(c) + fingerprint_of(e));
    }
  }
  EXPECT_EQ(seen.size(), all.size());
  for (auto const& e : events(three_atoms)) agrees(fingerprint_of(e) == fingerprint_of(delta(e)));

  law additive("h(d + e) = h(d) + h(e), h(n·d) = n·h(d), h(−d) = −h(d)");
  for (auto const& d : deltas({2, 9}, 2)) {
    additive(fingerprint_of(3 * d) == 3 * fingerprint_of(d) && fingerprint_of(-d) == -fingerprint_of(d));
    for (auto const& e : deltas({2, 9}, 2)) additive(fingerprint_of(d + e) == fingerprint_of(d) + fingerprint_of(e));
  }
  law visible("r(x) ≠ 0");
  for (std::size_t i = 0; i < 3 * atoms_per_agent; ++i) visible(code(nth(i)) != rota::fingerprint{});
}
TEST(fingerprint, is_the_same_on_every_machine) {
  EXPECT_EQ(fingerprint_of(atom_set{nth(0), nth(8), nth(16)}).value, 0x7f960aaf26f0ed7eu);
}

// The other storage -------------------------------------------------------------------------------------------------------

TEST(dense_event, is_the_sparse_one_in_every_operation) {
  law same("dense and sparse agree");
  law refuses("and refuse the same");
  // Three atoms of 65, around the border of a word.
  constexpr std::array<std::size_t, 3> chosen{0, 63, 64};
  using U = rota::index_universe<65>;
  using sparse_event = rota::event<std::size_t>;
  using sparse_set = rota::atom_set<std::size_t>;
  std::vector<sparse_event> all_events{{}};
  std::vector<sparse_set> all_sets{{}};
  for (std::size_t const x : chosen) {
    auto const shorter_events = all_events;
    for (auto const& e : shorter_events)
      for (auto const& one : {sparse_event::addition(x), sparse_event::subtraction(x)})
        all_events.push_back(compose(e, one));
    auto const shorter_sets = all_sets;
    for (auto c : shorter_sets) {
      c.insert(x);
      all_sets.push_back(c);
    }
  }
  auto const dense = [](auto const& x) { return to_dense(x, U{}).value(); };
  law reads("ι, χ and h of either storage are the same");
  law runs("compose_run of either storage is the same");
  for (auto const& e : all_events)
    for (auto const& f : all_events)
      for (auto const& g : all_events) {
        same(to_sparse(non_associating_atoms(dense(e), dense(f), dense(g))) == non_associating_atoms(e, f, g));
        same(associates(dense(e), dense(f), dense(g)) == associates(e, f, g));
      }
  for (auto const& e : all_events) {
    auto const d = dense(e);
    reads(rota::delta(d) == rota::delta(e) && fingerprint_of(d) == fingerprint_of(e));
    for (auto const& f : all_events)
      for (auto const& g : all_events) {
        std::vector const run{e, f, g};
        std::vector const dense_run{d, dense(f), dense(g)};
        auto const r = rota::compose_run(std::span<rota::dense_event<U> const>(dense_run));
        auto const expected = rota::compose_run<std::size_t>(run);
        runs(r.has_value() == expected.has_value() && (r ? to_sparse(*r) == *expected : r.error() == expected.error()));
      }
    same(to_sparse(d) == e && to_sparse(inverse(d)) == inverse(e) && d.size() == e.size() && d.empty() == e.empty());
    same(to_sparse(d.additions()) == e.additions() && to_sparse(d.subtractions()) == e.subtractions());
    for (std::size_t const x : chosen) same(d(x) == e(x));
    same(d(65) == e(65));  // outside the universe
    for (auto const& f : all_events)
      same(to_sparse(compose(d, dense(f))) == compose(e, f) && (d == dense(f)) == (e == f));
    for (auto const& c : all_sets) {
      auto const r = apply(d, dense(c));
      auto const expected = apply(e, c);
      refuses(applicable(d, dense(c)) == applicable(e, c) && r.has_value() == expected.has_value());
      if (r && expected) same(to_sparse(*r) == *expected);
      if (!r && !expected) refuses(r.error() == expected.error());
    }
  }
  law arrows("so are transitions");
  for (auto const& c : all_sets)
    for (auto const& d : all_sets) {
      reads(rota::delta(dense(c)) == rota::delta(c) && fingerprint_of(dense(c)) == fingerprint_of(c));
      rota::transition const t{c, d};
      rota::transition const dense_t{dense(c), dense(d)};
      arrows(to_sparse(event_of(dense_t)) == event_of(t) && delta_of(dense_t) == delta_of(t) &&
             composable(dense_t, dense_t) == (c == d) &&
             (c == d ? *checked_compose(dense_t, dense_t) == dense_t
                     : checked_compose(dense_t, dense_t).error() == checked_compose(t, t).error()));
      same(to_sparse(difference(dense(c), dense(d))) == difference(c, d));
      same(to_sparse(unite(dense(c), dense(d))) == unite(c, d) && is_subset(dense(c), dense(d)) == is_subset(c, d));
      same(to_sparse(intersect(dense(c), dense(d))) == intersect(c, d) &&
           to_sparse(subtract(dense(c), dense(d))) == subtract(c, d));
      auto const made = rota::dense_event<U>::make(dense(c), dense(d));
      auto const expected = sparse_event::make(c, d);
      refuses(made.has_value() == expected.has_value());
      if (made && expected) same(to_sparse(*made) == *expected);
      if (!made && !expected) refuses(made.error() == expected.error());
    }
  law atoms("so are events of one atom, and sets as atoms come and go");
  for (std::size_t const x : chosen) {
    using dense_event = rota::dense_event<U>;
    atoms(to_sparse(*dense_event::addition(x)) == sparse_event::addition(x));
    atoms(to_sparse(*dense_event::subtraction(x)) == sparse_event::subtraction(x));
    for (auto const& c : all_sets) {
      auto sparse_c = c;
      auto dense_c = dense(c);
      atoms(*dense_c.insert(x) == sparse_c.insert(x) && dense_c == dense(sparse_c) && dense_c.contains(x));
      atoms(dense_c.erase(x) && sparse_c.erase(x) && dense_c == dense(sparse_c) && !dense_c.contains(x));
      atoms(!dense_c.erase(x) && !dense_c.erase(65) && !dense_c.insert(65));
    }
  }
  EXPECT_EQ(to_dense(sparse_event::addition(65), U{}).error().witness, 65u);
}

// Runs -------------------------------------------------------------------------------------------------------------------------

std::vector<event> bracketings(std::vector<event> const& run, std::size_t first, std::size_t last) {
  if (last - first == 1) return {run[first]};
  std::vector<event> all;
  for (auto cut = first + 1; cut < last; ++cut)
    for (auto const& left : bracketings(run, first, cut))
      for (auto const& right : bracketings(run, cut, last)) all.push_back(compose(left, right));
  return all;
}
/// Sequences of events over these atoms.
std::vector<std::vector<event>> sequences(std::vector<std::size_t> const& atoms, std::size_t length) {
  std::vector<std::vector<event>> all{{}};
  for (std::size_t i = 0; i < length; ++i) {
    std::vector<std::vector<event>> longer;
    for (auto const& run : all)
      for (auto const& e : events(atoms)) {
        longer.push_back(run);
        longer.back().push_back(e);
      }
    all = std::move(longer);
  }
  return all;
}
bool applicable_from_somewhere(std::vector<event> const& run, std::vector<atom_set> const& sets) {
  return std::any_of(sets.begin(), sets.end(), [&](atom_set c) {
    for (auto const& e : run) {
      auto next = apply(e, c);
      if (!next) return false;
      c = *std::move(next);
    }
    return true;
  });
}
TEST(run, of_length_six_is_one_event_in_every_bracketing) {
  law iff("compose_run accepts what is consecutively applicable from somewhere, and nothing else");
  law one_event("every bracketing of a run is compose_run, and the sum of its deltas");
  auto const check = [&](std::vector<std::size_t> const& atoms, std::size_t length) {
    std::vector<atom_set> sets;
    for (auto const& members : functions(atoms, 0, 1)) {
      sets.emplace_back();
      for (auto const& [x, n] : members) sets.back().insert(x);
    }
    for (auto const& run : sequences(atoms, length)) {
      auto const composed = rota::compose_run<atom>(run);
      bool const is_run = applicable_from_somewhere(run, sets);
      iff(composed.has_value() == is_run);
      if (!is_run || !composed) continue;
      std::vector<delta> summands;
      for (auto const& e : run) summands.emplace_back(e);
      auto const total = rota::sum<atom, std::int64_t>(summands);
      for (auto const& bracketing : bracketings(run, 0, run.size()))
        one_event(bracketing == *composed && delta(bracketing) == total);
    }
  };
  for (std::size_t length = 1; length <= 6; ++length) check({5}, length);
  for (std::size_t length = 1; length <= 3; ++length) check({5, 8}, length);
}
TEST(run, refusal_names_the_atom_and_both_events) {
  auto const s = event::addition(nth(3));
  auto const other = event::addition(nth(1));
  EXPECT_EQ(rota::compose_run<atom>(std::vector{s, other, s}).error(), (rota::no_run<atom>{nth(3), 0, 2}));
  EXPECT_EQ(rota::compose_run<atom>(std::vector<event>{}).value(), event{});
}

// Def. 2 and Prop. 1 -----------------------------------------------------------------------------------------------------------

TEST(conflict, is_definition_2) {
  law directed("C₁ conflicts with C₂ ⇔ some atom is in C₁ and not in C₂");
  law agents("in conflict ⇔ either way");
  law cause("the causes are those atoms");
  law types("never between plan types");
  auto const all = beliefs(3);
  for (auto const& c : all)
    for (auto const& d : all) {
      allocation const c1{names::plan_type::ours, c};
      allocation const c2{names::plan_type::ours, d};
      allocation const other{names::plan_type::other, d};
      atom_set missing;
      for (auto const& x : c)
        if (std::find(d.begin(), d.end(), x) == d.end()) missing.insert(x);
      directed(conflicts_with(c1, c2) == !missing.empty());
      cause(causes(c1, c2) == missing);
      agents(in_conflict(c1, c2) == (conflicts_with(c1, c2) || conflicts_with(c2, c1)));
      types(!conflicts_with(c1, other) && !in_conflict(c1, other) && causes(c1, other).empty());
    }
}
TEST(proposition_1, the_witness_is_in_conflict_with_b) {
  law conflict("the witness and b are in conflict, by the same cause");
  law news("b's next message is a non-empty event at the witness");
  std::map<rota::conflict_partner, int> branches;
  auto const all = beliefs(2);
  for (auto const& c : all)
    for (auto const& d : all)
      for (auto const& own : all) {
        allocation const c1{names::plan_type::ours, c};
        allocation const c2{names::plan_type::ours, d};
        allocation const cb{names::plan_type::ours, own};
        for (auto const& x : causes(c1, c2)) {
          auto const w = proposition_1(c1, c2, cb, x);
          bool const first = w.partner == rota::conflict_partner::first;
          ++branches[w.partner];
          conflict(w.cause == x && (first ? causes(c1, cb) : causes(cb, c2)).contains(x));
          news(part(first ? c : d, x.agent) != part(own, x.agent));
        }
      }
  EXPECT_EQ(branches.size(), 2u);
}

// Def. 5 -------------------------------------------------------------------------------------------------------------------------

TEST(cycle, restores_the_part_of_b) {
  law restores("a cycle ⇔ e_m ≠ ∅ and b's part is as it was");
  law dense("of dense events, too");
  using both_agents = rota::in_universe<names, rota::name_list<names::agent{0}, names::agent{1}>,
                                        rota::name_list<names::plan{0}, names::plan{1}>,
                                        rota::name_list<names::task{0}, names::task{1}, names::task{2}>>;
  auto const in_planes = [](event const& e) { return to_dense(e, both_agents{}).value(); };
  auto const all = beliefs(2);
  for (auto const& before : all)
    for (std::uint8_t agent = 0; agent < 2; ++agent) {
      auto const b = static_cast<names::agent>(agent);
      for (std::size_t i = 0; i <= atoms_per_agent; ++i) {
        auto const told = with_part(before, b, i == atoms_per_agent ? atom_set{} : atom_set{nth(agent * 6u + i)});
        auto const e_m = difference(before, told);
        for (auto const& after : all) {
          auto const e_r = difference(told, after);
          bool const restored = !e_m.empty() && part(after, b) == part(before, b);
          restores(is_cycle(e_m, e_r, b) == restored);
          dense(is_cycle(in_planes(e_m), in_planes(e_r), b) == restored);
        }
      }
    }
}

TEST(cycle, entails_a_conflict_only_while_b_stands_by_its_message) {
  law stands("a cycle, and b's part of C_b is still what it told ⇒ a and b are in conflict");
  law moved("a cycle, and C_b is by now what a believes ⇒ they are not");
  auto const all = beliefs(2);
  auto const b = static_cast<names::agent>(1);
  for (auto const& before : all)
    for (auto const& told : all)
      for (auto const& after : all) {
        if (part(told, names::agent{}) != part(before, names::agent{})) continue;  // b speaks for itself
        if (!is_cycle(difference(before, told), difference(told, after), b)) continue;
        allocation const believed{names::plan_type::ours, after};
        moved(!in_conflict(believed, allocation{names::plan_type::ours, after}));
        for (auto const& own : all)
          if (part(own, b) == part(told, b)) stands(in_conflict(believed, allocation{names::plan_type::ours, own}));
      }
}

// The same functions on operands of every size -------------------------------------------------------------------------------

/// A fixed sequence of random words.
struct words {
  std::uint64_t state = 1;
  std::uint64_t operator()() { return rota::detail::mix(state += 0x9e3779b97f4a7c15u); }
};
using number_event = rota::event<std::uint32_t>;
using number_delta = rota::delta<std::uint32_t>;

number_event random_event(words& next, std::size_t n, std::size_t range) {
  std::map<std::uint32_t, bool> signs;
  while (signs.size() < n) signs[static_cast<std::uint32_t>(next() % range)] = next() % 2 == 0;
  rota::small_vector<rota::signed_atom<std::uint32_t>, 8> entries;
  for (auto const& [x, plus] : signs) entries.push_back({x, plus ? rota::sign::plus : rota::sign::minus});
  return number_event::from_entries(std::move(entries));
}
TEST(every_size, composes_adds_differs_and_applies_pointwise) {
  law composes("(e∘f)(x) = clamp(e(x) + f(x))");
  law adds("(ι(e) + ι(f))(x) = e(x) + f(x)");
  law differs("ι(diff(C, C′)) = χ(C′) − χ(C)");
  law applies("diff(C, C′)·C = C′");
  using numbers = std::map<std::uint32_t, int>;
  words next;
  for (std::size_t const m : {0u, 1u, 2u, 7u, 8u, 9u, 16u, 31u, 64u, 200u, 1000u})
    for (std::size_t const n : {0u, 1u, 3u, 8u, 17u, 33u, 64u, 65u, 127u, 500u, 1000u}) {
      auto const range = 3 * std::max(m, n) + 1;  // one for both, so that a short one lies all over a long one
      auto const e = random_event(next, m, range);
      auto const f = random_event(next, n, range);
      numbers sum;
      for (auto const& x : e) sum[x.atom] += to_int(x.value);
      for (auto const& x : f) sum[x.atom] += to_int(x.value);
      std::erase_if(sum, [](auto const& entry) { return entry.second == 0; });
      numbers composite;
      for (auto const& x : compose(e, f)) composite[x.atom] = to_int(x.value);
      numbers total;
      for (auto const& x : number_delta(e) + number_delta(f)) total[x.atom] = static_cast<int>(x.count);
      adds(total == sum);
      for (auto& [x, s] : sum) s = std::clamp(s, -1, 1);
      composes(composite == sum);

      auto const c = e.additions();
      auto const d = f.additions();
      numbers change;
      for (auto const& x : d) change[x] += 1;
      for (auto const& x : c) change[x] -= 1;
      std::erase_if(change, [](auto const& entry) { return entry.second == 0; });
      numbers found;
      for (auto const& x : difference(c, d)) found[x.atom] = to_int(x.value);
      differs(found == change);
      auto const there = apply(difference(c, d), c);
      applies(there.has_value() && *there == d);
    }
}

TEST(every_size, of_a_universe_composes_as_sparse_events_do) {
  law same("dense and sparse agree, whatever the number of words");
  words next;
  for (std::size_t const size : {1u, 63u, 64u, 65u, 128u, 1000u, 1023u, 1024u, 1025u, 1100u, 1984u, 2048u, 4100u}) {
    std::vector<std::uint32_t> numbers(size);
    for (std::size_t i = 0; i < size; ++i) numbers[i] = static_cast<std::uint32_t>(3 * i);
    rota::atom_set<std::uint32_t> const all(numbers.begin(), numbers.end());
    rota::listed_universe<std::uint32_t> const u(all);
    auto const random = [&] {
      std::vector<std::uint32_t> plus, minus;
      for (auto const x : numbers) {
        auto const which = next() % 4;
        if (which < 2) (which == 0 ? plus : minus).push_back(x);
      }
      using set = rota::atom_set<std::uint32_t>;
      return number_event::make(set(plus.begin(), plus.end()), set(minus.begin(), minus.end())).value();
    };
    auto const e = random();
    auto const f = random();
    auto const d = to_dense(e, u).value();
    auto const g = to_dense(f, u).value();
    same(to_sparse(compose(d, g)) == compose(e, f) && compose(d, g) == to_dense(compose(e, f), u).value());
    same(to_sparse(inverse(d)) == inverse(e) && compose(d, inverse(d)).empty());
    auto const c = e.additions();
    auto const change = difference(d.additions(), g.additions());
    same(to_sparse(change) == difference(c, f.additions()));
    same(apply(change, d.additions()).value() == g.additions());
    same(to_sparse(unite(d.additions(), g.additions())) == unite(c, f.additions()));
  }
}

}  // namespace
