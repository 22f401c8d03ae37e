// One wrong model per law: the checkers that pass the library's types must reject each of these, for the named law alone.
// Where a law follows from others, no model can break it alone; those cases say so.

#include "algebra/laws.hpp"
#include "algebra/models.hpp"
#include "algebra/universe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

using laws::law_names;
using universe::atom;
using universe::atom_set;
using universe::delta;
using universe::event;

// Wrong events --------------------------------------------------------------------------------------------------------

/// Signs on two atoms, composed by a table: most mistakes at one atom can be written this way.
template <class Table>
struct by_table {
  using signs = std::array<int, 2>;
  static std::vector<signs> elements() {
    return universe::every(2, -1, 1,
                           [](std::vector<int> const& v) { return v.size() == 2 ? signs{v[0], v[1]} : signs{}; });
  }
  static bool valid(signs const& e) { return std::abs(e[0]) <= 1 && std::abs(e[1]) <= 1; }
  static signs identity() { return {}; }
  static signs inverse(signs const& e) { return {-e[0], -e[1]}; }
  static signs compose(signs const& e, signs const& f) { return {Table::at(e[0], f[0]), Table::at(e[1], f[1])}; }
};

struct clamped {
  static int at(int s, int t) { return std::clamp(s + t, -1, 1); }
};
struct unclamped {
  static int at(int s, int t) { return s + t; }
};
/// Unmatched entries come out with the sign swapped.
struct swaps_what_one_side_mentions {
  static int at(int s, int t) { return s == 0 || t == 0 ? -(s + t) : clamped::at(s, t); }
};
/// Wraps around instead of clamping: the group Z/3, which shows that e∘e = e is the price of a group.
struct wraps_around {
  static int at(int s, int t) { return (s + t + 4) % 3 - 1; }
};

/// The inverse forgets to swap the two sets.
struct inverse_does_not_swap : by_table<clamped> {
  static signs inverse(signs const& e) { return e; }
};

/// Right as a function, but atoms that cancel stay behind with sign zero.
struct keeps_zero_signs {
  using entries = std::map<int, int>;
  static std::vector<entries> elements() {
    return universe::every(2, -1, 1, [](std::vector<int> const& v) {
      entries e;
      for (std::size_t i = 0; i < v.size(); ++i)
        if (v[i] != 0) e[static_cast<int>(i)] = v[i];
      return e;
    });
  }
  static bool valid(entries const& e) {
    return std::none_of(e.begin(), e.end(), [](auto const& x) { return x.second == 0; });
  }
  static entries identity() { return {}; }
  static entries inverse(entries e) {
    for (auto& [x, s] : e) s = -s;
    return e;
  }
  static entries compose(entries e, entries const& f) {
    for (auto const& [x, s] : f) e[x] = clamped::at(e[x], s);
    return e;
  }
  static bool equal(entries a, entries b) {
    std::erase_if(a, [](auto const& x) { return x.second == 0; });
    std::erase_if(b, [](auto const& x) { return x.second == 0; });
    return a == b;
  }
};

/// Events about one agent and one of two tasks: 0, +1, −1, +2, −2.
struct one_agent {
  static std::vector<int> elements() { return {0, 1, -1, 2, -2}; }
  static bool valid(int e) { return std::abs(e) <= 2; }
  static int identity() { return 0; }
  static int inverse(int e) { return -e; }
};
/// The later statement about the agent replaces the earlier one.
struct later_wins : one_agent {
  static int compose(int e, int f) { return e == -f ? 0 : f == 0 ? e : f; }
};
/// Cancels by agent and forgets the task.
struct cancels_by_agent : one_agent {
  static int compose(int e, int f) {
    return (e < 0) != (f < 0) && e != 0 && f != 0 ? 0 : std::abs(e) > std::abs(f) ? e : f;
  }
};

TEST(wrong_model, event_laws_accept_the_library_and_its_table) {
  EXPECT_EQ(laws::broken<models::events>(laws::event_laws), law_names{});
  EXPECT_EQ(laws::broken<by_table<clamped>>(laws::event_laws), law_names{});
}
TEST(wrong_model, event_closed) { EXPECT_EQ(laws::broken<keeps_zero_signs>(laws::event_laws), law_names{"closed"}); }
TEST(wrong_model, event_identity) {
  EXPECT_EQ(laws::broken<by_table<swaps_what_one_side_mentions>>(laws::event_laws), law_names{"identity"});
}
TEST(wrong_model, event_commutative) {
  EXPECT_EQ(laws::broken<later_wins>(laws::event_laws), law_names{"commutative"});
}
TEST(wrong_model, event_inverse) {
  EXPECT_EQ(laws::broken<inverse_does_not_swap>(laws::event_laws), law_names{"inverse"});
}
TEST(wrong_model, event_unique_inverse) {
  EXPECT_EQ(laws::broken<cancels_by_agent>(laws::event_laws), law_names{"unique_inverse"});
}
TEST(wrong_model, event_idempotent) {
  EXPECT_EQ(laws::broken<by_table<wraps_around>>(laws::event_laws), law_names{"idempotent"});
  EXPECT_EQ(laws::broken<by_table<wraps_around>>(laws::abelian_group_laws), law_names{})
      << "a group law on sign functions exists, but it is not Def. 4";
}
TEST(wrong_model, composing_without_the_clamp) {
  // e∘e = e is in the set, so leaving the set breaks both.
  EXPECT_EQ(laws::broken<by_table<unclamped>>(laws::event_laws), (law_names{"closed", "idempotent"}));
}

