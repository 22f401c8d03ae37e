// Each invariant can be broken: robots that nobody would write, and the watch that names what they break.
#include <gtest/gtest.h>

#include <rota/sim/campaign.hpp>

#include <deque>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace invariants_test {

namespace {

using namespace rota;
using namespace rota::sim;

constexpr names::plan_type type{1};

/// What a watch reads of a robot.
struct puppet {
  authority<names> rules;
  belief<names> believed;
  rota::incarnation life{1000};

  [[nodiscard]] authority<names> const* rule(names::plan_type) const { return &rules; }
  [[nodiscard]] belief<names> const* believes(names::plan_type) const { return &believed; }
  [[nodiscard]] rota::incarnation incarnation() const { return life; }
};

/// Three puppets with exact clocks.
struct puppets {
  std::deque<puppet> all = std::deque<puppet>(3);
  playbook plays_ = campaign_playbook();
  robot_clock exact;

  [[nodiscard]] std::size_t size() const { return all.size(); }
  [[nodiscard]] puppet const& robot(std::size_t i) const { return all[i]; }
  [[nodiscard]] bool plays(std::size_t) const { return true; }
  [[nodiscard]] robot_clock const& clock(std::size_t) const { return exact; }
  [[nodiscard]] playbook const& book() const { return plays_; }
};

constexpr instant at(int ms) { return instant{} + milliseconds(ms); }
in<names> does(std::uint64_t agent, std::uint64_t task) { return {{agent}, {1}, {task}}; }

claim<names> claim_of(std::uint64_t leader, std::uint64_t number, duration left = seconds(2)) {
  claim<names> c;
  c.type = type;
  c.leader = c.stamp.id = {leader};
  c.incarnation = {1000};
  c.number = number;
  c.version = 1;
  c.remaining = left;
  return c;
}
plan_message<names> plan_of(std::uint64_t sender, std::uint64_t sequence, std::uint64_t claims = 0,
                            std::uint64_t leads = 0) {
  plan_message<names> m{{sender}, {{1000}, sequence}, claims, {}};
  m.types.push_back({type, std::nullopt, leads, std::nullopt});
  return m;
}

struct invariants : testing::Test {
  puppets team;
  promises held = [] {
    promises p;
    p.delay = milliseconds(500);
    p.silence = milliseconds(2600);
    p.forget = seconds(30);
    p.longest_reign = seconds(2);
    p.renewals = 1;
    p.healed = p.hearing = p.settled = never;
    return p;
  }();
  std::optional<invariant_watch<puppets>> watch;

