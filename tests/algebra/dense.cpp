// Dense sets and events against sparse ones, over universes of about one, two and more words; refusals. The laws are in
// tests/testing/events.cpp.

#include "algebra/generators.hpp"
#include "support/allocation_counter.hpp"

#include <rota/algebra/allocation_event.hpp>
#include <rota/algebra/claimed_structures.hpp>
#include <rota/algebra/runs.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace dense_test {

namespace {

using namespace universe;
using rota::sign;
using rota::to_dense;
using rota::to_sparse;

/// nth(0), …, nth(N − 1), as a type.
template <std::size_t N>
struct first_atoms {
  using atom_type = atom;
  static constexpr std::size_t size() { return N; }
  static constexpr rota::result<std::size_t, rota::outside_universe<atom>> index_of(atom const& x) {
    auto const i =
        4 * static_cast<std::size_t>(x.agent) + 2 * static_cast<std::size_t>(x.plan) + static_cast<std::size_t>(x.task);
    if (i >= N) return rota::refused{rota::outside_universe<atom>{x}};
    return i;
  }
  static constexpr atom atom_at(std::size_t i) { return nth(i); }
  friend bool operator==(first_atoms const&, first_atoms const&) = default;
};

constexpr atom_set the_first(std::size_t n) {
  atom_set c;
  for (std::size_t i = 0; i < n; ++i) c.insert(nth(i));
  return c;
}

using word_event = rota::dense_event<first_atoms<64>>;
using listed = rota::listed_universe<atom>;

static_assert(rota::fixed_universe<first_atoms<64>> && rota::fixed_universe<rota::index_universe<7>>);
static_assert(rota::atom_universe<listed> && !rota::fixed_universe<listed>);
static_assert(!std::constructible_from<listed, atom_set&&>, "a view of a temporary");

// One concept, two storages.
static_assert(rota::allocation_event<event> && rota::allocation_event<rota::event<std::string>>);
static_assert(rota::allocation_event<word_event> && rota::allocation_event<rota::dense_event<listed>>);
static_assert(!rota::allocation_event<delta> && !rota::allocation_event<atom_set> && !rota::allocation_event<int>);
static_assert(rota::allocation_set<atom_set> && rota::allocation_set<rota::dense_atom_set<listed>>);
static_assert(!rota::allocation_set<event> && !rota::allocation_set<delta> && !rota::allocation_set<std::vector<atom>>);
static_assert(std::same_as<rota::event_on<rota::dense_atom_set<listed>>, rota::dense_event<listed>>);
static_assert(rota::groupoid<rota::transition<rota::dense_atom_set<listed>>>, "arrows within one universe do compose");
static_assert(std::constructible_from<delta, word_event> && !std::convertible_to<word_event, delta>);
static_assert(!std::constructible_from<delta, rota::dense_event<rota::index_universe<7>>>, "other atoms");
static_assert(rota::invertible_magma<word_event> && rota::commutative_magma<word_event> && !rota::monoid<word_event>);
static_assert(!rota::magma<rota::dense_event<listed>>, "events over two universes do not compose");

// Planes of one word are stored in the object.
static_assert(std::is_trivially_copyable_v<word_event> && std::is_trivially_destructible_v<word_event>);
static_assert(sizeof(word_event) == 2 * sizeof(std::uint64_t));
static_assert(sizeof(rota::dense_atom_set<first_atoms<64>>) == sizeof(std::uint64_t));
static_assert(sizeof(rota::dense_event<first_atoms<65>>) == 4 * sizeof(std::uint64_t));
static_assert(!std::convertible_to<rota::dense_atom_set<first_atoms<64>>, word_event>);

/// Compares every operation on two dense events and two dense sets with the sparse ones. Returns the names of those
/// that differ.
template <class U>
std::string differences(U const& u, event const& e, event const& f, atom_set const& c, atom_set const& d) {
  std::string names;
  auto const expect = [&](bool same, char const* name) {
    if (!same) names += std::string(name) + " ";
  };
  auto const same = [&](auto const& dense, auto const& sparse) {
    return to_sparse(dense) == sparse && dense == *to_dense(sparse, u);
  };
  auto const same_result = [&](auto const& dense, auto const& sparse) {
    return dense.has_value() ? sparse.has_value() && same(*dense, *sparse)
                             : !sparse.has_value() && dense.error() == sparse.error();
  };
  using dense = rota::dense_event<U>;
  auto const de = *to_dense(e, u);
  auto const df = *to_dense(f, u);
  auto const dc = *to_dense(c, u);
  auto const dd = *to_dense(d, u);

  expect(same(de, e) && same(dc, c), "conversion");
  expect((de == df) == (e == f) && (dc == dd) == (c == d), "equality");
  expect(de.size() == e.size() && de.empty() == e.empty(), "size of an event");
  expect(dense(u).empty() && same(dense(u), event{}), "identity");
  expect(same(de.additions(), e.additions()) && same(de.subtractions(), e.subtractions()), "parts");
  for (std::size_t i = 0; i < u.size() + 2; ++i) expect(de(nth(i)) == e(nth(i)), "sign");
  expect(same_result(dense::make(dc, dd), event::make(c, d)), "make");
  expect(same(compose(de, df), compose(e, f)), "compose");
  expect(same(inverse(de), inverse(e)), "inverse");
  expect(same(difference(dc, dd), difference(c, d)), "difference");
  for (event const& g : {e, difference(c, d), compose(difference(c, d), f)}) {  // rarely, always, sometimes applicable
    expect(applicable(*to_dense(g, u), dc) == applicable(g, c), "applicable");
    expect(same_result(rota::apply(*to_dense(g, u), dc), rota::apply(g, c)), "apply");
  }
  expect(dc.size() == c.size() && dc.empty() == c.empty(), "size of a set");
  expect(same(unite(dc, dd), unite(c, d)), "unite");
  expect(same(intersect(dc, dd), intersect(c, d)), "intersect");
  expect(same(subtract(dc, dd), subtract(c, d)), "subtract");
  expect(is_subset(dc, dd) == is_subset(c, d) && is_subset(intersect(dc, dd), dd), "is_subset");
  expect(delta(de) == delta(e) && delta(dc) == delta(c) && rota::delta(dd) == delta(d), "delta");
  expect(fingerprint_of(de) == fingerprint_of(e) && fingerprint_of(dc) == fingerprint_of(c), "fingerprint");
  rota::transition const t{c, d};
  rota::transition const dense_t{dc, dd};
  rota::transition const dense_back{dd, dc};
  expect(same(event_of(dense_t), event_of(t)) && delta_of(dense_t) == delta_of(t), "transition");
  expect(checked_compose(dense_t, dense_back) == rota::transition(dc, dc), "arrows that meet");
  auto const gap = checked_compose(t, t);
  auto const dense_gap = checked_compose(dense_t, dense_t);
  expect(gap.has_value() == dense_gap.has_value() && (gap.has_value() || gap.error() == dense_gap.error()),
         "arrows that do not meet");
  for (auto const& run : {std::array{difference(c, d), difference(d, c), e}, std::array{e, f, inverse(e)}}) {
    std::vector<dense> dense_run;
    for (auto const& g : run) dense_run.push_back(*to_dense(g, u));
    expect(same_result(rota::compose_run(std::span<dense const>(dense_run)), rota::compose_run<atom>(run)),
           "compose_run");
  }
  return names;
}

template <class U>
void no_differences_on_generated(U const& u) {
  auto const n = u.size();
  auto const e = *event_over(n).as("e");
  auto const f = *event_over(n).as("f");
  auto const c = *set_over(n).as("C");
  auto const d = *set_over(n).as("D");
  RC_ASSERT(differences(u, e, f, c, d) == "");
}

template <class U>
void insertion_and_erasure_are_the_same(U const& u) {
  auto const moves = *integers(40, -static_cast<int>(u.size()), static_cast<int>(u.size()) - 1).as("moves");
  atom_set c;
  rota::dense_atom_set<U> dc(u);
  for (int const move : moves) {
    auto const x = nth(static_cast<std::size_t>(move < 0 ? -move - 1 : move));
    RC_ASSERT((move < 0 ? dc.erase(x) : dc.insert(x).value()) == (move < 0 ? c.erase(x) : c.insert(x)));
    RC_ASSERT(dc.contains(x) == c.contains(x));
  }
  RC_ASSERT(to_sparse(dc) == c);
}

/// Calls f with one of the compile-time universes.
template <std::size_t... Sizes, class F>
void with_one_of(std::index_sequence<Sizes...>, std::size_t which, F f) {
  std::size_t i = 0;
  ((i++ == which ? f(first_atoms<Sizes>{}) : void()), ...);
}
using sizes = std::index_sequence<1, 3, 63, 64, 65, 127, 128, 129, 200>;

rc::Gen<std::size_t> universe_size() {
  return rc::gen::oneOf(rc::gen::element<std::size_t>(1, 2, 3, 63, 64, 65, 127, 128, 129, 200),
                        rc::gen::map(integer(1, 200), [](int n) { return static_cast<std::size_t>(n); }));
}

}  // namespace

