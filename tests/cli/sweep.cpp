#include "cli/program.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace rota::test {
namespace sweep_test {

using nlohmann::json;

class rota_sweep : public program_test {};

/// A short one: two systems, two seeds, games of half a second.
run_result sweep(std::vector<std::string> more) {
  std::vector<std::string> all{"sweep",   "--system", "rota,central", "--trouble", "mixed",
                               "--seeds", "2",        "--minutes",    "0.01"};
  all.insert(all.end(), more.begin(), more.end());
  return rota_program(all);
}
std::vector<std::string> lines_of(std::string const& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

TEST_F(rota_sweep, prints_means_with_intervals_in_json_and_as_a_table) {
  sandbox box;
  auto const rows = box.path("rows");
  auto const r = sweep({"--json", "--rows", rows, "--loss", "0,0.5"});
  ASSERT_EQ(r.status, 0) << r.complaint;
  auto const out = json::parse(r.output, nullptr, false);
  ASSERT_EQ(out["lines"].size(), 4u);
  std::vector<json> games;
  for (auto const& line : lines_of(slurp(rows))) games.push_back(json::parse(line, nullptr, false));
  ASSERT_EQ(games.size(), 8u);
  for (std::size_t i = 0; i < 4; ++i) {
    auto const& line = out["lines"][i];
    EXPECT_EQ(line["loss"], i < 2 ? 0.0 : 0.5);
    EXPECT_EQ(line["system"], i % 2 == 0 ? "rota" : "central");
    EXPECT_EQ(line["cycles"], i % 2 == 0 ? 4 : 0) << "the others know no n";
    double const a = games[2 * i]["messages_per_second"], b = games[2 * i + 1]["messages_per_second"];
    EXPECT_GT(a, 5);
    EXPECT_NEAR(line["messages_per_second"]["mean"].get<double>(), (a + b) / 2, 1e-9);
    EXPECT_NEAR(line["messages_per_second"]["within"].get<double>(), 12.706 * std::abs(a - b) / 2, 1e-9);
    EXPECT_EQ(line["messages_per_second"]["games"], 2);
    EXPECT_NEAR(line["not_right_share"]["mean"].get<double>(),
                line["not_one_attacker_share"]["mean"].get<double>() +
                    line["wrong_attacker_share"]["mean"].get<double>(),
                1e-9);
    EXPECT_FALSE(line.contains("")) << "a figure without a name";
  }
  auto const text = sweep({"--rows", rows, "--loss", "0,0.5"}).output;
  for (auto const* part : {"5 robots", "2 games of 0.01 minutes a line", "not one %", "50.0 %", "rota", "central", "±"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " not in:\n" << text;
}

/// A stamp is of rota's robots only, and says more on the air.
TEST_F(rota_sweep, plays_stamp_policies) {
  auto const r = sweep({"--json", "--stamp", "id,mates"});
  ASSERT_EQ(r.status, 0) << r.complaint;
  auto const out = json::parse(r.output, nullptr, false);
  ASSERT_EQ(out["lines"].size(), 3u);
  EXPECT_EQ(out["lines"][2]["stamp"], "-");
  EXPECT_GT(out["lines"][1]["bytes_per_second"]["mean"], out["lines"][0]["bytes_per_second"]["mean"]);
}

/// The lines of a longer one.
json lines_of_sweep(std::vector<std::string> more) {
  std::vector<std::string> all{"sweep", "--json", "--seeds", "2", "--minutes", "0.2"};
  all.insert(all.end(), more.begin(), more.end());
  auto const r = rota_program(all);
  EXPECT_EQ(r.status, 0) << r.complaint;
  return json::parse(r.output, nullptr, false)["lines"];
}
double mean_of(json const& line, char const* what) { return line[what]["mean"]; }

/// Fifteen metres are never saved in so short a game, so what was believed first stays; half a metre is not a plan's default.
TEST_F(rota_sweep, plays_hysteresis_of_all_and_change_costs_of_rota) {
  auto const usual = lines_of_sweep({"--trouble", "mixed", "--system", "rota,central"});
  ASSERT_EQ(usual.size(), 2u);
  EXPECT_EQ(usual[0]["hysteresis"], 0.1) << "that of the plan";
  EXPECT_EQ(usual[0]["change_cost"], 0);
  auto const stiff = lines_of_sweep(
      {"--trouble", "mixed", "--system", "rota,central", "--hysteresis", "0.1,15", "--change-cost", "0,7.5"});
  ASSERT_EQ(stiff.size(), 6u);
  EXPECT_EQ(stiff[0]["wrong_attacker_share"], usual[0]["wrong_attacker_share"]);
  for (std::size_t const i : {1u, 3u, 4u, 5u}) {
    SCOPED_TRACE(stiff[i].dump());
    EXPECT_GT(mean_of(stiff[i], "wrong_attacker_share"), 0.1) << "beside " << usual[0];
  }
  EXPECT_EQ(stiff[2]["system"], "central");
  EXPECT_EQ(stiff[2]["change_cost"], 0) << "the others know none";
  EXPECT_EQ(stiff[5]["hysteresis"], 15.0);
}

TEST_F(rota_sweep, plays_news_that_waits_and_reigns_of_any_length) {
  auto const lines = lines_of_sweep({"--trouble", "mixed", "--system", "rota", "--news", "on,off"});
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_GT(mean_of(lines[0], "messages_per_second"), mean_of(lines[1], "messages_per_second"));
  EXPECT_LT(mean_of(lines[0], "conflict_share"), mean_of(lines[1], "conflict_share"));
  auto const reigns =
      lines_of_sweep({"--system", "rota", "--trouble", "delusion", "--reign", "fixed", "--reign-length", "0.5,10"});
  ASSERT_EQ(reigns.size(), 2u);
  EXPECT_EQ(reigns[1]["reign_s"], 10.0);
  EXPECT_GT(mean_of(reigns[0], "reigns_per_hour"), mean_of(reigns[1], "reigns_per_hour"));
}

TEST_F(rota_sweep, does_not_depend_on_the_number_of_threads) {
  sandbox box;
  auto const one = sweep({"--json", "--jobs", "1", "--rows", box.path("one")});
  auto const three = sweep({"--json", "--jobs", "3", "--rows", box.path("three")});
  ASSERT_EQ(one.status, 0) << one.complaint;
  EXPECT_EQ(one.output, three.output);
  EXPECT_EQ(slurp(box.path("one")), slurp(box.path("three")));
  EXPECT_NE(sweep({"--json", "--seed", "5"}).output, one.output);
}

TEST_F(rota_sweep, goes_on_where_it_was_stopped) {
  sandbox box;
  auto const file = box.path("rows");
  auto const whole = sweep({"--json", "--rows", file});
  ASSERT_EQ(whole.status, 0) << whole.complaint;
  auto const all = slurp(file);
  auto const lines = lines_of(all);
  ASSERT_EQ(lines.size(), 4u);
  for (std::size_t const kept :
       {all.size() - 1, all.size() - 40, lines[0].size() + 1, lines[0].size() + 5, std::size_t{7}}) {
    std::ofstream(file) << all.substr(0, kept);
    auto const again = sweep({"--json", "--rows", file});
    EXPECT_EQ(again.status, 0) << again.complaint;
    EXPECT_EQ(again.output, whole.output);
    EXPECT_EQ(slurp(file), all) << "after " << kept << " bytes";
  }
  // What is there is not played again: a row that says otherwise is believed.
  auto doctored = all;
  auto const at = doctored.find("\"messages_per_second\":") + 22;
  doctored.replace(at, doctored.find(',', at) - at, "1000.0");
  std::ofstream(file) << doctored;
  auto const believed = json::parse(sweep({"--json", "--rows", file}).output, nullptr, false);
  EXPECT_GT(believed["lines"][0]["messages_per_second"]["mean"], 500);
  EXPECT_EQ(slurp(file), doctored);
}

TEST_F(rota_sweep, refuses_a_file_that_holds_something_else_and_leaves_it_as_it_is) {
  sandbox box;
  auto const file = box.path("rows");
  ASSERT_EQ(sweep({"--rows", file}).status, 0);
  auto const all = slurp(file);
  struct wrong {
    std::string text, place;
  };
  auto const first = all.substr(0, all.find('\n') + 1);
  auto renamed = first;
  renamed.replace(renamed.find("\"cycles\""), 8, "\"circles\"");
  auto negative = first;
  negative.replace(negative.find("\"seed\":1"), 8, "\"seed\":-1");
  for (auto const& w : {wrong{"a letter\n", ":1"}, wrong{"a letter", ":1"}, wrong{first + "{}\n", ":2"},
                        wrong{first + "\n", ":2"}, wrong{first + renamed, ":2"}, wrong{first + negative, ":2"},
                        wrong{first + "[half", ":2"}, wrong{first + first.substr(0, 40) + "\n", ":2"}}) {
    std::ofstream(file) << w.text;
    expect_complaint(sweep({"--rows", file}), {file + w.place, "not a row of a sweep"});
    EXPECT_EQ(slurp(file), w.text);
  }
  expect_complaint(sweep({"--rows", box.path("no/rows")}), {"no/rows", "No such file"});
  expect_complaint(sweep({"--rows", "/dev/null"}), {"/dev/null", "not a regular file"});
  expect_complaint(sweep({"--rows", ""}), {"--rows"});
}

/// A limit on the size of files cuts a write as a full disk does.
TEST_F(rota_sweep, on_a_full_disk_ends_with_whole_rows_and_goes_on_later) {
  sandbox box;
  auto const file = box.path("rows");
  auto const command = "trap '' XFSZ; ulimit -f 3; '" ROTA_PROGRAM
                       "' sweep --system rota,central --trouble mixed --seeds 2 "
                       "--minutes 0.01 --json --rows '" +
                       file + "' >'" + box.path("out") + "' 2>'" + box.path("err") + "'";
  int const status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(slurp(box.path("out")), "");
  auto const complaint = slurp(box.path("err"));
  EXPECT_EQ(complaint.find('\n'), complaint.size() - 1) << complaint;
  EXPECT_NE(complaint.find("2 rows of it are whole"), std::string::npos) << complaint;
  auto const rows = slurp(file);
  EXPECT_EQ(lines_of(rows).size(), 2u);
  EXPECT_EQ(rows.back(), '\n');
  auto const later = sweep({"--json", "--rows", file});
  EXPECT_EQ(later.output, sweep({"--json"}).output);
}

TEST_F(rota_sweep, draws_a_point_for_each_line) {
  sandbox box;
  auto const file = box.path("chart.svg");
  auto const r = rota_program(
      {"sweep", "--system", "rota,central", "--trouble", "mixed", "--seeds", "2", "--minutes", "0.2", "--chart", file});
  ASSERT_EQ(r.status, 0) << r.complaint;
  auto const svg = slurp(file);
  EXPECT_TRUE(svg.starts_with("<svg xmlns="));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  for (auto const* part : {">rota</text>", ">central</text>", "trouble: mixed", "<circle"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  expect_complaint(sweep({"--chart", box.path("no/chart.svg")}), {"no/chart.svg", "No such file"});
  expect_complaint(sweep({"--chart", "/dev/null"}), {"/dev/null", "not a regular file"});
}

TEST_F(rota_sweep, misuse_is_one_line) {
  auto const expect = [](std::string const& option, std::vector<std::string> const& values) {
    for (auto const& v : values) {
      SCOPED_TRACE(option + ' ' + v);
      expect_complaint(rota_program({"sweep", option, v}), {option});
    }
  };
  expect("--table", {"psychic", ""});
  expect("--system", {"psychic", "rota,psychic", "rota;central", ""});
  expect("--trouble", {"rain", ""});
  expect("--reign", {"eternal", "2"});
  expect("--stamp", {"alphabet"});
  expect("--news", {"perhaps", "on,maybe", ""});
  expect("--hysteresis", {"-0.1", "1001", "nan", "inf", "1e9", "0.1,x", ""});
  expect("--change-cost", {"-1", "1000.5", "nan", "a lot", "0,-0.1"});
  expect("--reign-length", {"0", "0.49", "61", "nan", "2s"});
  expect("--loss", {"1.1", "-0.1", "nan", "0.1,x", "0..1"});
  expect("--robots", {"1", "12", "2-5", "1e1", "5,05"});
  expect("--period", {"19", "1001", "100ms"});
  expect("--cycles", {"0", "1001", "4294967300"});
  expect("--minutes", {"0", "1441", "nan"});
  expect("--seeds", {"0", "10001", "1.5"});
  expect("--seed", {"-1", "18446744073709551616"});
  expect("--jobs", {"0", "1025"});
  expect_complaint(rota_program({"sweep", "--table", "loss", "--seeds", "10000"}), {"100000 games"});
  expect_complaint(rota_program({"sweep", "surplus"}), {"surplus"});
}

}  // namespace sweep_test
}  // namespace rota::test
