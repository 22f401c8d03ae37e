#include <rota/algebra/print.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <tuple>

namespace algebra_print_test {

struct soccer {
  enum class agent : std::uint8_t { left = 1, right };
  enum class plan_type : std::uint8_t {};
  enum class plan : std::uint8_t { normal, kickoff };
  enum class task : std::uint8_t { attack, defend };
  enum class state : std::uint8_t {};
};
char const* to_string(soccer::task t) { return t == soccer::task::attack ? "attack" : "defend"; }

using atom = rota::in<soccer>;
using sets = rota::atom_set<atom>;
using events = rota::event<atom>;
using rota::sign;

atom const x{soccer::agent::left, soccer::plan::normal, soccer::task::attack};
atom const y{soccer::agent::right, soccer::plan::kickoff, soccer::task::defend};

/// Names that a caller gives, as for the ids of a plan file.
struct spoken {
  std::string operator()(soccer::agent a) const { return a == soccer::agent::left ? "Ann" : "Bob"; }
  std::string operator()(soccer::plan) const { return "p"; }
  std::string operator()(soccer::task t) const { return to_string(t); }
};

TEST(algebra_print, sets_list_their_atoms_in_order) {
  EXPECT_EQ(to_string(sets{}), "{}");
  EXPECT_EQ(to_string(sets{y, x}), "{In(1, 0, attack), In(2, 1, defend)}");
  EXPECT_EQ(to_string(sets{y, x}, spoken{}), "{In(Ann, p, attack), In(Bob, p, defend)}");
  EXPECT_EQ(to_string(rota::atom_set<int>{3, -1}), "{-1, 3}");
  EXPECT_EQ(to_string(rota::atom_set<std::string>{"b", "a"}), "{a, b}");
  EXPECT_EQ(to_string(rota::atom_set<rota::atom_set<int>>{{2}, {}}), "{{}, {2}}");
}

TEST(algebra_print, events_are_two_sets) {
  EXPECT_EQ(to_string(events{}), "({}, {})");
  auto const e = *events::make({x}, {y});
  EXPECT_EQ(to_string(e), "({In(1, 0, attack)}, {In(2, 1, defend)})");
  EXPECT_EQ(to_string(e, spoken{}), "({In(Ann, p, attack)}, {In(Bob, p, defend)})");
  EXPECT_EQ(to_string(*e.begin()), "+In(1, 0, attack)");
  EXPECT_EQ(to_string(*inverse(e).begin()), "-In(1, 0, attack)");
}

TEST(algebra_print, the_storage_does_not_show) {
  using universe = rota::index_universe<9>;
  auto const e = *rota::event<std::size_t>::make({1, 5}, {8});
  EXPECT_EQ(to_string(*rota::to_dense(e, universe{})), to_string(e));
  EXPECT_EQ(to_string(*rota::to_dense(e.additions(), universe{})), "{1, 5}");
}

TEST(algebra_print, deltas_give_each_atom_its_multiplicity) {
  using deltas = rota::delta<atom>;
  EXPECT_EQ(to_string(deltas{}), "{}");
  EXPECT_EQ(to_string(deltas(x, 2) - deltas(y, 1)), "{In(1, 0, attack): +2, In(2, 1, defend): -1}");
  EXPECT_EQ(to_string(rota::delta<int, std::int8_t>(7, 65)), "{7: +65}");  // a number, no character
}

TEST(algebra_print, transitions_are_arrows) {
  EXPECT_EQ(to_string(rota::transition<sets>({}, {x})), "{} -> {In(1, 0, attack)}");
}

TEST(algebra_print, fingerprints_are_hexadecimal_and_signs_are_signs) {
  EXPECT_EQ(to_string(rota::fingerprint{0xfedcba9876543210}), "0xfedcba9876543210");
  EXPECT_EQ(to_string(rota::fingerprint{255}), "0x00000000000000ff");
  EXPECT_EQ(to_string(sign::plus) + to_string(sign::zero) + to_string(sign::minus), "+0-");
}

TEST(algebra_print, refusals_are_sentences_about_their_witness) {
  EXPECT_EQ(to_string(events::make({x, y}, {y}).error()), "In(2, 1, defend) is both added and subtracted");
  EXPECT_EQ(to_string(events::make({x, y}, {y})), "refused: In(2, 1, defend) is both added and subtracted");
  EXPECT_EQ(to_string(events::make({x}, {})), "({In(1, 0, attack)}, {})");
  EXPECT_EQ(to_string(apply(events::addition(x), sets{x}).error(), spoken{}),
            "In(Ann, p, attack) is added though present, or subtracted though absent");
  EXPECT_EQ(to_string(rota::index_universe<2>::index_of(3)), "refused: 3 is not in the universe");
  using small = rota::delta<int, std::int8_t>;
  EXPECT_EQ(to_string(checked_sum(small(4, 100), small(4, 100)).error()), "the multiplicity of 4 is out of range");
  rota::transition<sets> const t({}, {x});
  EXPECT_EQ(to_string(checked_compose(t, t).error()),
            "where the first arrow ends and the second begins differs in In(1, 0, attack)");
  events const twice[] = {events::addition(x), events{}, events::addition(x)};
  EXPECT_EQ(to_string(rota::compose_run<atom>(twice).error()),
            "events 0 and 2 both add In(1, 0, attack) or both subtract it, and no event between them mentions it");
}

}  // namespace algebra_print_test