// Wrong groups --------------------------------------------------------------------------------------------------------

/// Saturates at ±2; at ±1 it would be Def. 4, broken for the same reason.
struct saturates {
  static std::vector<delta> elements() { return universe::every_delta(2, 2); }
  static bool valid(delta const& d) { return models::deltas::valid(d); }
  static delta identity() { return {}; }
  static delta inverse(delta const& d) { return -d; }
  static delta compose(delta const& d, delta const& e) {
    delta r;
    for (auto const& x : d + e) r += delta(x.atom, std::clamp<std::int64_t>(x.count, -2, 2));
    return r;
  }
};

/// The invariant "no count zero" forgotten: sums are right pointwise, but cancelled atoms stay.
struct keeps_zero_counts {
  using counts = std::map<int, int>;
  static std::vector<counts> elements() {
    return universe::every(2, -1, 1, [](std::vector<int> const& v) {
      counts d;
      for (std::size_t i = 0; i < v.size(); ++i)
        if (v[i] != 0) d[static_cast<int>(i)] = v[i];
      return d;
    });
  }
  static bool valid(counts const&) { return true; }
  static counts identity() { return {}; }
  static counts inverse(counts d) {
    for (auto& [x, n] : d) n = -n;
    return d;
  }
  static counts compose(counts d, counts const& e) {
    for (auto const& [x, n] : e) d[x] += n;
    return d;
  }
};

/// The history itself, kept in order and reduced: the free group, where nothing commutes.
struct words {
  using word = std::vector<int>;  // ±1, ±2: a generator or its inverse
  static std::vector<word> elements() {
    return {{}, {1}, {-1}, {2}, {-2}, {1, 2}, {2, 1}, {1, -2}, {2, 2}, {-1, 2, 1}};
  }
  static bool valid(word const& w) {
    return std::adjacent_find(w.begin(), w.end(), [](int a, int b) { return a == -b; }) == w.end();
  }
  static word identity() { return {}; }
  static word inverse(word w) {
    std::reverse(w.begin(), w.end());
    for (int& x : w) x = -x;
    return w;
  }
  static word compose(word v, word const& w) {
    for (int const x : w) {
      if (!v.empty() && v.back() == -x)
        v.pop_back();
      else
        v.push_back(x);
    }
    return v;
  }
  static word scale(int n, word const& w) {
    word r;
    for (int k = 0; k < std::abs(n); ++k) r = compose(r, n < 0 ? inverse(w) : w);
    return r;
  }
};

/// Every sum counts one message too many.
struct counts_the_messenger {
  static std::vector<int> elements() { return {-3, -2, -1, 0, 1, 2, 3}; }
  static bool valid(int) { return true; }
  static int identity() { return 0; }
  static int inverse(int d) { return -d - 1; }
  static int compose(int d, int e) { return d + e + 1; }
};

/// A natural number of robots: nothing below zero.
struct no_negatives : saturates {
  static std::vector<delta> elements() { return universe::every(2, 0, 2, universe::delta_of<std::int64_t>); }
  static bool valid(delta const& d) {
    return std::all_of(d.begin(), d.end(), [](auto const& x) { return x.count > 0; });
  }
  static delta compose(delta const& d, delta const& e) { return d + e; }
};

TEST(wrong_model, group_laws_accept_the_library) {
  EXPECT_EQ(laws::broken<models::deltas>(laws::abelian_group_laws), law_names{});
}
TEST(wrong_model, group_associative) {
  EXPECT_EQ(laws::broken<saturates>(laws::abelian_group_axioms), law_names{"associative"});
  EXPECT_EQ(laws::broken<saturates>(laws::abelian_group_laws), (law_names{"associative", "cancellative"}))
      << "cancellation follows from associativity and inverses, and falls with it";
}
TEST(wrong_model, group_inverse) {
  EXPECT_EQ(laws::broken<keeps_zero_counts>(laws::abelian_group_laws), law_names{"inverse"});
}
TEST(wrong_model, group_commutative) {
  EXPECT_EQ(laws::broken<words>(laws::abelian_group_laws), law_names{"commutative"});
}
TEST(wrong_model, group_identity) {
  EXPECT_EQ(laws::broken<counts_the_messenger>(laws::abelian_group_laws), law_names{"identity"});
}
TEST(wrong_model, group_closed) {
  EXPECT_EQ(laws::broken<no_negatives>(laws::abelian_group_laws), law_names{"closed"});
}

