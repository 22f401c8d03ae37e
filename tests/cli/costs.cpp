#include "cli/program.hpp"

#include <rota/search/assign.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace rota::test {
namespace costs_test {

using nlohmann::json;

std::string shipped(std::string const& name) { return (own_files() / name).string(); }

/// A plan with tasks Attack 1..1, Defend 1..2, Support 0..2, team 2..5.
std::string const play = "json/etc/plans/SoccerPlay.pml";

class rota_allocate_costs : public program_test {
protected:
  run_result allocate(std::string const& table, std::vector<std::string> more = {}) {
    std::vector<std::string> all{"allocate", "--plan", shipped(play), "--utilities", box_.write("costs.csv", table)};
    all.insert(all.end(), more.begin(), more.end());
    return rota_program(all);
  }
  std::string write(std::string const& name, std::string const& text) { return box_.write(name, text); }

private:
  sandbox box_;
};

TEST_F(rota_allocate_costs, are_entered_as_they_are) {
  std::string const table = "agent,Attack,Defend,Support\nr1,4,1,3\nr2,2,0,5\nr3,3,2,2\n";
  auto const r = allocate(table, {"--minimise"});
  EXPECT_EQ(r.status, 0) << r.complaint;
  for (auto const* part :
       {"cost     4 for 3 agents with a task, proved optimal\n", "  r1  Defend  1\n", "  r2  Defend  0\n",
        "  r3  Attack  3\n", "what costs less counts more, never below 0, and 3 of 3 pairs have a cost"})
    EXPECT_NE(r.output.find(part), std::string::npos) << part << "not in:\n" << r.output;
  EXPECT_EQ(allocate(table, {"--minimize"}).output, r.output);
  auto const j = json::parse(allocate(table, {"--minimise", "--json"}).output);
  EXPECT_EQ(j["cost"], 4);
  EXPECT_FALSE(j.contains("utility"));
}

TEST_F(rota_allocate_costs, leave_nobody_idle_who_can_have_a_task) {
  // r4 is dear and r5 may have no task at all; five places, but only four agents.
  std::string const table = "agent,Attack,Defend,Support\nr1,1,1,1\nr2,1,1,1\nr3,1,1,1\nr4,,,1000\nr5,,,\n";
  auto const j = json::parse(allocate(table, {"--minimise", "--json"}).output);
  EXPECT_EQ(j["cost"], 1003);
  EXPECT_EQ(j["idle"], json::parse(R"(["r5"])"));
  auto const forbidden = allocate(table, {"--minimise", "--no-idle"});
  EXPECT_EQ(forbidden.status, 1);
  EXPECT_NE(forbidden.output.find("r5 can take on no task and may not idle"), std::string::npos) << forbidden.output;
}

TEST_F(rota_allocate_costs, negated_by_hand_are_refused_with_advice_or_leave_all_they_can_idle) {
  std::string const table = "agent,Attack,Defend,Support\nr1,-4,-1,-3\nr2,-2,-1,-5\nr3,-3,-2,-2\n";
  for (auto const& more : {std::vector<std::string>{}, {"--no-idle"}}) {
    auto const r = allocate(table, more);
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.output.find("below 0 (costs are written as they are, with --minimise)"), std::string::npos) << r.output;
  }
  EXPECT_NE(rota_program({"allocate", "--help"}).output.find("write costs as they are, and add --minimise"),
            std::string::npos);
}

TEST_F(rota_allocate_costs, are_least_as_the_dense_solver_finds_them) {
  std::mt19937 random(8);
  std::array<cardinality, 3> const bounds{{{1, 1}, {1, 2}, {0, 2}}};
  for (int round = 0; round < 12; ++round) {
    std::vector<double> costs;
    std::string table = "agent,Attack,Defend,Support\n";
    auto const agents = 2 + random() % 5;
    for (std::size_t a = 0; a < agents; ++a) {
      table += "r" + std::to_string(a);
      for (int k = 0; k < 3; ++k) {
        bool const forbidden = random() % 5 == 0;
        auto const eighths = static_cast<int>(random() % 80) - 20;
        costs.push_back(forbidden ? std::numeric_limits<double>::infinity() : eighths / 8.0);
        table += ',' + (forbidden ? std::string() : std::to_string(eighths / 8.0));
      }
      table += '\n';
    }
    auto const least = assign(costs, bounds, {.minimise = true, .forbidden = std::numeric_limits<double>::infinity()});
    auto const got = json::parse(allocate(table, {"--minimise", "--json"}).output);
    ASSERT_EQ(got["plan"].is_null(), !least) << table << got;
    if (!least) continue;
    EXPECT_EQ(got["cost"], least->total) << table << got;
    EXPECT_EQ(got["idle"].size(),
              static_cast<std::size_t>(std::count(least->tasks.begin(), least->tasks.end(), assignment::idle)));
  }
}

TEST_F(rota_allocate_costs, say_what_a_change_saves) {
  std::string const table = "agent,Attack,Defend,Support\nr1,4,1,3\nr2,2,0,5\n";
  auto const worse = write("worse.json", R"({"plan": "SoccerPlay", "assignment": [{"agent": "r1", "task": "Attack"},
                                                                                {"agent": "r2", "task": "Defend"}]})");
  auto const adopted = allocate(table, {"--minimise", "--current", worse});
  EXPECT_NE(adopted.output.find("a running team adopts this: saves 1, more than the hysteresis"), std::string::npos)
      << adopted.output;
  auto const best = write("best.json", R"({"plan": "SoccerPlay", "cost": 3, "assignment": [
                            {"agent": "r1", "task": "Defend"}, {"agent": "r2", "task": "Attack"}]})");
  auto const kept = allocate(table, {"--minimise", "--current", best});
  EXPECT_NE(kept.output.find("a running team keeps it"), std::string::npos) << kept.output << kept.complaint;
}

TEST_F(rota_allocate_costs, of_several_plans_compare_likewise) {
  auto const r = rota_program({"allocate", "--plan", shipped("json"), "--plan-type", "Soccer", "--utilities",
                               shipped("utilities-of-both-plans.csv"), "--minimise"});
  EXPECT_EQ(r.status, 0) << r.complaint;
  EXPECT_NE(r.output.find(
                "cost     2 for 5 agents with a task, proved optimal\nnext     SoccerPress with 2.25 for 5 agents\n"),
            std::string::npos)
      << r.output;
}

TEST_F(rota_allocate_costs, too_far_apart_are_refused) {
  expect_complaint(allocate("agent,Attack,Defend,Support\nr1,0,1,1e9\nr2,1,1,1\n", {"--minimise"}),
                   {"costs.csv", "costs from 0 to 1e+09 are too far apart for 2 agents"});
}

}  // namespace costs_test
}  // namespace rota::test