// The same results ----------------------------------------------------------------------------------------------------

RC_GTEST_PROP(dense, is_sparse_over_universes_of_compile_time_size, ()) {
  with_one_of(sizes{}, static_cast<std::size_t>(*integer(0, int(sizes::size()) - 1).as("universe")),
              [](auto u) { no_differences_on_generated(u); });
}
RC_GTEST_PROP(dense, is_sparse_over_universes_of_run_time_size, ()) {
  auto const all = the_first(*universe_size().as("atoms"));
  no_differences_on_generated(listed(all));
}
RC_GTEST_PROP(dense, insertion_and_erasure_are_those_of_sparse_sets, ()) {
  with_one_of(sizes{}, static_cast<std::size_t>(*integer(0, int(sizes::size()) - 1).as("universe")),
              [](auto u) { insertion_and_erasure_are_the_same(u); });
  auto const all = the_first(*universe_size().as("atoms"));
  insertion_and_erasure_are_the_same(listed(all));
}

TEST(dense, is_sparse_on_everything_over_three_atoms) {
  auto const all = the_first(3);
  int pairs = 0;
  for (auto const& e : every_event(3))
    for (auto const& f : every_event(3))
      for (auto const& c : every_set(3))
        for (auto const& d : every_set(3)) {
          EXPECT_EQ(differences(first_atoms<3>{}, e, f, c, d), "");
          EXPECT_EQ(differences(listed(all), e, f, c, d), "");
          ++pairs;
        }
  EXPECT_EQ(pairs, 27 * 27 * 8 * 8);
}

