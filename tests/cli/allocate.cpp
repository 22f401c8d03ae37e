#include "cli/program.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <random>

namespace rota::test {
namespace allocate_test {

using nlohmann::json;

std::string shipped(std::string const& name) { return (own_files() / name).string(); }

/// A plan with tasks Attack 1..1, Defend 1..2, Support 0..2.
std::string const play = "json/etc/plans/SoccerPlay.pml";

class rota_allocate : public program_test {};

TEST_F(rota_allocate, prints_the_json_of_the_documentation) {
  sandbox box;
  auto const csv = box.write("u.csv", "agent,Attack,Defend,Support\nr2,2,1,\nr1,1,1.5,\nr3,,,\n");
  auto const r = rota_program({"allocate", "--plan", shipped(play), "--utilities", csv, "--json"});
  EXPECT_EQ(r.status, 0) << r.complaint;
  EXPECT_EQ(r.output,
            R"({"plan":"SoccerPlay","utility":3.5,"optimal":true,"assignment":[{"agent":"r1","task":"Defend"},)"
            R"({"agent":"r2","task":"Attack"}],"idle":["r3"],"event":{"added":[],"removed":[]}})"
            "\n");
}

TEST_F(rota_allocate, says_why_and_what_changes) {
  auto const r = rota_program({"allocate", "--plan", shipped(play), "--utilities", shipped("utilities.csv"),
                               "--current", shipped("current.json")});
  EXPECT_EQ(r.status, 0) << r.complaint;
  for (auto const* part :
       {"plan     SoccerPlay (2011030100100)\n", "utility  7.25, proved optimal\n", "  r2  Attack  2.25\n",
        "Attack 1 in 1..1, Defend 2 in 1..2, Support 2 in 0..2", "5 in 2..5", "5 of 5 pairs have a task of SoccerPlay",
        "5 agents with a task in 5 pairs", "role              not applied", "0, and idling is allowed",
        "  + r2  Attack\n", "  - r3  Attack\n", "a running team adopts this: gain "})
    EXPECT_NE(r.output.find(part), std::string::npos) << part << "not in:\n" << r.output;
}

TEST_F(rota_allocate, both_formats_and_any_order_of_rows_give_the_same_bytes) {
  sandbox box;
  auto const csv = box.write("u.csv", "\xEF\xBB\xBF"
                                      "agent,Support,\"Attack\",Defend\r\nr5,0.25,0.25,1\r\n\"r2\",1,2.25,\"0.25\"\r\n"
                                      "r4, 0.5 ,,2\r\nr1,0.75,0.5,1.5\r\nr3,1.25,1.75,0.5\r\n\r\n");
  auto const a = rota_program({"allocate", "--plan", shipped(play), "--utilities", shipped("utilities.csv"), "--json"});
  auto const b =
      rota_program({"allocate", "--plan", shipped("xml/etc/plans/SoccerPlay.pml"), "--utilities", csv, "--json"});
  EXPECT_EQ(a.status, 0) << a.complaint;
  EXPECT_EQ(a.output, b.output) << b.complaint;
}

// ALICA's first defect: a plan type yields the plan with the lowest id, not the best one.
TEST_F(rota_allocate, a_plan_type_yields_its_best_plan) {
  auto const r = rota_program({"allocate", "--plan", shipped("json"), "--plan-type", "Soccer", "--utilities",
                               shipped("utilities-of-both-plans.csv"), "--current", shipped("current.json"), "--json"});
  ASSERT_EQ(r.status, 0) << r.complaint;
  auto const j = json::parse(r.output);
  EXPECT_EQ(j["plan"], "SoccerPress") << "its id is the higher one";
  EXPECT_EQ(j["utility"], 7.5);
  EXPECT_EQ(j["event"]["added"].size(), 5u);
  EXPECT_EQ(j["event"]["removed"][0], json({{"agent", "r2"}, {"plan", "SoccerPlay"}, {"task", "Support"}}));
}

TEST_F(rota_allocate, its_output_is_a_current_allocation) {
  sandbox box;
  std::vector<std::string> const question = {
      "allocate", "--plan", shipped(play), "--utilities", shipped("utilities.csv"), "--json"};
  auto const first = rota_program(question);
  auto again = question;
  again.insert(again.end(), {"--current", box.write("now.json", first.output)});
  auto const second = rota_program(again);
  EXPECT_EQ(second.status, 0) << second.complaint;
  auto expected = json::parse(first.output);
  expected["decision"] = {{"keep", true}, {"reason", "nothing is better than the current allocation"}};
  EXPECT_EQ(json::parse(second.output), expected) << "nothing changes, so the event is empty";
  again.back() = box.write("then.json", second.output);
  EXPECT_EQ(rota_program(again).output, second.output) << "what the program prints, it reads";
}

// The event leads to the best allocation; whether a running team would go there is another question.
TEST_F(rota_allocate, says_whether_a_running_team_would_change) {
  sandbox box;
  auto const now = box.write("now.json", R"({"plan": "SoccerPlay", "assignment": [{"agent": "a", "task": "Attack"},
                                              {"agent": "b", "task": "Defend"}]})");
  auto const ask = [&](std::string const& rows, bool in_json) {
    auto const csv = box.write("u.csv", "agent,Attack,Defend,Support\n" + rows);
    std::vector<std::string> question = {"allocate", "--plan", shipped(play), "--utilities", csv, "--current", now};
    if (in_json) question.push_back("--json");
    auto const r = rota_program(question);
    EXPECT_EQ(r.status, 0) << r.complaint;
    return r.output;
  };
  auto const expect = [&](std::string const& rows, std::size_t changes, bool keep, std::string const& reason) {
    SCOPED_TRACE(rows);
    auto const j = json::parse(ask(rows, true), nullptr, false);
    ASSERT_TRUE(j.is_object());
    EXPECT_EQ(j["event"]["added"].size(), changes);
    EXPECT_EQ(j["event"]["removed"].size(), changes);
    EXPECT_EQ(j["decision"], json({{"keep", keep}, {"reason", reason}}));
    auto const text = ask(rows, false);
    EXPECT_NE(text.find(keep && changes == 0 ? "keeps it: "
                        : keep               ? "without the event above: "
                                             : "adopts this: "),
              std::string::npos)
        << text;
    EXPECT_NE(text.find(reason), std::string::npos) << text;
  };
  expect("a,1,1,\nb,1,1,\n", 0, true, "nothing is better than the current allocation");
  expect("a,1,1.0625,\nb,1,1,\n", 2, true, "gain 0.0625, no more than the hysteresis");
  expect("a,1,1.5,\nb,1,1,\n", 2, false, "gain 0.5, more than the hysteresis");
  expect("a,,1,\nb,1,1,\n", 2, false, "the current allocation is not valid");
}

