#pragma once

#include <gtest/gtest.h>

#include "soccer.hpp"

#include <rota/team/robot.hpp>

#include <array>
#include <vector>

/// What a robot believes: how good it thinks each robot is at attacking.
struct view {
  std::array<double, 10> attack{};
};

using robot = rota::robot<soccer>;
using claim = rota::claim<soccer>;
using plan_message = rota::plan_message<soccer>;
using message = rota::message<soccer>;

constexpr auto play_id = soccer::plan_type::play;
constexpr auto defence_id = soccer::plan_type::defence;

/// One plan: exactly one attacks, up to three defend, worth a little.
inline rota::plan_type<soccer, view> make_play(soccer::plan_type type = play_id) {
  using plan = rota::plan<soccer, view>;
  rota::additive_utility<soccer, view> const worth = [](soccer::agent a, soccer::task t, view const& v) {
    return std::optional<double>(t == soccer::task::attack ? v.attack[static_cast<std::size_t>(a)] : 0.125);
  };
  auto p = plan::make({.plan = soccer::plan::normal,
                       .tasks = {{soccer::task::attack, {1, 1}, soccer::state::get_ball},
                                 {soccer::task::defend, {0, 3}, soccer::state::protect}},
                       .utility = worth});
  return *rota::plan_type<soccer, view>::make(type, {*p});
}

inline std::vector<soccer::agent> squad(int n) {
  std::vector<soccer::agent> all;
  for (int i = 1; i <= n; ++i) all.push_back(agent(i));
  return all;
}

inline rota::team<soccer> make_team(int n) {
  rota::team<soccer> t;
  for (auto a : squad(n)) t.add(a);
  return t;
}

/// Everybody believes that robot `best` attacks best.
inline view sees(int best) {
  view v;
  v.attack[static_cast<std::size_t>(best)] = 1;
  return v;
}

inline plan_message says(int sender, std::uint64_t sequence, std::optional<soccer::task> task,
                         soccer::plan_type type = play_id) {
  plan_message m{agent(sender), {{1}, sequence}, {}};
  rota::participation<soccer> p{type, std::nullopt};
  if (task) p.place = rota::placement<soccer>{soccer::plan::normal, *task, soccer::state::none};
  m.types.push_back(p);
  return m;
}
inline plan_message says_nothing(int sender, std::uint64_t sequence) { return {agent(sender), {{1}, sequence}, {}}; }

constexpr rota::instant start{};
constexpr rota::incarnation first_life{1};
constexpr auto attack = soccer::task::attack;
constexpr auto defend = soccer::task::defend;

inline atom does(int n, soccer::task t) { return {agent(n), soccer::plan::normal, t}; }

inline claim claim_by(int leader, int attacker, std::uint64_t number = 1) {
  return {play_id, {does(attacker, attack)}, {0, agent(leader)}, agent(leader), first_life, number,
          1,       rota::seconds(2),         {rota::duration{}}};
}

/// A team of nine, of which the tests let some robots play.
struct playground : testing::Test {
  rota::plan_type<soccer, view> play = make_play();
  rota::team<soccer> members = make_team(9);
  rota::workspace space;

  robot in_play(int n, rota::robot_options const& options = {}) {
    robot a(agent(n), squad(9), first_life, options);
    a.enter(play, start);
    return a;
  }
  rota::decision<soccer> think(robot& a, view const& v, rota::instant now = start) {
    return a.deliberate(play, members, v, now, space);
  }
};
