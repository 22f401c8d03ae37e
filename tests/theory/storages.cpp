// Dense events and sets, which must agree with the sparse ones, and operands of every size.

#include "theory/every_case.hpp"

#include <rota/algebra/apply.hpp>
#include <rota/algebra/associativity.hpp>
#include <rota/algebra/dense_event.hpp>
#include <rota/algebra/fingerprint.hpp>
#include <rota/algebra/runs.hpp>
#include <rota/algebra/transition.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace storages_theory {
namespace {

using namespace theory;

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
      auto const range =
          3 * std::max(m, n) + 1;  // one range for both, so that the atoms of a short event are spread over a long one
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
}  // namespace storages_theory