// Wrong scalings ------------------------------------------------------------------------------------------------------

struct scales_to_nothing : models::deltas {
  static delta scale(int, delta const&) { return {}; }
};
struct loses_the_sign_of_the_scalar : models::deltas {
  static delta scale(int n, delta const& d) { return std::abs(n) * d; }
};
/// Multiplies twice.
struct squares_the_scalar : models::deltas {
  static delta scale(int n, delta const& d) { return n * (n * d); }
};

TEST(wrong_model, module_laws_accept_the_library) {
  EXPECT_EQ(laws::broken_module_laws<models::deltas>(), law_names{});
}
TEST(wrong_model, module_unit) { EXPECT_EQ(laws::broken_module_laws<scales_to_nothing>(), law_names{"scale_unit"}); }
TEST(wrong_model, module_adds_scalars) {
  EXPECT_EQ(laws::broken_module_laws<loses_the_sign_of_the_scalar>(), law_names{"scale_adds_scalars"});
  EXPECT_EQ(laws::broken_module_laws<squares_the_scalar>(), law_names{"scale_adds_scalars"});
}
TEST(wrong_model, module_adds_elements) {
  EXPECT_EQ(laws::broken_module_laws<words>(), law_names{"scale_adds_elements"})
      << "powers of words that do not commute";
}
// mn·d = m·(n·d) cannot fail alone: unit and sum of scalars make n·d the n-fold sum of d.
struct scales_by_the_successor : models::deltas {
  static delta scale(int n, delta const& d) { return (n + 1) * d; }
};
TEST(wrong_model, module_multiplies) {
  EXPECT_EQ(laws::broken_module_laws<scales_by_the_successor>(),
            (law_names{"scale_unit", "scale_adds_scalars", "scale_multiplies"}));
}

// Wrong embeddings ----------------------------------------------------------------------------------------------------

/// Clamps by parity: right on the image of ι, wrong on sums.
struct clamps_by_parity : models::embedding {
  static event clamp(delta const& d) {
    delta odd;
    for (auto const& x : d)
      if (x.count % 2 != 0) odd += delta(x.atom, x.count);
    return rota::clamp(odd);
  }
};
/// Forgets subtractions. The first law is the second one at f = 0, so it cannot fail alone.
struct forgets_subtractions : models::embedding {
  static event clamp(delta const& d) { return event::make(rota::clamp(d).additions(), {}).value(); }
};

TEST(wrong_model, embedding_laws_accept_the_library) {
  EXPECT_EQ(laws::broken_embedding_laws<models::embedding>(), law_names{});
}
TEST(wrong_model, embedding_compose_is_clamped_sum) {
  EXPECT_EQ(laws::broken_embedding_laws<clamps_by_parity>(), law_names{"compose_is_clamped_sum"});
}
TEST(wrong_model, embedding_clamp_retracts) {
  EXPECT_EQ(laws::broken_embedding_laws<forgets_subtractions>(),
            (law_names{"clamp_retracts_embed", "compose_is_clamped_sum"}));
}

// Wrong extensions ----------------------------------------------------------------------------------------------------

struct ignores_multiplicity {
  template <class F>
  static std::int64_t extend(delta const& d, F const& f, std::int64_t zero) {
    for (auto const& x : d) zero += x.count > 0 ? f(x.atom) : -f(x.atom);
    return zero;
  }
};
struct extends_to_zero {
  template <class F>
  static std::int64_t extend(delta const&, F const&, std::int64_t zero) {
    return zero;
  }
};

template <class M>
law_names broken_extension_laws() {
  law_names all;
  auto const f = [](atom const& x) { return std::int64_t{x == universe::nth(0) ? 3 : 7}; };
  auto const deltas = universe::every_delta(2, 2);
  for (std::size_t i = 0; i < 2; ++i)
    if (!laws::extend_agrees_on_generators<M, delta>(universe::nth(i), f, std::int64_t{0})) all.insert("generators");
  for (auto const& d : deltas)
    for (auto const& e : deltas)
      if (!laws::extend_is_additive<M>(d, e, f, std::int64_t{0})) all.insert("additive");
  return all;
}

TEST(wrong_model, extension_laws_accept_the_library) {
  EXPECT_EQ(broken_extension_laws<models::extension>(), law_names{});
}
TEST(wrong_model, extension_additive) {
  EXPECT_EQ(broken_extension_laws<ignores_multiplicity>(), law_names{"additive"});
}
TEST(wrong_model, extension_generators) {
  EXPECT_EQ(broken_extension_laws<extends_to_zero>(), law_names{"generators"});
}