// Universes -----------------------------------------------------------------------------------------------------------

namespace {

struct soccer {
  enum class agent : std::uint8_t { keeper = 1, left = 4, right = 9 };
  enum class plan_type : std::uint8_t { play };
  enum class plan : std::uint8_t { normal, kickoff };
  enum class task : std::uint8_t { attack, defend };
  enum class state : std::uint8_t { any };
};
using enum soccer::agent;
using enum soccer::plan;
using enum soccer::task;
using pitch = rota::in_universe<soccer, rota::name_list<keeper, left, right>, rota::name_list<normal, kickoff>,
                                rota::name_list<attack, defend>>;
using play = rota::dense_event<pitch>;
using in = rota::in<soccer>;

template <rota::atom_universe U>
constexpr bool is_an_ordered_bijection(U const& u) {
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (*u.index_of(u.atom_at(i)) != i) return false;
    if (i > 0 && !(u.atom_at(i - 1) < u.atom_at(i))) return false;
  }
  return true;
}
static_assert(rota::fixed_universe<pitch> && pitch::size() == 12 && sizeof(play) == 16);
static_assert(is_an_ordered_bijection(pitch{}) && is_an_ordered_bijection(rota::index_universe<70>{}));
static_assert(is_an_ordered_bijection(first_atoms<70>{}));
static_assert(pitch::index_of(in{soccer::agent{2}, normal, attack}).error().witness.agent == soccer::agent{2});
static_assert(!pitch::index_of(in{left, soccer::plan{2}, attack}) &&
              !pitch::index_of(in{left, normal, soccer::task{7}}));

// Two agents swap tasks, at compile time; and nothing happens in the empty universe.
constexpr bool tasks_are_swapped_at_compile_time() {
  using crew = rota::dense_atom_set<pitch>;
  auto const before = to_dense(rota::atom_set<in>{{left, normal, attack}, {right, normal, defend}}, pitch{}).value();
  auto const after = to_dense(rota::atom_set<in>{{left, normal, defend}, {right, normal, attack}}, pitch{}).value();
  auto const swap = rota::difference(before, after);
  return swap.size() == 4 && rota::apply(swap, before) == after && rota::apply(inverse(swap), after) == before &&
         compose(swap, inverse(swap)) == play{} && swap({left, normal, attack}) == sign::minus && crew{}.empty() &&
         rota::apply(swap, after).error().witness == in{left, normal, attack};
}
static_assert(tasks_are_swapped_at_compile_time());
static_assert([] {
  rota::atom_set<int> const numbers{3, 5, 8};
  rota::listed_universe<int> const u(numbers);
  auto const e = rota::dense_event<rota::listed_universe<int>>::addition(5, u).value();
  return is_an_ordered_bijection(u) && compose(e, inverse(e)).empty() && to_sparse(e) == rota::event<int>::addition(5);
}());
static_assert(compose(rota::dense_event<rota::index_universe<0>>{}, {}).empty());

}  // namespace

