#include "sandbox.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace rota::test {
namespace alica_own_files_test {

/// The model without what tells the formats apart: file names and formats.
alica::model without_files(alica::model m) {
  m.diagnostics.clear();
  m.roots.clear();
  m.documents.clear();
  for (auto& x : m.plans) x.file.clear();
  for (auto& x : m.plan_types) x.file.clear();
  for (auto& x : m.tasks) x.file.clear();
  for (auto& x : m.roles) x.file.clear();
  return m;
}

TEST(alica_own_files, both_formats_load_to_the_same_model) {
  auto const json = load(own_files() / "json");
  auto const xml = load(own_files() / "xml");
  EXPECT_TRUE(json.diagnostics.empty()) << errors_of(json);
  EXPECT_TRUE(xml.diagnostics.empty()) << errors_of(xml);
  EXPECT_EQ(json.documents.size(), 5u);
  EXPECT_EQ(xml.documents.size(), 6u) << "the older format keeps role definitions in a file of their own";
  EXPECT_EQ(without_files(json), without_files(xml));
  for (auto const& d : json.documents) EXPECT_EQ(d.format, alica::file_format::json);
  for (auto const& d : xml.documents) EXPECT_EQ(d.format, alica::file_format::xml);
}

TEST(alica_own_files, hold_what_the_readme_says) {
  auto const m = load(own_files() / "json");
  ASSERT_EQ(m.plans.size(), 2u);
  auto const& play = m.plans[0];
  EXPECT_EQ(play.name, "SoccerPlay");
  EXPECT_EQ(play.team_size, (cardinality{2, 5}));
  EXPECT_EQ(play.utility_threshold, 0.1);
  EXPECT_EQ(play.precondition, std::nullopt);
  ASSERT_EQ(play.entry_points.size(), 3u);
  EXPECT_EQ(play.entry_points[0].task_name, "Attack");
  EXPECT_EQ(play.entry_points[0].bounds, (cardinality{1, 1}));
  EXPECT_EQ(play.entry_points[0].state_name, "GetBall");
  EXPECT_EQ(play.entry_points[1].bounds, (cardinality{1, 2}));
  EXPECT_EQ(play.entry_points[2].bounds, (cardinality{0, 2}));
  ASSERT_EQ(m.plan_types.size(), 1u);
  EXPECT_EQ(m.plan_types[0].plans.size(), 2u);
}

TEST(alica_own_files, a_plan_alone_finds_its_tasks_on_disk) {
  for (auto const* format : {"json", "xml"}) {
    auto const m = load(own_files() / format / "etc" / "plans" / "SoccerPlay.pml");
    EXPECT_TRUE(m.diagnostics.empty()) << errors_of(m);
    ASSERT_EQ(m.plans.size(), 1u);
    EXPECT_EQ(m.plans[0].entry_points[1].task_name, "Defend");
    ASSERT_EQ(m.documents.size(), 2u);
    EXPECT_EQ(std::count_if(m.documents.begin(), m.documents.end(), [](auto const& d) { return d.followed; }), 1);
  }
}

TEST(alica_own_files, a_plan_type_alone_finds_its_plans_and_their_tasks) {
  for (auto const* format : {"json", "xml"}) {
    auto const m = load(own_files() / format / "etc" / "plans" / "Soccer.pty");
    EXPECT_TRUE(m.diagnostics.empty()) << errors_of(m);
    EXPECT_EQ(m.plans.size(), 2u);
    EXPECT_EQ(m.documents.size(), 4u);
  }
}

TEST(alica_own_files, the_order_of_paths_and_repeated_paths_change_nothing) {
  auto const plans = own_files() / "json" / "etc" / "plans";
  std::vector<fs::path> paths{plans / "SoccerPlay.pml", plans / "SoccerPress.pml", plans / "Soccer.pty"};
  auto const there = load(paths);
  std::reverse(paths.begin(), paths.end());
  EXPECT_EQ(there, load(paths));
  paths.push_back(paths.front());
  EXPECT_EQ(there, load(paths));
}

TEST(alica_own_files, convert_to_plans_of_the_library) {
  using V = runtime_vocabulary;
  auto const m = load(own_files() / "xml");
  auto const factory = [](alica::plan const&) -> additive_utility<V, no_beliefs> {
    return [](V::agent, V::task, no_beliefs const&) { return 1.0; };
  };
  auto const type = alica::to_plan_type(m, m.plan_types[0], factory);
  ASSERT_TRUE(type.has_value());
  ASSERT_EQ(type->plans().size(), 2u);
  auto const& play = type->plans()[0];
  EXPECT_EQ(play.id(), V::plan{m.plans[0].id});
  EXPECT_EQ(play.team_size(), (cardinality{2, 5}));
  EXPECT_EQ(play.hysteresis(), 0.1);
  auto const& attack = m.plans[0].entry_points[0];
  auto const* t = play.find({attack.task});
  ASSERT_NE(t, nullptr);
  EXPECT_EQ(t->bounds, attack.bounds);
  EXPECT_EQ(t->entry, V::state{attack.state});

  ASSERT_EQ(m.roles.size(), 2u);
  auto const keeper = alica::to_role(m, m.roles[1]);
  EXPECT_EQ(m.roles[1].name, "Keeper");
  EXPECT_FALSE(keeper.permits({attack.task})) << "a negative priority forbids";
  EXPECT_EQ(keeper.priority({m.plans[0].entry_points[1].task}), 1.0);

  auto const nothing =
      alica::to_plan_type(m.plans[0], [](alica::plan const&) { return additive_utility<V, no_beliefs>{}; });
  ASSERT_FALSE(nothing.has_value());
  EXPECT_EQ(nothing.error().plan, m.plans[0].id);
}

// ALICA's sixth defect: files write `defaultPriority`, its reader looks for `priorityDefault`, the default is 0.
TEST(alica_own_files, default_priority_is_honoured) {
  auto const m = load(own_files() / "json");
  ASSERT_EQ(m.roles.size(), 2u);
  EXPECT_EQ(m.roles[0].default_priority, 0.5);
  auto const field_player = alica::to_role(m, m.roles[0]);
  EXPECT_EQ(field_player.priority({m.tasks[2].id}), 0.5);

  sandbox box;
  box.write("etc/a.rst", R"({"id": 1, "priorityDefault": 7, "defaultPriority": -1, "roles": [{"id": 2}]})");
  auto const strict = box.load();
  ASSERT_EQ(strict.roles.size(), 1u) << errors_of(strict);
  EXPECT_EQ(strict.roles[0].default_priority, -1);
  EXPECT_FALSE(alica::to_role(strict, strict.roles[0]).permits({5})) << "a negative default forbids every other task";
}

TEST(alica_own_files, one_task_at_several_entry_points_keeps_them_apart) {
  sandbox box;
  box.write("etc/t.tsk", R"({"id": 1, "tasks": [{"id": 2, "name": "Move"}, {"id": 3, "name": "Watch"}]})");
  box.write("etc/r.rst", R"({"id": 4, "roles": [{"id": 5, "taskPriorities": {"t.tsk#2": -1}}]})");
  box.write("etc/p.pml", R"({"id": 10, "name": "P", "entryPoints": [
    {"id": 11, "name": "Left", "task": "t.tsk#2", "minCardinality": 0, "maxCardinality": 1},
    {"id": 12, "name": "MISSING_NAME", "task": "t.tsk#2", "minCardinality": 1, "maxCardinality": 2147483647},
    {"id": 13, "name": "Watch", "task": "t.tsk#3", "minCardinality": 0, "maxCardinality": 1000}]})");
  auto const m = box.load();
  ASSERT_EQ(m.plans.size(), 1u) << errors_of(m);
  auto const& p = m.plans[0];
  EXPECT_EQ(label(p, p.entry_points[0]), "Left");
  EXPECT_EQ(label(p, p.entry_points[1]), "Move#12");
  EXPECT_EQ(label(p, p.entry_points[2]), "Watch");
  EXPECT_EQ(alica::task_key(p, p.entry_points[0]).value, 11u);
  EXPECT_EQ(alica::task_key(p, p.entry_points[1]).value, 12u);
  EXPECT_EQ(alica::task_key(p, p.entry_points[2]).value, 3u);
  EXPECT_FALSE(p.entry_points[1].bounds.is_bounded()) << "2147483647 means no limit";
  EXPECT_EQ(p.entry_points[2].bounds, (cardinality{0, 1000})) << "1000 is kept as it is";
  auto const role = alica::to_role(m, m.roles[0]);
  EXPECT_FALSE(role.permits({11}));
  EXPECT_FALSE(role.permits({12}));
  EXPECT_TRUE(role.permits({3}));
}

