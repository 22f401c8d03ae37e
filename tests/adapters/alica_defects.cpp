#include "sandbox.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sys/stat.h>

namespace rota::test {
namespace alica_defects_test {

std::string const tasks = R"({"id": 1, "tasks": [{"id": 2, "name": "A"}, {"id": 3, "name": "B"}]})";
std::string const sound = R"({"id": 90, "name": "Sound", "entryPoints": [
  {"id": 91, "task": "t.tsk#2", "minCardinality": 0, "maxCardinality": 1}]})";
std::string const sound_xml =
    R"(<?xml version="1.0" encoding="ASCII"?><a:Plan id="90" name="Sound"><entryPoints id="91" minCardinality="0" )"
    R"(maxCardinality="1"><task>t.tsk#2</task></entryPoints></a:Plan>)";

/// A plan whose only entry point has these fields.
std::string plan_with(std::string const& entry, std::string const& more = "") {
  return R"({"id": 10, "name": "Broken")" + more + R"(, "entryPoints": [{"id": 11, )" + entry + "}]}";
}
std::string xml_plan_with(std::string const& entry, std::string const& more = "") {
  return "<a:Plan id=\"10\" " + more + "><entryPoints id=\"11\" " + entry + "</entryPoints></a:Plan>";
}
std::string repeated(std::string const& s, std::size_t n) {
  std::string out;
  for (std::size_t i = 0; i < n; ++i) out += s;
  return out;
}

struct defect {
  std::string name;
  std::string file;
  std::string bytes;
  std::string reason;                      ///< part of what must be said
  std::optional<alica::identity> id = {};  ///< that must be named
};

void PrintTo(defect const& d, std::ostream* out) { *out << d.name; }