  puppet& robot(std::size_t i) { return team.all[i]; }
  void obey(std::size_t i, claim<names> const& c, instant now) {
    robot(i).rules = {};
    robot(i).rules.hear(c, std::nullopt, now, milliseconds(500));
  }
  void lead(std::size_t i, std::uint64_t number, instant end, std::uint32_t renewals = 0) {
    robot(i).rules = {};
    robot(i).rules.lead(type, {}, {0, {i + 1}}, {1000}, number, instant{}, instant{}, end, renewals);
  }
  void tell(instant t, std::size_t i, happening what, std::size_t other = 0, message<names> const* content = nullptr,
            std::optional<claim_outcome> outcome = std::nullopt, verdict v = verdict::accepted,
            std::optional<bool> abstains = std::nullopt, bool changed = false) {
    if (!watch) watch.emplace(team, held, faults{});
    world_state const truth;
    event<in<names>> const change;
    (*watch)(log_record{t, i, what, change, robot(i).believed.atoms(), truth, other, 0, false, false, false, outcome,
                        content, v, refusal::none, true, abstains, changed});
  }
  void hear(instant t, std::size_t i, claim<names> const& c, claim_outcome outcome) {
    message<names> const m = c;
    tell(t, i, happening::heard_claim, c.leader.value - 1, &m, outcome);
  }
  void hear(instant t, std::size_t i, plan_message<names> const& p, verdict v = verdict::accepted) {
    message<names> const m = p;
    tell(t, i, happening::heard_plan, p.sender.value - 1, &m, std::nullopt, v);
  }
  void fine() const { EXPECT_FALSE(watch->broken()) << watch->broken()->reason; }
  void broken(invariant what) const {
    ASSERT_TRUE(watch->broken());
    EXPECT_EQ(watch->broken()->what, what) << watch->broken()->reason;
    EXPECT_FALSE(watch->broken()->reason.empty());
  }
};

TEST_F(invariants, each_has_words_of_its_own) {
  std::set<std::string_view> words;
  for (std::size_t i = 0; i < invariant_count; ++i) words.insert(to_string(static_cast<invariant>(i)));
  EXPECT_EQ(words.size(), invariant_count);
}

TEST_F(invariants, one_leader) {
  obey(0, claim_of(3, 1), at(0));
  tell(at(0), 0, happening::deliberated);
  fine();
  obey(0, claim_of(1, 1), at(0));  // itself
  tell(at(0), 0, happening::deliberated);
  broken(invariant::one_leader);
}

TEST_F(invariants, greater_stamps) {
  obey(0, claim_of(2, 1), at(0));
  tell(at(0), 0, happening::deliberated);
  obey(0, claim_of(3, 1), at(100));
  tell(at(100), 0, happening::deliberated);
  fine();
  obey(0, claim_of(2, 1), at(0));
  tell(at(200), 0, happening::deliberated);
  broken(invariant::greater_stamps);
}

TEST_F(invariants, nothing_revives) {
  obey(0, claim_of(3, 1), at(0));
  tell(at(0), 0, happening::deliberated);
  robot(0).rules = {};
  tell(at(2100), 0, happening::deliberated);
  fine();
  obey(0, claim_of(3, 1), at(2200));
  tell(at(2200), 0, happening::deliberated);
  broken(invariant::nothing_revives);
}

TEST_F(invariants, nothing_revives_in_an_older_claim) {
  obey(0, claim_of(3, 2), at(0));
  tell(at(0), 0, happening::deliberated);
  obey(0, claim_of(3, 1), at(0));
  tell(at(10), 0, happening::deliberated);
  broken(invariant::nothing_revives);
}

TEST_F(invariants, nothing_revives_by_staying) {
  obey(0, claim_of(3, 1), at(0));
  tell(at(2000), 0, happening::deliberated);
  broken(invariant::nothing_revives);
}

TEST_F(invariants, ends_with_leader) {
  for (int const late : {0, 500, 501}) {
    watch.reset();
    lead(2, 1, at(1000));
    hear(at(0), 2, claim_of(2, 1), claim_outcome::challenged);
    tell(at(0), 2, happening::reign_began);
    obey(0, claim_of(3, 1, seconds(1)), at(late));
    tell(at(late), 0, happening::deliberated);
    late <= 500 ? fine() : broken(invariant::ends_with_leader);
  }
}

TEST_F(invariants, reigns_bounded) {
  obey(0, claim_of(3, 1, milliseconds(2001)), at(0));
  tell(at(0), 0, happening::deliberated);
  broken(invariant::reigns_bounded);
}

TEST_F(invariants, answers_inherit) {
  lead(2, 1, at(2000));
  tell(at(0), 2, happening::reign_began);  // without a detection, or a claim to answer
  broken(invariant::answers_inherit);
}

TEST_F(invariants, answers_inherit_an_end) {
  lead(1, 1, at(1000));
  hear(at(0), 1, claim_of(1, 1), claim_outcome::challenged);
  tell(at(0), 1, happening::reign_began);
  lead(2, 1, at(1501));
  hear(at(0), 2, claim_of(2, 1), claim_outcome::challenged);
  tell(at(0), 2, happening::reign_began);
  broken(invariant::answers_inherit);
}

TEST_F(invariants, answers_inherit_dissent_that_was_heard) {
  auto dissents = plan_of(2, 1);
  dissents.types[0].stance = stance::dissents;
  lead(2, 1, at(2000));
  hear(at(0), 2, dissents);
  lead(2, 2, at(3500), 1);
  tell(at(1500), 2, happening::reign_renewed);
  fine();
  EXPECT_EQ(watch->seen().renewals, 1U);
  hear(at(1600), 2, plan_of(2, 2));
  lead(2, 3, at(5000), 1);
  tell(at(3000), 2, happening::reign_renewed);
  broken(invariant::answers_inherit);
}

TEST_F(invariants, reigns_bounded_in_how_often_they_are_renewed) {
  auto dissents = plan_of(2, 1);
  dissents.types[0].stance = stance::dissents;
  hear(at(0), 2, dissents);
  lead(2, 2, at(3500), 2);
  tell(at(1500), 2, happening::reign_renewed);
  broken(invariant::reigns_bounded);
}

TEST_F(invariants, followers_follow) {
  obey(0, claim_of(3, 1), at(0));
  robot(0).believed.admit({2}, at(0));
  robot(0).believed.replace({does(2, 1)});
  tell(at(0), 0, happening::deliberated);
  broken(invariant::followers_follow);
}

TEST_F(invariants, followers_follow_in_everything) {
  auto c = claim_of(3, 1);
  c.atoms = {does(2, 1)};
  c.ages = {duration{}};
  obey(0, c, at(0));
  hear(at(0), 0, c, claim_outcome::adopted);
  fine();
  robot(0).believed.admit({2}, at(0));
  hear(at(0), 0, c, claim_outcome::repeated);
  broken(invariant::followers_follow);
}

TEST_F(invariants, silent_forgotten) {
  robot(0).believed.admit({2}, at(0));
  tell(at(0), 1, happening::said_plan);
  tell(at(2600), 0, happening::deliberated);
  fine();
  tell(at(2601), 0, happening::deliberated);
  broken(invariant::silent_forgotten);
}

TEST_F(invariants, messages_heard) {
  hear(at(0), 0, plan_of(2, 1));
  hear(at(10), 0, plan_of(2, 1), verdict::stale);
  fine();
  hear(at(20), 0, plan_of(2, 2), verdict::stale);
  broken(invariant::messages_heard);
}

TEST_F(invariants, messages_heard_once) {
  hear(at(0), 0, plan_of(2, 2));
  hear(at(30'001), 0, plan_of(2, 1));
  fine();
  hear(at(30'002), 0, plan_of(2, 1));
  broken(invariant::messages_heard);
}

TEST_F(invariants, claims_heeded) {
  hear(at(0), 0, claim_of(3, 1), claim_outcome::adopted);
  broken(invariant::claims_heeded);
}

TEST_F(invariants, claims_heeded_while_their_leader_leads) {
  lead(2, 1, at(1000));
  hear(at(999), 0, claim_of(3, 2), claim_outcome::expired);
  hear(at(1000), 0, claim_of(3, 1), claim_outcome::expired);
  fine();
  hear(at(999), 0, claim_of(3, 1), claim_outcome::expired);
  broken(invariant::claims_heeded);
}

TEST_F(invariants, no_orphans) {
  obey(0, claim_of(3, 1), at(0));
  hear(at(0), 0, plan_of(3, 1, 0, 0));
  hear(at(10), 0, plan_of(3, 2, 1, 1));
  fine();
  hear(at(20), 0, plan_of(3, 3, 1, 0));
  broken(invariant::no_orphans);
}

TEST_F(invariants, nothing_refused) {
  hear(at(0), 0, plan_of(3, 1), verdict::refused);
  broken(invariant::nothing_refused);
}

TEST_F(invariants, nothing_changed) {
  message<names> const m = plan_of(3, 1);
  tell(at(0), 0, happening::heard_plan, 2, &m);
  tell(at(1), 0, happening::heard_plan, 2, &m, std::nullopt, verdict::stale);
  fine();
  tell(at(2), 0, happening::heard_plan, 2, &m, std::nullopt, verdict::stale, std::nullopt, true);
  broken(invariant::nothing_changed);
}

TEST_F(invariants, smaller_answered) {
  held.answers = true;
  auto const adopts = [&](int t, std::size_t i, std::uint64_t leader, std::uint64_t number) {
    obey(i, claim_of(leader, number), at(t));
    hear(at(t), i, claim_of(leader, number), claim_outcome::adopted);
  };
  adopts(0, 0, 3, 1);  // the greater one
  lead(2, 1, at(5));
  hear(at(0), 2, claim_of(1, 1), claim_outcome::challenged);
  adopts(10, 2, 1, 1);  // once more: it was answered
  tell(at(10), 1, happening::deliberated, 0, nullptr, std::nullopt, verdict::accepted, true);
  adopts(10, 1, 1, 1);  // who abstains answers nobody
  fine();
  robot(2).rules = {};
  tell(at(20), 2, happening::deliberated);
  adopts(20, 2, 1, 2);
  broken(invariant::smaller_answered);
}

TEST_F(invariants, smaller_answered_unless_somebody_rules) {
  held.answers = true;
  obey(2, claim_of(1, 1), at(0));
  tell(at(0), 2, happening::deliberated);
  obey(2, claim_of(2, 1), at(0));
  hear(at(0), 2, claim_of(2, 1), claim_outcome::adopted);
  fine();
}

/// Until bits that have flipped count no more, a team may do what it never does otherwise.
TEST_F(invariants, nothing_refused_once_all_is_genuine) {
  held.genuine = at(1000);
  hear(at(999), 0, plan_of(3, 1), verdict::refused);
  fine();
  hear(at(1000), 0, plan_of(3, 1), verdict::refused);
  broken(invariant::nothing_refused);
}

/// Bounds worked out by hand: three robots, L = 5 ms, exact clocks, each period a microsecond longer to be safe.
TEST(promised, is_what_the_theory_says) {
  simulation_options o;
  o.network.latency = milliseconds(2);
  o.network.jitter = milliseconds(3);
  o.clock.drift_ppm = o.clock.loop_spread_ppm = 0;
  auto const calm = instant{} + seconds(10);
  auto const us = [](std::int64_t n) { return instant{} + microseconds(n); };

  auto p = promised(o, 3, calm);
  EXPECT_EQ(p.delay, milliseconds(5));
  EXPECT_EQ(p.slack, microseconds(2));
  EXPECT_EQ(p.silence, microseconds(2'600'001));  // 2 s + a claim period of 100 ms + 500 ms that a claim may take
  EXPECT_EQ(p.longest_reign, seconds(2));
  EXPECT_EQ(p.healed, calm);
  EXPECT_EQ(p.hearing, us(10'105'001));  // P + L
  EXPECT_EQ(p.genuine, instant{});
  EXPECT_TRUE(p.answers);
  // silence 2.600001, D 0.030001, twice 4 (0.100001 + 0.005 + 0.030001), T 2.000001, 3 L
  EXPECT_EQ(p.settled, us(10'105'001 + 2'600'001 + 30'001 + 2 * 4 * 135'002 + 2'000'001 + 15'000));

  o.faults.flips = flipped_bits{{{}, instant{} + seconds(12)}, 0.01};
  p = promised(o, 3, calm);
  EXPECT_EQ(p.healed, instant{} + seconds(12));
  EXPECT_EQ(p.hearing, us(12'105'001 + 5'000 + 30'000'001));           // L + forget later
  EXPECT_EQ(p.genuine, us(42'110'002 + 2'000'000 + 600'001 + 5'000));  // the longest reign, 500 ms, P and L later

  o.faults = {};
  o.faults.late = late_copies{{{}, instant{} + seconds(3)}, 0.1, milliseconds(200), seconds(1)};
  p = promised(o, 3, calm);
  EXPECT_EQ(p.delay, seconds(1));
  EXPECT_TRUE(p.overdue);
  EXPECT_EQ(p.silence, microseconds(2'600'001 + 3 * 500'000));  // each robot may add what is unexpected
  EXPECT_EQ(p.hearing, us(10'105'001)) << "the last late copy has arrived before";

  o.faults = {};
  o.faults.drifts = {{1, 100}};
  p = promised(o, 3, calm);
  EXPECT_EQ(p.hearing, calm + microseconds(105'000) + nanoseconds(10'000 + 100 + 1'000)) << "a ten-thousandth longer";

  o.faults = {};
  o.faults.confidences = {{0, {}, 3}};
  EXPECT_FALSE(promised(o, 3, calm).answers);
}

TEST_F(invariants, belief_well_formed) {
  robot(0).believed.replace({does(2, 1)});
  robot(0).believed.admit({1}, at(0));
  tell(at(0), 0, happening::deliberated);
  broken(invariant::belief_well_formed);
}

TEST_F(invariants, all_hear_all) {
  held.healed = held.hearing = at(1000);
  tell(at(999), 0, happening::deliberated);
  fine();
  tell(at(1000), 0, happening::deliberated);
  broken(invariant::all_hear_all);
}

TEST_F(invariants, nobody_rules) {
  held.settled = at(1000);
  obey(0, claim_of(3, 1), at(0));
  tell(at(999), 0, happening::said_plan);
  fine();
  tell(at(1000), 0, happening::said_plan);
  broken(invariant::nobody_rules);
}

TEST_F(invariants, all_agree) {
  held.settled = at(1000);
  for (std::size_t i = 0; i < 2; ++i) {
    robot(i).believed.admit({i + 1}, at(0));
    robot(i).believed.replace({does(i + 1, 1)});
    tell(at(1000), i, happening::said_plan);
    i == 0 ? fine() : broken(invariant::all_agree);
  }
}

TEST_F(invariants, all_agree_on_one_attacker) {
  held.settled = at(1000);
  tell(at(1000), 0, happening::said_plan);
  broken(invariant::all_agree);
}

}  // namespace

}  // namespace invariants_test
