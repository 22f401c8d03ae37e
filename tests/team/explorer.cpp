// The explorer: every interleaving of a few robots, and long random ones. docs/testing.md says what it does.
#include "explorer/search.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace explorer_test {

namespace {

using explorer::act;
using explorer::search;
using explorer::setting;

/// Sanitizers and builds without optimisation visit fewer.
#ifdef __OPTIMIZE__
constexpr std::uint64_t states_of_a_search = 22600, walks_of_a_setting = 100;
#else
constexpr std::uint64_t states_of_a_search = 500, walks_of_a_setting = 10;
#endif

/// ROTA_EXPLORE multiplies the states that are visited.
std::uint64_t times() {
  char const* const text = std::getenv("ROTA_EXPLORE");
  return text ? std::strtoull(text, nullptr, 10) : 1;
}

/// Searches from each beginning, then walks.
struct exploration : playground {
  void explore(setting const& s) {
    std::uint64_t states = 0, ruled = 0, robots = 0, compared = 0;
    std::string depths;
    auto const add = [&](search const& x) {
      states += x.states(), ruled += x.ruled();
      robots += x.all_minds().met(), compared += x.all_minds().compared();
    };
    for (auto const from : explorer::beginnings) {
      search x(s, from, *this);
      auto const f = x.run(states_of_a_search * times());
      if (f) {
        ADD_FAILURE() << x.script(*f);
      }
      depths += ' ' + std::to_string(x.depth());
      add(x);
    }
    search x(s, explorer::beginning::fresh, *this);
    auto const f = x.walk(walks_of_a_setting * times(), 150, 1);
    if (f) {
      ADD_FAILURE() << x.script(*f);
    }
    add(x);
    EXPECT_GT(ruled, states / 10);
    EXPECT_GT(compared, 0u);
    RecordProperty("states", std::to_string(states));
    std::printf("  %llu states, breadth first to depths%s, %llu of them ruled; %llu states of robots, %llu compared\n",
                static_cast<unsigned long long>(states), depths.c_str(), static_cast<unsigned long long>(ruled),
                static_cast<unsigned long long>(robots), static_cast<unsigned long long>(compared));
  }
};

TEST_F(exploration, loss_breaks_nothing) { explore({.name = "loss", .acts = {act::lose}}); }
TEST_F(exploration, duplicates_break_nothing) { explore({.name = "duplicates", .acts = {act::duplicate, act::lose}}); }
TEST_F(exploration, leaving_and_entering_break_nothing) {
  explore({.name = "leaving", .robots = 3, .acts = {act::leave, act::enter}});
}
TEST_F(exploration, restarts_break_nothing) { explore({.name = "restarts", .robots = 3, .acts = {act::restart}}); }
TEST_F(exploration, a_same_or_smaller_incarnation_breaks_nothing_for_long) {
  explore({.name = "same or smaller incarnation", .acts = {act::restart_same, act::restart_less}, .rounds = 42});
}
TEST_F(exploration, crashes_break_nothing) {
  explore({.name = "crashes", .robots = 3, .acts = {act::crash, act::lose, act::restart}, .rounds = 22});
}
TEST_F(exploration, confidence_breaks_nothing) {
  explore({.name = "confidence", .robots = 3, .acts = {act::confident, act::leave, act::enter}, .troubles = 2});
}
TEST_F(exploration, blindness_breaks_nothing) { explore({.name = "blindness", .robots = 3, .acts = {act::blind}}); }
TEST_F(exploration, who_sees_the_same_agrees) {
  explore({.name = "agreeing", .robots = 3, .acts = {act::lose, act::leave, act::enter}, .agree = true, .rounds = 14});
}
TEST_F(exploration, two_types_do_not_disturb_each_other) {
  explore({.name = "two types", .acts = {act::lose, act::leave, act::enter}, .types = 2});
}

}  // namespace

}  // namespace explorer_test
