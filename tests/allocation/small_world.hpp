#pragma once
/// @file
/// Small random allocation problems: as plain data, for oracles, and built into the model, for the library.
/// Includes nothing of allocation/ or search/, so that an oracle on the plain data shares no code with either.

#include "support/dice.hpp"

#include <rota/model/plan_type.hpp>
#include <rota/model/team.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace small_world {

using rota_test::any_seed;
using rota_test::between;
using rota_test::dice;

struct names {
  enum class agent : std::uint8_t {};
  enum class plan_type : std::uint8_t { only };
  enum class plan : std::uint8_t {};
  enum class task : std::uint8_t {};
  enum class state : std::uint8_t {};
};

inline constexpr unsigned unlimited = ~0u;

/// In(agent, plan, task) in plain numbers.
struct fact {
  int agent = 0;
  int plan = 0;
  int task = 0;
  friend auto operator<=>(fact const&, fact const&) = default;
};
using facts = std::vector<fact>;  // ascending, distinct

enum class truth { always, often, seldom, never };

struct raw_task {
  int id = 0;
  unsigned min = 0;
  unsigned max = unlimited;
};

/// Weights of the parts of a utility that is a sum: agents alone, pairs of agents, the whole, role priorities, staying.
struct raw_sum {
  double alone = 1, pairs = 0, whole = 0, priority = 0, staying = 0;
};

struct raw_plan {
  int id = 0;
  std::vector<raw_task> tasks;
  unsigned team_min = 0;
  unsigned team_max = unlimited;
  bool general = false;
  bool bounded = false;  // a general utility with a bound
  bool kinds = false;    // a general utility that says which agents are interchangeable
  std::optional<raw_sum> sum;
  truth pre = truth::always;
  bool entry_only = false;
  double offset = 0;  // of a general utility
  double hysteresis = 0;
  std::uint64_t salt = 0;
  std::array<std::array<std::optional<double>, 8>, 8> u{};  // [agent][task]
};

struct raw_problem {
  std::vector<int> members;                        // in listing order
  std::vector<int> participants;                   // ascending
  std::array<std::array<bool, 8>, 8> forbidden{};  // by role: [agent][task]
  bool idle = true;
  std::vector<raw_plan> plans;  // in listing order
  facts current;                // at most one atom per agent
  double change_cost = 0;
  std::array<std::array<double, 8>, 8> priority{};  // by role: [agent][task]
};

inline double sum_of(raw_plan const& p, facts const& c) {
  double sum = 0;
  for (fact const& x : c)
    if (auto const& u = p.u[static_cast<std::size_t>(x.agent)][static_cast<std::size_t>(x.task)]) sum += *u;
  return sum;
}

inline double crowding(facts const& c) {
  double value = 0;
  for (fact const& x : c)
    for (fact const& y : c) value -= x.agent < y.agent && x.task == y.task ? 1.0 : 0.0;
  return value;
}
/// General utility: the sum, less one for each pair of agents on one task, plus the offset.
inline double general_value(raw_plan const& p, facts const& c) { return sum_of(p, c) + p.offset + crowding(c); }

/// What two agents are worth together.
inline double company(raw_plan const& p, int a, int s, int b, int t) {
  auto const h = (p.salt + static_cast<std::uint64_t>(((a * 8 + s) * 8 + b) * 8 + t)) * 0x9E3779B97F4A7C15u;
  return 0.5 * static_cast<double>((h >> 40) % 5) - 1.0;
}

/// U_p, whatever it is made of.
inline double value_of(raw_problem const& r, raw_plan const& p, facts const& c) {
  if (!p.sum) return p.general ? general_value(p, c) : sum_of(p, c);
  double value = p.sum->alone * sum_of(p, c) + p.sum->whole * (crowding(c) + p.offset);
  for (fact const& x : c) {
    value += p.sum->priority * r.priority[static_cast<std::size_t>(x.agent)][static_cast<std::size_t>(x.task)];
    value += p.sum->staying * static_cast<double>(std::count(r.current.begin(), r.current.end(), x));
    for (fact const& y : c)
      if (x.agent < y.agent) value += p.sum->pairs * company(p, x.agent, x.task, y.agent, y.task);
  }
  return value;
}