TEST_F(rota_allocate, of_equals_a_running_team_keeps_its_own) {
  sandbox box;
  auto const now = box.write("now.json", R"({"plan": "SoccerPlay", "assignment": [{"agent": "b", "task": "Attack"},
                                              {"agent": "a", "task": "Defend"}]})");
  auto const csv = box.write("u.csv", "agent,Attack,Defend,Support\na,1,1,\nb,1,1,\n");
  auto const r = rota_program({"allocate", "--plan", shipped(play), "--utilities", csv, "--current", now, "--json"});
  ASSERT_EQ(r.status, 0) << r.complaint;
  auto const j = json::parse(r.output);
  EXPECT_EQ(j["event"]["added"].size(), 2u) << "the first of equals is the best";
  EXPECT_EQ(j["decision"]["keep"], true);
}

// The solver counts in steps of 2^-20; what is printed must be what was counted.
TEST_F(rota_allocate, utilities_off_the_grid_are_those_that_were_counted) {
  sandbox box;
  auto const ask = [&](std::string const& rows, bool in_json = true) {
    auto const csv = box.write("u.csv", "agent,Attack,Defend,Support\n" + rows);
    std::vector<std::string> question = {"allocate", "--plan", shipped(play), "--utilities", csv};
    if (in_json) question.push_back("--json");
    return rota_program(question);
  };
  for (std::string const x : {"1e-7", "-1e-7", "4e-7", "-4e-7", "1e-300", "-0.0"}) {
    auto const r = ask("a," + x + ",,\nb,," + x + ",\n");
    EXPECT_EQ(r.status, 0) << r.complaint;
    EXPECT_NE(r.output.find(R"("utility":0.0,)"), std::string::npos) << x << " counts 0: " << r.output;
    auto const text = ask("a," + x + ",,\nb,," + x + ",\n", false).output;
    EXPECT_NE(text.find("utility  0, proved"), std::string::npos) << text;
    EXPECT_NE(text.find("  a  Attack  0\n"), std::string::npos) << text;
    EXPECT_NE(text.find("  0 is at least 0, and 2 of 2 pairs have a utility"), std::string::npos) << text;
  }
  auto const third = json::parse(ask("a,0.333333333,,\nb,,0.1,\n").output, nullptr, false);
  EXPECT_EQ(third["utility"], (349525 + 104858) / 1048576.0) << "the sum of the rounded cells";
  EXPECT_EQ(ask("a,-6e-7,,\nb,,0,\n").status, 1) << "one step below 0";
}