// Wrong actions -------------------------------------------------------------------------------------------------------

struct swaps_the_difference : models::action {
  static event difference(atom_set const& c, atom_set const& d) { return rota::difference(d, c); }
};
/// (C ∖ ϑ⁻) ∪ ϑ⁺ whether or not the event applies.
struct never_refuses : models::action {
  static rota::result<atom_set, rota::inapplicable<atom>> apply(event const& e, atom_set const& c) {
    return unite(subtract(c, e.subtractions()), e.additions());
  }
};
struct names_the_greatest_atom : models::action {
  static rota::result<atom_set, rota::inapplicable<atom>> apply(event const& e, atom_set const& c) {
    auto const r = rota::apply(e, c);
    if (r.has_value()) return *r;
    auto const target = delta(c) + delta(e);
    auto witness = r.error().witness;
    for (auto const& x : target)
      if (x.count != 1) witness = x.atom;
    return rota::refused{rota::inapplicable<atom>{witness}};
  }
};
struct counts_members_twice : models::action {
  static delta characteristic(atom_set const& c) { return 2 * delta(c); }
};
/// The later event wins at each atom: associative, and still wrong.
struct composes_by_the_later : models::action {
  static event compose(event const& e, event const& f) {
    std::vector<int> signs;
    for (std::size_t i = 0; i < 3; ++i) {
      auto const x = universe::nth(i);
      signs.push_back(to_int(f(x) == rota::sign::zero ? e(x) : f(x)));
    }
    return universe::event_of(signs);
  }
};

template <class M>
law_names broken_action_laws() {
  return laws::broken_action_laws<M, delta>(universe::every_event(2), universe::every_set(2));
}

TEST(wrong_model, action_laws_accept_the_library) { EXPECT_EQ(broken_action_laws<models::action>(), law_names{}); }
TEST(wrong_model, action_unique_applicable_event) {
  EXPECT_EQ(broken_action_laws<swaps_the_difference>(), law_names{"unique_applicable_event"});
}
TEST(wrong_model, action_refuses) {
  EXPECT_EQ(broken_action_laws<never_refuses>(), law_names{"refuses_iff_it_leaves_the_sets"});
}
TEST(wrong_model, action_witness) {
  EXPECT_EQ(broken_action_laws<names_the_greatest_atom>(), law_names{"refusal_names_the_least_atom"});
}
TEST(wrong_model, action_characteristic) {
  EXPECT_EQ(broken_action_laws<counts_members_twice>(), law_names{"characteristic_adds"});
}
TEST(wrong_model, action_functor) {
  EXPECT_EQ(broken_action_laws<composes_by_the_later>(),
            (law_names{"difference_is_a_functor", "apply_is_compatible_with_compose"}))
      << "given the unique applicable event, each of the two says the other";
}

// Wrong runs ----------------------------------------------------------------------------------------------------------

/// All runs of this length over two atoms, from every start.
std::vector<std::vector<event>> every_run(std::size_t length) {
  std::vector<std::vector<event>> runs;
  for (auto const& path : universe::every_vector(length + 1, 0, 3)) {
    auto const set = [&](int bits) { return universe::set_of({bits & 1, bits & 2}); };
    std::vector<event> run;
    for (std::size_t i = 0; i < length; ++i) run.push_back(rota::difference(set(path[i]), set(path[i + 1])));
    runs.push_back(std::move(run));
  }
  return runs;
}

template <class M>
law_names broken_run_laws() {
  law_names all;
  for (std::size_t length = 2; length <= 4; ++length)
    for (auto const& run : every_run(length)) {
      if (!laws::brackets_do_not_matter<M>(run)) all.insert("brackets_do_not_matter");
      if (!laws::left_fold_is_clamped_sum<M>(run)) all.insert("left_fold_is_clamped_sum");
    }
  return all;
}

/// Subtracts each event from what came before; as a left fold that is merely the negative of the sum.
struct subtracts : models::action {
  static event compose(event const& e, event const& f) { return rota::compose(e, inverse(f)); }
  static event clamped_sum(std::vector<event> const& run) { return inverse(models::action::clamped_sum(run)); }
};

TEST(wrong_model, run_laws_accept_the_library) { EXPECT_EQ(broken_run_laws<models::action>(), law_names{}); }
TEST(wrong_model, run_brackets) { EXPECT_EQ(broken_run_laws<subtracts>(), law_names{"brackets_do_not_matter"}); }
TEST(wrong_model, run_sum) {
  EXPECT_EQ(broken_run_laws<composes_by_the_later>(), law_names{"left_fold_is_clamped_sum"});
}

}  // namespace