TEST(dense, listed_universes_are_equal_when_their_atoms_are) {
  auto const a = the_first(70);
  auto const b = the_first(70);
  EXPECT_TRUE(is_an_ordered_bijection(listed(a)));
  EXPECT_EQ(listed(a), listed(b));
  auto const fewer = the_first(69);
  EXPECT_FALSE(listed(a) == listed(fewer));
  EXPECT_FALSE(listed(a) == listed());
}

// Refusals ------------------------------------------------------------------------------------------------------------

RC_GTEST_PROP(dense, refuses_the_least_atom_outside_the_universe, ()) {
  auto const members = *set_over(70).as("universe");
  auto const c = *set_over(70).as("C");
  auto const e = *event_over(70).as("e");
  listed const u(members);
  auto const refuses_least = [&](auto const& conversion, atom_set const& atoms) {
    auto const strangers = subtract(atoms, members);
    return conversion.has_value() ? strangers.empty()
                                  : !strangers.empty() && conversion.error().witness == *strangers.begin();
  };
  RC_ASSERT(refuses_least(to_dense(c, u), c));
  RC_ASSERT(refuses_least(to_dense(e, u), unite(e.additions(), e.subtractions())));
}

TEST(dense, refuses_one_atom_outside_the_universe) {
  auto const stranger = nth(64);
  rota::dense_atom_set<first_atoms<64>> c;
  EXPECT_EQ(c.insert(stranger).error().witness, stranger);
  EXPECT_FALSE(c.erase(stranger));
  EXPECT_FALSE(c.contains(stranger));
  EXPECT_TRUE(c.empty()) << "a refusal changes nothing";
  EXPECT_EQ(word_event::addition(stranger).error().witness, stranger);
  EXPECT_EQ(word_event::subtraction(stranger).error().witness, stranger);
  EXPECT_EQ(word_event::addition(nth(63))->operator()(nth(63)), sign::plus);
  EXPECT_EQ(word_event::subtraction(nth(63))->operator()(nth(63)), sign::minus);
  EXPECT_EQ((*word_event::addition(nth(63)))(stranger), sign::zero) << "finite support";
}

#ifndef NDEBUG
TEST(dense_death, operands_over_different_universes_are_asserted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  auto const a = the_first(3);
  auto const b = the_first(4);
  rota::dense_event<listed> const e{listed(a)}, f{listed(b)};
  rota::dense_atom_set<listed> const c{listed(a)}, d{listed(b)};
  EXPECT_DEATH((void)compose(e, f), "universe");
  EXPECT_DEATH((void)rota::apply(e, d), "universe");
  EXPECT_DEATH((void)difference(c, d), "universe");
  EXPECT_DEATH((void)unite(c, d), "universe");
}
TEST(dense_death, overlapping_planes_are_asserted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH((void)word_event::from_words({}, [](std::size_t) { return std::array<std::uint64_t, 2>{1, 1}; }),
               "minus");
}
#endif

// Memory --------------------------------------------------------------------------------------------------------------

namespace {

template <class U>
std::uint64_t allocations_of_one_composition(U const& u) {
  auto const e = *to_dense(event_of({1, -1, 0, 1}), u);
  auto const f = *to_dense(event_of({0, 1, 1, -1}), u);
  auto const before = rota_test::allocation_count();
  auto const r = compose(e, f);
  auto const allocations = rota_test::allocation_count() - before;
  EXPECT_EQ(r.size(), 2u);
  return allocations;
}

}  // namespace

TEST(dense, events_allocate_only_beyond_256_atoms_of_a_run_time_universe) {
  auto const at_most_inline = the_first(256);
  auto const more = the_first(257);
  EXPECT_EQ(allocations_of_one_composition(first_atoms<64>{}), 0u);
  EXPECT_EQ(allocations_of_one_composition(first_atoms<1000>{}), 0u);
  EXPECT_EQ(allocations_of_one_composition(listed(at_most_inline)), 0u);
  EXPECT_EQ(allocations_of_one_composition(listed(more)), 1u);
}

TEST(dense, one_word_allocates_nothing_whatever_it_does) {
  using set = rota::dense_atom_set<first_atoms<64>>;
  auto const before = rota_test::allocation_count();
  set c;
  set d;
  for (std::size_t i = 0; i < 64; ++i) (void)(i % 3 == 0 ? c : d).insert(nth(i));
  auto const e = rota::difference(c, d);
  auto const f = *word_event::make(c, d);
  bool const right = *rota::apply(e, c) == d && compose(e, inverse(e)).empty() && compose(e, f).empty() &&
                     applicable(e, c) && !applicable(f, c) && f.additions() == c;
  auto const allocations = rota_test::allocation_count() - before;
  EXPECT_TRUE(right);
  EXPECT_EQ(allocations, 0u);
}

}  // namespace dense_test