TEST_F(rota_allocate, a_plan_type_that_is_the_only_one_need_not_be_named) {
  auto const csv = shipped("utilities-of-both-plans.csv");
  auto const named =
      rota_program({"allocate", "--plan", shipped("json"), "--plan-type", "Soccer", "--utilities", csv, "--json"});
  auto const r =
      rota_program({"allocate", "--plan", shipped("json/etc/plans/Soccer.pty"), "--utilities", csv, "--json"});
  EXPECT_EQ(r.status, 0) << r.complaint;
  EXPECT_EQ(r.output, named.output);
}

TEST_F(rota_allocate, an_agent_that_left_is_removed) {
  sandbox box;
  auto const now =
      box.write("now.json", R"({"plan": "SoccerPlay", "assignment": [{"agent": "r9", "task": "Attack"}]})");
  auto const r = rota_program(
      {"allocate", "--plan", shipped(play), "--utilities", shipped("utilities.csv"), "--json", "--current", now});
  ASSERT_EQ(r.status, 0) << r.complaint;
  EXPECT_EQ(json::parse(r.output)["event"]["removed"], json::parse(R"([{"agent": "r9", "task": "Attack"}])"));
}

TEST_F(rota_allocate, gives_up_where_it_is_told_to_and_says_how_far_off_it_may_be) {
  sandbox box;
  auto const csv =
      box.write("u.csv", "agent,Attack,Defend,Support\na,6,6,0\nb,4,8,7\nc,6,4,7\nd,5,9,3\ne,8,2,4\nf,2,1,9\n");
  auto const ask = [&](std::vector<std::string> const& more) {
    std::vector<std::string> question = {"allocate", "--plan", shipped(play), "--utilities", csv};
    question.insert(question.end(), more.begin(), more.end());
    auto const r = rota_program(question);
    EXPECT_EQ(r.status, 0) << r.complaint;
    return r.output;
  };
  auto const best = json::parse(ask({"--json"}), nullptr, false);
  EXPECT_EQ(best["optimal"], true);
  EXPECT_FALSE(best.contains("gap"));
  EXPECT_FALSE(best.contains("stats"));
  for (std::vector<std::string> const& limit : {std::vector<std::string>{"--budget", "0"}, {"--deadline", "0"}}) {
    auto all = limit;
    all.push_back("--json");
    auto const some = json::parse(ask(all), nullptr, false);
    EXPECT_EQ(some["optimal"], false);
    EXPECT_LE(some["utility"], best["utility"]);
    EXPECT_GE(some["utility"].get<double>() + some["gap"].get<double>(), best["utility"].get<double>());
    EXPECT_NE(ask(limit).find("at most"), std::string::npos);
  }
  EXPECT_EQ(json::parse(ask({"--json", "--budget", "100000", "--deadline", "60000"}), nullptr, false), best);

  auto const stats = json::parse(ask({"--json", "--stats"}), nullptr, false)["stats"];
  EXPECT_GE(stats["searches"], 1);
  EXPECT_GE(stats["augmentations"], 1);
  EXPECT_GE(stats["relaxations"], 1);
  EXPECT_GT(stats["microseconds"], 0);
  EXPECT_NE(ask({"--stats"}).find("\nsearch\n"), std::string::npos);

  // What it prints then is an allocation to compare with, too, as any worse one is.
  ask({"--current", box.write("some.json", ask({"--json", "--stats", "--budget", "0"}))});
  auto const now = box.write("now.json", R"({"plan": "SoccerPlay", "assignment": [
      {"agent": "a", "task": "Attack"}, {"agent": "b", "task": "Defend"}]})");
  EXPECT_NE(ask({"--current", now}).find("gain "), std::string::npos);
  for (std::vector<std::string> const& wrong :
       {std::vector<std::string>{"--budget", "-1"}, {"--budget", "1.5"}, {"--deadline", "-1"}, {"--deadline", "nan"}}) {
    std::vector<std::string> question = {"allocate", "--plan", shipped(play), "--utilities", csv};
    question.insert(question.end(), wrong.begin(), wrong.end());
    expect_complaint(rota_program(question), {wrong[0]});
  }
}