/// Participants who would do something else than now.
inline int changes(raw_problem const& r, facts const& c) {
  auto part = [](facts const& of, int a) {
    auto const x = std::find_if(of.begin(), of.end(), [&](fact const& f) { return f.agent == a; });
    return x == of.end() ? std::optional<fact>{} : std::optional{*x};
  };
  int n = 0;
  for (int a : r.participants) n += part(r.current, a) != part(c, a);
  return n;
}

inline bool holds(raw_plan const& p, facts const& c) {
  std::uint64_t h = p.salt;
  for (fact const& x : c)
    h = (h ^ static_cast<std::uint64_t>(x.agent * 8 + x.task + 1)) * 0x9E3779B97F4A7C15u + (h >> 29);
  switch (p.pre) {
  case truth::always: return true;
  case truth::often: return (h >> 40) % 4 != 0;
  case truth::seldom: return (h >> 40) % 8 == 0;
  case truth::never: return false;
  }
  return true;
}

/// What a random problem may contain.
struct flavour {
  int agents = 4;
  int tasks = 3;
  int plans = 2;
  int levels = 3;  // how many different utilities; few make ties
  bool general = false;
  bool preconditions = false;
  bool negative = false;
  bool sums = false;
  bool running = false;  // there is a current allocation, and changes may cost
};

inline raw_plan random_plan(dice& d, int id, flavour const& f) {
  raw_plan p;
  p.id = id;
  p.salt = d.bits();
  for (int t : d.some(1 + d.below(f.tasks), 4)) {
    raw_task r{t, static_cast<unsigned>(d.chance(65) ? 0 : 1 + d.below(2)), unlimited};
    if (d.chance(60)) r.max = r.min + static_cast<unsigned>(d.below(3));
    p.tasks.push_back(r);
  }
  d.shuffle(p.tasks);
  if (d.chance(30)) p.team_min = static_cast<unsigned>(d.below(4));
  if (d.chance(30)) p.team_max = p.team_min + static_cast<unsigned>(d.below(3));
  if (f.general && d.chance(60)) p.general = true, p.bounded = d.chance(50);
  if (f.preconditions) p.pre = static_cast<truth>(d.below(4)), p.entry_only = d.chance(40);
  p.offset = f.negative ? -d.below(4) : d.below(2);
  p.hysteresis = d.below(4) * 0.5;
  int const forbidding = d.chance(40) ? 0 : d.below(60);
  for (auto& row : p.u)
    for (auto& u : row) {
      u = 0.5 * d.below(f.levels) - (f.negative ? 0.5 * d.below(f.levels) : 0.0);
      if (d.chance(forbidding)) u.reset();
    }
  if (d.chance(30)) p.u.fill(p.u[0]);  // interchangeable agents
  p.kinds = d.chance(50);
  if (f.sums && d.chance(75)) {
    auto weight = [&](int percent) { return d.chance(percent) ? 0.5 * (d.below(5) - 1) : 0.0; };
    p.sum = raw_sum{weight(80), weight(40), weight(40), weight(40), weight(40)};
    p.general = p.sum->whole != 0;
  }
  return p;
}

