// The best allocation of one plan: `5x3` is five agents and three tasks, and everybody may idle.
//
// Every task takes at most a few agents and the first needs one, so that agents compete. Each step has other utilities.

#include "support.hpp"

#include <rota/search/reallocate.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace {

using vocabulary = rota::runtime_vocabulary;
using atom = rota::in<vocabulary>;
using view = rota::allocation_view<vocabulary>;

/// The skill of each agent at each task, and the worth of two agents on one task together.
struct beliefs {
  std::size_t tasks = 0;
  std::vector<double> skill;
  std::vector<double> company;

  double of(std::size_t agent, std::size_t task) const { return skill[agent * tasks + task]; }
};
using plan = rota::plan<vocabulary, beliefs>;
using plan_type = rota::plan_type<vocabulary, beliefs>;
using problem = rota::problem<vocabulary, beliefs>;

double worth_of(beliefs const& b, view atoms) {
  double sum = 0;
  for (atom const& x : atoms) {
    sum += b.of(x.agent.value, x.task.value);
    for (atom const& y : atoms)
      if (y.agent < x.agent && y.task == x.task) sum += b.company[x.agent.value + y.agent.value];
  }
  return sum;
}

struct size {
  std::size_t agents;
  std::size_t tasks;
  std::uint32_t room() const { return static_cast<std::uint32_t>((agents + tasks - 1) / tasks); }
};

plan_type make_type(size s, bool additive) {
  rota::plan_description<vocabulary, beliefs> d;
  for (std::size_t t = 0; t < s.tasks; ++t) d.tasks.push_back({{t}, {t == 0 ? 1u : 0u, s.room()}, {}});
  if (additive) {
    d.utility = rota::additive_utility<vocabulary, beliefs>{
        [](auto a, auto t, beliefs const& b) { return std::optional{b.of(a.value, t.value)}; }};
  } else {
    d.utility = rota::general_utility<vocabulary, beliefs>{worth_of, {}};
  }
  return *plan_type::make({1}, {*plan::make(std::move(d))});
}

rota::team<vocabulary> make_team(std::size_t n) {
  rota::team<vocabulary> t;
  for (std::size_t a = 0; a < n; ++a) t.add({a});
  return t;
}

std::vector<beliefs> some_beliefs(size s) {
  auto random = seeded();
  std::vector<beliefs> all(64);
  for (auto& b : all) {
    b.tasks = s.tasks;
    for (std::size_t i = 0; i < s.agents * s.tasks; ++i) b.skill.push_back(uniform(random));
    for (std::size_t i = 0; i < 2 * s.agents; ++i) b.company.push_back(uniform(random) - 0.5);
  }
  return all;
}

/// The greatest utility of a valid assignment, by trying all.
double enumerate(beliefs const& b, size s, bool additive) {
  double best = -std::numeric_limits<double>::infinity();
  std::vector<std::size_t> choice(s.agents, 0);
  std::vector<atom> atoms;
  for (;;) {
    std::vector<std::uint32_t> count(s.tasks + 1, 0);
    for (std::size_t c : choice) ++count[c];
    bool const fits =
        count[0] > 0 && std::all_of(count.begin(), count.end() - 1, [&](auto n) { return n <= s.room(); });
    if (fits) {
      atoms.clear();
      double sum = 0;
      for (std::size_t a = 0; a < s.agents; ++a) {
        if (choice[a] == s.tasks) continue;
        atoms.push_back({{a}, {}, {choice[a]}});
        sum += b.of(a, choice[a]);
      }
      best = std::max(best, additive ? sum : worth_of(b, {atoms.data(), atoms.size()}));
    }
    std::size_t a = 0;
    while (a < s.agents && choice[a] == s.tasks) choice[a++] = 0;
    if (a == s.agents) return best;
    ++choice[a];
  }
}

