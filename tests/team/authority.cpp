#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "soccer.hpp"

#include <rota/team/authority.hpp>

#include <map>
#include <set>
#include <tuple>
#include <vector>

namespace authority_test {

using rota::claim_outcome;
using rota::milliseconds;

namespace {

using authority = rota::authority<soccer>;
using claim = rota::claim<soccer>;
using stamp = rota::claim_stamp<soccer>;

constexpr rota::instant start{};
constexpr rota::incarnation life{1};
constexpr auto reign = rota::seconds(2);
constexpr auto period = milliseconds(100);

stamp of(int n) { return {0, agent(n)}; }
atoms attacker(int n) { return {atom{agent(n), soccer::plan::normal, soccer::task::attack}}; }

claim claim_by(int n, std::uint64_t number = 1, std::uint64_t version = 1, rota::duration remaining = reign) {
  return {soccer::plan_type::play, attacker(n), of(n), agent(n), life, number, version, remaining};
}

claim_outcome hear(authority& a, claim const& c, stamp mine, rota::instant now, rota::duration max_delay = reign) {
  return a.hear(c, mine, now, max_delay).outcome;
}
void lead(authority& a, int n, atoms const& what, rota::instant now = start, rota::incarnation in = life,
          std::uint64_t number = 1) {
  a.lead(soccer::plan_type::play, what, of(n), in, number, now, now, now + reign);
}

TEST(authority, the_greater_stamp_wins_whatever_comes_first) {
  for (auto const& order : {std::vector{7, 9}, std::vector{9, 7}}) {
    authority a;
    for (int n : order) hear(a, claim_by(n), of(1), start);
    EXPECT_TRUE(a.obeying());
    EXPECT_EQ(a.current().leader, agent(9));
  }
}

/// ALICA's defect: an agent that obeys leader 9 is taken over by a later claim of 7.
TEST(authority, a_later_claim_of_a_smaller_one_takes_nobody_over) {
  authority a;
  EXPECT_EQ(hear(a, claim_by(9), of(1), start), claim_outcome::adopted);
  for (std::uint64_t number = 1; number < 5; ++number)
    EXPECT_EQ(hear(a, claim_by(7, number), of(1), start), claim_outcome::outranked);
  EXPECT_EQ(a.current().leader, agent(9));
}

TEST(authority, confidence_outranks_the_id) {
  authority a;
  hear(a, claim_by(9), of(1), start);
  auto sure = claim_by(7);
  sure.stamp.confidence = 1;
  EXPECT_EQ(hear(a, sure, of(1), start), claim_outcome::adopted);
  EXPECT_EQ(a.current().leader, agent(7));
}

TEST(authority, a_smaller_claim_challenges_the_greater_agent) {
  authority a;
  EXPECT_EQ(hear(a, claim_by(7), of(8), start), claim_outcome::challenged);
  EXPECT_FALSE(a.active());
  EXPECT_EQ(hear(a, claim_by(7), of(8), start), claim_outcome::adopted)
      << "an answer once for each claim; then it obeys";
  hear(a, claim_by(9), of(8), start);
  EXPECT_EQ(hear(a, claim_by(7, 2), of(8), start), claim_outcome::outranked) << "it already obeys a greater one";
}

TEST(authority, a_leader_answers_a_smaller_claim_at_once_and_yields_to_a_greater_one) {
  authority a;
  lead(a, 8, attacker(8));
  EXPECT_TRUE(a.next_claim(start, period));
  EXPECT_FALSE(a.next_claim(start, period));
  EXPECT_EQ(hear(a, claim_by(7), of(8), start), claim_outcome::outranked);
  EXPECT_TRUE(a.next_claim(start, period));
  EXPECT_EQ(hear(a, claim_by(9), of(8), start), claim_outcome::adopted);
  EXPECT_TRUE(a.obeying());
  EXPECT_FALSE(a.next_claim(start + period, period)) << "the loser drops its own";
}

TEST(authority, a_leader_repeats_as_long_as_it_rules_and_says_what_is_left) {
  authority a;
  lead(a, 8, attacker(8));
  int repeats = 0;
  for (auto now = start; now < start + rota::seconds(3); now += milliseconds(10)) {
    a.expire(now);
    if (auto c = a.next_claim(now, period)) {
      ++repeats;
      EXPECT_EQ(c->remaining, start + reign - now);
      EXPECT_GT(c->remaining, rota::duration{});
    }
  }
  EXPECT_EQ(repeats, 20);
  EXPECT_FALSE(a.active());
}

TEST(authority, a_change_of_mind_is_a_new_version_due_at_once) {
  authority leader, follower;
  lead(leader, 8, attacker(8));
  auto const first = *leader.next_claim(start, period);
  leader.revise(attacker(8), start);
  EXPECT_FALSE(leader.next_claim(start, period)) << "nothing changed";
  leader.revise(attacker(3), start);
  auto const second = *leader.next_claim(start, period);
  EXPECT_EQ(second.version, first.version + 1);
  EXPECT_EQ(hear(follower, second, of(1), start), claim_outcome::adopted);
  EXPECT_EQ(hear(follower, first, of(1), start), claim_outcome::repeated) << "an older version imposes nothing";
  EXPECT_EQ(follower.current().atoms, attacker(3));
}

TEST(authority, copies_of_a_claim_expire_at_the_minimum) {
  authority a;
  hear(a, claim_by(9, 1, 1, milliseconds(500)), of(1), start);
  hear(a, claim_by(9, 1, 1, milliseconds(2000)), of(1), start + milliseconds(100));  // a delayed first copy
  EXPECT_EQ(a.expiry(), start + milliseconds(500));
  hear(a, claim_by(9, 1, 2, milliseconds(100)), of(1), start + milliseconds(200));
  EXPECT_EQ(a.expiry(), start + milliseconds(300));
  EXPECT_FALSE(a.expire(start + milliseconds(299)));
  EXPECT_TRUE(a.expire(start + milliseconds(300)));
}

TEST(authority, an_expired_claim_never_revives_but_the_next_one_counts) {
  authority a;
  hear(a, claim_by(9, 3), of(1), start);
  a.expire(start + reign);
  for (std::uint64_t number : {1u, 2u, 3u})
    EXPECT_EQ(hear(a, claim_by(9, number, 7), of(1), start + reign), claim_outcome::expired);
  EXPECT_EQ(hear(a, claim_by(9, 4), of(1), start + reign), claim_outcome::adopted);
}

/// Every interleaving of loss, duplication, reordering, delay and restart that the generator finds, over the real state
/// machine: a bag of claims in flight, of which any may be delivered any number of times, or never.
TEST(authority, invariants_over_every_interleaving) {
  constexpr int team = 4;
  int switched = 0, revived_attempts = 0, restarts = 0;
  EXPECT_TRUE(rc::check("one leader, greater stamps only, bounded reigns, no revival", [&] {
    using name = std::tuple<soccer::agent, rota::incarnation, std::uint64_t>;
    struct copy {
      claim what;
      rota::instant sent;
    };
    struct member {
      authority rule;
      rota::incarnation incarnation = life;
      std::uint64_t claims = 0;
      std::set<name> ended;  // a restart forgets them, as it forgets the robot
    };
    std::vector<member> members(team + 1);
    std::vector<copy> flying;
    std::map<name, rota::instant> leader_expiry;
    rota::duration greatest_delay{};
    rota::instant now = start;

    auto const key = [](claim const& c) { return name(c.leader, c.incarnation, c.number); };
    auto const begin = [&](int n) {
      auto& m = members[static_cast<std::size_t>(n)];
      lead(m.rule, n, attacker(*rc::gen::inRange(1, team + 1)), now, m.incarnation, ++m.claims);
      leader_expiry[key(m.rule.current())] = now + reign;
    };

    int const steps = *rc::gen::inRange(20, 120).as("steps");
    for (int step = 0; step < steps; ++step) {
      int const n = *rc::gen::inRange(1, team + 1).as("member");
      auto& m = members[static_cast<std::size_t>(n)];
      switch (*rc::gen::weightedElement<int>({{3, 0}, {2, 1}, {3, 2}, {9, 3}, {1, 4}, {1, 5}}).as("action")) {
      case 0: now += milliseconds(*rc::gen::inRange(1, 700)); break;
      case 1:
        if (!m.rule.active()) begin(n);
        break;
      case 2:
        if (auto c = m.rule.next_claim(now, period)) flying.push_back({*c, now});
        break;
      case 3: {
        if (flying.empty()) break;
        auto const& c = flying[static_cast<std::size_t>(*rc::gen::inRange<int>(0, int(flying.size())))];
        if (c.what.leader == agent(n)) break;
        greatest_delay = std::max(greatest_delay, now - c.sent);
        bool const obeyed = m.rule.obeying();
        auto const previous = obeyed || m.rule.leading() ? m.rule.current() : claim{};
        auto const outcome = hear(m.rule, c.what, of(n), now, rota::seconds(1000));
        if (outcome == claim_outcome::adopted) {
          RC_ASSERT(m.ended.count(key(c.what)) == 0);
          if (obeyed) RC_ASSERT(!(c.what.stamp < previous.stamp));
          switched += obeyed && previous.leader != c.what.leader;
          if (previous.leader == agent(n) && previous.version > 0) m.ended.insert(key(previous));
        }
        revived_attempts += outcome == claim_outcome::expired;
        if (outcome == claim_outcome::challenged) begin(n);
        if (m.rule.obeying()) {
          RC_ASSERT(m.rule.current().leader != agent(n));
          RC_ASSERT(m.rule.expiry() <= leader_expiry.at(key(m.rule.current())) + greatest_delay);
        }
        break;
      }
      case 4:  // a restart: the state is lost, the incarnation grows
        m = member{authority{}, {m.incarnation.value + 1}, 0, {}};
        ++restarts;
        break;
      default:
        if (m.rule.leading()) m.rule.revise(attacker(*rc::gen::inRange(1, team + 1)), now);
      }
      for (auto& each : members) {
        if (!each.rule.active()) continue;
        auto const held = key(each.rule.current());
        if (each.rule.expire(now)) each.ended.insert(held);
        bool const over = each.rule.active() && now >= each.rule.expiry();
        RC_ASSERT(!over);
      }
    }
    // Nobody speaks any more: every reign is over after the bound.
    now += reign + greatest_delay;
    for (auto& each : members) {
      each.rule.expire(now);
      RC_ASSERT(!each.rule.active());
    }
  }));
  EXPECT_GT(switched, 50);
  EXPECT_GT(revived_attempts, 50);
  EXPECT_GT(restarts, 50);
}

/// With a connected group and one repeat round without loss, everybody obeys the greatest claimant.
TEST(authority, one_round_without_loss_settles_on_the_greatest_claimant) {
  EXPECT_TRUE(rc::check("the greatest claimant rules", [] {
    constexpr int team = 5;
    std::vector<authority> members(team + 1);
    int greatest = 0;
    for (int n = 1; n <= team; ++n) {
      if (!*rc::gen::arbitrary<bool>().as("claims")) continue;
      lead(members[static_cast<std::size_t>(n)], n, attacker(n));
      greatest = n;
    }
    RC_PRE(greatest > 0);
    // The round: everybody who leads speaks, everybody hears it; challenged agents lead and speak as well.
    bool speaking = true;
    while (speaking) {
      speaking = false;
      for (int n = 1; n <= team; ++n) {
        auto const c = members[static_cast<std::size_t>(n)].next_claim(start, period);
        if (!c) continue;
        speaking = true;
        for (int other = 1; other <= team; ++other) {
          if (other == n) continue;
          auto& rule = members[static_cast<std::size_t>(other)];
          if (hear(rule, *c, of(other), start) == claim_outcome::challenged) {
            lead(rule, other, attacker(other));
            greatest = std::max(greatest, other);
          }
        }
      }
    }
    for (int n = 1; n <= team; ++n) {
      auto const& rule = members[static_cast<std::size_t>(n)];
      RC_ASSERT(rule.active());
      RC_ASSERT(rule.leading() == (n == greatest));
      RC_ASSERT(rule.current().atoms == attacker(greatest));
    }
  }));
}

}  // namespace

}  // namespace authority_test