inline raw_problem random_problem(dice& d, flavour const& f) {
  raw_problem r;
  int const n = d.chance(70) ? f.agents : d.below(f.agents + 1);
  auto const all = d.some(std::min(7, n + d.below(2)), 7);
  r.members = all;
  d.shuffle(r.members);
  r.participants = all;
  while (static_cast<int>(r.participants.size()) > n)
    r.participants.erase(r.participants.begin() + d.below(static_cast<int>(r.participants.size())));
  r.idle = d.chance(70);
  int const forbidding = d.chance(40) ? 0 : d.below(50);
  for (auto& row : r.forbidden)
    for (bool& b : row) b = d.chance(forbidding);
  for (int id : d.some(1 + d.below(f.plans), 5)) r.plans.push_back(random_plan(d, id, f));
  d.shuffle(r.plans);
  for (auto& row : r.priority)
    for (double& x : row) x = 0.5 * d.below(4);
  if (f.running && d.chance(80)) {
    r.change_cost = d.chance(60) ? 0.5 * d.below(4) : 0;
    for (int a : r.participants) {
      if (d.chance(30)) continue;
      auto const& p = r.plans[d.chance(80) ? 0 : d.bits() % r.plans.size()];
      r.current.push_back({a, p.id, p.tasks[d.bits() % p.tasks.size()].id});
    }
    std::sort(r.current.begin(), r.current.end());
  }
  return r;
}

/// The same problem as the library sees it. Beliefs are unused: the functions carry their plan's data.
using plan_t = rota::plan<names, rota::no_beliefs>;
using plan_type_t = rota::plan_type<names, rota::no_beliefs>;
using atoms_t = rota::allocation_atoms<names>;

inline facts to_facts(rota::allocation_view<names> atoms) {
  facts r;
  for (auto const& x : atoms)
    r.push_back({static_cast<int>(x.agent), static_cast<int>(x.plan), static_cast<int>(x.task)});
  return r;
}
inline facts to_facts(atoms_t const& atoms) { return to_facts(atoms.atoms()); }

inline atoms_t to_atoms(facts const& c) {
  atoms_t r;
  for (fact const& x : c) r.insert({names::agent(x.agent), names::plan(x.plan), names::task(x.task)});
  return r;
}

inline rota::cardinality to_cardinality(unsigned min, unsigned max) {
  return {min, max == unlimited ? rota::cardinality::unbounded : max};
}

using part_t = rota::utility_part<names, rota::no_beliefs>;

/// The parts of weight 0 are left out, but for one.
inline rota::weighted_sum<names, rota::no_beliefs>
build_sum(std::shared_ptr<raw_plan const> shared, rota::additive_utility<names, rota::no_beliefs> const& alone) {
  rota::weighted_sum<names, rota::no_beliefs> sum;
  auto const& w = *shared->sum;
  sum.push_back({w.alone, part_t{alone}});
  if (w.pairs != 0)
    sum.push_back({w.pairs, part_t{rota::pairwise_utility<names, rota::no_beliefs>{
                                {}, [shared](auto a, auto s, auto b, auto t, rota::no_beliefs) {
                                  return company(*shared, static_cast<int>(a), static_cast<int>(s), static_cast<int>(b),
                                                 static_cast<int>(t));
                                }}}});
  if (w.whole != 0) {
    rota::general_utility<names, rota::no_beliefs> u;
    u.value = [shared](rota::no_beliefs, rota::allocation_view<names> c) {
      return crowding(to_facts(c)) + shared->offset;
    };
    if (shared->bounded)  // what is there already can only get worse
      u.bound = [shared](rota::no_beliefs, rota::allocation_view<names> c, std::span<names::agent const>) {
        return crowding(to_facts(c)) + shared->offset;
      };
    if (shared->kinds) u.kind = [](rota::no_beliefs, names::agent) { return std::uint64_t{0}; };
    sum.push_back({w.whole, part_t{u}});
  }
  if (w.priority != 0) sum.push_back({w.priority, part_t{rota::role_priorities{}}});
  if (w.staying != 0) sum.push_back({w.staying, part_t{rota::similarity{}}});
  return sum;
}