TEST_F(rota_allocate, no_valid_allocation_is_exit_1_with_a_reason) {
  sandbox box;
  auto const reason = [&](std::string const& csv, bool no_idle) {
    std::vector<std::string> question = {"allocate", "--plan",      shipped(play),
                                         "--json",   "--utilities", box.write("u.csv", csv)};
    if (no_idle) question.push_back("--no-idle");
    auto const r = rota_program(question);
    EXPECT_EQ(r.status, 1) << r.output << r.complaint;
    auto const j = json::parse(r.output, nullptr, false);
    EXPECT_TRUE(j.is_object() && j.size() == 2 && j["plan"].is_null()) << r.output;
    return j.value("reason", "");
  };
  std::string const head = "agent,Attack,Defend,Support\n";
  EXPECT_EQ(reason(head + "r1,1,1,1\n", false), "SoccerPlay: it needs at least 2 agents, and there are 1");
  EXPECT_EQ(reason(head, false), "SoccerPlay: it needs at least 2 agents, and there are 0");
  EXPECT_EQ(reason(head + "r1,,1,1\nr2,,1,1\n", false), "SoccerPlay: 0 agents can take on Attack, which needs 1..1");
  EXPECT_EQ(reason(head + "r1,1,1,\nr2,1,1,\nr3,,,\n", true), "SoccerPlay: r3 can take on no task and may not idle");
  EXPECT_EQ(reason(head + "r1,-5,1,\nr2,-5,1,\n", false),
            "SoccerPlay: its utility is at most -4, below 0 (costs are written as they are, with --minimise)");
  EXPECT_EQ(reason(head + "a,1,1,1\nb,1,1,1\nc,1,1,1\nd,1,1,1\ne,1,1,1\nf,1,1,1\n", true),
            "SoccerPlay: nobody may idle, there are 6 agents, and it has room for 5");
}

TEST_F(rota_allocate, wrong_tables_are_one_line_with_line_and_column) {
  sandbox box;
  auto const expect = [&](std::string const& csv, std::string const& place, std::string const& reason) {
    auto const file = box.write("u.csv", csv);
    SCOPED_TRACE(csv);
    expect_complaint(rota_program({"allocate", "--plan", shipped(play), "--utilities", file}),
                     {file + ':' + place + ": ", reason});
  };
  std::string const head = "agent,Attack,Defend,Support\n";
  expect("", "1:1", "empty");
  expect("\n", "1:1", "empty");
  expect("robot,Attack\n", "1:1", "begins with \"robot\"");
  expect("agent\nr1\n", "1:1", "no task");
  expect("agent,Attack,Keep\n", "1:14", "no task is called \"Keep\"; there are Attack, Defend, Support");
  expect("agent,Attack,Attack\n", "1:14", "\"Attack\" stands twice");
  expect("agent,SoccerPlay/Attack\n", "1:7", "no task is called");
  expect("agent,Attack,Support\nr1,1,2\n", "1:1", "no column for Defend; ");
  expect("agent,Attack\n", "1:1", "no column for Defend, Support; ");
  expect("agent,Attack,Defend,Support\rr1,1,2,3\rr2,1,2,3\r", "1:28", "a carriage return alone");
  expect(head + "r1,1,2,\"3\"\rr2,1,2,3\n", "2:11", "a carriage return alone");
  expect(head + "r1,1,2\n", "2:6", "3 cells, but the header has 4");
  expect(head + "r1,1,2,3,4\n", "2:10", "5 cells");
  expect(head + "r1,1,2,3\n\nr2,1,2,3\n", "3:1", "1 cells");
  expect(head + "r1,1,x,3\n", "2:6", "\"x\" is no number");
  expect(head + "r1,1,1.5m,3\n", "2:6", "is no number");
  expect(head + "r1,1,0x10,3\n", "2:6", "is no number");
  expect(head + "r1,1,nan,3\n", "2:6", "no utility");
  expect(head + "r1,1,inf,3\n", "2:6", "no utility");
  expect(head + "r1,1,-inf,3\n", "2:6", "no utility");
  expect(head + "r1,1,1e999,3\n", "2:6", "no utility");
  expect(head + "r1,1,2e9,3\n", "2:6", "no utility");
  expect(head + "r1,1,2,3\nr1,1,2,3\n", "3:1", "the agent \"r1\" stands twice");
  expect(head + ",1,2,3\n", "2:1", "without a name");
  expect(head + "\"r1,1,2,3\n", "2:1", "never closed");
  expect(head + "\"r1\"x,1,2,3\n", "2:5", "behind a closing quote");
  expect(head + "r\"1,1,2,3\n", "2:1", "quote inside");
  expect(head + "r\xFF,1,2,3\n", "2:2", "not UTF-8");
}

