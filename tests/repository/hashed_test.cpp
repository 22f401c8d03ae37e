#include <rota/hash.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace hashed_test {

struct crew {
  enum class agent : std::uint8_t {};
  enum class plan_type : std::uint8_t { voyage };
  enum class plan : std::uint8_t {};
  enum class task : std::uint8_t {};
  using state = rota::strong_id<crew, std::array<std::uint8_t, 16>>;
};
using atom = rota::in<crew>;

atom nth(unsigned i) {
  return {static_cast<crew::agent>(i / 4), static_cast<crew::plan>(i / 2 % 2), static_cast<crew::task>(i % 2)};
}
/// Every event over the first five atoms: 3⁵ of them, by the digits of a number.
std::vector<rota::event<atom>> every_event() {
  std::vector<rota::event<atom>> all;
  for (unsigned n = 0; n < 243; ++n) {
    rota::atom_set<atom> plus, minus;
    for (unsigned i = 0, digits = n; i < 5; ++i, digits /= 3) {
      if (digits % 3 == 1) plus.insert(nth(i));
      if (digits % 3 == 2) minus.insert(nth(i));
    }
    all.push_back(*rota::event<atom>::make(plus, minus));
  }
  return all;
}

/// That equal values have equal hashes, and that these differ among themselves, as 64 bits of a good mix do.
template <class T>
void expect_good_hashes(std::vector<T> const& distinct) {
  std::unordered_set<std::size_t> hashes;
  std::unordered_map<T, std::size_t> places;
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    T const copy = distinct[i];
    EXPECT_EQ(std::hash<T>{}(copy), std::hash<T>{}(distinct[i]));
    hashes.insert(std::hash<T>{}(copy));
    EXPECT_TRUE(places.emplace(copy, i).second);
  }
  EXPECT_EQ(hashes.size(), distinct.size());
  for (std::size_t i = 0; i < distinct.size(); ++i) EXPECT_EQ(places.at(distinct[i]), i);
}
template <class T, class From, class Make>
void expect_good_hashes_of(std::vector<From> const& from, Make make) {
  std::vector<T> all;
  for (From const& x : from) all.push_back(make(x));
  expect_good_hashes(all);
}

TEST(hashed, names_and_atoms) {
  std::vector<unsigned> numbers;
  for (unsigned i = 0; i < 200; ++i) numbers.push_back(i);
  using id = rota::strong_id<crew>;
  expect_good_hashes_of<id>(numbers, [](unsigned i) { return id{i}; });
  expect_good_hashes_of<crew::state>(numbers, [](unsigned i) {
    crew::state z;
    z.value[i % 16] = static_cast<std::uint8_t>(1 + i / 16);
    return z;
  });
  using text = rota::strong_id<crew, std::array<char, 4>>;
  static_assert(std::is_default_constructible_v<std::hash<text>>);
  expect_good_hashes_of<atom>(numbers, nth);
  expect_good_hashes_of<rota::in_state<crew>>(numbers, [](unsigned i) {
    auto const x = nth(i / 2);
    crew::state z;
    z.value[15] = i % 2;
    return rota::in_state<crew>{x.agent, x.plan, x.task, z};
  });
  expect_good_hashes_of<rota::instant>(numbers, [](unsigned i) { return rota::instant{i}; });
  expect_good_hashes_of<rota::duration>(numbers, [](unsigned i) { return rota::milliseconds(i); });
}

TEST(hashed, sets_events_and_deltas) {
  auto const events = every_event();
  expect_good_hashes(events);
  expect_good_hashes_of<rota::delta<atom>>(events, [](auto const& e) { return 3 * rota::delta<atom>(e); });
  std::vector<rota::atom_set<atom>> sets;
  for (auto const& e : events)
    if (e.subtractions().empty()) sets.push_back(e.additions());
  EXPECT_EQ(sets.size(), 32u);
  expect_good_hashes(sets);
  expect_good_hashes_of<rota::allocation<crew>>(sets, [](auto const& c) { return rota::allocation<crew>{{}, c}; });
  expect_good_hashes_of<rota::transition<rota::atom_set<atom>>>(
      sets, [](auto const& c) { return rota::transition<rota::atom_set<atom>>({}, c); });
  expect_good_hashes(std::vector<rota::atom_set<std::string>>{{}, {"a"}, {"b"}, {"a", "b"}, {"ab"}});
}

TEST(hashed, dense_values_over_either_kind_of_universe) {
  rota::atom_set<atom> all;
  for (unsigned i = 0; i < 5; ++i) all.insert(nth(i));
  using listed = rota::listed_universe<atom>;
  listed const universe(all);
  expect_good_hashes_of<rota::dense_event<listed>>(every_event(),
                                                   [&](auto const& e) { return *to_dense(e, universe); });
  // Equal though made otherwise: two universes that list the same atoms.
  auto const same_atoms = all;
  auto const e = *to_dense(rota::event<atom>::addition(nth(2)), universe);
  auto const f = *to_dense(rota::event<atom>::addition(nth(2)), listed(same_atoms));
  ASSERT_EQ(e, f);
  EXPECT_EQ(std::hash<rota::dense_event<listed>>{}(e), std::hash<rota::dense_event<listed>>{}(f));

  using wide = rota::dense_atom_set<rota::index_universe<130>>;
  std::vector<wide> singles;
  for (std::size_t i = 0; i < 130; ++i) {
    wide c;
    (void)c.insert(i);
    singles.push_back(c);
  }
  expect_good_hashes(singles);
}

TEST(hashed, an_event_does_not_depend_on_how_it_was_made) {
  auto const x = rota::event<atom>::addition(nth(1));
  auto const y = rota::event<atom>::subtraction(nth(30));
  rota::event<atom> const there_and_back = compose(compose(x, y), inverse(y));
  ASSERT_EQ(there_and_back, x);
  EXPECT_EQ(std::hash<rota::event<atom>>{}(there_and_back), std::hash<rota::event<atom>>{}(x));
}

/// An atom that nobody can hash: then neither can its sets, and the compiler says so.
struct opaque {
  int x = 0;
  friend auto operator<=>(opaque const&, opaque const&) = default;
};
static_assert(!std::is_default_constructible_v<std::hash<rota::atom_set<opaque>>>);
static_assert(!std::is_default_constructible_v<std::hash<rota::event<opaque>>>);

}  // namespace hashed_test
