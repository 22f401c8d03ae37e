// The explorer: every interleaving of a few robots, and long random ones. See explorer.hpp.
#include "explorer.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace explorer_test {

namespace {

using explorer::act;
using explorer::search;
using explorer::setting;

struct exploration : playground {};

/// Sanitizers and builds without optimisation visit fewer.
#ifdef __OPTIMIZE__
constexpr std::uint64_t states_of_a_setting = 20000, walks_of_a_setting = 100;
#else
constexpr std::uint64_t states_of_a_setting = 1000, walks_of_a_setting = 10;
#endif

/// ROTA_EXPLORE multiplies the states that are visited.
std::uint64_t times() {
  char const* const text = std::getenv("ROTA_EXPLORE");
  return text ? std::strtoull(text, nullptr, 10) : 1;
}

std::vector<setting> settings() {
  return {{.name = "loss", .robots = 2, .acts = {act::lose}},
          {.name = "duplicates", .robots = 2, .acts = {act::duplicate, act::lose}},
          {.name = "leaving", .robots = 3, .acts = {act::leave, act::enter}},
          {.name = "restarts", .robots = 3, .acts = {act::restart}},
          {.name = "same or smaller incarnation",
           .robots = 2,
           .acts = {act::restart_same, act::restart_less},
           .rounds = 70},
          {.name = "confidence", .robots = 3, .acts = {act::confident}},
          {.name = "blindness", .robots = 3, .acts = {act::blind}},
          {.name = "agreeing", .robots = 3, .acts = {act::lose, act::leave, act::enter}, .agree = true}};
}

TEST_F(exploration, no_short_interleaving_breaks_anything) {
  std::uint64_t states = 0;
  for (auto const& s : settings()) {
    search x(s, *this);
    auto const f = x.run(states_of_a_setting * times());
    if (f) {
      ADD_FAILURE() << s.name << '\n' << x.script(*f);
    }
    states += x.states();
    std::printf("  %-28s %8llu states, depth %d\n", s.name.c_str(), static_cast<unsigned long long>(x.states()),
                x.depth());
  }
  RecordProperty("states", static_cast<int>(states));
}

TEST_F(exploration, no_long_walk_breaks_anything) {
  for (auto const& s : settings()) {
    search x(s, *this);
    auto const f = x.walk(walks_of_a_setting * times(), 150, 1);
    if (f) {
      ADD_FAILURE() << s.name << '\n' << x.script(*f);
    }
    EXPECT_GT(x.ruled() * 20, s.agree ? 0 : x.states()) << s.name;
    std::printf("  %-28s %8llu steps, %llu of them ruled\n", s.name.c_str(),
                static_cast<unsigned long long>(x.states()), static_cast<unsigned long long>(x.ruled()));
  }
}

}  // namespace

}  // namespace explorer_test