TEST_F(rota_allocate, wrong_current_allocations_are_one_line_with_a_place) {
  sandbox box;
  auto const expect = [&](std::string const& text, std::string const& place, std::string const& reason) {
    auto const file = box.write("now.json", text);
    SCOPED_TRACE(text);
    expect_complaint(rota_program({"allocate", "--plan", shipped(play), "--utilities", shipped("utilities.csv"),
                                   "--current", file, "--json"}),
                     {file + ':' + place, reason});
  };
  expect("", "1:1", "cut off");
  expect("{\"plan\": ", "1:10", "cut off");
  expect("[]", "/", "not an allocation");
  expect("{}", "/", "\"plan\" is missing");
  expect(R"({"plan": 5})", "/plan", "neither a name nor null");
  expect(R"({"plan": "SoccerPlay"})", "/", "\"assignment\" is missing");
  expect(R"({"plan": "SoccerPlay", "assignment": {}})", "/assignment", "not a list");
  expect(R"({"plan": "SoccerPlay", "assignment": [5]})", "/assignment/0", "not an object");
  expect(R"({"plan": "SoccerPlay", "assignment": [{"agent": "r1"}]})", "/assignment/0", "\"task\" is missing");
  expect(R"({"plan": "SoccerPlay", "assignment": [{"agent": 1, "task": "Attack"}]})", "/assignment/0/agent", "no");
  expect(R"({"plan": "SoccerPlay", "assignment": [{"agent": "r1", "task": "Keep"}]})", "/assignment/0/task",
         "no task \"Keep\"");
  expect(R"({"plan": "SoccerPlay", "assignment": [{"agent": "r1", "task": "Attack", "x": 1}]})", "/assignment/0/x",
         "only");
  expect(
      R"({"plan": "SoccerPlay", "assignment": [{"agent": "r1", "task": "Attack"}, {"agent": "r1", "task": "Defend"}]})",
      "/assignment/1", "two tasks");
  expect(R"({"plan": "Chess", "assignment": []})", "/plan", "no plan \"Chess\"");
  expect(R"({"plan": "", "assignment": []})", "/plan", "without a name");
  expect(R"({"plan": "SoccerPlay", "assignment": [{"agent": "", "task": "Attack"}]})", "/assignment/0/agent",
         "not a name");
  expect(R"({"plan": "SoccerPlay", "assignment": [{"agent": "r1", "task": ""}]})", "/assignment/0/task", "not a name");
  expect(R"({"plan": "SoccerPlay", "assignment": [], "idle": [5]})", "/idle/0", "not a name");
  expect(R"({"plan": "SoccerPlay", "assignment": [], "idle": ["r1", "r1"]})", "/idle/1", "stands twice");
  expect(R"({"plan": "SoccerPlay", "assignment": [], "utility": "5"})", "/utility", "not a number");
  expect(R"({"plan": "SoccerPlay", "assignment": [], "optimal": 1})", "/optimal", "neither true nor false");
  expect(R"({"plan": "SoccerPlay", "assignment": [], "event": []})", "/event", "not an object");
  expect(R"({"plan": null, "assignment": [{"agent": "r1", "task": "Attack"}]})", "/assignment", "without a plan");
  expect(R"({"plan": "SoccerPlay", "assigment": []})", "/assigment", "no such key");
  expect(R"({"plan": "SoccerPlay", "plan": "SoccerPlay"})", "/plan", "twice");
  expect(std::string(100, '['), "/0/0", "nested deeper");
}

