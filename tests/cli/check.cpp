#include "cli/program.hpp"

#include <nlohmann/json.hpp>

namespace rota::test {
namespace check_test {

using nlohmann::json;

class rota_check : public program_test {};

bool says(run_result const& r, std::string const& what) { return r.output.find(what) != std::string::npos; }

TEST_F(rota_check, prints_what_files_hold) {
  auto const r = rota_program({"check", own_files() / "json"});
  EXPECT_EQ(r.status, 0) << r.complaint;
  EXPECT_EQ(r.complaint, "");
  EXPECT_TRUE(says(r, "plan SoccerPlay  id 2011030100100  ")) << r.output;
  EXPECT_TRUE(says(r, "  Attack   1..1  enters at GetBall\n  Defend   1..2"));
  EXPECT_TRUE(says(r, "  team 2..5, hysteresis 0.1\n"));
  EXPECT_TRUE(says(r, "plan type Soccer"));
  EXPECT_TRUE(says(r, "  Attack, Defend, Support\n"));
  EXPECT_TRUE(says(r, "  Attack  -1  (forbidden)\n"));
  EXPECT_TRUE(says(r, "5 files: 5 loaded, 0 listed, 0 refused, 0 ignored; 2 plans, 1 plan type, 3 tasks, 2 roles; "
                      "0 warnings, 0 errors\n"));
}

TEST_F(rota_check, errors_are_exit_1_with_file_and_place) {
  sandbox box;
  auto const file = box.write("etc/p.pml", R"({"id": 10, "entryPoints": [
    {"id": 11, "task": "t.tsk#2", "minCardinality": 3, "maxCardinality": 1}]})");
  auto const r = rota_program({"check", file});
  EXPECT_EQ(r.status, 1);
  EXPECT_EQ(r.complaint, "");
  EXPECT_TRUE(says(r, "error: " + file + ":/entryPoints/0: minCardinality 3 is above maxCardinality 1 (id 11)\n"))
      << r.output;
}

TEST_F(rota_check, json_accounts_for_every_file) {
  sandbox box;
  fs::copy(own_files() / "xml", box.folder(), fs::copy_options::recursive);
  box.write("etc/note.txt", "hello");
  box.write("etc/plans/broken.pml", "{");
  auto const r = rota_program({"check", "--json", box.folder()});
  EXPECT_EQ(r.status, 1);
  auto const j = json::parse(r.output, nullptr, false);
  ASSERT_TRUE(j.is_object()) << r.output;
  EXPECT_EQ(j["files"].size(), 8u);
  EXPECT_EQ(j["plans"].size(), 2u);
  EXPECT_EQ(j["plans"][0]["tasks"][1]["cardinality"], json({{"min", 1}, {"max", 2}}));
  EXPECT_EQ(j["plan_types"][0]["plans"].size(), 2u);
  EXPECT_EQ(j["roles"][1]["default_priority"], 0.5);
  EXPECT_EQ(j["errors"], 1);
  EXPECT_EQ(j["ignored"], 1);
  for (auto const& d : j["diagnostics"])
    for (auto const* key : {"severity", "file", "place", "id", "reason"}) EXPECT_TRUE(d.contains(key)) << key;
  EXPECT_EQ(rota_program({"check", "--json", box.folder()}).output, r.output) << "the same bytes again";
}

TEST_F(rota_check, file_names_cannot_break_lines) {
  sandbox box;
  box.write("etc/a\nb\x1B[31m\xFF.pml", "{");
  auto const r = rota_program({"check", box.folder()});
  EXPECT_EQ(r.status, 1);
  EXPECT_TRUE(says(r, "a\\x0ab\\x1b[31m\\xff.pml")) << r.output;
  auto const j = json::parse(rota_program({"check", "--json", box.folder()}).output, nullptr, false);
  EXPECT_TRUE(j.is_object());
}

TEST_F(rota_check, names_cannot_draw_on_the_terminal_or_turn_the_line) {
  sandbox box;
  box.write("etc/t.tsk", "{\"id\": 1, \"tasks\": [{\"id\": 2, \"name\": \"\xC2\x9B"
                         "31m\xE2\x80\xAE"
                         "k\xC3\xBC"
                         "n "
                         "\xE2\x80\xA6 \xE2\x81\xA9\xE2\x80\x8F\xE2\x80\xA8\xD8\x9C\"}]}");
  auto const r = rota_program({"check", box.folder()});
  EXPECT_EQ(r.status, 0);
  EXPECT_TRUE(says(r, "  \\u009b31m\\u202ek\xC3\xBCn \xE2\x80\xA6 \\u2069\\u200f\\u2028\\u061c\n")) << r.output;
}

TEST_F(rota_check, misuse_is_exit_2) {
  expect_complaint(rota_program({"check", "/nowhere/x.pml"}), {"/nowhere/x.pml", "no such file"});
  expect_complaint(rota_program({"check", ""}), {"PATH", "empty"});
  sandbox box;
  expect_complaint(rota_program({"check", box.folder()}), {box.folder(), "no plan file"});
  auto const note = box.write("note.txt", "hello");
  expect_complaint(rota_program({"check", box.folder()}), {box.folder(), "no plan file"});
  expect_complaint(rota_program({"check", own_files() / "json", note}), {note, "no plan file"});
  expect_complaint(rota_program({"check", own_files() / "json", box.folder()}), {box.folder(), "no plan file"});
  expect_complaint(rota_program({"check"}), {"PATH"});
  expect_complaint(rota_program({"check", "--bogus", "."}), {"--bogus"});
  expect_complaint(rota_program({"bogus"}), {"rota"});
  expect_complaint(rota_program({}), {"subcommand"});
  EXPECT_EQ(rota_program({"--help"}).status, 0);
  EXPECT_EQ(rota_program({"check", "--help"}).status, 0);
}

TEST_F(rota_check, accounts_for_every_real_file) {
  if (!fs::exists(real_files())) GTEST_SKIP() << "no folder " << real_files();
  auto const r = rota_program({"check", real_files()});
  EXPECT_EQ(r.status, 1);
  EXPECT_TRUE(says(r, "39 files: 21 loaded, 3 listed, 7 refused, 8 ignored; 15 plans, 0 plan types, 82 tasks, "
                      "17 roles; 123 warnings, 9 errors\n"))
      << r.output.substr(r.output.rfind('\n', r.output.size() - 2) + 1);
}

}  // namespace check_test
}  // namespace rota::test