/// The greatest additive utility by the Hungarian method, one column per place. A large reward keeps the needed place filled.
double hungarian(beliefs const& b, size s) {
  std::size_t const n = s.agents;
  std::vector<std::size_t> task_of;
  for (std::size_t t = 0; t < s.tasks; ++t) task_of.insert(task_of.end(), s.room(), t);
  std::size_t const places = task_of.size();
  task_of.insert(task_of.end(), n, s.tasks);
  constexpr double needed = 1e6;
  auto cost = [&](std::size_t a, std::size_t c) {
    return task_of[c] == s.tasks ? 0.0 : -b.of(a, task_of[c]) - (c == 0 ? needed : 0.0);
  };
  std::size_t const m = places + n;
  std::vector<double> u(n + 1, 0.0), v(m + 1, 0.0);
  std::vector<std::size_t> row(m + 1, 0), way(m + 1, 0);
  for (std::size_t i = 1; i <= n; ++i) {
    row[0] = i;
    std::size_t j0 = 0;
    std::vector<double> least(m + 1, std::numeric_limits<double>::infinity());
    std::vector<char> used(m + 1, 0);
    do {
      used[j0] = 1;
      double step = std::numeric_limits<double>::infinity();
      std::size_t j1 = 0;
      for (std::size_t j = 1; j <= m; ++j) {
        if (used[j]) continue;
        double const reduced = cost(row[j0] - 1, j - 1) - u[row[j0]] - v[j];
        if (reduced < least[j]) least[j] = reduced, way[j] = j0;
        if (least[j] < step) step = least[j], j1 = j;
      }
      for (std::size_t j = 0; j <= m; ++j) {
        if (used[j]) {
          u[row[j]] += step;
          v[j] -= step;
        } else {
          least[j] -= step;
        }
      }
      j0 = j1;
    } while (row[j0] != 0);
    for (; j0 != 0; j0 = way[j0]) row[j0] = row[way[j0]];
  }
  double sum = 0;
  for (std::size_t j = 1; j <= m; ++j)
    if (row[j] != 0 && task_of[j - 1] != s.tasks) sum += b.of(row[j] - 1, task_of[j - 1]);
  return sum;
}

/// Each term is rounded to 2^-20, so the optimum of the rounded utilities is as near to that of the real ones.
bool near(double fixed, double real) { return std::abs(fixed - real) < 1e-4; }

void best(benchmark::State& state, size s, bool additive) {
  auto const type = make_type(s, additive);
  auto const members = make_team(s.agents);
  auto const views = some_beliefs(s);
  rota::workspace space;
  for (std::size_t i = 0; i < views.size() && i < 8; ++i) {
    auto const found = best_allocation(problem{type, members, views[i]}, space);
    double const right = additive ? hungarian(views[i], s) : enumerate(views[i], s, false);
    check(found && found->proved && near(found->utility, right), "best_allocation");
    check(near(worth_of(views[i], found->atoms.atoms()), right) || additive, "the allocation is worth its utility");
  }
  rotate(state, views, [&](beliefs const& b) { return best_allocation(problem{type, members, b}, space); });
}

void enumeration(benchmark::State& state, size s, bool additive) {
  auto const views = some_beliefs(s);
  if (additive) check(near(hungarian(views[0], s), enumerate(views[0], s, true)), "hungarian");
  rotate(state, views, [&](beliefs const& b) { return enumerate(b, s, additive); });
}

/// Beliefs change; the running allocation stays unless another one is better.
void reallocate_changing(benchmark::State& state, size s, bool additive) {
  auto const type = make_type(s, additive);
  auto const members = make_team(s.agents);
  auto const views = some_beliefs(s);
  rota::workspace space;
  auto const current = best_allocation(problem{type, members, views[0]}, space)->atoms;
  for (beliefs const& b : views) {
    auto const next = reallocate(problem{type, members, b}.running(current), {}, space);
    check(*apply(next.event, current) == next.atoms, "reallocate: the event leads there");
    check(near(next.utility, additive ? hungarian(b, s) : enumerate(b, s, false)), "reallocate: and that is best");
  }
  rotate(state, views,
         [&](beliefs const& b) { return reallocate(problem{type, members, b}.running(current), {}, space); });
}

BENCHMARK_CAPTURE(best, , size{5, 3}, true)->Name("best_allocation/additive/5x3");
BENCHMARK_CAPTURE(enumeration, , size{5, 3}, true)->Name("best_allocation/additive/5x3/peer:enumeration");
BENCHMARK_CAPTURE(best, , size{8, 4}, true)->Name("best_allocation/additive/8x4");
BENCHMARK_CAPTURE(best, , size{50, 10}, true)->Name("best_allocation/additive/50x10");
BENCHMARK_CAPTURE(best, , size{5, 3}, false)->Name("best_allocation/general/5x3");
BENCHMARK_CAPTURE(enumeration, , size{5, 3}, false)->Name("best_allocation/general/5x3/peer:enumeration");
BENCHMARK_CAPTURE(best, , size{8, 4}, false)->Name("best_allocation/general/8x4");
BENCHMARK_CAPTURE(enumeration, , size{8, 4}, false)->Name("best_allocation/general/8x4/peer:enumeration");
BENCHMARK_CAPTURE(reallocate_changing, , size{5, 4}, true)->Name("reallocate/additive/5x4");
BENCHMARK_CAPTURE(reallocate_changing, , size{5, 4}, false)->Name("reallocate/general/5x4");

}  // namespace
