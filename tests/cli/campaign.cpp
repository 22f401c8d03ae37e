#include "cli/program.hpp"

#include <nlohmann/json.hpp>

#include <sstream>

namespace rota::test {
namespace campaign_cli_test {

using nlohmann::json;

class rota_campaign : public program_test {};

run_result campaign(std::vector<std::string> more) {
  more.insert(more.begin(), "campaign");
  return rota_program(more);
}

TEST_F(rota_campaign, keeps_every_promise_and_says_what_it_has_seen) {
  auto const r = campaign({"--ticks", "20000", "--json"});
  EXPECT_EQ(r.status, 0) << r.complaint;
  EXPECT_EQ(r.complaint, "");
  auto const out = json::parse(r.output, nullptr, false);
  ASSERT_TRUE(out.is_object());
  EXPECT_EQ(out["kept"], true);
  EXPECT_GE(out["seen"]["ticks"], 20000);
  EXPECT_GT(out["seen"]["reigns"], 10);
  EXPECT_EQ(campaign({"--ticks", "20000", "--json"}).output, r.output);
  EXPECT_NE(campaign({"--ticks", "20000", "--json", "--seed", "2"}).output, r.output);
}

/// Held to a radio faster than its own, a team breaks a promise; the command that is printed shows it again.
TEST_F(rota_campaign, prints_the_command_that_plays_a_broken_promise_again) {
  auto const r = campaign({"--runs", "100", "--delay", "0.1"});
  EXPECT_EQ(r.status, 1) << r.complaint;
  auto const where = r.output.find("again: rota ");
  ASSERT_NE(where, std::string::npos) << r.output;
  std::istringstream line(r.output.substr(where + 12, r.output.find('\n', where) - where - 12));
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  auto const again = rota_program(words);
  EXPECT_EQ(again.status, 1);
  auto const cause = [](std::string const& output) { return output.substr(output.find("\n\n")); };
  auto const shown = r.output.substr(r.output.find("\n\n"), r.output.find("again:") - r.output.find("\n\n"));
  EXPECT_NE(cause(again.output).find(shown), std::string::npos) << again.output << r.output;
  EXPECT_NE(r.output.find("the world is calm from"), std::string::npos) << "what went wrong in this run";
  auto const out = json::parse(campaign({"--runs", "100", "--delay", "0.1", "--json"}).output, nullptr, false);
  EXPECT_EQ(out["kept"], false);
  EXPECT_NE(out["broken"].value("again", "").find("--delay 0.1"), std::string::npos);
}

TEST_F(rota_campaign, measures_how_long_faults_last) {
  auto const r = campaign({"--figures", "--runs", "2", "--json"});
  EXPECT_EQ(r.status, 0) << r.complaint;
  auto const out = json::parse(r.output, nullptr, false);
  ASSERT_EQ(out["figures"].size(), 13U);
  for (auto const& f : out["figures"]) {
    EXPECT_TRUE(f["here"].is_number() && (f["wanted"].is_null() || f["wanted"].is_number())) << f;
    EXPECT_TRUE(f["unit"] == "ms" || (f["unit"] == "1" && f["here"] <= 1)) << f;
  }
  auto const text = campaign({"--figures", "--runs", "2", "--opening", "300"}).output;
  for (auto const* part : {"wanted", "for 300 ms", "last disagreement", "60.0 % loss"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " not in:\n" << text;
}

TEST_F(rota_campaign, misuse_is_one_line) {
  for (std::string const ticks : {"0", "-1", "1e6", "0x1", ""})
    expect_complaint(campaign({"--ticks", ticks}), {"--ticks"});
  for (std::string const runs : {"0", "-1", "1000000001", ""}) expect_complaint(campaign({"--runs", runs}), {"--runs"});
  for (std::string const robots : {"1", "12", "x"}) expect_complaint(campaign({"--robots", robots}), {"--robots"});
  for (std::string const delay : {"-1", "nan", ""}) expect_complaint(campaign({"--delay", delay}), {"--delay"});
  expect_complaint(campaign({"--runs", "1", "--ticks", "1"}), {"--ticks"});
  expect_complaint(campaign({"--opening", "1"}), {"--figures"});
  for (std::string const other : {"--ticks", "--robots", "--delay"})
    expect_complaint(campaign({"--figures", other, "5"}), {"--figures"});
  expect_complaint(campaign({"--figures", "--opening", "2001"}), {"--opening"});
  expect_complaint(campaign({"surplus"}), {"surplus"});
}

}  // namespace campaign_cli_test
}  // namespace rota::test
