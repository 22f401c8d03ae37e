#include "cli/program.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace rota::test {
namespace studies_test {

using nlohmann::json;

class rota_budget : public program_test {};
class rota_timing : public program_test {};
class rota_monitors : public program_test {};
class rota_stamps : public program_test {};

TEST_F(rota_budget, counts_what_is_sent_and_spares_messages_without_more_conflict) {
  auto const r = rota_program({"budget", "--minutes", "0.2", "--runs", "2", "--json"});
  ASSERT_EQ(r.status, 0) << r.complaint;
  auto const rows = json::parse(r.output, nullptr, false)["budgets"];
  ASSERT_EQ(rows.size(), 6u);
  auto const row = [&](int wanted, bool news) {
    for (auto const& x : rows)
      if (x["wanted_per_second"] == wanted && x["news_at_once"] == news) return x;
    return json();
  };
  for (int const wanted : {10, 5, 2}) {
    EXPECT_GE(row(wanted, false)["sent_per_second"], 0.99 * wanted) << "claims come on top";
    EXPECT_LE(row(wanted, true)["sent_per_second"], 1.5 * wanted) << "about so many";
  }
  double const spared = row(2, true)["detection_ms"][0], slow = row(2, false)["detection_ms"][0];
  EXPECT_LT(spared, 600);
  EXPECT_GT(slow, 1200);
}

TEST_F(rota_budget, prints_a_table_and_misuse_is_one_line) {
  auto const r = rota_program({"budget", "--minutes", "0.01", "--runs", "1"});
  EXPECT_EQ(r.status, 0) << r.complaint;
  for (auto const* part : {"Five robots play", "news at once", "2/s", "20 min", "taken over"})
    EXPECT_NE(r.output.find(part), std::string::npos) << part << " not in:\n" << r.output;
  expect_complaint(rota_program({"budget", "--minutes", "0"}), {"--minutes"});
  expect_complaint(rota_program({"budget", "--runs", "0"}), {"--runs"});
  expect_complaint(rota_program({"budget", "--loss", "1.5"}), {"--loss"});
  expect_complaint(rota_program({"budget", "--plan", "/nowhere.pml"}), {"/nowhere.pml", "no such file"});
}

TEST_F(rota_timing, prints_the_check_figures) {
  auto const r = rota_program({"timing", "--runs", "20"});
  EXPECT_EQ(r.status, 0) << r.complaint;
  for (auto const* part : {"20 runs", "115 ms", "315 ms", "215 ms", "615 ms"})
    EXPECT_NE(r.output.find(part), std::string::npos) << part << " not in:\n" << r.output;
  expect_complaint(rota_program({"timing", "--runs", "0"}), {"--runs"});
  expect_complaint(rota_program({"timing", "--seed", "x"}), {"--seed"});
}

TEST_F(rota_monitors, prints_one_row_for_each_monitor_and_n) {
  auto const r =
      rota_program({"monitors", "--runs", "5", "--cycles", "4", "--monitor", "both", "--limit", "120", "--json"});
  ASSERT_EQ(r.status, 0) << r.complaint;
  auto const rows = json::parse(r.output, nullptr, false)["monitors"];
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["monitor"], "both");
  EXPECT_EQ(rows[0]["cycles"], 4);
  EXPECT_EQ(rows[0]["detection_ms"].size(), 6u);
  EXPECT_EQ(rows[0]["fights_missed"], 0);
  EXPECT_EQ(rows[0]["missed"], json(std::vector<double>(12))) << "the default misses nothing for ever";
  auto const literal = rota_program({"monitors", "--runs", "5", "--cycles", "4", "--monitor", "literal"});
  EXPECT_NE(literal.output.find("100.0 %"), std::string::npos) << literal.output;
  expect_complaint(rota_program({"monitors", "--monitor", "psychic"}), {"--monitor"});
  expect_complaint(rota_program({"monitors", "--cycles", "0"}), {"--cycles"});
  expect_complaint(rota_program({"monitors", "--runs", "4"}), {"--runs"});
  expect_complaint(rota_program({"monitors", "--limit", "0"}), {"--limit"});
}

TEST_F(rota_stamps, sets_what_robots_can_know_beside_what_they_cannot) {
  auto const r = rota_program({"stamps", "--seeds", "2", "--minutes", "0.02", "--json"});
  ASSERT_EQ(r.status, 0) << r.complaint;
  auto const cells = json::parse(r.output, nullptr, false)["stamps"];
  ASSERT_EQ(cells.size(), 5u * (6 + 3));
  std::size_t possible = 0;
  for (auto const& c : cells) {
    possible += c["possible"] == true ? 1 : 0;
    EXPECT_EQ(c["wrong_attacker_share"]["games"], 2) << c;
    for (auto const* share : {"right_share", "wrong_attacker_share", "not_one_attacker_share", "conflict_share"}) {
      if (c[share]["games"] == 0) continue;
      EXPECT_GE(c[share]["mean"], 0) << share;
      EXPECT_LE(c[share]["mean"], 1) << share;
    }
  }
  EXPECT_EQ(possible, 5u * 6);
}

TEST_F(rota_stamps, prints_tables_and_misuse_is_one_line) {
  auto const r = rota_program({"stamps", "--seeds", "1", "--minutes", "0.1", "--stamp", "consensus"});
  EXPECT_EQ(r.status, 0) << r.complaint;
  for (auto const* part :
       {"1 game of each", "right leaders", "a wrong attacker", "mislocalised", "consensus", "missed"})
    EXPECT_NE(r.output.find(part), std::string::npos) << part << " not in:\n" << r.output;
  expect_complaint(rota_program({"stamps", "--stamp", "psychic"}), {"--stamp", "psychic", "consensus"});
  expect_complaint(rota_program({"stamps", "--seeds", "0"}), {"--seeds"});
  expect_complaint(rota_program({"stamps", "--seed", "-1"}), {"--seed"});
  expect_complaint(rota_program({"stamps", "--minutes", "nan"}), {"--minutes"});
  expect_complaint(rota_program({"stamps", "--plan", "/nowhere.pml"}), {"/nowhere.pml", "no such file"});
}

}  // namespace studies_test
}  // namespace rota::test
