#include "sandbox.hpp"

#include <gtest/gtest.h>

#include <map>

namespace rota::test {
namespace alica_real_files_test {

constexpr auto no_limit = cardinality::unbounded;

struct pinned_task {
  std::string name;
  cardinality bounds;
};
struct pinned_file {
  std::string file;
  alica::file_status status;
  std::string name;
  std::vector<pinned_task> tasks;  ///< of a plan, in the order of entry points
  cardinality team;
};

using enum alica::file_status;

// What is in ALICA's own files, pinned: all that holds a plan, plan type, task or role, and what becomes of the rest.
std::vector<pinned_file> const& table() {
  static std::string const msl = "dasys-lab__cnc-msl/etc/";
  static std::string const tests = "rapyuta-robotics__alica/alica_tests/etc/";
  static std::string const more = "rapyuta-robotics__alica/supplementary/";
  static std::vector<pinned_file> const all = {
      {"LICENSE.cnc-msl", ignored, "", {}, {}},
      {"LICENSE.cnc-turtlebots", ignored, "", {}, {}},
      {"LICENSE.engine", ignored, "", {}, {}},
      {"MANIFEST.md", ignored, "", {}, {}},
      {msl + "Alica.conf", ignored, "", {}, {}},
      {msl + "Misc/taskrepository.tsk", loaded, "", {}, {}},
      {msl + "plans/Attack/AdvancdeSimplePass.beh", listed, "AdvancdeSimplePass", {}, {}},
      {msl + "plans/Attack/AttackPlay.pml",
       loaded,
       "AttackPlay",
       {{"Attack", {1, 1}}, {"Block", {0, 1}}, {"Defend", {0, 1}}, {"ReceivePassInGame", {1, 1}}},
       {2, 4}},
      {msl + "plans/Attack/AttackPlay.pmlex", ignored, "", {}, {}},
      {msl + "plans/GameStrategy/Gameplay/GamePlayAttackType.pty", refused, "GamePlayAttackType", {}, {}},
      {msl + "plans/GenericStandards/GenericExecute.pml",
       loaded,
       "GenericExecute",
       {{"ExecuteStandard", {1, 1}}, {"ReceiveStandard", {1, 1}}, {"Block", {0, 1}}, {"Defend", {0, 1}}},
       {2, 4}},
      {msl + "plans/Standards/Own/FreeKick/FreeKick.pty", refused, "FreeKick", {}, {}},
      {msl + "plans/Standards/Own/FreeKick/FreekickOwnHalf.pml",
       loaded,
       "FreekickOwnHalf",
       {{"ExecuteStandard", {1, 1}}, {"ReceiveStandard", {1, 1}}, {"AlternativeReceive", {1, 1}}, {"Block", {0, 1}}},
       {3, 4}},
      {msl + "plans/Standards/Own/ThrowIn/ThrowIn.pty", refused, "ThrowIn", {}, {}},
      {msl + "plans/TestPlans/DribbleTestMOS/DriveZigZagViewStraight.pml",
       loaded,
       "DriveZigZagViewStraight",
       {{"DefaultTask", {0, no_limit}}},
       {0, no_limit}},
      {msl + "roles/Roleset.graph", ignored, "", {}, {}},
      {msl + "roles/rolesDefinition.rdefset", loaded, "", {}, {}},
      {"dasys-lab__cnc-turtlebots/etc/Misc/taskrepository.tsk", loaded, "", {}, {}},
      {tests + "behaviours/EmptyBehaviour.beh", listed, "EmptyBehaviour", {}, {}},
      {tests + "conditions/ConditionRepository.cnd", listed, "ConditionRepository", {}, {}},
      {tests + "hairy/Alica.yaml", ignored, "", {}, {}},
      {tests + "plans/Attack.pty", refused, "Attack", {}, {}},
      {tests + "plans/AuthorityTest.pml",
       loaded,
       "AuthorityTest",
       {{"DefaultTask", {1, 1}}, {"AttackTask", {1, 1}}},
       {}},
      {tests + "plans/AuthorityTestMaster.pml", loaded, "AuthorityTestMaster", {{"DefaultTask", {0, no_limit}}}, {}},
      {tests + "plans/GoalPlan.pml", loaded, "GoalPlan", {{"DefaultTask", {0, no_limit}}}, {}},
      {tests + "plans/MasterPlanTaskAssignment.pml",
       loaded,
       "MasterPlanTaskAssignment",
       {{"DefaultTask", {2, 5}},
        {"AttackTask", {0, 1000}},
        {"MidFieldTask", {0, no_limit}},
        {"DefendTask", {0, no_limit}}},
       {}},
      {tests + "plans/MasterSyncTransition.pml",
       loaded,
       "MasterSyncTransition",
       {{"AttackTask", {1, 10000}}, {"DefaultTask", {1, 10000}}},
       {}},
      {tests + "plans/MidFieldPlayPlan.pml",
       loaded,
       "MidFieldPlayPlan",
       {{"DefaultTask", {0, no_limit}}, {"DefaultTask", {3, 5}}},
       {}},
      {tests + "plans/MultiAgentTestPlan.pml",
       loaded,
       "MultiAgentTestPlan",
       {{"AttackTask", {1, 1}}, {"DefaultTask", {1, 1}}, {"DefaultTask", {0, no_limit}}},
       {}},
      {tests + "plans/PlanType.pty", refused, "PlanType", {}, {}},
      {tests + "plans/PreConditionPlan.pml", loaded, "PreConditionPlan", {{"DefaultTask", {0, no_limit}}}, {}},
      {tests + "plans/RuntimeConditionPlan.pml", loaded, "RuntimeConditionPlan", {{"DefaultTask", {0, no_limit}}}, {}},
      {tests + "plans/SimpleTestPlan.pml", loaded, "SimpleTestPlan", {{"DefaultTask", {0, no_limit}}}, {}},
      {tests + "plans/StandardLibraryCompareConditionsPlan.pml",
       loaded,
       "StandardLibraryCompareConditionsPlan",
       {{"DefaultTask", {0, no_limit}}},
       {}},
      {tests + "roles/Roleset.rst", loaded, "Roleset", {}, {}},
      {tests + "roles/RolesetTA.rst", loaded, "RolesetTA", {}, {}},
      {tests + "tasks/taskrepository.tsk", loaded, "taskrepository", {}, {}},
      {more + "alica_ros1/supplementary_tests/src/test/etc/plans/QueryPlantype.pty", refused, "QueryPlantype", {}, {}},
      {more + "alica_turtlesim/etc/plans/FourCorners.pml", refused, "FourCorners", {}, {}},
  };
  return all;
}

class alica_real_files : public testing::Test {
protected:
  void SetUp() override {
    if (!fs::exists(real_files()))
      GTEST_SKIP() << "no folder " << real_files() << ": ROTA_ALICA_DATA names another place";
    model_ = load(real_files());
  }
  static std::string short_name(std::string const& file) {
    return fs::path(file).lexically_relative(real_files()).generic_string();
  }
  alica::model model_;
};

TEST_F(alica_real_files, every_file_is_as_pinned) {
  std::map<std::string, alica::document> documents;
  for (auto const& d : model_.documents) documents[short_name(d.file)] = d;
  EXPECT_EQ(documents.size(), table().size());
  std::size_t plans = 0;
  for (auto const& pinned : table()) {
    SCOPED_TRACE(pinned.file);
    ASSERT_TRUE(documents.contains(pinned.file));
    auto const& d = documents[pinned.file];
    EXPECT_EQ(to_string(d.status), to_string(pinned.status));
    EXPECT_EQ(d.name, pinned.name);
    EXPECT_FALSE(d.followed);
    bool const loaded_plan = d.kind == alica::file_kind::plan && d.status == loaded;
    plans += loaded_plan;
    for (auto const& p : model_.plans) {
      if (p.file != d.file) continue;
      EXPECT_TRUE(loaded_plan);
      EXPECT_EQ(p.team_size, pinned.team);
      ASSERT_EQ(p.entry_points.size(), pinned.tasks.size());
      for (std::size_t i = 0; i < p.entry_points.size(); ++i) {
        EXPECT_EQ(p.entry_points[i].task_name, pinned.tasks[i].name);
        EXPECT_EQ(p.entry_points[i].bounds, pinned.tasks[i].bounds);
        EXPECT_NE(p.entry_points[i].state, 0u);
      }
    }
    bool const has_error = std::any_of(model_.diagnostics.begin(), model_.diagnostics.end(), [&](auto const& x) {
      return x.file == d.file && x.severity == alica::severity::error;
    });
    EXPECT_EQ(has_error, pinned.status == refused);
    bool const is_ignored = std::any_of(model_.diagnostics.begin(), model_.diagnostics.end(), [&](auto const& x) {
      return x.file == d.file && x.severity == alica::severity::ignored;
    });
    EXPECT_EQ(is_ignored, pinned.status == ignored);
  }
  EXPECT_EQ(model_.plans.size(), plans);
  EXPECT_EQ(model_.plans.size(), 15u);
  EXPECT_EQ(model_.tasks.size(), 82u);
  EXPECT_EQ(model_.roles.size(), 17u);
}

TEST_F(alica_real_files, what_is_refused_misses_a_plan_or_a_task) {
  std::map<std::string, std::vector<std::string>> reasons;
  for (auto const& d : only(model_, alica::severity::error)) reasons[fs::path(d.file).filename()].push_back(d.reason);
  auto const missing = [](std::string const& what) { return "the " + what + " is not found: there is no such file"; };
  std::map<std::string, std::vector<std::string>> const expected = {
      {"Attack.pty", {missing("plan AttackPlan.pml#1402488634525"), missing("plan Tackle.pml#1402489318663")}},
      {"FourCorners.pml", {missing("task TaskRepository.tsk#3310236980587704776")}},
      {"FreeKick.pty", {missing("plan OwnFreeKickInOppHalf.pml#1464531946023")}},
      {"GamePlayAttackType.pty", {missing("plan ../../Attack/StandardAttack.pml#1434046634656")}},
      {"PlanType.pty", {missing("plan AttackPlan.pml#1402488634525")}},
      {"QueryPlantype.pty", {missing("plan QueryPlan1.pml#1479556074049")}},
      {"ThrowIn.pty",
       {missing("plan ThrowInNearGoal.pml#1461237603689"), missing("plan ThrowInOwnHalf.pml#1462360503828")}},
  };
  EXPECT_EQ(reasons, expected);
}

TEST_F(alica_real_files, attack_play_lacks_sixteen_files_and_loads) {
  auto const m = load(real_files() / "dasys-lab__cnc-msl/etc/plans/Attack/AttackPlay.pml");
  EXPECT_EQ(errors_of(m), "");
  EXPECT_EQ(only(m, alica::severity::warning).size(), 16u);
  ASSERT_EQ(m.plans.size(), 1u);
  EXPECT_EQ(m.plans[0].id, 1434045709191u);
  EXPECT_EQ(m.plans[0].utility_threshold, 1e-7);
  EXPECT_EQ(m.documents.size(), 2u) << "its task repository was found on disk";
}

TEST_F(alica_real_files, two_roots_share_seven_task_ids) {
  std::map<alica::identity, std::size_t> roots;
  for (auto const& t : model_.tasks) ++roots[t.id];
  EXPECT_EQ(std::count_if(roots.begin(), roots.end(), [](auto const& x) { return x.second == 2; }), 7);
}

// ALICA's sixth defect, on its own role files.
TEST_F(alica_real_files, default_priority_is_honoured) {
  std::size_t seen = 0;
  for (auto const& r : model_.roles) {
    if (!r.file.ends_with(".rst")) continue;
    ++seen;
    EXPECT_EQ(r.default_priority, 0.5) << r.file;
    EXPECT_EQ(alica::to_role(model_, r).priority({1225115406909}), 0.5) << "a task that no role lists";
  }
  EXPECT_EQ(seen, 12u);
}

TEST_F(alica_real_files, a_precondition_is_kept_as_text) {
  for (auto const& p : model_.plans) {
    if (p.name == "PreConditionPlan") {
      EXPECT_EQ(p.precondition, "Test");
    } else if (p.name == "GoalPlan") {
      EXPECT_EQ(p.precondition, "");
    } else if (p.name == "AttackPlay") {
      EXPECT_EQ(p.precondition, std::nullopt);
    }
  }
}

}  // namespace alica_real_files_test
}  // namespace rota::test