TEST_F(rota_allocate, wrong_plans_are_one_line) {
  sandbox box;
  auto const csv = shipped("utilities.csv");
  auto const ask = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"allocate", "--utilities", csv});
    return rota_program(more);
  };
  expect_complaint(ask({"--plan", "/nowhere.pml"}), {"/nowhere.pml", "no such file"});
  expect_complaint(ask({}), {"--plan"});
  expect_complaint(rota_program({"allocate", "--plan", shipped(play)}), {"--utilities"});
  expect_complaint(rota_program({"allocate", "--plan", shipped(play), "--utilities", "/nowhere.csv"}),
                   {"/nowhere.csv", "no such file"});
  expect_complaint(rota_program({"allocate", "--plan", shipped(play), "--utilities", box.folder()}),
                   {box.folder(), "folder"});
  expect_complaint(ask({"--plan", shipped("json")}), {"2 plans (SoccerPlay, SoccerPress)"});
  expect_complaint(ask({"--plan", shipped("json"), "--plan-type", "Chess"}), {"no plan type is called \"Chess\""});
  expect_complaint(ask({"--plan", shipped("json/etc/tasks/soccer.tsk")}), {"no plan"});
  auto const broken = box.write("etc/p.pml", R"({"id": 10, "entryPoints": [{"id": 11, "task": "t.tsk#2"}]})");
  expect_complaint(ask({"--plan", broken}), {broken, "/entryPoints/0/task", "t.tsk#2 is not found", "id 11"});
  expect_complaint(ask({"--plan", box.write("etc/q.pml", "{")}), {"q.pml:1:2", "cut off"});
  // One that is broken is not left out for another that is not.
  expect_complaint(ask({"--plan", shipped(play), "--plan", box.path("etc/q.pml")}), {"q.pml:1:2", "cut off"});
  fs::remove(box.path("etc/p.pml"));
  fs::copy(own_files() / "json" / "etc" / "plans" / "SoccerPlay.pml", box.path("etc/good.pml"));
  fs::copy(own_files() / "json" / "etc" / "tasks", box.path("etc/tasks"));
  expect_complaint(ask({"--plan", box.folder()}), {"q.pml:1:2", "cut off"});
  fs::remove(box.path("etc/q.pml"));
  EXPECT_EQ(ask({"--plan", box.folder()}).status, 0);
  expect_complaint(ask({"--plan", shipped(play), "--plan", box.write("note.txt", "x")}), {"note.txt", "no plan file"});
}

TEST_F(rota_allocate, empty_values_are_mistakes) {
  std::vector<std::string> const sound = {"allocate", "--plan", shipped(play), "--utilities", shipped("utilities.csv")};
  for (std::string const option : {"--plan", "--plan-type", "--current", "--utilities"}) {
    auto question = sound;
    if (option == "--plan") question.erase(question.begin() + 1, question.begin() + 3);
    if (option == "--utilities") question.resize(3);
    question.insert(question.end(), {option, ""});
    expect_complaint(rota_program(question), {option, "empty"});
  }
}

TEST_F(rota_allocate, complaints_stay_lines_that_people_can_read) {
  sandbox box;
  std::string entries;
  std::string tasks;
  for (int i = 0; i < 500; ++i) {
    auto const n = std::to_string(i);
    tasks += (i == 0 ? "" : ",") + std::string(R"({"id": 1)") + n + R"(0, "name": "A task of quite some length )" + n +
             "\"}";
    entries += (i == 0 ? "" : ",") + std::string(R"({"id": 2)") + n + R"(0, "task": "t.tsk#1)" + n +
               R"(0", "minCardinality": 0, "maxCardinality": 1})";
  }
  box.write("etc/t.tsk", R"({"id": 1, "tasks": [)" + tasks + "]}");
  auto const plan = box.write("etc/p.pml", R"({"id": 2, "name": "P", "entryPoints": [)" + entries + "]}");
  auto const csv = box.write("u.csv", "agent,\xE2\x80\xAE"
                                      "evil\xC2\x9B"
                                      "2J\xE2\x81\xA6\nr1,1\n");
  auto const r = rota_program({"allocate", "--plan", plan, "--utilities", csv});
  expect_complaint(r, {"no task is called", "\\u202eevil\\u009b2J\\u2066", "500 in all"});
  EXPECT_LT(r.complaint.size(), 2100u);
}

