#include "cli/program.hpp"

#include <nlohmann/json.hpp>

#include <set>

namespace rota::test {
namespace playing_test {

using nlohmann::json;

class rota_simulate : public program_test {};
class rota_reproduce : public program_test {};

run_result ball_fight(std::vector<std::string> const& more) {
  std::vector<std::string> all = {"simulate", "--scenario", "ball-fight", "--minutes", "0.2"};
  all.insert(all.end(), more.begin(), more.end());
  return rota_program(all);
}

/// The keys that the issue asks of one scenario under one setting, with their types.
void expect_figures(json const& f, std::string const& name, std::string const& resolution) {
  ASSERT_TRUE(f.is_object());
  EXPECT_EQ(f.value("name", ""), name);
  EXPECT_EQ(f.value("resolution", ""), resolution);
  for (auto const* key : {"episodes", "cycles", "detections", "reigns", "renewals"})
    EXPECT_TRUE(f.contains(key) && f[key].is_number_unsigned()) << key;
  ASSERT_TRUE(f.contains("conflict_share") && f["conflict_share"].is_number());
  EXPECT_GE(f["conflict_share"], 0);
  EXPECT_LE(f["conflict_share"], 1);
  ASSERT_TRUE(f.contains("episode_ms") && f["episode_ms"].is_object());
  for (auto const* key : {"median", "p99", "max"})
    EXPECT_TRUE(f["episode_ms"].contains(key) && f["episode_ms"][key].is_number()) << key;
  EXPECT_LE(f["episode_ms"]["median"], f["episode_ms"]["p99"]);
  EXPECT_LE(f["episode_ms"]["p99"], f["episode_ms"]["max"]);
  ASSERT_TRUE(f.contains("right_share"));
  EXPECT_EQ(f["right_share"].is_null(), f["reigns"] == 0 && f["renewals"] == 0) << "the share of none is no number";
  EXPECT_TRUE(f.contains("resolved") && f["resolved"].is_boolean());
  EXPECT_EQ(f["resolved"], f["episode_ms"]["max"] <= 4000);
  for (auto const* key : {"not_one_attacker_share", "wrong_attacker_share"}) {
    ASSERT_TRUE(f.contains(key) && f[key].is_number()) << key;
    EXPECT_GE(f[key], 0) << key;
    EXPECT_LE(f[key], 1) << key;
  }
  ASSERT_TRUE(f.contains("reactions") && f["reactions"].is_number_unsigned());
  ASSERT_TRUE(f.contains("missed_changes") && f["missed_changes"].is_number_unsigned());
  ASSERT_TRUE(f.contains("reaction_ms"));
  EXPECT_EQ(f["reaction_ms"].is_null(), f["reactions"] == 0) << "the mean of none is no number";
}

TEST_F(rota_simulate, prints_the_json_of_the_documentation) {
  for (std::string const resolution : {"on", "off"}) {
    auto const r = ball_fight({"--json", "--resolution", resolution});
    EXPECT_EQ(r.status, 0) << r.complaint;
    EXPECT_EQ(r.complaint, "");
    expect_figures(json::parse(r.output, nullptr, false), "ball-fight", resolution);
  }
}

TEST_F(rota_simulate, knows_every_scenario) {
  for (std::string const name : {"ball-fight", "phantom-two", "phantom-none", "mislocalised", "hour"}) {
    auto const r = rota_program({"simulate", "--scenario", name, "--minutes", "0.05", "--json"});
    EXPECT_EQ(r.status, 0) << r.complaint;
    EXPECT_EQ(json::parse(r.output, nullptr, false).value("name", ""), name);
  }
}

TEST_F(rota_simulate, the_seed_alone_decides) {
  auto const seven = ball_fight({"--json", "--seed", "7"});
  EXPECT_EQ(seven.status, 0) << seven.complaint;
  EXPECT_EQ(ball_fight({"--json", "--seed", "7"}).output, seven.output);
  auto a = json::parse(seven.output, nullptr, false);
  auto b = json::parse(ball_fight({"--json", "--seed", "8"}).output, nullptr, false);
  a.erase("seed");
  b.erase("seed");
  EXPECT_NE(a, b) << "another seed is another game, not only another number";
  EXPECT_EQ(ball_fight({"--seed", "18446744073709551615"}).status, 0);
  EXPECT_EQ(ball_fight({"--seed", "0"}).status, 0);
}

TEST_F(rota_simulate, prints_a_table_for_people) {
  auto const r = ball_fight({"--robots", "3", "--loss", "0.25"});
  EXPECT_EQ(r.status, 0) << r.complaint;
  for (auto const* part : {"ball-fight: 3 robots play SoccerPlay", "loss 25.0 %", "time in conflict", "reigns",
                           "not exactly one attacker", "a wrong attacker", "another is best"})
    EXPECT_NE(r.output.find(part), std::string::npos) << part << " not in:\n" << r.output;
}

TEST_F(rota_simulate, lets_the_stamp_policy_decide_who_leads) {
  auto const play = [](std::string const& stamp) {
    auto const r = rota_program({"simulate", "--scenario", "ball-fight", "--stamp", stamp, "--minutes", "1", "--json"});
    EXPECT_EQ(r.status, 0) << r.complaint;
    return json::parse(r.output, nullptr, false);
  };
  auto const id = play("id"), consensus = play("consensus");
  EXPECT_EQ(id["stamp"], "id");
  EXPECT_EQ(id["led"].size(), 1u) << "the greatest id leads";
  EXPECT_EQ(consensus["stamp"], "consensus");
  EXPECT_GT(consensus["led"].size(), 1u);
  EXPECT_GT(consensus["right_share"], id["right_share"]);
  EXPECT_EQ(consensus["perception_digest"], id["perception_digest"]);
}

TEST_F(rota_simulate, plays_a_plan_type_in_either_format) {
  auto const play = [](std::string const& format) {
    auto const file = (own_files() / format / "etc" / "plans" / "Soccer.pty").string();
    return ball_fight({"--json", "--plan", file});
  };
  auto const r = play("json");
  EXPECT_EQ(r.status, 0) << r.complaint;
  EXPECT_EQ(play("xml").output, r.output);
}

TEST_F(rota_simulate, misuse_is_one_line) {
  auto const expect = [](std::string const& option, std::vector<std::string> const& values) {
    for (auto const& v : values) {
      SCOPED_TRACE(option + ' ' + v);
      expect_complaint(ball_fight({option, v}), {option});
    }
  };
  expect("--seed", {"-1", "18446744073709551616", "1.5", "0x1", "010", "+1", " 1", "1 ", "x", ""});
  expect("--loss", {"0x1", "nan", "-nan", "inf", "1.01", "-0.01", "1e-1x", "0,5", ""});
  expect("--latency", {"0x1", "nan", "-1", "10001", "1e999", ""});
  expect("--reign", {"0x1", "nan", "0", "-2", "3601", "2s", ""});
  expect("--robots", {"0", "1", "12", "-1", "0x5", "05", "5.0", "4294967301", ""});
  expect("--cycles", {"0", "-1", "0x4", "4.5", "1000001", "4294967300", ""});
  expect("--resolution", {"maybe", "ON", ""});
  expect("--stamp", {"psychic", "ID", ""});
  expect("--plan", {""});
  for (std::string const minutes : {"0", "-1", "nan", "inf", "0x1", "1441", ""})
    expect_complaint(rota_program({"simulate", "--scenario", "hour", "--minutes", minutes}), {"--minutes"});
  expect_complaint(rota_program({"simulate"}), {"--scenario"});
  expect_complaint(rota_program({"simulate", "--scenario", "chess"}), {"--scenario", "chess", "ball-fight"});
  expect_complaint(ball_fight({"--plan", "/nowhere.pml"}), {"/nowhere.pml", "no such file"});
  expect_complaint(ball_fight({"surplus"}), {"surplus"});
  sandbox box;
  expect_complaint(ball_fight({"--plan", box.write("etc/broken.pml", "{")}), {"broken.pml:1:2", "cut off"});
  box.write("etc/t.tsk", R"({"id": 1, "tasks": [{"id": 2, "name": "A"}]})");
  auto const crowd = box.write("etc/crowd.pml", R"({"id": 10, "name": "Crowd", "entryPoints": [
    {"id": 11, "task": "t.tsk#2", "minCardinality": 6, "maxCardinality": 9}]})");
  expect_complaint(ball_fight({"--plan", crowd}), {"crowd.pml", "5 robots cannot play it"});
}

TEST_F(rota_reproduce, misuse_is_one_line) {
  for (std::string const seed : {"-1", "18446744073709551616", "0x1", "nan", ""})
    expect_complaint(rota_program({"reproduce", "--seed", seed}), {"--seed"});
  expect_complaint(rota_program({"reproduce", "--plan", ""}), {"--plan"});
  expect_complaint(rota_program({"reproduce", "--stamp", "psychic"}), {"--stamp", "psychic", "consensus"});
  expect_complaint(rota_program({"reproduce", "--plan", "/nowhere.pml"}), {"/nowhere.pml", "no such file"});
  expect_complaint(rota_program({"reproduce", "--minutes", "1"}), {"--minutes"});
  expect_complaint(rota_program({"reproduce", "surplus"}), {"surplus"});
  EXPECT_EQ(rota_program({"reproduce", "--help"}).status, 0);
}

}  // namespace playing_test
}  // namespace rota::test