inline plan_t build(raw_plan const& raw) {
  rota::plan_description<names, rota::no_beliefs> d;
  d.plan = names::plan(raw.id);
  for (raw_task const& t : raw.tasks) d.tasks.push_back({names::task(t.id), to_cardinality(t.min, t.max), {}});
  d.team_size = to_cardinality(raw.team_min, raw.team_max);
  d.hysteresis = raw.hysteresis;
  d.scope = raw.entry_only ? rota::precondition_scope::entry_only : rota::precondition_scope::always;
  auto const shared = std::make_shared<raw_plan const>(raw);
  if (raw.pre != truth::always)
    d.precondition = [shared](rota::no_beliefs, rota::allocation_view<names> c) { return holds(*shared, to_facts(c)); };
  rota::additive_utility<names, rota::no_beliefs> const alone = [shared](names::agent a, names::task t,
                                                                         rota::no_beliefs) {
    return shared->u[static_cast<std::size_t>(a)][static_cast<std::size_t>(t)];
  };
  if (raw.sum) {
    d.utility = build_sum(shared, alone);
    return std::move(plan_t::make(std::move(d)).value());
  }
  if (!raw.general) {
    d.utility = alone;
    return std::move(plan_t::make(std::move(d)).value());
  }
  rota::general_utility<names, rota::no_beliefs> u;
  if (raw.kinds)  // equal rows, equal kind: nothing else tells agents apart
    u.kind = [shared](rota::no_beliefs, names::agent a) {
      std::size_t k = 0;
      while (shared->u[k] != shared->u[static_cast<std::size_t>(a)]) ++k;
      return std::uint64_t{k};
    };
  u.value = [shared](rota::no_beliefs, rota::allocation_view<names> c) { return general_value(*shared, to_facts(c)); };
  if (raw.bounded)
    u.bound = [shared](rota::no_beliefs, rota::allocation_view<names> c, std::span<names::agent const> rest) {
      double bound = general_value(*shared, to_facts(c));
      for (auto a : rest) {
        double most = 0;
        for (auto const& v : shared->u[static_cast<std::size_t>(a)]) most = std::max(most, v.value_or(0));
        bound += most;
      }
      return bound;
    };
  d.utility = std::move(u);
  return std::move(plan_t::make(std::move(d)).value());
}

/// Owns what a `rota::problem` views.
struct built {
  plan_type_t type;
  rota::team<names> team;
  std::vector<names::agent> participants;
  rota::no_beliefs beliefs{};
  atoms_t current;

  explicit built(raw_problem const& raw) : type(build_type(raw)), current(to_atoms(raw.current)) {
    for (int a : raw.members) {
      rota::role<names> role;
      for (int t = 0; t < 8; ++t)
        if (raw.forbidden[static_cast<std::size_t>(a)][static_cast<std::size_t>(t)]) {
          role.forbid(names::task(t));
        } else {
          role.prioritise(names::task(t), raw.priority[static_cast<std::size_t>(a)][static_cast<std::size_t>(t)]);
        }
      team.add(names::agent(a), role);
    }
    for (int a : raw.participants) participants.push_back(names::agent(a));
  }
  static plan_type_t build_type(raw_problem const& raw) {
    std::vector<plan_t> plans;
    for (raw_plan const& p : raw.plans) plans.push_back(build(p));
    return std::move(plan_type_t::make(names::plan_type::only, std::move(plans)).value());
  }
};

/// A random allocation, meant for p: mostly sensible, so that every clause is violated alone as well as together with others.
inline facts random_facts(dice& d, raw_problem const& r, raw_plan const& p) {
  facts c;
  for (int a : r.participants) {
    if (d.chance(r.idle ? 25 : 15)) continue;
    auto const& t = p.tasks[static_cast<std::size_t>(d.below(static_cast<int>(p.tasks.size())))];
    c.push_back({a, p.id, t.id});
  }
  int const noise = d.chance(60) ? 0 : 1 + d.below(2);
  for (int i = 0; i < noise; ++i) {
    int const a = r.members.empty() || d.chance(30) ? d.below(8) : r.members[d.bits() % r.members.size()];
    c.push_back({a, d.chance(70) ? p.id : d.below(6), d.chance(60) ? p.tasks[0].id : d.below(5)});
  }
  std::sort(c.begin(), c.end());
  c.erase(std::unique(c.begin(), c.end()), c.end());
  return c;
}

}  // namespace small_world
