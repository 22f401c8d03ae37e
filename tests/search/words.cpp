// What a search says for a person to read.
#include <rota/core/print.hpp>
#include <rota/search/print.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace words_test {

namespace {

struct soccer {
  enum class agent : unsigned char { keeper, left, right };
  enum class plan_type : unsigned char { play };
  enum class plan : unsigned char { normal, kickoff };
  enum class task : unsigned char { attack, defend };
  enum class state : unsigned char {};

  friend std::string to_string(agent a) { return a == agent::keeper ? "Kim" : a == agent::left ? "Lea" : "Rob"; }
  friend std::string to_string(plan p) { return p == plan::normal ? "normal" : "kickoff"; }
  friend std::string to_string(task t) { return t == task::attack ? "attack" : "defend"; }
};
using beliefs = double[3];

struct fixture {
  beliefs skill{1, 2, 3};
  rota::cardinality attackers{1, 2};
  std::optional<rota::plan_type<soccer, beliefs>> type;
  rota::team<soccer> team{soccer::agent::keeper, soccer::agent::left, soccer::agent::right};
  rota::workspace work;

  rota::plan<soccer, beliefs> plan(soccer::plan id, double weight) const {
    rota::plan_description<soccer, beliefs> d;
    d.plan = id;
    d.tasks = {{soccer::task::attack, attackers, {}}};
    d.utility = [weight](soccer::agent a, soccer::task, beliefs const& b) {
      return std::optional<double>(weight * b[static_cast<std::size_t>(a)]);
    };
    d.hysteresis = 0.5;
    return rota::plan<soccer, beliefs>::make(std::move(d)).value();
  }
  rota::problem<soccer, beliefs> problem(bool two_plans = false) {
    type =
        two_plans
            ? rota::plan_type<soccer, beliefs>::make(soccer::plan_type::play,
                                                     {plan(soccer::plan::normal, 1), plan(soccer::plan::kickoff, 2)})
                  .value()
            : rota::plan_type<soccer, beliefs>::make(soccer::plan_type::play, {plan(soccer::plan::normal, 1)}).value();
    return {*type, team, skill};
  }
};

std::string said(auto const& found) { return found ? describe(*found) : describe(found.error()); }

TEST(describe, a_solution) {
  fixture f;
  EXPECT_EQ(said(best_allocation(f.problem(), f.work)), "plan normal with utility 5, proved to be the best");
  EXPECT_EQ(said(best_allocation(f.problem(true), f.work)),
            "plan kickoff with utility 10, proved to be the best; the next best is plan normal, worth 5 less");
  f.skill[1] = std::nan("");
  EXPECT_EQ(
      said(best_allocation(f.problem(), f.work)),
      "plan normal with utility 4, proved to be the best; left out: the utility of agent Lea on task attack is not "
      "a number");
}

TEST(describe, a_solution_that_is_not_proved) {
  rota::solution<soccer> s;
  s.plan = soccer::plan::normal;
  s.utility = 2.5;
  s.gap = 0.25;
  EXPECT_EQ(describe(s), "plan normal with utility 2.5, another may be better, by at most 0.25");
  s.gap = std::numeric_limits<double>::infinity();
  EXPECT_EQ(describe(s), "plan normal with utility 2.5, another may be better, by an unknown amount");
  s.gap = 0;
  EXPECT_EQ(describe(s), "plan normal with utility 2.5, nothing is better, but another may be as good and preferred");
  s.lie = rota::bound_lie<soccer>{soccer::plan::normal, {}, 3, {}, 0.5, 4};
  EXPECT_EQ(describe(s),
            "plan normal with utility 2.5, nothing is better, but another may be as good and preferred; nothing is "
            "proved, for the bound of plan normal is wrong: it says at most 0.5 where 4 is possible");
}

TEST(describe, no_allocation_names_who_has_no_utility) {
  fixture f;
  f.attackers = {3, 3};
  f.skill[2] = std::nan("");
  auto const none = best_allocation(f.problem(), f.work);
  EXPECT_EQ(said(none), "no allocation is valid: plan normal: the utility of agent Rob on task attack is not a number");
  EXPECT_EQ(describe(reallocate(f.problem(), {}, f.work)),
            "nobody has a task: no allocation is valid: plan normal: the utility of agent Rob on task attack is not a "
            "number");
  f.attackers = {4, 4};
  EXPECT_EQ(
      said(best_allocation(f.problem(true), f.work)),
      "no allocation is valid: plan normal: 3 agents take part, 4 are needed; plan kickoff: 3 agents take part, 4 "
      "are needed");
  EXPECT_EQ(said(best_allocation(f.problem().with_change_cost(-1), f.work)).substr(0, 48),
            "no allocation is valid: plan normal: 3 agents ta");
  f.attackers = {1, 1};
  auto const refused = best_allocation(f.problem().with_change_cost(std::nan("")), f.work);
  EXPECT_EQ(said(refused),
            "no valid allocation was found, but one may exist: plan normal: the change cost is not a number");
}

TEST(describe, every_way_a_reallocation_ends) {
  fixture f;
  using reason = rota::reallocation_reason;
  auto const first = reallocate(f.problem(), {}, f.work);
  EXPECT_EQ(first.reason, reason::first);
  EXPECT_EQ(describe(first), "plan normal is adopted with utility 5: nothing was running");
  auto const kept = reallocate(f.problem().running(first.atoms), {}, f.work);
  EXPECT_EQ(describe(kept), "the running allocation stays with utility 5: nothing is better");
  f.skill[0] = 2.25;
  auto const lazy = reallocate(f.problem().running(first.atoms), {}, f.work);
  EXPECT_EQ(lazy.reason, reason::kept_hysteresis);
  EXPECT_EQ(describe(lazy),
            "the running allocation stays with utility 5: another is better by 0.25, not by more than the hysteresis");
  f.skill[0] = 4;
  auto const better = reallocate(f.problem().running(first.atoms), {}, f.work);
  EXPECT_EQ(describe(better), "plan normal is adopted with utility 7: a gain of 2");
  f.attackers = {0, 1};
  auto const invalid = reallocate(f.problem().running(first.atoms), {}, f.work);
  EXPECT_EQ(invalid.reason, reason::current_invalid);
  ASSERT_TRUE(invalid.violated);
  EXPECT_EQ(invalid.violated->what, rota::clause::cardinality);
  EXPECT_EQ(describe(invalid),
            "plan normal is adopted with utility 4: the running allocation is not valid: task attack "
            "has 2 agents instead of 0..1");
  f.attackers = {4, 4};
  auto const none = reallocate(f.problem().running(first.atoms), {}, f.work);
  EXPECT_EQ(none.reason, reason::no_valid_allocation);
  EXPECT_EQ(describe(none), "nobody has a task: no allocation is valid: plan normal: 3 agents take part, 4 are needed");
  f.attackers = {0, 3};
  auto const costly = reallocate(f.problem().running(first.atoms).with_change_cost(-1), {}, f.work);
  EXPECT_EQ(costly.reason, reason::kept_unproved);
  EXPECT_EQ(describe(costly), "the running allocation stays with utility 5: nothing better was found: plan normal: the "
                              "change cost is negative");
}

TEST(describe, knows_every_reason) {
  for (int r = 0; r <= static_cast<int>(rota::no_plan_reason::change_cost_refused); ++r) {
    rota::plan_refusal<soccer> refusal;
    refusal.reason = rota::no_plan_reason(r);
    refusal.fault = rota::utility_fault::threw;
    EXPECT_GT(describe(refusal).size(), 10u) << r;
    EXPECT_GT(to_string(refusal.reason).size(), 5u) << r;
  }
  for (int r = 0; r <= static_cast<int>(rota::reallocation_reason::search_incomplete); ++r) {
    rota::reallocation<soccer> next;
    next.reason = rota::reallocation_reason(r);
    EXPECT_GT(describe(next).size(), 10u) << r;
    EXPECT_GT(to_string(next.reason).size(), 5u) << r;
  }
  EXPECT_EQ(to_string(rota::dense::status::infeasible), "infeasible");
  EXPECT_EQ(to_string(rota::dense::flow_obstacle::slot_short), "a slot lacks agents");
  EXPECT_EQ(to_string(rota::dense::pair_cut::symmetry), "symmetry");
}

struct numbers {
  template <class Id>
  std::string operator()(Id id) const {
    return std::to_string(int(id));
  }
};

// Of the whole, of one agent, of two.
TEST(describe, a_utility_that_is_none) {
  rota::plan_refusal<soccer> r;
  r.reason = rota::no_plan_reason::utility_refused;
  r.fault = rota::utility_fault::positive_infinity;
  EXPECT_EQ(describe(r), "the utility is +infinity");
  r.about_atom = true;
  r.agent = soccer::agent::left;
  r.task = soccer::task::defend;
  EXPECT_EQ(describe(r), "the utility of agent Lea on task defend is +infinity");
  r.about_pair = true;
  r.other = {soccer::agent::right, {}, soccer::task::attack};
  EXPECT_EQ(describe(r), "the utility of agent Lea on task defend together with agent Rob on task attack is +infinity");
  EXPECT_EQ(describe(r, numbers{}), "the utility of agent 1 on task 1 together with agent 2 on task 0 is +infinity");
}

}  // namespace

}  // namespace words_test
