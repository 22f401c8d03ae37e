// Who stands between robots that do not hear each other forwards what is news, although it takes no part itself.
#include <gtest/gtest.h>

#include "playground.hpp"

#include <rota/team/relay.hpp>

#include <support/allocation_counter.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace relaying_test {

using rota::milliseconds;
using rota::seconds;

namespace {

using relay = rota::relay<soccer>;

constexpr rota::instant at(int ms) { return start + milliseconds(ms); }
constexpr std::array<soccer::plan_type, 2> both{defence_id, play_id};

relay between(int self = 2, rota::robot_options const& options = {}) {
  return relay(agent(self), squad(9), both, options);
}
claim left(int leader, int ms, std::uint64_t number = 1, std::uint64_t version = 1) {
  auto c = claim_by(leader, leader, number);
  c.version = version;
  c.remaining = milliseconds(ms);
  return c;
}

struct relaying : playground {};

/// A line 1 – 2 – 3: only neighbours hear each other, and 2 does not execute the type. It executes another, or none.
TEST_F(relaying, makes_a_line_a_team_whose_middle_takes_no_part) {
  auto const defence = make_play(defence_id);
  for (int const variant : {0, 1, 2, 3}) {
    bool const forwards = variant != 3;
    std::vector<robot> line;
    for (int n = 1; n <= 3; ++n) {
      rota::robot_options options;
      options.first_message = at(37 * n);
      robot r(agent(n), squad(3), rota::incarnation{1}, options);
      if (n != 2) r.enter(play, start);
      if (n == 2 && variant == 1) r.enter(defence, start);
      line.push_back(r);
    }
    auto middle = between();
    int obeyed = 0, fights = 0, steps = 0;
    std::size_t forwarded = 0, spoken = 0;
    std::vector<std::pair<std::size_t, message>> air;  // who says what
    for (auto now = start; now < at(5000); now = now + milliseconds(1)) {
      for (std::size_t i = 0; i < 3; ++i) {
        // 1 and 3 are each sure that they are closest.
        if (i != 1 && (now.ns / 1'000'000) % 30 == static_cast<std::int64_t>(i * 7))
          (void)think(line[i], sees(i == 0 ? 1 : 3), now);
        while (auto m = line[i].next_message(now)) air.emplace_back(i, *m), ++spoken;
      }
      while (!air.empty()) {
        auto const [from, m] = air.back();
        air.pop_back();
        for (std::size_t to = 0; to < 3; ++to) {
          if (to + 1 != from && from + 1 != to) continue;
          bool news = line[to].receive(m, now).relay;
          if (to == 1) news = forwards ? middle.is_news(m, now) : news;
          if (!news || to != 1) continue;
          air.emplace_back(to, m);
          ASSERT_LE(++forwarded, spoken) << "forwarding does not end";
        }
      }
      int attackers = 0;
      for (std::size_t const i : {0U, 2U})
        attackers += line[i].believes(play_id)->part(line[i].self()) == does(int(i) + 1, attack);
      if (now < at(1000)) continue;
      ++steps;
      fights += attackers != 1;
      obeyed +=
          line[0].rule(play_id)->obeying() && line[0].believes(play_id)->atoms() == line[2].believes(play_id)->atoms();
    }
    EXPECT_TRUE(line[0].believes(play_id)->takes_part(agent(3))) << "plan messages reach everybody either way";
    if (forwards) {
      EXPECT_GE(obeyed * 10, steps * 8) << obeyed;
      EXPECT_LE(fights * 10, steps) << fights;
    } else {  // who goes by the robot alone forwards no claim about what it does not execute
      EXPECT_EQ(obeyed, 0);
      EXPECT_GE(fights * 3, steps) << fights;
    }
  }
}

TEST_F(relaying, copies_are_not_forwarded_twice) {
  auto r = between();
  EXPECT_TRUE(r.is_news(says(1, 5, attack), at(0)));
  EXPECT_FALSE(r.is_news(says(1, 5, attack), at(1)));
  EXPECT_FALSE(r.is_news(says(1, 4, attack), at(2))) << "overtaken";
  EXPECT_TRUE(r.is_news(says(3, 4, attack), at(3))) << "of another";

  EXPECT_TRUE(r.is_news(left(3, 2000), at(0)));
  EXPECT_FALSE(r.is_news(left(3, 2000), at(10))) << "the same";
  EXPECT_TRUE(r.is_news(left(3, 1900), at(100))) << "a repetition";
  EXPECT_FALSE(r.is_news(left(3, 1950), at(101))) << "an earlier one, late";
  EXPECT_TRUE(r.is_news(left(3, 1900, 1, 2), at(102))) << "a new version, in the same instant";
  EXPECT_FALSE(r.is_news(left(3, 1900, 1, 1), at(103)));
  EXPECT_TRUE(r.is_news(left(3, 1500, 2), at(500))) << "its next claim";
  EXPECT_FALSE(r.is_news(left(3, 1400, 1), at(501))) << "and no older one";
  auto other = left(3, 1500, 1);
  other.type = defence_id;
  EXPECT_TRUE(r.is_news(other, at(501))) << "for another type";
  EXPECT_TRUE(r.is_news(left(4, 1500), at(501))) << "of another leader";
  EXPECT_FALSE(r.is_news(left(4, 1500), at(502)));
  EXPECT_FALSE(r.is_news(other, at(502)));
}

/// Whoever forwards in a ring hears its own words again.
TEST_F(relaying, ends_in_a_ring) {
  std::vector<relay> ring;
  for (int n = 1; n <= 5; ++n) ring.push_back(between(n));
  std::size_t said = 0;
  std::vector<std::pair<std::size_t, message>> air{{0, says(1, 1, attack)}, {0, left(1, 1000)}};
  while (!air.empty()) {
    auto const [from, m] = air.back();
    air.pop_back();
    ASSERT_LE(++said, 10U) << "each says each once";
    for (std::size_t const to : {(from + 1) % 5, (from + 4) % 5})
      if (ring[to].is_news(m, at(static_cast<int>(said)))) air.emplace_back(to, m);
  }
  EXPECT_EQ(said, 10U);
}

TEST_F(relaying, what_cannot_be_genuine_is_no_news) {
  auto r = between();
  EXPECT_FALSE(r.is_news(says(2, 1, attack), at(0))) << "its own words";
  auto const before = r;
  auto const refused = [&](message const& m) {
    EXPECT_FALSE(r.is_news(m, at(0)));
    EXPECT_TRUE(r == before) << "it leaves a trace";
  };
  refused(says(10, 1, attack));  // a stranger's
  refused(left(2, 1000));
  refused(left(10, 1000));
  auto m = says(1, std::uint64_t{1} << 62, attack);
  refused(m);
  m = says(1, 1, attack);
  m.number.incarnation = {0};
  refused(m);
  m.number.incarnation = {std::uint64_t{1} << 62};
  refused(m);
  m = says(1, 1, attack);
  for (std::size_t i = 0; i < 70; ++i) m.types.push_back({play_id, std::nullopt});
  refused(m);
  refused(left(1, 0));
  refused(left(1, 2001));
  refused(left(1, 1000, 0));
  refused(left(1, 1000, std::uint64_t{1} << 62));
  auto c = left(1, 1000);
  c.stamp.id = agent(3);
  refused(c);
  c = left(1, 1000);
  c.type = static_cast<soccer::plan_type>(77);
  refused(c);
}

/// Forged numbers within reach come as often as you like: when they stop, genuine messages are news after `forget` at most.
TEST_F(relaying, a_flood_of_forged_numbers_deafens_it_for_no_longer_than_forget) {
  auto r = between();
  EXPECT_TRUE(r.is_news(says(1, 1, attack), at(0)));
  EXPECT_TRUE(r.is_news(left(1, 2000), at(0)));
  EXPECT_FALSE(r.is_news(says(1, 2 + rota::most_jump, attack), at(1))) << "out of reach";
  EXPECT_FALSE(r.is_news(left(1, 1900, 2 + rota::most_jump), at(1)));
  std::uint64_t far = 1;
  for (int i = 0; i < 1000; ++i, far += rota::most_jump) {
    (void)r.is_news(says(1, far, attack), at(i));
    (void)r.is_news(left(1, 1500, far), at(i));
  }
  for (int const ms : {1100, 30'998}) {
    EXPECT_FALSE(r.is_news(says(1, 3, attack), at(ms)));
    EXPECT_FALSE(r.is_news(left(1, 2000, 2), at(ms)));
  }
  EXPECT_TRUE(r.is_news(says(1, 4, attack), at(31'000)));
  EXPECT_TRUE(r.is_news(left(1, 2000, 2), at(31'000)));
  EXPECT_TRUE(r.is_news(says(1, 5, attack), at(31'100)));
  EXPECT_TRUE(r.is_news(left(1, 1900, 2), at(31'100)));
}

/// A copy with a forged time hides genuine ones for the greatest delay at most.
TEST_F(relaying, a_forged_time_hides_a_claim_for_the_greatest_delay_at_most) {
  auto r = between();
  EXPECT_TRUE(r.is_news(left(3, 2000), at(0)));
  EXPECT_FALSE(r.is_news(left(3, 1), at(100)));
  EXPECT_TRUE(r.is_news(left(3, 1401), at(100)));  // 499 ms too little
  EXPECT_FALSE(r.is_news(left(3, 1500), at(500)));
  EXPECT_TRUE(r.is_news(left(3, 1400), at(600)));
}

TEST_F(relaying, a_sender_may_begin_a_new_life) {
  auto r = between();
  EXPECT_TRUE(r.is_news(says(1, 100, attack), at(0)));
  EXPECT_TRUE(r.is_news(left(1, 2000, 9), at(0)));
  auto m = says(1, 1, attack);
  m.number.incarnation = {2};
  auto c = left(1, 2000, 1);
  EXPECT_TRUE(r.is_news(m, at(100)));
  EXPECT_FALSE(r.is_news(c, at(101))) << "of the life before";
  c.type = defence_id;
  EXPECT_FALSE(r.is_news(c, at(101))) << "for whatever type";
  c.type = play_id;
  c.incarnation = {2};
  EXPECT_TRUE(r.is_news(c, at(102)));
}

TEST_F(relaying, survives_a_clock_that_is_set_back) {
  auto r = between();
  auto const late = at(0) + seconds(1'000'000);
  EXPECT_TRUE(r.is_news(says(1, 100, attack), late));
  EXPECT_TRUE(r.is_news(left(1, 2000, 9), late));
  EXPECT_TRUE(r.is_news(left(3, 2000, 9), late));
  EXPECT_FALSE(r.is_news(says(1, 1, attack), at(0)));
  EXPECT_FALSE(r.is_news(left(1, 2000, 1), at(0)));
  EXPECT_TRUE(r.is_news(left(1, 1900, 9), at(100)));
  EXPECT_TRUE(r.is_news(says(1, 1, attack), at(30'001)));
  EXPECT_TRUE(r.is_news(left(1, 2000, 1), at(30'101)));
  EXPECT_TRUE(r.is_news(left(3, 2000, 1), at(30'101)));
}

TEST_F(relaying, allocates_nothing) {
  auto r = between();
  std::vector<message> const all{says(1, 1, attack), left(1, 2000), says(9, 1, attack), left(9, 2000),
                                 says_nothing(4, 1)};
  auto const before = rota_test::allocation_count();
  int news = 0;
  for (auto const& m : all) news += r.is_news(m, at(0));
  EXPECT_EQ(rota_test::allocation_count() - before, 0u);
  EXPECT_EQ(news, 5);
}

}  // namespace

}  // namespace relaying_test
