#pragma once
/// @file
/// The formulas of Def. 1 and of section 3 of docs/algebra.md, read off one by one on plain data. An oracle: it knows
/// nothing of allocation/ and search/, and is as slow as it is literal.

#include "allocation/small_world.hpp"

#include <set>

namespace reading {

using namespace small_world;

struct verdict {
  std::set<fact> other_plan;  // (0)
  std::set<fact> foreign;     // task outside Tasks(p)
  std::set<fact> strangers;
  std::set<fact> roles;
  std::set<int> cardinality;  // tasks
  std::set<int> two_tasks;    // agents
  bool precondition = false;  // violated
  bool negative = false;
  std::set<fact> forbidden;  // pairs
  bool team_size = false;
  std::set<int> idle;  // agents

  [[nodiscard]] bool valid() const {
    return other_plan.empty() && foreign.empty() && strangers.empty() && roles.empty() && cardinality.empty() &&
           two_tasks.empty() && !precondition && !negative && forbidden.empty() && !team_size && idle.empty();
  }
};

inline bool among(std::vector<int> const& v, int x) { return std::find(v.begin(), v.end(), x) != v.end(); }

inline bool has_task(raw_plan const& p, int t) {
  return std::any_of(p.tasks.begin(), p.tasks.end(), [&](raw_task const& r) { return r.id == t; });
}

/// Every clause on C, relative to p. `running`: an entry-only precondition is not asked.
inline verdict judge(raw_problem const& problem, raw_plan const& p, facts const& c, bool running) {
  verdict v;
  std::set<int> employed;
  facts known;
  for (fact const& x : c) {
    if (x.plan != p.id) {
      v.other_plan.insert(x);
      continue;
    }
    employed.insert(x.agent);
    bool const foreign = !has_task(p, x.task);
    bool const stranger = !among(problem.participants, x.agent);
    if (foreign) v.foreign.insert(x);
    if (stranger) v.strangers.insert(x);
    if (!foreign && among(problem.members, x.agent) &&
        problem.forbidden[static_cast<std::size_t>(x.agent)][static_cast<std::size_t>(x.task)])
      v.roles.insert(x);
    if (!foreign && !stranger) known.push_back(x);
  }
  for (raw_task const& t : p.tasks) {
    std::set<int> a;
    for (fact const& x : c)
      if (x.plan == p.id && x.task == t.id) a.insert(x.agent);
    if (a.size() < t.min || (t.max != unlimited && a.size() > t.max)) v.cardinality.insert(t.id);
  }
  for (fact const& x : c)
    for (fact const& y : c)
      if (x.plan == p.id && y.plan == p.id && x.agent == y.agent && x.task != y.task) v.two_tasks.insert(x.agent);
  if (!(running && p.entry_only)) v.precondition = !holds(p, known);
  if (!p.general || p.sum)
    for (fact const& x : known)
      if (!p.u[static_cast<std::size_t>(x.agent)][static_cast<std::size_t>(x.task)]) v.forbidden.insert(x);
  if (v.forbidden.empty()) v.negative = value_of(problem, p, known) < 0;
  v.team_size = employed.size() < p.team_min || (p.team_max != unlimited && employed.size() > p.team_max);
  if (!problem.idle)
    for (int a : problem.participants)
      if (employed.count(a) == 0) v.idle.insert(a);
  return v;
}

inline raw_plan const* find_plan(raw_problem const& problem, int id) {
  for (raw_plan const& p : problem.plans)
    if (p.id == id) return &p;
  return nullptr;
}

/// What enumeration finds best.
struct best {
  raw_plan const* plan = nullptr;
  facts atoms;
  double utility = 0;
  double objective = 0;  // less change costs
  std::uint64_t leaves = 0;
};

/// All assignments of one plan in lexicographic order, tasks ascending and idle last; the first of the best valid ones.
template <class Valid>
best enumerate(raw_problem const& problem, raw_plan const& p, Valid const& valid) {
  std::vector<int> tasks;
  for (raw_task const& t : p.tasks) tasks.push_back(t.id);
  std::sort(tasks.begin(), tasks.end());
  best b;
  std::vector<std::size_t> choice(problem.participants.size(), 0);
  for (;;) {
    ++b.leaves;
    facts c;
    for (std::size_t a = 0; a < choice.size(); ++a)
      if (choice[a] < tasks.size()) c.push_back({problem.participants[a], p.id, tasks[choice[a]]});
    if (valid(p, c)) {
      double const utility = value_of(problem, p, c);
      double const objective = utility - problem.change_cost * changes(problem, c);
      if (b.plan == nullptr || objective > b.objective)
        b.plan = &p, b.atoms = c, b.utility = utility, b.objective = objective;
    }
    std::size_t a = choice.size();
    while (a > 0 && choice[a - 1] == tasks.size()) choice[--a] = 0;
    if (a == 0) return b;
    ++choice[a - 1];
  }
}

/// The best over all plans; the least plan among equals.
template <class Valid>
best enumerate(raw_problem const& problem, Valid const& valid) {
  best all;
  for (raw_plan const& p : problem.plans) {
    best const b = enumerate(problem, p, valid);
    if (b.plan == nullptr) continue;
    if (all.plan == nullptr || b.objective > all.objective ||
        (b.objective == all.objective && b.plan->id < all.plan->id))
      all = b;
  }
  return all;
}

inline best enumerate(raw_problem const& problem) {
  return enumerate(problem, [&](raw_plan const& p, facts const& c) {
    auto const runs = [&](fact const& x) { return x.plan == p.id; };
    return judge(problem, p, c, std::any_of(problem.current.begin(), problem.current.end(), runs)).valid();
  });
}

}  // namespace reading