TEST(alica_own_files, preconditions_are_kept_as_text) {
  sandbox box;
  box.write("etc/t.tsk", R"({"id": 1, "tasks": [{"id": 2, "name": "A"}]})");
  auto const plan = [](int id, std::string const& pre) {
    return R"({"id": )" + std::to_string(id) + R"(, "preCondition": )" + pre + R"(, "entryPoints": [{"id": )" +
           std::to_string(id + 1) + R"(, "task": "t.tsk#2"}]})";
  };
  box.write("etc/a.pml", plan(10, R"({"conditionString": "ball near", "enabled": true})"));
  box.write("etc/b.pml", plan(20, R"({"conditionString": "ball near", "enabled": false})"));
  box.write("etc/c.pml", plan(30, R"({"conditionString": ""})"));
  auto const m = box.load();
  ASSERT_EQ(m.plans.size(), 3u) << errors_of(m);
  EXPECT_EQ(m.plans[0].precondition, "ball near");
  EXPECT_EQ(m.plans[1].precondition, std::nullopt);
  EXPECT_EQ(m.plans[2].precondition, "");
  EXPECT_EQ(only(m, alica::severity::warning).size(), 6u) << "a cardinality left out is warned of";
}

TEST(alica_own_files, an_inactive_plan_is_no_choice_and_may_be_missing) {
  sandbox box;
  box.write("etc/t.tsk", R"({"id": 1, "tasks": [{"id": 2, "name": "A"}]})");
  box.write("etc/p.pml", R"({"id": 10, "entryPoints": [
    {"id": 11, "task": "t.tsk#2", "minCardinality": 0, "maxCardinality": 1}]})");
  box.write("etc/pt.pty", R"({"id": 20, "annotatedPlans": [
    {"id": 21, "plan": "p.pml#10"}, {"id": 22, "activated": false, "plan": "gone.pml#99"}]})");
  auto const m = box.load();
  EXPECT_EQ(errors_of(m), "");
  ASSERT_EQ(m.plan_types.size(), 1u);
  EXPECT_EQ(only(m, alica::severity::warning).size(), 1u);
  auto const type = alica::to_plan_type(m, m.plan_types[0], [](alica::plan const&) {
    return additive_utility<runtime_vocabulary, no_beliefs>(
        [](auto, auto, no_beliefs const&) { return std::optional<double>(1.0); });
  });
  ASSERT_TRUE(type.has_value());
  EXPECT_EQ(type->plans().size(), 1u);
}

TEST(alica_own_files, ids_are_unique_per_root_only) {
  sandbox box;
  for (std::string const root : {"one/etc/", "two/etc/"}) {
    box.write(root + "t.tsk", R"({"id": 1, "tasks": [{"id": 2, "name": "T of )" + root + R"("}]})");
    box.write(root + "plans/p.pml", R"({"id": 10, "entryPoints": [
      {"id": 11, "task": "t.tsk#2", "minCardinality": 0, "maxCardinality": 1}]})");
  }
  auto const m = box.load();
  EXPECT_EQ(errors_of(m), "");
  ASSERT_EQ(m.plans.size(), 2u);
  EXPECT_EQ(m.roots.size(), 2u);
  EXPECT_EQ(m.plans[0].entry_points[0].task_name, "T of one/etc/");
  EXPECT_EQ(m.plans[1].entry_points[0].task_name, "T of two/etc/");
}

}  // namespace alica_own_files_test
}  // namespace rota::test
