// Who obeys says if it would do otherwise; then the leader renews its reign. Who sees nothing valid says so and is given nothing.
#include <gtest/gtest.h>

#include "playground.hpp"

#include <rota/team/budget.hpp>
#include <rota/team/print.hpp>

#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace dissent_test {

using rota::decision_reason;
using rota::milliseconds;
using rota::seconds;
using rota::stance;

namespace {

struct dissent : playground {
  /// What it would say now, if it is due.
  static stance stands(robot a, rota::instant now) {
    while (auto const m = a.next_message(now))
      if (auto const* p = std::get_if<plan_message>(&*m)) return p->types[0].stance;
    return stance::none;
  }
  static plan_message says_so(int sender, std::uint64_t sequence, std::optional<soccer::task> task, stance s) {
    auto m = says(sender, sequence, task);
    m.types[0].stance = s;
    return m;
  }
  /// Robot 5, which has answered a claim of robot 4 and leads until 2 s.
  robot leader(rota::robot_options const& options = {}) {
    robot a = in_play(5, options);
    a.receive(says(4, 1, defend), start);
    a.receive(claim_by(4, 4), start);
    (void)think(a, sees(5), start);
    return a;
  }
  /// All claims that it says now.
  static std::optional<claim> claims(robot& a, rota::instant now) {
    std::optional<claim> last;
    while (auto const m = a.next_message(now))
      if (auto const* c = std::get_if<claim>(&*m)) last = *c;
    return last;
  }
};

TEST_F(dissent, is_said_just_while_a_follower_would_do_otherwise) {
  auto a = in_play(1);
  a.receive(says(9, 1, defend), start);
  auto c = claim_by(9, 1);
  c.atoms.insert(does(9, defend));
  c.ages.push_back({});
  a.receive(c, start);
  auto d = think(a, sees(1), start + milliseconds(30));
  EXPECT_EQ(d.reason, decision_reason::obeyed);
  EXPECT_FALSE(d.dissents);
  EXPECT_EQ(stands(a, start + milliseconds(100)), stance::none);

  d = think(a, sees(9), start + milliseconds(60));
  EXPECT_EQ(d.reason, decision_reason::obeyed);
  EXPECT_TRUE(d.dissents);
  EXPECT_TRUE(d.event.empty()) << "it says so, and does what it is told";
  EXPECT_EQ(d.own, does(1, attack));
  EXPECT_TRUE(d.search->atoms.contains(does(9, attack)));
  EXPECT_EQ(stands(a, start + milliseconds(100)), stance::dissents);
  EXPECT_EQ(stands(a, start + seconds(2)), stance::none) << "nobody rules any more";
  EXPECT_FALSE(think(a, sees(1), start + milliseconds(90)).dissents);
  EXPECT_EQ(stands(a, start + milliseconds(100)), stance::none);
}

TEST_F(dissent, is_not_the_hysteresis_of_a_plan) {
  rota::robot_options o;
  o.hysteresis = rota::hysteresis{0.5, {}};
  auto a = in_play(1, o);
  auto c = claim_by(9, 1);
  c.atoms.insert(does(9, defend));
  c.ages.push_back({});
  a.receive(c, start);
  view v;
  v.attack[1] = 0.6, v.attack[9] = 1;
  EXPECT_FALSE(think(a, v, start).dissents) << "by itself it would keep this allocation";
  v.attack[1] = 0.1;
  EXPECT_TRUE(think(a, v, start).dissents);
}

TEST_F(dissent, a_leader_renews_if_it_was_told_to_and_its_reign_ends_soon) {
  for (auto const told : {stance::none, stance::abstains, stance::dissents}) {
    auto a = leader();
    auto const first = *claims(a, start);
    a.receive(says_so(4, 2, defend, told), start + milliseconds(100));
    EXPECT_FALSE(think(a, sees(5), start + milliseconds(1499)).reign_renewed) << "it has more than `max_delay` left";
    auto const d = think(a, sees(5), start + milliseconds(1500));
    EXPECT_EQ(d.reign_renewed, told == stance::dissents);
    EXPECT_FALSE(d.reign_began || d.reign_ended);
    auto const next = *claims(a, start + milliseconds(1500));
    bool const renewed = told == stance::dissents;
    EXPECT_EQ(next.number, first.number + (renewed ? 1 : 0));
    EXPECT_EQ(next.renewals, renewed ? 1u : 0u);
    EXPECT_EQ(next.remaining, renewed ? seconds(2) : milliseconds(500));
    EXPECT_EQ(a.rule(play_id)->expiry(), start + (renewed ? milliseconds(3500) : milliseconds(2000)));
  }
}

TEST_F(dissent, counts_as_its_sender_said_last_and_only_while_it_takes_part) {
  auto const renews = [&](robot a) { return think(a, sees(5), start + milliseconds(1600)).reign_renewed; };
  auto a = leader();
  a.receive(says_so(4, 3, defend, stance::dissents), start + milliseconds(100));
  EXPECT_TRUE(renews(a));
  a.receive(says_so(4, 2, defend, stance::none), start + milliseconds(200));
  EXPECT_TRUE(renews(a)) << "an old message";
  auto b = a;
  b.receive(says_so(4, 4, defend, stance::none), start + milliseconds(300));
  EXPECT_FALSE(renews(b));
  b = a;
  b.receive(says_nothing(4, 4), start + milliseconds(300));
  EXPECT_FALSE(renews(b)) << "it has left";
  rota::robot_options o;
  o.silence = seconds(1);
  o.max_delay = milliseconds(400);
  b = leader(o);
  b.receive(says_so(4, 3, defend, stance::dissents), start + milliseconds(100));
  EXPECT_FALSE(think(b, sees(5), start + milliseconds(1700)).reign_renewed) << "it was silent for too long";
}

TEST_F(dissent, renews_a_reign_so_often_at_most_and_never_if_it_may_not) {
  for (std::uint32_t const most : {0u, 1u, 3u}) {
    rota::robot_options o;
    o.renewals = most;
    auto a = leader(o);
    std::uint32_t renewed = 0;
    std::uint64_t n = 1;
    auto now = start;
    for (; a.rule(play_id)->leading(); now += milliseconds(30)) {
      a.receive(says_so(4, ++n, defend, stance::dissents), now);
      auto const d = think(a, sees(5), now);
      renewed += d.reign_renewed;
      EXPECT_EQ(d.search.has_value(), true);
      if (d.leader) {
        EXPECT_LE(claims(a, now).value_or(claim{}).renewals, most);
      }
    }
    EXPECT_EQ(renewed, most);
    EXPECT_LE(now, start + seconds(2) * static_cast<std::int64_t>(most + 1) + milliseconds(60));
  }
}

TEST_F(dissent, costs_nothing_where_nobody_renews) {
  rota::robot_options o;
  o.renewals = 0;
  auto a = in_play(1, o);
  a.receive(says(9, 1, defend), start);
  a.receive(claim_by(9, 1), start);
  auto const d = think(a, sees(9), start + milliseconds(30));
  EXPECT_FALSE(d.search);
  EXPECT_FALSE(d.dissents);
  EXPECT_EQ(stands(a, start + milliseconds(100)), stance::none);
}

/// A plan message may overtake the new claim. It must not free who obeys the one before: or else the conflict is back for a moment,
/// and who leads is not open again.
TEST_F(dissent, a_plan_message_that_comes_before_the_renewal_frees_nobody) {
  auto a = in_play(1);
  a.set_confidence(3);
  a.receive(says(9, 1, defend), start);
  auto c = claim_by(9, 9);
  c.stamp.confidence = 4;
  a.receive(c, start);
  auto leads_on = says(9, 2, attack);
  leads_on.claims = leads_on.types[0].leads = 2;
  a.receive(leads_on, start + milliseconds(1510));
  EXPECT_TRUE(a.rule(play_id)->obeying());
  c.number = 2;
  c.renewals = 1;
  c.stamp.confidence = 2;
  EXPECT_EQ(a.receive(c, start + milliseconds(1540)).claim, rota::claim_outcome::challenged);
  // A leader that has made other claims since and leads with none frees it.
  auto b = in_play(1);
  b.receive(claim_by(9, 9), start);
  auto over = says(9, 3, attack);
  over.claims = 2;
  b.receive(over, start + milliseconds(1510));
  EXPECT_FALSE(b.rule(play_id)->active());
}

TEST_F(dissent, renews_early_enough_whatever_the_greatest_delay) {
  for (auto const& [delay, early] :
       std::vector<std::pair<int, int>>{{0, 200}, {10, 200}, {300, 300}, {500, 500}, {1900, 1000}}) {
    rota::robot_options o;
    o.max_delay = milliseconds(delay);
    auto a = leader(o);
    a.receive(says_so(4, 2, defend, stance::dissents), start + milliseconds(100));
    EXPECT_FALSE(think(a, sees(5), start + seconds(2) - milliseconds(early + 1)).reign_renewed) << delay;
    EXPECT_TRUE(think(a, sees(5), start + seconds(2) - milliseconds(early)).reign_renewed) << delay;
  }
}

TEST_F(dissent, who_abstains_and_is_needed_keeps_the_reign_alive) {
  using plan = rota::plan<soccer, view>;
  rota::additive_utility<soccer, view> const worth = [](soccer::agent a, soccer::task, view const& v) {
    return std::optional<double>(v.attack[static_cast<std::size_t>(a)]);
  };
  auto const pair = *plan::make({.plan = soccer::plan::normal,
                                 .tasks = {{soccer::task::attack, {2, 2}, soccer::state::get_ball}},
                                 .utility = worth});
  auto const both = *rota::plan_type<soccer, view>::make(play_id, {pair});
  robot a(agent(5), squad(9), first_life);
  a.enter(both, start);
  a.receive(says(4, 1, attack), start);
  a.receive(claim_by(4, 4), start);
  auto const judge = [&](int ms) { return a.deliberate(both, members, sees(5), start + milliseconds(ms), space); };
  (void)judge(0);
  a.receive(says_so(4, 2, attack, stance::abstains), start + milliseconds(100));
  EXPECT_TRUE(judge(1500).reign_renewed);
  // It has no task: without the reign it would have none, either.
  auto b = leader();
  b.receive(says_so(4, 2, std::nullopt, stance::abstains), start + milliseconds(100));
  EXPECT_FALSE(think(b, sees(5), start + milliseconds(1500)).reign_renewed);
}

TEST_F(dissent, from_another_leader_or_from_long_ago_counts_for_nothing) {
  auto a = in_play(5);
  a.receive(says_so(3, 1, defend, stance::dissents), start);  // from robot 4
  auto c = claim_by(4, 4);
  c.remaining = milliseconds(300);
  a.receive(c, start);
  (void)think(a, sees(5), start);
  EXPECT_FALSE(think(a, sees(5), start + milliseconds(290)).reign_renewed);

  // It has found a loop itself, after somebody dissented from a leader before.
  rota::robot_options quick;
  quick.cycles = 1;
  auto finder = in_play(5, quick);
  finder.receive(says_so(3, 1, defend, stance::dissents), start);
  finder.receive(says(2, 1, defend), start);
  (void)think(finder, sees(5), start);
  finder.receive(says(2, 2, attack), start + milliseconds(10));
  EXPECT_TRUE(think(finder, sees(5), start + milliseconds(30)).reign_began);
  EXPECT_FALSE(think(finder, sees(5), start + milliseconds(1600)).reign_renewed);

  rota::robot_options o;
  o.silence = seconds(20);
  auto b = leader(o);
  b.receive(says_so(4, 2, defend, stance::dissents), start + milliseconds(100));
  EXPECT_TRUE(think(b, sees(5), start + milliseconds(1600)).reign_renewed);
  EXPECT_FALSE(think(b, sees(5), start + milliseconds(3100)).reign_renewed) << "it may be dead";
}

/// Two robots whose confidences grow all the time; 2 enters shortly before the reign of 1 ends, and messages are slow. Each answer
/// reaches the other when all that it knows of is over: stamps alone do not end it.
TEST_F(dissent, answers_to_answers_end_whatever_confidences_do) {
  auto const everybody = squad(3);
  robot a(agent(1), everybody, first_life), b(agent(2), everybody, first_life);
  a.enter(play, start);
  a.set_confidence(1);
  a.receive(claim_by(3, 3), start);
  struct letter {
    int due, to;
    message what;
  };
  std::vector<letter> air;
  int answers = 0, last = 0;
  for (int ms = 0; ms < 10'000; ++ms) {
    auto const now = start + milliseconds(ms);
    if (ms == 1800) b.enter(play, now);
    for (auto* x : {&a, &b}) x->set_confidence(1 + static_cast<std::uint32_t>(ms));
    for (std::size_t i = 0; i < air.size();) {
      if (air[i].due > ms) {
        ++i;
        continue;
      }
      auto& x = air[i].to == 1 ? a : b;
      if (x.receive(air[i].what, now).claim == rota::claim_outcome::challenged) ++answers, last = ms;
      air.erase(air.begin() + static_cast<std::ptrdiff_t>(i));
    }
    for (auto* x : {&a, &b}) {
      if (ms % 5 == 0 && x->executes(play_id)) (void)think(*x, sees(1), now);
      while (auto m = x->next_message(now)) air.push_back({ms + 200, x == &a ? 2 : 1, *m});
    }
  }
  EXPECT_GE(answers, 1);
  EXPECT_LE(answers, 2) << "three robots: a claim, and an answer of each of the others";
  EXPECT_LE(last, 2400);
}

TEST_F(dissent, a_renewal_is_obeyed_and_the_claim_before_it_is_over) {
  auto a = in_play(1);
  auto const first = claim_by(9, 1);
  a.receive(first, start);
  auto second = claim_by(9, 1, 2);
  second.renewals = 1;
  EXPECT_EQ(a.receive(second, start + milliseconds(1500)).claim, rota::claim_outcome::adopted);
  EXPECT_EQ(a.rule(play_id)->expiry(), start + milliseconds(3500));
  EXPECT_EQ(a.receive(first, start + milliseconds(1510)).claim, rota::claim_outcome::expired);
  EXPECT_EQ(a.rule(play_id)->current().number, 2u);
  second.renewals = 2;
  EXPECT_EQ(a.receive(second, start + milliseconds(1520)).reason, rota::refusal::foreign_stamp)
      << "how often it was renewed never changes";
  second.renewals = 1;
  second.answers = 1;
  EXPECT_EQ(a.receive(second, start + milliseconds(1530)).reason, rota::refusal::foreign_stamp);
}

/// Robot 1 is smaller than 9; its confidence grows while it obeys. Its stamp stays until the reign is renewed.
TEST_F(dissent, a_renewal_opens_again_who_leads_and_nothing_else_does) {
  auto a = in_play(1);
  a.receive(claim_by(9, 9), start);
  a.set_confidence(3);
  EXPECT_EQ(a.receive(claim_by(9, 9), start + milliseconds(100)).claim, rota::claim_outcome::repeated);
  auto next = claim_by(9, 9, 2);
  EXPECT_EQ(a.receive(next, start + milliseconds(200)).claim, rota::claim_outcome::adopted)
      << "a claim of its own right, made after another detection";
  next.number = 3;
  next.renewals = 1;
  EXPECT_EQ(a.receive(next, start + milliseconds(1500)).claim, rota::claim_outcome::challenged);
  (void)think(a, sees(1), start + milliseconds(1500));
  auto const answer = *claims(a, start + milliseconds(1500));
  EXPECT_EQ(answer.stamp.confidence, 3u);
  EXPECT_EQ(answer.renewals, 1u) << "as often renewed as the claim that it answers";
  EXPECT_LE(answer.remaining, seconds(2));
  a.set_confidence(7);
  EXPECT_EQ(claims(a, start + milliseconds(1600))->stamp.confidence, 3u) << "frozen again";
  a.receive(says_so(9, 1, defend, stance::dissents), start + milliseconds(1700));
  EXPECT_TRUE(think(a, sees(1), start + milliseconds(3100)).reign_renewed);
  EXPECT_EQ(claims(a, start + milliseconds(3100))->stamp.confidence, 7u) << "who leads is open again";
}

TEST_F(dissent, who_sees_nothing_valid_for_a_message_period_abstains_also_under_authority) {
  auto a = in_play(1);
  view none;
  none.attack.fill(-100);
  (void)think(a, none, start);
  (void)think(a, none, start + milliseconds(99));
  EXPECT_EQ(stands(a, start + milliseconds(100)), stance::none) << "it may have missed a look";
  EXPECT_EQ(think(a, none, start + milliseconds(100)).reason, decision_reason::no_valid_allocation);
  EXPECT_EQ(stands(a, start + milliseconds(100)), stance::abstains);
  a.receive(claim_by(9, 1), start + milliseconds(110));
  auto const d = think(a, none, start + milliseconds(130));
  EXPECT_EQ(d.reason, decision_reason::obeyed);
  EXPECT_FALSE(d.dissents);
  EXPECT_EQ(d.own, does(1, attack)) << "it obeys";
  EXPECT_EQ(stands(a, start + milliseconds(200)), stance::abstains);
  (void)think(a, sees(1), start + milliseconds(160));
  EXPECT_NE(stands(a, start + milliseconds(200)), stance::abstains);
  (void)think(a, none, start + milliseconds(190));
  EXPECT_EQ(stands(a, start + milliseconds(200)), stance::none)
      << "the time counts anew; and who sees nothing dissents from nothing";
}

TEST_F(dissent, nobody_who_obeys_says_where_it_stands_if_reigns_have_a_fixed_length) {
  rota::robot_options o;
  o.renewals = 0;
  auto a = in_play(1, o);
  view none;
  none.attack.fill(-100);
  (void)think(a, none, start);
  (void)think(a, none, start + milliseconds(100));
  EXPECT_EQ(stands(a, start + milliseconds(100)), stance::abstains);
  a.receive(claim_by(9, 1), start + milliseconds(110));
  (void)think(a, sees(1), start + milliseconds(130));
  EXPECT_EQ(stands(a, start + milliseconds(200)), stance::none) << "it sees again, and has not judged";
}

TEST_F(dissent, who_enters_anew_has_not_judged_yet_and_does_not_abstain) {
  auto a = in_play(1);
  view none;
  none.attack.fill(-100);
  for (int ms : {0, 100}) (void)think(a, none, start + milliseconds(ms));
  EXPECT_EQ(stands(a, start + milliseconds(100)), stance::abstains);
  a.leave(play_id);
  a.enter(play, start + milliseconds(50));
  EXPECT_EQ(stands(a, start + milliseconds(100)), stance::none);
}

TEST_F(dissent, who_abstains_is_given_no_task_as_long_as_others_can_take_them_all) {
  auto a = in_play(1);
  a.receive(says_so(2, 1, std::nullopt, stance::abstains), start);
  auto d = think(a, sees(2), start);
  EXPECT_EQ(a.believes(play_id)->atoms(), (atoms{does(1, attack)})) << "though 2 would attack better";
  EXPECT_TRUE(a.believes(play_id)->takes_part(agent(2)));
  a.receive(says_so(2, 2, std::nullopt, stance::none), start);
  d = think(a, sees(2), start);
  EXPECT_EQ(a.believes(play_id)->atoms(), (atoms{does(1, defend), does(2, attack)}));
  // As a leader, too: what it gave is taken away.
  auto b = leader();
  (void)think(b, sees(4), start);
  EXPECT_TRUE(b.believes(play_id)->atoms().contains(does(4, attack)));
  b.receive(says_so(4, 2, attack, stance::abstains), start);
  (void)think(b, sees(4), start);
  EXPECT_EQ(b.believes(play_id)->atoms(), (atoms{does(5, attack)}));
}

/// If only those who abstain could make an allocation valid, they are counted in: or else one blind robot would blind all.
/// Hysteresis and change cost hold among those who do not abstain, too.
TEST_F(dissent, the_others_keep_what_they_do_where_somebody_abstains) {
  rota::robot_options o;
  o.hysteresis = rota::hysteresis{0.5, {}};
  auto a = in_play(1, o);
  a.receive(says(2, 1, attack), start);
  a.receive(says_so(3, 1, std::nullopt, stance::abstains), start);
  view v;
  v.attack[1] = 1, v.attack[2] = 0.75;
  auto d = think(a, v, start);
  EXPECT_EQ(a.believes(play_id)->atoms(), (atoms{does(2, attack)}));
  EXPECT_EQ(d.left_out.size(), 1u);
  EXPECT_EQ(d.left_out[0], agent(3));
  EXPECT_NE(describe(d).find("left out, since they abstain: 3"), std::string::npos) << describe(d);
  a.receive(says(3, 2, defend), start);
  d = think(a, v, start);
  EXPECT_TRUE(d.left_out.empty());
  EXPECT_EQ(describe(d).find("abstain"), std::string::npos);
}

TEST_F(dissent, who_abstains_makes_nobody_else_abstain) {
  using plan = rota::plan<soccer, view>;
  rota::additive_utility<soccer, view> const worth = [](soccer::agent a, soccer::task, view const& v) {
    return std::optional<double>(v.attack[static_cast<std::size_t>(a)]);
  };
  auto const pair = *plan::make({.plan = soccer::plan::normal,
                                 .tasks = {{soccer::task::attack, {2, 2}, soccer::state::get_ball}},
                                 .utility = worth});
  auto const both = *rota::plan_type<soccer, view>::make(play_id, {pair});
  robot a(agent(1), squad(9), first_life);
  a.enter(both, start);
  a.receive(says_so(2, 1, std::nullopt, stance::abstains), start);
  auto const d = a.deliberate(both, members, sees(2), start, space);
  EXPECT_EQ(d.reason, decision_reason::reallocated);
  EXPECT_EQ(a.believes(play_id)->atoms(), (atoms{does(1, attack), does(2, attack)}));
  EXPECT_TRUE(d.left_out.empty());
  EXPECT_EQ(stands(a, start + milliseconds(100)), stance::none);
}

TEST_F(dissent, is_news) {
  auto a = in_play(1, rota::sparing(milliseconds(500)));
  a.receive(claim_by(9, 1), start);
  auto now = start;
  for (; now < start + milliseconds(600); now += milliseconds(10)) (void)a.next_message(now);  // what was news, twice
  EXPECT_EQ(a.next_due(), start + milliseconds(1250));
  (void)think(a, sees(9), now);
  EXPECT_EQ(stands(a, now + milliseconds(100)), stance::dissents);
  (void)a.next_message(now + milliseconds(100));
  (void)a.next_message(now + milliseconds(200));
  (void)think(a, sees(9), now + milliseconds(210));
  EXPECT_GT(a.next_due(), now + milliseconds(300)) << "it still does: that is none";
}

TEST_F(dissent, is_told_in_words) {
  auto a = leader();
  a.receive(says_so(4, 2, defend, stance::dissents), start + milliseconds(100));
  EXPECT_NE(describe(think(a, sees(5), start + milliseconds(1500)))
                .find("the robot renews its reign, since others would do "
                      "otherwise"),
            std::string::npos);
  EXPECT_NE(to_string(says_so(4, 2, defend, stance::dissents)).find(", dissents"), std::string::npos);
  EXPECT_NE(to_string(says_so(4, 2, std::nullopt, stance::abstains)).find("no task, abstains"), std::string::npos);
  EXPECT_EQ(to_string(says(4, 2, defend)).find("dissents"), std::string::npos);
}

}  // namespace

}  // namespace dissent_test