std::vector<defect> const& defects() {
  static std::string const bounds = R"("minCardinality": 0, "maxCardinality": 1)";
  static std::string const to_a = R"("task": "t.tsk#2", )";
  static std::string const xml_task = "<task>t.tsk#2</task>";
  static std::vector<defect> const all = {
      {"empty", "x.pml", "", "empty"},
      {"blank", "x.pml", " \n\t", "empty"},
      {"only_a_byte_order_mark", "x.pml", "\xEF\xBB\xBF", "empty"},
      {"neither_format", "x.pml", "plan: 1", "neither JSON nor XML"},
      {"cut_off_json", "x.pml", sound.substr(0, 60), "cut off"},
      {"cut_off_xml", "x.pml", sound_xml.substr(0, 120), "XML"},
      {"json_syntax", "x.pml", R"({"id": 10,, })", "no JSON"},
      {"json_trailing", "x.pml", sound + "}", "no JSON"},
      {"json_list", "x.pml", "[1, 2]", "no JSON object"},
      {"json_twice_the_key", "x.pml", R"({"id": 10, "id": 12})", "twice"},
      {"json_number_overflow", "x.pml", R"({"id": 10, "utilityThreshold": 1e999})", "no JSON"},
      {"json_nesting_bomb", "x.pml", repeated("[", 1'000'000), "nested deeper"},
      {"json_nested_objects", "x.pml", repeated(R"({"a":)", 100'000) + "1" + repeated("}", 100'000), "nested deeper"},
      {"json_too_many_values", "x.pml", "[0" + repeated(",0", 1'000'001) + "]", "more than 1000000 values"},
      {"xml_nesting_bomb", "x.pml", repeated("<a>", 400'000) + repeated("</a>", 400'000), "nested deeper"},
      {"xml_open_bomb", "x.pml", repeated("<a>", 900'000), "XML"},
      {"xml_too_many_elements", "x.pml", "<a>" + repeated("<b/>", 2'000'001) + "</a>", "more than 1000000 elements"},
      {"xml_two_roots", "x.pml", "<a:Plan id=\"10\"/><a:Plan id=\"12\"/>", "more than one root"},
      {"xml_doctype", "x.pml", "<!DOCTYPE a [<!ENTITY x \"y\">]>" + sound_xml.substr(38), "DOCTYPE"},
      {"xml_entity_bomb", "x.pml",
       "<!DOCTYPE l [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;\">]><a:Plan id=\"10\" name=\"&b;\"/>", "entity"},
      {"xml_external_entity", "x.pml", "<!DOCTYPE l [<!ENTITY a SYSTEM \"file:///etc/passwd\">]><a:Plan id=\"10\"/>",
       "DOCTYPE"},
      {"xml_unknown_entity", "x.pml", "<a:Plan id=\"10\" name=\"&ouml;\"/>", "entity"},
      {"xml_wrong_root", "x.pml", "<a:PlanType id=\"10\"/>", "root element"},
      {"xml_twice_the_attribute", "x.pml",
       xml_plan_with("minCardinality=\"0\" maxCardinality=\"1\">" + xml_task, "name=\"a\" name=\"b\""), "twice", 10},
      {"not_utf_8", "x.pml", "{\"id\": 10, \"name\": \"K\xFCr\"}", "not UTF-8"},
      {"utf_16", "x.pml", std::string("\xFF\xFE{\0}\0", 6), "not UTF-8"},
      {"nul_bytes", "x.pml", sound + std::string("\0", 1), "not UTF-8"},
      {"no_id", "x.pml", R"({"name": "n"})", "has no id"},
      {"id_a_text", "x.pml", R"({"id": "10"})", "id is \"10\""},
      {"id_negative", "x.pml", R"({"id": -10})", "id is -10"},
      {"id_fractional", "x.pml", R"({"id": 10.5})", "id is 10.5"},
      {"id_huge", "x.pml", R"({"id": 99999999999999999999999})", "id is "},
      {"xml_id_huge", "x.pml", "<a:Plan id=\"99999999999999999999999\"/>", "id is "},
      {"name_a_number", "x.pml", R"({"id": 10, "name": 7, "entryPoints": [{"id": 11, )" + to_a + bounds + "}]}",
       "name is 7", 10},
      {"no_entry_point", "x.pml", R"({"id": 10, "entryPoints": []})", "no entry point", 10},
      {"entry_points_an_object", "x.pml", R"({"id": 10, "entryPoints": {}})", "not a list", 10},
      {"entry_point_a_number", "x.pml", R"({"id": 10, "entryPoints": [7]})", "entry 0 is no object", 10},
      {"min_above_max", "x.pml", plan_with(to_a + R"("minCardinality": 3, "maxCardinality": 2)"),
       "minCardinality 3 is above maxCardinality 2", 11},
      {"xml_min_above_max", "x.pml", xml_plan_with("minCardinality=\"3\" maxCardinality=\"2\">" + xml_task),
       "minCardinality 3 is above maxCardinality 2", 11},
      {"team_min_above_max", "x.pml", plan_with(to_a + bounds, R"(, "minCardinality": 4, "maxCardinality": 2)"),
       "minCardinality 4 is above maxCardinality 2", 10},
      {"min_negative", "x.pml", plan_with(to_a + R"("minCardinality": -1, "maxCardinality": 2)"),
       "minCardinality is -1", 11},
      {"max_negative", "x.pml", plan_with(to_a + R"("minCardinality": 0, "maxCardinality": -1)"),
       "maxCardinality is -1", 11},
      {"max_fractional", "x.pml", plan_with(to_a + R"("minCardinality": 0, "maxCardinality": 1.5)"),
       "maxCardinality is 1.5", 11},
      {"max_huge", "x.pml", plan_with(to_a + R"("minCardinality": 0, "maxCardinality": 2147483648)"),
       "maxCardinality is 2147483648", 11},
      {"max_beyond_64_bits", "x.pml",
       plan_with(to_a + R"("minCardinality": 0, "maxCardinality": 18446744073709551617)"), "maxCardinality is ", 11},
      {"max_a_text", "x.pml", plan_with(to_a + R"("minCardinality": 0, "maxCardinality": "1")"),
       "maxCardinality is \"1\"", 11},
      {"max_a_list", "x.pml", plan_with(to_a + R"("minCardinality": 0, "maxCardinality": [1])"),
       "maxCardinality is a list", 11},
      {"xml_max_a_word", "x.pml", xml_plan_with("minCardinality=\"0\" maxCardinality=\"many\">" + xml_task),
       "maxCardinality is \"many\"", 11},
      {"xml_max_empty", "x.pml", xml_plan_with("minCardinality=\"0\" maxCardinality=\"\">" + xml_task),
       "maxCardinality is \"\"", 11},
      {"xml_max_negative", "x.pml", xml_plan_with("minCardinality=\"0\" maxCardinality=\"-1\">" + xml_task),
       "maxCardinality is \"-1\"", 11},
      {"threshold_negative", "x.pml", plan_with(to_a + bounds, R"(, "utilityThreshold": -0.1)"),
       "utilityThreshold is negative", 10},
      {"xml_threshold_nan", "x.pml",
       xml_plan_with("minCardinality=\"0\" maxCardinality=\"1\">" + xml_task, "utilityThreshold=\"nan\""),
       "utilityThreshold is \"nan\"", 10},
      {"precondition_a_text", "x.pml", plan_with(to_a + bounds, R"(, "preCondition": "yes")"),
       "preCondition is \"yes\"", 10},
      {"no_task", "x.pml", plan_with(bounds), "has no task", 11},
      {"task_no_reference", "x.pml", plan_with(R"("task": "Attack", )" + bounds), "no reference", 11},
      {"task_missing", "x.pml", plan_with(R"("task": "t.tsk#77", )" + bounds), "the task t.tsk#77 is not found", 11},
      {"task_file_missing", "x.pml", plan_with(R"("task": "gone.tsk#77", )" + bounds), "there is no such file", 11},
      {"task_elsewhere_bare", "x.pml", plan_with(R"("task": 77, )" + bounds), "the task #77 is not found", 11},
      {"task_is_a_plan", "x.pml", plan_with(R"("task": "sound.pml#90", )" + bounds), "is a plan, not a task", 11},
      {"task_twice_in_xml", "x.pml", xml_plan_with("minCardinality=\"0\" maxCardinality=\"1\">" + xml_task + xml_task),
       "task is there twice", 11},
      {"id_twice_in_a_file", "x.pml",
       R"({"id": 10, "entryPoints": [{"id": 11, "task": "t.tsk#2", "minCardinality": 0, "maxCardinality": 1},)"
       R"({"id": 11, "task": "t.tsk#3", "minCardinality": 0, "maxCardinality": 1}]})",
       "the id 11 stands twice", 11},
      {"id_of_another_file", "x.pml", plan_with(to_a + bounds).replace(7, 2, "90"), "the id 90 stands twice", 90},
      {"task_id_twice", "x.tsk", R"({"id": 30, "tasks": [{"id": 31, "name": "a"}, {"id": 31, "name": "b"}]})",
       "the id 31 stands twice", 31},
      {"tasks_a_number", "x.tsk", R"({"id": 30, "tasks": 5})", "tasks is 5, not a list", 30},
      {"task_without_id", "x.tsk", R"({"id": 30, "tasks": [{"name": "a"}]})", "the task has no id"},
      {"plan_missing", "x.pty",
       R"({"id": 40, "annotatedPlans": [{"id": 41, "activated": true, "plan": "gone.pml#77"}]})",
       "the plan gone.pml#77 is not found", 40},
      {"plan_twice", "x.pty", R"({"id": 40, "annotatedPlans": [{"plan": "sound.pml#90"}, {"plan": "sound.pml#90"}]})",
       "twice", 90},
      {"plan_type_of_nothing", "x.pty", R"({"id": 40, "annotatedPlans": []})", "no activated plan", 40},
      {"plan_type_all_off", "x.pty", R"({"id": 40, "annotatedPlans": [{"activated": false, "plan": "sound.pml#90"}]})",
       "no activated plan", 40},
      {"activated_a_text", "x.pty", R"({"id": 40, "annotatedPlans": [{"activated": "yes", "plan": "sound.pml#90"}]})",
       "activated is \"yes\"", 40},
      {"default_priority_a_text", "x.rst", R"({"id": 50, "defaultPriority": "high"})", "defaultPriority is \"high\"",
       50},
      {"priority_a_text", "x.rst", R"({"id": 50, "roles": [{"id": 51, "taskPriorities": {"t.tsk#2": "high"}}]})",
       "the priority is \"high\"", 51},
      {"priority_null", "x.rst", R"({"id": 50, "roles": [{"id": 51, "taskPriorities": {"t.tsk#2": null}}]})",
       "the priority is null", 51},
      {"priority_of_no_task", "x.rst", R"({"id": 50, "roles": [{"id": 51, "taskPriorities": {"Attack": 1}}]})",
       "refers to no task", 51},
      {"priority_of_missing_task", "x.rst", R"({"id": 50, "roles": [{"id": 51, "taskPriorities": {"t.tsk#77": 1}}]})",
       "the task t.tsk#77 is not found", 51},
      {"priority_twice", "x.rst", R"({"id": 50, "roles": [{"id": 51, "taskPriorities": {"t.tsk#2": 1, "#2": 2}}]})",
       "two priorities for the task 2", 51},
      {"xml_priority_missing", "x.rst",
       "<a:RoleSet id=\"50\"><mappings id=\"51\"><taskPriorities "
       "key=\"2\"/><role>d.rdefset#5</role></mappings></a:RoleSet>",
       "the priority is missing", 5},
      {"behaviour_cut_off", "x.beh", "{\"id\": 60", "cut off"},
      {"conditions_without_id", "x.cnd", "{}", "has no id"},
  };
  return all;
}

class alica_defects : public testing::TestWithParam<defect> {};

// One defect: one error that names the file, the id and the reason; the file refused whole, the others loaded.
TEST_P(alica_defects, is_one_clear_error) {
  auto const& d = GetParam();
  sandbox box;
  box.write("etc/t.tsk", tasks);
  box.write("etc/sound.pml", sound);
  auto const file = box.write("etc/" + d.file, d.bytes);
  auto const m = box.load();
  auto const errors = only(m, alica::severity::error);
  ASSERT_EQ(errors.size(), 1u) << errors_of(m);
  EXPECT_EQ(errors[0].file, file);
  EXPECT_NE(errors[0].reason.find(d.reason), std::string::npos) << errors[0].reason;
  EXPECT_TRUE(!d.id || errors[0].id == d.id) << errors[0].reason;
  EXPECT_LT(errors[0].reason.size(), 300u);
  EXPECT_LT(errors[0].place.size(), 150u);
  EXPECT_TRUE(!errors[0].place.empty() || d.reason == "empty") << "a place, where there is one";
  ASSERT_EQ(m.plans.size(), 1u);
  EXPECT_EQ(m.plans[0].name, "Sound");
  EXPECT_EQ(m.tasks.size(), 2u);
  EXPECT_TRUE(m.plan_types.empty());
  EXPECT_TRUE(m.roles.empty());
  for (auto const& x : m.documents)
    EXPECT_EQ(x.status, x.file == file ? alica::file_status::refused : alica::file_status::loaded) << x.file;
}

INSTANTIATE_TEST_SUITE_P(each, alica_defects, testing::ValuesIn(defects()),
                         [](auto const& each) { return each.param.name; });

TEST(alica_hostile, several_defects_are_several_errors) {
  sandbox box;
  box.write("etc/t.tsk", tasks);
  box.write("etc/x.pml", R"({"id": 10, "utilityThreshold": -1, "entryPoints": [
    {"id": 11, "task": "t.tsk#2", "minCardinality": 2, "maxCardinality": 1},
    {"id": 12, "task": "t.tsk#2", "minCardinality": -2, "maxCardinality": 1}]})");
  auto const m = box.load();
  EXPECT_EQ(only(m, alica::severity::error).size(), 3u) << errors_of(m);
}

TEST(alica_hostile, unknown_keys_are_tolerated) {
  sandbox box;
  box.write("etc/t.tsk", tasks);
  box.write("etc/a.pml", R"({"id": 10, "future": {"deep": [[[{"id": "x"}]]]}, "entryPoints": [
    {"id": 11, "task": "t.tsk#2", "minCardinality": 0, "maxCardinality": 1, "isDynamic": "perhaps"}]})");
  box.write("etc/b.pml", R"(<a:Plan id="20" future="1"><unknown id="x"><task>no</task></unknown>)"
                         R"(<entryPoints id="21" minCardinality="0" maxCardinality="1" new=""><task href="t.tsk#3"/>)"
                         R"(</entryPoints></a:Plan>)");
  auto const m = box.load();
  EXPECT_EQ(errors_of(m), "");
  EXPECT_EQ(m.plans.size(), 2u);
}

TEST(alica_hostile, a_refused_file_takes_with_it_what_needs_it_and_says_so) {
  sandbox box;
  box.write("etc/t.tsk", R"({"id": 1, "tasks": [{"id": 2, "name": 5}]})");
  box.write("etc/a.pml", sound);
  box.write("etc/b.pty", R"({"id": 20, "annotatedPlans": [{"plan": "a.pml#90"}]})");
  auto const m = box.load();
  auto const errors = only(m, alica::severity::error);
  ASSERT_EQ(errors.size(), 3u) << errors_of(m);
  EXPECT_NE(errors[0].reason.find("t.tsk was refused"), std::string::npos);
  EXPECT_NE(errors[1].reason.find("a.pml was refused"), std::string::npos);
  EXPECT_NE(errors[2].reason.find("name is 5"), std::string::npos);
  EXPECT_TRUE(m.plans.empty());
}

TEST(alica_hostile, of_two_files_with_one_id_the_later_name_is_refused) {
  for (bool const reverse : {false, true}) {
    sandbox box;
    box.write("etc/t.tsk", tasks);
    for (std::string const name : {reverse ? "b" : "a", reverse ? "a" : "b"}) box.write("etc/" + name + ".pml", sound);
    auto const m = box.load();
    auto const errors = only(m, alica::severity::error);
    ASSERT_EQ(errors.size(), 2u) << "the plan and its entry point\n" << errors_of(m);
    EXPECT_EQ(errors[0].file, box.path("etc/b.pml"));
    ASSERT_EQ(m.plans.size(), 1u);
    EXPECT_EQ(m.plans[0].file, box.path("etc/a.pml"));
  }
}

TEST(alica_hostile, what_is_no_file_is_one_error) {
  sandbox box;
  box.write("etc/t.tsk", tasks);
  box.write("etc/sound.pml", sound);
  auto const expect_one = [&](std::string const& name, std::string const& reason) {
    auto const m = box.load();
    auto const errors = only(m, alica::severity::error);
    ASSERT_EQ(errors.size(), 1u) << errors_of(m);
    EXPECT_EQ(errors[0].file, box.path(name));
    EXPECT_NE(errors[0].reason.find(reason), std::string::npos) << errors[0].reason;
    EXPECT_EQ(m.plans.size(), 1u);
    EXPECT_EQ(only(load(box.path(name)), alica::severity::error).size(), 1u) << "also when given alone";
    fs::remove_all(box.path(name));
  };
  fs::create_directory(box.path("etc/x.pml"));
  expect_one("etc/x.pml", "a folder with the name of a plan file");
  fs::create_symlink("y.pml", box.path("etc/x.pml"));
  expect_one("etc/x.pml", "a symbolic link to nothing");
  fs::create_symlink("x.pml", box.path("etc/x.pml"));
  expect_one("etc/x.pml", "cannot be reached");
  ASSERT_EQ(::mkfifo(box.path("etc/x.pml").c_str(), 0600), 0);
  expect_one("etc/x.pml", "not a regular file");
  if (::geteuid() != 0) {  // root may read anything
    box.write("etc/x.pml", sound);
    fs::permissions(box.path("etc/x.pml"), fs::perms::none);
    expect_one("etc/x.pml", "cannot be opened");
  }
  EXPECT_EQ(only(load(box.path("nowhere")), alica::severity::error).size(), 1u);
}

TEST(alica_hostile, links_to_folders_are_not_followed_and_links_to_files_are_read_once) {
  sandbox box;
  box.write("etc/t.tsk", tasks);
  box.write("etc/sound.pml", sound);
  fs::create_directory_symlink("..", box.path("etc/loop"));
  fs::create_symlink("sound.pml", box.path("etc/same.pml"));
  auto const m = box.load();
  EXPECT_EQ(errors_of(m), "");
  EXPECT_EQ(m.plans.size(), 1u);
  EXPECT_EQ(only(m, alica::severity::ignored).size(), 2u);
  EXPECT_EQ(m.documents.size(), 4u) << "every file is accounted for";
}

TEST(alica_hostile, limits_are_errors) {
  sandbox box;
  box.write("etc/t.tsk", tasks);
  box.write("etc/x.pml", sound + repeated(" ", 200));
  auto const reason = [&](alica::load_options const& limits) {
    auto const errors = only(box.load(limits), alica::severity::error);
    return errors.empty() ? std::string() : errors.front().reason;
  };
  EXPECT_EQ(reason({}), "");
  alica::load_options small;
  small.max_bytes = 200;
  EXPECT_EQ(reason(small), "larger than 200 bytes");
  small = {};
  small.max_depth = 2;
  EXPECT_NE(reason(small).find("nested deeper than 2"), std::string::npos);
  small = {};
  small.max_elements = 3;
  EXPECT_NE(reason(small).find("more than 3 values"), std::string::npos);
  small = {};
  small.max_entry_points = 0;
  EXPECT_EQ(reason(small), "more than 0 entry points");
  small = {};
  small.max_entries = 1;
  EXPECT_NE(reason(small).find("more than 1 files and folders"), std::string::npos);
}

TEST(alica_hostile, references_do_not_lead_to_files_of_other_kinds) {
  sandbox box;
  box.write("secret.txt", tasks);
  box.write("etc/x.pml", plan_with(R"("task": "../secret.txt#2", "minCardinality": 0, "maxCardinality": 1)"));
  auto const m = load(box.path("etc/x.pml"));
  EXPECT_EQ(only(m, alica::severity::error).size(), 1u);
  EXPECT_EQ(m.documents.size(), 1u);
}

// ALICA's JSON names files without their folders: a file of the same name answers for it, one of another name does not.
TEST(alica_hostile, a_reference_is_answered_by_a_file_of_that_name_only) {
  auto const plan = [](std::string const& file) {
    return plan_with("\"task\": \"" + file + R"(#2", "minCardinality": 0, "maxCardinality": 1)");
  };
  auto const reason = [&](std::string const& file) {
    sandbox box;
    box.write("etc/tasks/t.tsk", tasks);
    box.write("etc/tasks/other.tsk", R"({"id": 7, "tasks": [{"id": 8, "name": "C"}]})");
    auto const m = load(box.write("etc/plans/x.pml", plan(file)));
    auto const all = box.load();
    EXPECT_EQ(errors_of(all).empty(), errors_of(m).empty()) << "whether the file was given or found";
    auto const errors = only(all, alica::severity::error);
    return errors.empty() ? std::string() : errors.front().reason;
  };
  EXPECT_EQ(reason("t.tsk"), "");
  EXPECT_EQ(reason("../tasks/t.tsk"), "");
  EXPECT_EQ(reason("gone/t.tsk"), "");
  EXPECT_NE(reason("u.tsk").find("u.tsk#2 is not found: there is no such file; the id stands in "), std::string::npos);
  EXPECT_NE(reason("other.tsk").find("other.tsk#2 is not found; the id stands in "), std::string::npos);
  EXPECT_NE(reason("../tasks/other.tsk").find("other.tsk#2 is not found; the id stands"), std::string::npos);
}

TEST(alica_hostile, the_file_that_is_named_goes_before_its_namesake) {
  sandbox box;
  box.write("etc/plans/t.tsk", R"({"id": 1, "tasks": [{"id": 2, "name": "Near"}]})");
  auto const far = box.write("etc/tasks/t.tsk", R"({"id": 5, "tasks": [{"id": 6, "name": "Far"}]})");
  auto const m = load({box.write("etc/plans/x.pml", sound), far});
  EXPECT_EQ(errors_of(m), "");
  ASSERT_EQ(m.plans.size(), 1u);
  EXPECT_EQ(m.plans[0].entry_points[0].task_name, "Near");
}

TEST(alica_hostile, a_link_to_a_file_answers_by_either_name) {
  sandbox box;
  box.write("etc/real/tasks.tsk", tasks);
  fs::create_directories(box.path("etc/plans"));
  fs::create_symlink("../real/tasks.tsk", box.path("etc/plans/t.tsk"));
  auto const m = load(box.write("etc/plans/x.pml", sound));
  EXPECT_EQ(errors_of(m), "");
  EXPECT_EQ(m.plans.size(), 1u);
}

// The folder of a plan outside any `etc` may be anything, a home directory say: nothing below it is looked for.
TEST(alica_hostile, without_etc_only_the_named_file_is_read) {
  sandbox box;
  auto const plan = box.write("p/x.pml", sound);
  box.write("p/deep/t.tsk", tasks);
  auto const alone = only(load(plan), alica::severity::error);
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_NE(alone[0].reason.find("there is no such file"), std::string::npos);
  EXPECT_EQ(errors_of(load({plan, box.path("p/deep")})), "");
  box.write("p/t.tsk", R"({"id": 5, "tasks": [{"id": 2, "name": "A"}]})");
  EXPECT_EQ(errors_of(load(plan)), "");
}

TEST(alica_hostile, a_search_that_was_given_up_says_so) {
  sandbox box;
  auto const plan = box.write("etc/plans/x.pml", sound);
  for (int i = 0; i < 20; ++i) box.write("etc/other/" + std::to_string(i), "");
  alica::load_options small;
  small.max_entries = 10;
  auto const errors = only(load(plan, small), alica::severity::error);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].reason.find("given up, more than 10 files and folders"), std::string::npos) << errors[0].reason;
}

TEST(alica_hostile, no_path_gives_an_empty_model) { EXPECT_EQ(load(std::vector<fs::path>{}), alica::model{}); }

}  // namespace alica_defects_test
}  // namespace rota::test
