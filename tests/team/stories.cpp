// The protocol's main stories, which a person can read: stories/*.txt. See docs/testing.md.
#include "explorer/search.hpp"
#include "stories/story.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

namespace stories_test {

namespace {

struct stories : playground {
  /// Plays the story that has the name of the test.
  void play_it() {
    std::ifstream in(std::string(ROTA_SOURCE_DIR "/tests/team/stories/") +
                     testing::UnitTest::GetInstance()->current_test_info()->name() + ".txt");
    ASSERT_TRUE(in);
    EXPECT_EQ(::stories::story(*this).play(in), "");
  }
  std::string play_text(std::string const& text) {
    std::istringstream in(text);
    return ::stories::story(*this).play(in);
  }
};

TEST_F(stories, a_conflict_that_heals) { play_it(); }
TEST_F(stories, a_loop_its_detection_authority_and_end) { play_it(); }
TEST_F(stories, two_claimants) { play_it(); }
TEST_F(stories, a_leader_dies) { play_it(); }
TEST_F(stories, a_leader_restarts) { play_it(); }
TEST_F(stories, a_robot_joins_under_authority) { play_it(); }
TEST_F(stories, a_lost_claim_is_repeated) { play_it(); }
TEST_F(stories, a_late_duplicate) { play_it(); }
TEST_F(stories, a_blind_robot_abstains) { play_it(); }
TEST_F(stories, a_robot_that_abstains_is_needed) { play_it(); }
TEST_F(stories, a_reign_lasts_as_long_as_its_cause) { play_it(); }
TEST_F(stories, a_renewal_is_a_new_election) { play_it(); }
TEST_F(stories, a_partition_heals) { play_it(); }
TEST_F(stories, a_relay_on_a_line) { play_it(); }
TEST_F(stories, a_clock_is_set_back) { play_it(); }

TEST_F(stories, each_file_is_a_test) {
  std::set<std::string> files, tests;
  for (auto const& file : std::filesystem::directory_iterator(ROTA_SOURCE_DIR "/tests/team/stories"))
    if (file.path().extension() == ".txt") files.insert(file.path().stem());
  auto const& all = *testing::UnitTest::GetInstance()->current_test_suite();
  for (int i = 0; i < all.total_test_count(); ++i) tests.insert(all.GetTestInfo(i)->name());
  for (auto const& name : files) EXPECT_TRUE(tests.count(name)) << name;
  EXPECT_GE(files.size(), 12u);
}

TEST_F(stories, a_story_that_is_not_so_names_its_line) {
  std::string const told = "robots 2\nat 0 ms: everybody enters\n\nat 30 ms: 1 deliberates; expect 1 attacks\n";
  EXPECT_EQ(play_text(told), "");
  EXPECT_EQ(play_text(told + "expect 1 defends\n"), "line 5: expect 1 defends: 1 attacks");
  EXPECT_EQ(play_text(told + "expect 2 leads"), "line 5: expect 2 leads: 2 is free");
  EXPECT_EQ(play_text(told + "at 20 ms: 1 leaves"), "line 5: at 20 ms: 1 leaves: time goes forward");
  EXPECT_EQ(play_text(told + "2 hears message 1 of 1"), "line 5: 2 hears message 1 of 1: no such message was said");
  EXPECT_EQ(play_text(told + "3 leaves"), "line 5: 3 leaves: there is no such robot");
  EXPECT_EQ(play_text(told + "1 dances"), "line 5: 1 dances: no such sentence");
  std::pair<char const*, char const*> const empty[] = {
      {"2 hears 1", "there is nothing that it has not heard"},
      {"2 never hears 1", "there is nothing that it has not heard"},
      {"1 speaks\n1 and 2 are out of range\n2 hears 1", "it is out of range"},
      {"1 and 7 are out of range", "there is no such robot"},
      {"2 dies\n2 speaks", "it is dead"},
      {"2 dies\n1 speaks\n2 hears 1", "it is dead"},
      {"cycles 2", "the robots have their options already"},
      {"robots 3", "the robots have their options already"},
      {"until 55 ms: all think, speak and hear", "it goes on in steps of 10 ms"},
      {"cycles 99999999999", "no such sentence"}};
  for (auto const& [line, why] : empty) {
    auto const said = play_text(told + line);
    EXPECT_TRUE(said.ends_with(std::string(": ") + why)) << line << ": " << said;
  }
  EXPECT_EQ(play_text("expect everybody is free"), "line 1: expect everybody is free: there are no robots yet");
  EXPECT_EQ(play_text(told + "expect everybody agrees"), "line 5: expect everybody agrees: they do not");
}

/// What the explorer prints is a story, and playing it brings the robots to where they were.
TEST_F(stories, what_the_explorer_prints_is_a_story) {
  using explorer::act;
  std::uint64_t told = 0;
  std::vector<explorer::setting> const settings{
      {.name = "three",
       .robots = 3,
       .acts = {act::lose, act::duplicate, act::leave, act::enter, act::crash, act::restart}},
      {.name = "two", .acts = {act::restart_same, act::restart_less, act::blind, act::confident}, .troubles = 2},
      {.name = "two types", .acts = {act::lose, act::leave, act::enter, act::blind}, .types = 2},
      {.name = "agreeing", .acts = {act::lose}, .agree = true}};
  for (auto const& s : settings)
    for (auto const from : explorer::beginnings) {
      explorer::search x(s, from, *this);
      for (std::uint64_t seed = 1; seed <= 3; ++seed)
        for (int settled = -1; settled < 3; ++settled) {
          explorer::fault const way{"nothing", x.any_way(80, seed), settled};
          std::array<std::uint64_t, explorer::most_robots> digests{};
          auto const script = x.script(way, [&](explorer::world const& w) {
            for (std::size_t i = 0; i < w.size(); ++i) digests[i] = w.alive(i) ? x.digest_of(w, i) : 0;
          });
          std::istringstream in(script);
          ::stories::story played(*this);
          ASSERT_EQ(played.play(in), "") << script;
          for (std::size_t i = 0; i < digests.size(); ++i)
            if (digests[i] != 0) {
              ++told;
              ASSERT_EQ(played.digest(static_cast<int>(i) + 1), digests[i]) << script;
            }
        }
    }
  EXPECT_GT(told, 100u);
}

/// `ROTA_STORY=FILE test_team --gtest_filter=stories.of_the_environment`: what an explorer has printed.
TEST_F(stories, of_the_environment) {
  char const* const file = std::getenv("ROTA_STORY");
  if (!file) return;
  std::ifstream in(file);
  ASSERT_TRUE(in) << file;
  EXPECT_EQ(::stories::story(*this).play(in), "");
}

}  // namespace

}  // namespace stories_test
