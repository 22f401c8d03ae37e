#pragma once

#include <rota/core/result.hpp>
#include <rota/model/plan_type.hpp>
#include <rota/model/team.hpp>
#include <rota/sim/perception.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rota::sim {

using names = runtime_vocabulary;

/// A plan as a file describes it, which leaves out the utility.
struct plan_sketch {
  struct task {
    names::task id{};
    std::string name;
    cardinality bounds;
    names::state entry{};
  };
  names::plan id{};
  std::string name;
  std::vector<task> tasks;
  cardinality team_size{};
  double hysteresis = 0;
};

/// How much a task pays, in metres. Attack pays the diagonal of the field minus the robot's distance to the ball; every other
/// task pays a fraction of the diagonal minus the robot's distance to the home of the task. So the robot nearest to the ball
/// attacks, unless that costs the others sixteen times as many metres. A plan's hysteresis counts metres saved.
struct pay_options {
  std::int64_t other = 16;  ///< every other task pays a sixteenth
};

/// A plan type ready to be played: the plans of files with soccer utilities, which read the robot's own perception.
struct playbook {
  plan_type<names, perceived> type;
  std::vector<plan_sketch> plans;      ///< ascending by id, as in `type`
  std::vector<names::task> attacking;  ///< the attack task of each plan

  /// Whether the atom is about attacking.
  [[nodiscard]] bool attacks(in<names> const& x) const {
    for (std::size_t i = 0; i < plans.size(); ++i)
      if (plans[i].id == x.plan) return attacking[i] == x.task;
    return false;
  }
};

/// The first task whose name contains "Attack"; without one, the first task that needs somebody; without that, the first.
/// @pre the plan has a task
[[nodiscard]] inline names::task attack_task(plan_sketch const& plan) {
  for (auto const& t : plan.tasks)
    if (t.name.find("Attack") != std::string::npos) return t.id;
  for (auto const& t : plan.tasks)
    if (t.bounds.lower() > 0) return t.id;
  return plan.tasks.front().id;
}

/// The home of the k-th task that is not Attack, counted in the file's order.
[[nodiscard]] constexpr point home_of(std::size_t k) noexcept {
  constexpr point homes[] = {{metres(-6), metres(0)}, {metres(-2), metres(3)},  {metres(3), metres(-3)},
                             {metres(4), metres(3)},  {metres(-2), metres(-3)}, {metres(0), metres(0)}};
  return homes[k % (sizeof homes / sizeof *homes)];
}

/// (diagonal − d) / divisor in metres, at least 0, in whole units of 2^-20, so that no compiler's rounding decides who attacks.
[[nodiscard]] constexpr double pay(micrometres d, std::int64_t divisor) noexcept {
  constexpr std::int64_t unit = 1 << 20;
  auto const units = (std::max<micrometres>)(field_diagonal - d, 0) * unit / metres(1);
  auto const paid = divisor == 1    ? units
                    : divisor == 16 ? units / 16
                                    : units / divisor;  // the defaults take no division
  return static_cast<double>(paid) / unit;
}

/// The utility that `pay_options` describes. The robots are called 1, 2, 3, …
[[nodiscard]] inline additive_utility<names, perceived> soccer_utility(plan_sketch const& plan, pay_options const& w) {
  std::vector<std::pair<names::task, std::optional<point>>> homes;
  std::size_t others = 0;
  for (auto const& t : plan.tasks) {
    bool const attack = t.id == attack_task(plan);
    homes.emplace_back(t.id, attack ? std::nullopt : std::optional(home_of(others)));
    others += attack ? 0 : 1;
  }
  return [homes = std::move(homes), w](names::agent a, names::task t, perceived const& seen) -> std::optional<double> {
    if (seen.blind) return std::nullopt;
    point const at = seen.robots[a.value - 1];
    for (auto const& [task, home] : homes)
      if (task == t) return home ? pay(distance(at, *home), w.other) : pay(distance(at, seen.ball), 1);
    return std::nullopt;
  };
}

/// The plan type with these plans, or in words why they cannot be played.
[[nodiscard]] inline result<playbook, std::string>
make_playbook(names::plan_type type, std::vector<plan_sketch> sketches, pay_options const& w = {}) {
  std::sort(sketches.begin(), sketches.end(), [](plan_sketch const& a, plan_sketch const& b) { return a.id < b.id; });
  std::vector<plan<names, perceived>> plans;
  std::vector<names::task> attacking;
  for (plan_sketch const& s : sketches) {
    if (s.tasks.empty()) return refused{"plan " + s.name + " has no task"};
    plan_description<names, perceived> d;
    d.plan = s.id;
    for (auto const& t : s.tasks) d.tasks.push_back({t.id, t.bounds, t.entry});
    d.utility = soccer_utility(s, w);
    d.team_size = s.team_size;
    d.hysteresis = s.hysteresis;
    auto made = plan<names, perceived>::make(std::move(d));
    if (!made)
      return refused{"plan " + s.name + " lists a task twice, or its utility threshold is no number from 0 on"};
    plans.push_back(*std::move(made));
    attacking.push_back(attack_task(s));
  }
  auto made = plan_type<names, perceived>::make(type, std::move(plans));
  if (!made) return refused{std::string("the plan type has no plan, or one of them twice")};
  return playbook{*std::move(made), std::move(sketches), std::move(attacking)};
}

/// Robots 1 … n, without restrictions.
[[nodiscard]] inline team<names> team_of(std::size_t robots) {
  team<names> t;
  for (std::size_t i = 1; i <= robots; ++i) t.add(names::agent{i});
  return t;
}

}  // namespace rota::sim
