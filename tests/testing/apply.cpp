// Difference, apply and runs. Each law is a test of its own, such as event.apply.unique_applicable_event, for both
// storages and for a foreign one. Then one wrong model per law, in each storage.

#include "testing/foreign.hpp"
#include "testing/wrong.hpp"

#include <rota/testing/apply_laws.hpp>
#include <rota/testing/gtest.hpp>

#include <map>
#include <set>
#include <span>
#include <vector>

namespace apply_test {

using namespace rota::testing;
using sample::atom;
using sample::delta;
using sample::dense_event;
using sample::event;
using sample::map_event;

[[maybe_unused]] bool const registered =
    register_laws("event", apply_laws<event>()) && register_laws("event", apply_theorems<event>()) &&
    register_laws("event", run_laws<event>()) && register_laws("dense_event", apply_laws<dense_event>()) &&
    register_laws("dense_event", apply_theorems<dense_event>()) &&
    register_laws("dense_event", run_laws<dense_event>()) && register_laws<map_event>("map_event");

// The right functions; each model below changes one ----------------------------------------------------------

template <class E>
using right = rota::structure<E>;
template <class E>
using as = storage<E, right<E>>;
template <class E>
using set_of = typename right<E>::set_type;
template <class E>
using applied = rota::result<set_of<E>, rota::inapplicable<atom>>;
template <class E>
using composed = rota::result<E, rota::no_run<atom>>;

template <class E>
composed<E> right_run(std::span<E const> events) {
  std::vector<event> values;
  for (auto const& e : events) values.push_back(as<E>::read(e));
  auto const r = rota::compose_run(std::span<event const>(values));
  if (!r) return rota::refused{r.error()};
  return as<E>::stored(*r);
}

// Apply and difference ------------------------------------------------------------------------------------------------

template <class E>
struct swaps_the_difference : right<E> {
  static E difference(set_of<E> const& c, set_of<E> const& d) { return right<E>::difference(d, c); }
};
/// (C ∖ e⁻) ∪ e⁺, whether or not e is applicable.
template <class E>
struct never_refuses : right<E> {
  static applied<E> apply(E const& e, set_of<E> const& c) {
    auto const signs = as<E>::read(e);
    return as<E>::stored(unite(subtract(as<E>::read(c), signs.subtractions()), signs.additions()));
  }
};
template <class E>
struct names_the_greatest_atom : right<E> {
  static applied<E> apply(E const& e, set_of<E> const& c) {
    auto const r = right<E>::apply(e, c);
    if (r.has_value()) return *r;
    auto witness = r.error().witness;
    for (auto const& x : delta(as<E>::read(c)) + delta(as<E>::read(e)))
      if (x.count != 1) witness = x.atom;
    return rota::refused{rota::inapplicable<atom>{witness}};
  }
};
template <class E>
struct overlooks_the_least_member : right<E> {
  static std::set<atom> members(set_of<E> const& c) {
    auto const all = as<E>::read(c);
    return {all.empty() ? all.begin() : all.begin() + 1, all.end()};
  }
};
/// The later event wins at each atom: associative, and still wrong.
template <class E>
struct composes_by_the_later : right<E> {
  static E combine(E const& e, E const& f) {
    auto const x = as<E>::read(e);
    auto const y = as<E>::read(f);
    auto const mentioned = unite(y.additions(), y.subtractions());
    return as<E>::stored(event::make(unite(subtract(x.additions(), mentioned), y.additions()),
                                     unite(subtract(x.subtractions(), mentioned), y.subtractions()))
                             .value());
  }
};
template <class E>
void one_model_for_each_law_of_apply() {
  EXPECT_EQ((broken(apply_laws<E, swaps_the_difference<E>>())), "unique_applicable_event");
  EXPECT_EQ((broken(apply_laws<E, never_refuses<E>>())), "refuses_iff_it_leaves_the_sets");
  EXPECT_EQ((broken(apply_laws<E, names_the_greatest_atom<E>>())), "refusal_names_the_least_atom");
  EXPECT_EQ((broken(apply_laws<E, overlooks_the_least_member<E>>())), "characteristic_adds");
  EXPECT_EQ((broken(apply_laws<E, composes_by_the_later<E>>())), "compatible_with_compose");
  EXPECT_EQ((broken(apply_theorems<E, composes_by_the_later<E>>())), "difference_is_a_functor");
}
TEST(wrong_apply, one_model_for_each_law) { one_model_for_each_law_of_apply<event>(); }
TEST(wrong_apply, one_model_for_each_law_of_dense_events) { one_model_for_each_law_of_apply<dense_event>(); }
TEST(wrong_apply, one_model_for_each_law_of_foreign_events) { one_model_for_each_law_of_apply<map_event>(); }

// Runs ----------------------------------------------------------------------------------------------------------------

/// The composition so far, to which only single events can be added: right as a left fold, but in no other brackets.
template <class E>
struct accumulated {
  E value{};
  bool several = false;
  friend bool operator==(accumulated const& x, accumulated const& y) { return x.value == y.value; }
};
template <class E>
struct only_accumulates {
  using item = accumulated<E>;
  using set_type = set_of<E>;
  static item combine(item const& e, item const& f) {
    return f.several ? e : item{right<E>::combine(e.value, f.value), true};
  }
  static item difference(set_type const& c, set_type const& d) { return {right<E>::difference(c, d)}; }
  static bool applicable(item const& e, set_type const& c) { return right<E>::applicable(e.value, c); }
  static applied<E> apply(item const& e, set_type const& c) { return right<E>::apply(e.value, c); }
  static composed<item> compose_run(std::span<item const> events) {
    std::vector<E> values;
    for (auto const& e : events) values.push_back(e.value);
    auto const r = right_run(std::span<E const>(values));
    if (!r) return rota::refused{r.error()};
    return item{*r};
  }
  static std::map<atom, int> signs(item const& e) {
    std::map<atom, int> r;
    for (auto const& x : as<E>::read(e.value)) r[x.atom] = to_int(x.value);
    return r;
  }
  static item event_with(std::map<atom, int> const& signs) {
    event e;
    for (auto const& [x, s] : signs) e = compose(e, s > 0 ? event::addition(x) : event::subtraction(x));
    return {as<E>::stored(e)};
  }
  static set_type set_with(std::set<atom> const& members) {
    return as<E>::stored(sample::atom_set(members.begin(), members.end()));
  }
  static std::set<atom> members(set_type const& c) {
    auto const r = as<E>::read(c);
    return {r.begin(), r.end()};
  }
};
/// The later event wins, also in runs of several.
template <class E>
struct runs_by_the_later : composes_by_the_later<E> {
  static composed<E> compose_run(std::span<E const> run) {
    auto const r = right_run(run);
    if (!r) return r;
    E folded = run.front();
    for (auto const& e : run.subspan(1)) folded = composes_by_the_later<E>::combine(folded, e);
    return folded;
  }
};
template <class E>
struct forgets_the_last : right<E> {
  static composed<E> compose_run(std::span<E const> run) {
    auto const r = right_run(run);
    return r && run.size() > 3 ? right_run(run.first(run.size() - 1)) : r;
  }
};
template <class E>
struct composes_what_is_no_run : right<E> {
  static composed<E> compose_run(std::span<E const> run) {
    auto const r = right_run(run);
    if (r) return r;
    return run.front();
  }
};
template <class E>
struct blames_the_first_two : right<E> {
  static composed<E> compose_run(std::span<E const> run) {
    auto const r = right_run(run);
    if (r) return r;
    return rota::refused{rota::no_run<atom>{r.error().witness, 0, 1}};
  }
};
template <class E>
void one_model_for_each_law_of_runs() {
  EXPECT_EQ((broken(run_laws<accumulated<E>, only_accumulates<E>>())), "brackets_do_not_matter");
  EXPECT_EQ((broken(run_laws<E, runs_by_the_later<E>>())), "left_fold_is_the_sum");
  EXPECT_EQ((broken(run_laws<E, forgets_the_last<E>>())), "compose_run_is_the_left_fold");
  EXPECT_EQ((broken(run_laws<E, composes_what_is_no_run<E>>())), "compose_run_refuses_the_rest");
  EXPECT_EQ((broken(run_laws<E, blames_the_first_two<E>>())), "compose_run_refuses_the_rest");
}
TEST(wrong_run, one_model_for_each_law) { one_model_for_each_law_of_runs<event>(); }
TEST(wrong_run, one_model_for_each_law_of_dense_events) { one_model_for_each_law_of_runs<dense_event>(); }
TEST(wrong_run, one_model_for_each_law_of_foreign_events) { one_model_for_each_law_of_runs<map_event>(); }

}  // namespace apply_test
