#include "command.hpp"
#include "costs.hpp"
#include "json.hpp"
#include "target.hpp"
#include "text.hpp"

#include <rota/adapters/alica/convert.hpp>
#include <rota/algebra/apply.hpp>
#include <rota/allocation/print.hpp>
#include <rota/allocation/validate.hpp>
#include <rota/search/best_allocation.hpp>
#include <rota/search/reallocate.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <initializer_list>
#include <optional>
#include <set>

namespace rota::cli {
namespace {

using atom = in<vocabulary>;

/// Everything that a report needs. A view.
struct question {
  target const& where;
  roster const& who;
  utilities const& worth;
  std::optional<cost_scale> const& costs;  ///< none: `worth` are utilities
  rota::plan_type<vocabulary> const& type;
  rota::problem<vocabulary, no_beliefs> const& problem;
  allocation_atoms<vocabulary> current;
  bool has_current = false;
  std::vector<std::string> departed;

  [[nodiscard]] std::string task(atom const& x) const { return where.name(where.plan(x.plan), x.task); }
};

rota::plan_type<vocabulary> build_type(target const& t, roster const& who, utilities const& worth,
                                       std::optional<cost_scale> const& costs) {
  auto const factory = [&](alica::plan const& p) {
    return [&, id = vocabulary::plan{p.id}](vocabulary::agent a, vocabulary::task task, no_beliefs const&) {
      auto const cell = worth(who.name(a), id, task);
      return cell && costs ? std::optional(costs->utility(in_steps(*cell))) : cell;
    };
  };
  auto made = t.type != nullptr ? alica::to_plan_type(t.model, *t.type, factory)
                                : alica::to_plan_type(*t.plans.front(), factory);
  if (!made) throw input_error("plan " + std::to_string(made.error().plan), "", made.error().reason);
  return *std::move(made);
}

allocation_atoms<vocabulary> atoms_of(named_allocation const& a, target const& t, roster const& who,
                                      std::string const& file) {
  allocation_atoms<vocabulary> out;
  if (!a.plan) return out;
  auto const at = std::find_if(t.plans.begin(), t.plans.end(), [&](auto const* p) { return t.name(*p) == *a.plan; });
  if (at == t.plans.end()) throw input_error(file, "/plan", "there is no plan \"" + *a.plan + '"');
  for (auto const& pair : a.assignment) {
    auto const task = t.find_task(**at, pair.task);
    if (!task) throw input_error(file, pair.place + "/task", "the plan has no task \"" + pair.task + '"');
    out.insert({who.id(pair.agent), {(*at)->id}, *task});
  }
  return out;
}

std::string explain(plan_refusal<vocabulary> const& r, question const& q) {
  auto const& p = q.where.plan(r.plan);
  auto const task = [&] { return q.where.name(p, r.task); };
  auto const agents = [](std::size_t n) { return counted(n, "agent"); };
  auto const why = [&]() -> std::string {
    switch (r.reason) {
    case no_plan_reason::contradictory_cardinalities:
      return "its tasks sum to " + agents(r.count) + ", which its team size " + interval(r.bounds) + " never admits";
    case no_plan_reason::too_few_agents:
      return "it needs at least " + agents(r.bounds.lower()) + ", and there are " + std::to_string(r.count);
    case no_plan_reason::too_many_agents:
      return "nobody may idle, there are " + agents(r.count) + ", and it has room for " +
             std::to_string(r.bounds.upper());
    case no_plan_reason::task_short:
      return agents(r.count) + " can take on " + task() + ", which needs " + interval(r.bounds);
    case no_plan_reason::agent_without_task: return q.who.name(r.agent) + " can take on no task and may not idle";
    case no_plan_reason::pairs_contradict:
      return "each task and each agent could be served alone, but not all together" +
             (r.task != vocabulary::task{}     ? ": left over is " + task()
              : r.agent != vocabulary::agent{} ? ": left over is " + q.who.name(r.agent)
                                               : std::string());
    case no_plan_reason::utility_refused: return "a utility " + to_string(r.fault);
    case no_plan_reason::utilities_too_great:
      return q.costs ? "the costs are too far apart to be summed exactly for so many agents"
                     : "the utilities are too large to be summed exactly";
    case no_plan_reason::precondition_never_holds: return "its precondition never holds";
    case no_plan_reason::precondition_threw: return "its precondition failed";
    case no_plan_reason::negative_utility:
      return "its utility is at most " + number(r.value) + ", below 0 (costs are written as they are, with --minimise)";
    case no_plan_reason::change_cost_refused: return "the change cost " + to_string(r.fault);
    case no_plan_reason::search_incomplete: return "the search ended before it found one";
    }
    return "";
  }();
  return q.where.name(p) + ": " + why;
}

/// The utility or the cost of an agent at a task, as it counts.
double counted_cell(question const& q, atom const& x) {
  return in_steps(q.worth(q.who.name(x.agent), x.plan, x.task).value_or(0));
}

double total_of(question const& q, allocation_atoms<vocabulary> const& atoms) {
  double total = 0;
  for (atom const& x : atoms) total += counted_cell(q, x);
  return total;
}

std::vector<std::string> idle_agents(question const& q, allocation_atoms<vocabulary> const& atoms) {
  std::vector<std::string> idle;
  for (auto const a : q.problem.participants)
    if (part_of(atoms, a).empty()) idle.push_back(q.who.name(a));
  return idle;
}

/// Whether a running team would change to this allocation.
named_decision decide(question const& q, solution<vocabulary> const& s) {
  auto const r = reallocate<vocabulary, no_beliefs>(q.problem, hysteresis{}, s);
  auto const gain = [&](std::string const& compared) -> std::string {
    if (!q.costs) return "gain " + number(r.gain.value_or(0)) + compared;
    if (s.atoms.size() != q.current.size()) return "more agents have a task";
    return "saves " + number(total_of(q, q.current) - total_of(q, s.atoms)) + compared;
  };
  switch (r.reason) {
  case reallocation_reason::first: return {false, "the team has no allocation yet"};
  case reallocation_reason::adopted_better: return {false, gain(", more than the hysteresis")};
  case reallocation_reason::current_invalid: return {false, "the current allocation is not valid"};
  case reallocation_reason::kept_optimal:
    return {true, q.current.empty() ? "nothing is better than no task for anybody"
                                    : "nothing is better than the current allocation"};
  case reallocation_reason::kept_hysteresis: return {true, gain(", no more than the hysteresis")};
  case reallocation_reason::kept_unproved: return {true, "nothing better was found"};
  case reallocation_reason::no_valid_allocation: return {false, "no allocation is valid"};
  case reallocation_reason::search_incomplete: break;
  }
  return {false, "the search ended before it found an allocation"};
}

named_change named(question const& q, atom const& x) {
  auto const plan = [&] { return q.where.name(q.where.plan(x.plan)); };
  return {q.who.name(x.agent), q.where.type != nullptr ? std::optional(plan()) : std::nullopt, q.task(x)};
}

named_answer named(question const& q, solution<vocabulary> const& s) {
  named_answer out;
  out.plan = q.where.name(q.where.plan(s.plan));
  out.utility = s.utility;
  if (q.costs) out.cost = total_of(q, s.atoms);
  out.optimal = s.proved;
  out.gap = s.gap;
  for (atom const& x : s.atoms) out.assignment.emplace_back(q.who.name(x.agent), q.task(x));
  out.idle = idle_agents(q, s.atoms);
  if (!q.has_current) return out;  // without a current allocation nothing is added or removed
  for (auto const& x : difference(q.current, s.atoms))
    (x.value == sign::plus ? out.added : out.removed).push_back(named(q, x.atom));
  out.decision = decide(q, s);
  return out;
}

/// One line per clause of validity: whether it holds, and on which numbers.
std::string clauses(question const& q, solution<vocabulary> const& s, validity_report<vocabulary> const& report) {
  auto const& p = *q.type.find(s.plan);
  auto const& file = q.where.plan(s.plan);
  auto const pairs = s.atoms.size();
  auto const of_pairs = [&](auto const& holds) {
    return std::to_string(std::count_if(s.atoms.begin(), s.atoms.end(), holds)) + " of " + counted(pairs, "pair");
  };
  std::string counts;
  for (auto const& t : p.tasks()) {
    auto const n = std::count_if(s.atoms.begin(), s.atoms.end(), [&](atom const& x) { return x.task == t.task; });
    counts += (counts.empty() ? "" : ", ") + q.where.name(file, t.task) + ' ' + std::to_string(n) + " in " +
              interval(t.bounds);
  }
  std::set<vocabulary::agent> employed;
  for (atom const& x : s.atoms) employed.insert(x.agent);
  auto const idle = idle_agents(q, s.atoms).size();
  std::string out;
  auto const line = [&](std::string const& head, std::initializer_list<clause> which, std::string const& why) {
    bool const fails = std::any_of(which.begin(), which.end(), [&](clause c) { return report.violates(c); });
    out += "  " + padded(head, 18) + (fails ? "FAILS: " : "") + printable(why) + '\n';
  };
  line("(0) one plan", {clause::one_plan, clause::foreign_task, clause::stranger},
       of_pairs([&](atom const& x) { return x.plan == s.plan && p.find(x.task) != nullptr; }) + " have a task of " +
           q.where.name(file));
  line("(1)-(3) counts", {clause::cardinality}, counts);
  line("(4) one task", {clause::one_task},
       counted(employed.size(), "agent") + " with a task in " + counted(pairs, "pair"));
  line("(5) precondition", {clause::precondition},
       !file.precondition           ? "the plan has none"
       : file.precondition->empty() ? "taken to hold: the file does not spell it out"
                                    : "taken to hold, not evaluated: " + *file.precondition);
  auto const have = of_pairs([&](atom const& x) { return q.worth(q.who.name(x.agent), x.plan, x.task).has_value(); });
  line("(6) utility", {clause::utility, clause::forbidden_pair},
       q.costs          ? "what costs less counts more, never below 0, and " + have + " have a cost"
       : s.utility >= 0 ? number(s.utility) + " is at least 0, and " + have + " have a utility"
                        : number(s.utility) + " is below 0, and " + have + " have a utility");
  line("team size", {clause::team_size}, std::to_string(employed.size()) + " in " + interval(p.team_size()));
  line("role", {clause::role},
       "not applied: a table names no roles; an empty cell forbids" +
           (q.where.model.roles.empty() ? std::string()
                                        : " (" + counted(q.where.model.roles.size(), "role") + " in the files)"));
  line("idle", {clause::idle_forbidden},
       std::to_string(idle) +
           (q.problem.idle == idling::allowed ? ", and idling is allowed" : ", and nobody may idle"));
  return out;
}

std::string as_text(question const& q, solution<vocabulary> const& s, validity_report<vocabulary> const& report,
                    std::string const& current_file) {
  auto const& p = q.where.plan(s.plan);
  std::string out;
  auto const line = [&](std::string const& text) { out += printable(text) + '\n'; };
  line("plan     " + q.where.name(p) + " (" + std::to_string(p.id) + ")" +
       (q.where.type != nullptr ? ", best of " + counted(q.where.plans.size(), "plan") + " of " + q.where.type->name
                                : ""));
  if (q.costs)
    line("cost     " + number(total_of(q, s.atoms)) + " for " + counted(s.atoms.size(), "agent") + " with a task" +
         (s.proved                            ? ", proved optimal"
          : s.gap < q.costs->one_more_agent() ? ", at most " + number(s.gap) + " above the least"
                                              : "; perhaps more agents can have one"));
  else
    line("utility  " + number(s.utility) +
         (s.proved ? ", proved optimal" : ", at most " + number(s.gap) + " below the best"));
  if (s.runner_up) {
    auto const& next = *s.runner_up;
    line("next     " + q.where.name(q.where.plan(next.plan)) + " with " +
         (q.costs ? number(q.costs->cost(next.utility)) + " for " + counted(q.costs->employed(next.utility), "agent")
                  : number(next.utility) + ", " + number(next.distance) + " less"));
  }
  line("assignment");
  std::size_t width = 0;
  for (auto const a : q.problem.participants) width = std::max(width, q.who.name(a).size());
  for (atom const& x : s.atoms)
    line("  " + padded(q.who.name(x.agent), width) + "  " + q.task(x) + "  " + number(counted_cell(q, x)));
  for (auto const& name : idle_agents(q, s.atoms)) line("  " + padded(name, width) + "  (idle)");
  out += "valid, because\n" + clauses(q, s, report);
  if (!q.has_current) return out;
  line("event from " + current_file + " to this");
  auto const e = difference(q.current, s.atoms);
  if (e.empty()) line("  none: it is the same allocation");
  for (auto const& x : e)
    line(std::string("  ") + (x.value == sign::plus ? "+ " : "- ") + q.who.name(x.atom.agent) + "  " +
         (q.where.type != nullptr ? q.where.name(q.where.plan(x.atom.plan)) + '/' : "") + q.task(x.atom));
  for (auto const& name : q.departed) line("  " + name + " is not in the table: it left");
  auto const d = decide(q, s);
  line("decision");
  line(std::string("  a running team ") +
       (!d.keep     ? "adopts this: "
        : e.empty() ? "keeps it: "
                    : "keeps what it has in " + current_file + ", without the event above: ") +
       d.reason);
  return out;
}

std::string as_text(search_report const& r) {
  auto const& w = r.work;
  char time[32];
  std::snprintf(time, sizeof time, "%.1f us", r.microseconds);
  return "search\n  " + counted(w.searches, "shortest-path tree") + ", " + counted(w.augmentations, "chain") +
         " of agents moved, " + counted(w.relaxations, "step") + "\n  " + counted(w.nodes, "placement") +
         " by branch and bound, " + counted(w.leaves, "allocation") + " evaluated, " + counted(w.pruned, "subtree") +
         " left\n  " + time + '\n';
}

}  // namespace

outcome run_allocate(allocate_options const& o) {
  auto const where = find_target(o.plans, o.plan_type);
  utilities const worth{read_utilities(o.utilities), *where, o.utilities};
  named_allocation old;
  if (!o.current.empty()) old = read_allocation(o.current);
  std::vector<std::string> departed;
  for (auto const& pair : old.assignment)
    if (!std::binary_search(worth.agents().begin(), worth.agents().end(), pair.agent)) departed.push_back(pair.agent);
  roster const who{worth.agents(), departed};

  std::optional<cost_scale> costs;
  if (o.minimise) costs.emplace(worth.table(), o.utilities);
  auto const type = build_type(*where, who, worth, costs);
  team<vocabulary> members;
  for (auto const a : who.present()) members.add(a);
  no_beliefs const beliefs;
  problem<vocabulary, no_beliefs> p{type, members, beliefs, o.no_idle ? idling::forbidden : idling::allowed};
  question const q{*where,  who, worth, costs, type, p, atoms_of(old, *where, who, o.current), !o.current.empty(),
                   departed};
  p.current = q.current.atoms();

  workspace work;
  using clock = std::chrono::steady_clock;
  auto const start = clock::now();
  auto const late = [&, limit = std::chrono::duration<double, std::milli>(o.deadline.value_or(0))] {
    return clock::now() - start >= limit;
  };
  search_budget budget;
  if (o.budget) budget.nodes = budget.relaxations = *o.budget;
  if (o.deadline) budget.stop = late;
  auto const best = best_allocation(p, work, budget);
  std::chrono::duration<double, std::micro> const taken = clock::now() - start;
  if (!best) {
    std::string reason;
    for (auto const& r : best.error().plans) reason += (reason.empty() ? "" : "; ") + explain(r, q);
    if (o.json) return {refusal_as_json(reason), negative};
    return {"no valid allocation: " + printable(reason) + '\n', negative};
  }
  auto const report = validate(p, *type.find(best->plan), best->atoms);
  if (!report) throw std::logic_error("the allocation found is not valid: please report this");
  std::optional<search_report> stats;
  if (o.stats) stats = search_report{best->work, taken.count()};
  if (!o.json) return {as_text(q, *best, report, o.current) + (stats ? as_text(*stats) : ""), success};
  auto answer = named(q, *best);
  answer.stats = stats;
  return {as_json(answer), success};
}

}  // namespace rota::cli