// --- AttackPlay, against plain enumeration -----------------------------------------------------------------------

struct task_bounds {
  std::string name;
  int min;
  int max;
};

/// The greatest utility over every assignment, by trying them all; nothing if none is valid.
std::optional<double> enumerate(std::vector<std::vector<std::optional<double>>> const& u,
                                std::vector<task_bounds> const& tasks, int team_min, int team_max) {
  std::optional<double> best;
  std::vector<std::size_t> choice(u.size(), 0);  // 0 is idle
  for (;;) {
    std::vector<int> counts(tasks.size() + 1, 0);
    double sum = 0;
    bool valid = true;
    for (std::size_t a = 0; a < u.size(); ++a) {
      ++counts[choice[a]];
      if (choice[a] == 0) continue;
      auto const x = u[a][choice[a] - 1];
      valid = valid && x.has_value();
      sum += x.value_or(0);
    }
    for (std::size_t t = 0; t < tasks.size(); ++t)
      valid = valid && counts[t + 1] >= tasks[t].min && counts[t + 1] <= tasks[t].max;
    int const employed = static_cast<int>(u.size()) - counts[0];
    valid = valid && employed >= team_min && employed <= team_max && sum >= 0;
    if (valid && (!best || sum > *best)) best = sum;
    std::size_t a = 0;
    while (a < choice.size() && ++choice[a] > tasks.size()) choice[a++] = 0;
    if (a == choice.size()) return best;
  }
}

TEST_F(rota_allocate, attack_play_gets_the_optimum_of_enumeration) {
  if (!fs::exists(real_files())) GTEST_SKIP() << "no folder " << real_files();
  auto const plan = (real_files() / "dasys-lab__cnc-msl/etc/plans/Attack/AttackPlay.pml").string();
  std::vector<task_bounds> const tasks = {
      {"Attack", 1, 1}, {"Block", 0, 1}, {"Defend", 0, 1}, {"ReceivePassInGame", 1, 1}};
  std::mt19937 random{20110301};
  sandbox box;
  int none = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<std::vector<std::optional<double>>> u(1 + random() % 6);
    std::string csv = "agent,Attack,Block,Defend,ReceivePassInGame\n";
    for (std::size_t a = 0; a < u.size(); ++a) {
      csv += 'r' + std::to_string(a + 1);
      for (std::size_t t = 0; t < tasks.size(); ++t) {
        // Quarters: exact in the CSV, in doubles and in the solver's fixed point.
        auto& cell = u[a].emplace_back();
        if (random() % 4 != 0) cell = (static_cast<double>(random() % 40) - 8) / 4;
        csv += ',' + (cell ? std::to_string(*cell) : std::string());
      }
      csv += '\n';
    }
    SCOPED_TRACE(csv);
    auto const r = rota_program({"allocate", "--plan", plan, "--utilities", box.write("u.csv", csv), "--json"});
    auto const expected = enumerate(u, tasks, 2, 4);
    auto const j = json::parse(r.output, nullptr, false);
    ASSERT_TRUE(j.is_object()) << r.complaint;
    if (!expected) {
      ++none;
      EXPECT_EQ(r.status, 1);
      EXPECT_TRUE(j["plan"].is_null());
      continue;
    }
    EXPECT_EQ(r.status, 0);
    ASSERT_EQ(j["plan"], "AttackPlay") << r.output;
    EXPECT_EQ(j["utility"], *expected);
    EXPECT_EQ(j["optimal"], true);
    EXPECT_EQ(j["assignment"].size() + j["idle"].size(), u.size());
    double sum = 0;
    for (auto const& x : j["assignment"]) {
      auto const a = std::stoul(x["agent"].get<std::string>().substr(1)) - 1;
      for (std::size_t t = 0; t < tasks.size(); ++t)
        if (x["task"] == json(tasks[t].name)) sum += u[a][t].value();
    }
    EXPECT_EQ(sum, *expected) << "the assignment is worth what is said";
  }
  EXPECT_GT(none, 3);
  EXPECT_LT(none, 30);
}

}  // namespace allocate_test
}  // namespace rota::test
