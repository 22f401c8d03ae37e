#include "json.hpp"

#include "command.hpp"
#include "load.hpp"
#include "playing.hpp"
#include "table.hpp"

#include <rota/adapters/alica/text.hpp>

#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <set>
#include <utility>

namespace rota::cli {
namespace {

using alica::severity;
using alica::detail::in_quotes;
using nlohmann::ordered_json;

// Objects are filled member by member, because nested braces take the compiler twenty times as long.

template <class T>
ordered_json or_null(std::optional<T> const& x) {
  return x ? ordered_json(*x) : ordered_json(nullptr);
}

/// "none" is null.
template <class Enum>
ordered_json word(Enum e) {
  return e == Enum::none ? ordered_json(nullptr) : ordered_json(to_string(e));
}

/// A list with one entry for each item.
template <class Range, class Convert>
ordered_json list_of(Range const& all, Convert const& convert) {
  auto out = ordered_json::array();
  for (auto const& x : all) out.push_back(convert(x));
  return out;
}

ordered_json json_of(cardinality c) {
  ordered_json out;
  out["min"] = c.lower();
  out["max"] = nullptr;
  if (c.is_bounded()) out["max"] = c.upper();
  return out;
}

ordered_json json_of(alica::document const& d) {
  ordered_json out;
  out["file"] = d.file;
  out["status"] = to_string(d.status);
  out["kind"] = word(d.kind);
  out["format"] = word(d.format);
  out["id"] = or_null(d.id);
  out["name"] = d.name;
  return out;
}

ordered_json json_of(alica::plan const& p) {
  ordered_json out;
  out["plan"] = p.name;
  out["id"] = p.id;
  out["file"] = p.file;
  out["tasks"] = list_of(p.entry_points, [&](alica::entry_point const& e) {
    ordered_json task;
    task["task"] = label(p, e);
    task["id"] = e.task;
    task["entry_point"] = e.id;
    task["cardinality"] = json_of(e.bounds);
    task["state"] = e.state_name;
    return task;
  });
  out["team_size"] = json_of(p.team_size);
  out["utility_threshold"] = p.utility_threshold;
  out["precondition"] = or_null(p.precondition);
  return out;
}

ordered_json json_of(alica::plan_type const& t, alica::model const& m) {
  ordered_json out;
  out["plan_type"] = t.name;
  out["id"] = t.id;
  out["file"] = t.file;
  out["plans"] = list_of(t.plans, [&](alica::plan_choice const& c) {
    ordered_json choice;
    choice["plan"] = choice_name(m, t, c);
    choice["id"] = c.plan;
    choice["activated"] = c.activated;
    return choice;
  });
  return out;
}

ordered_json json_of(alica::task const& t) {
  ordered_json out;
  out["task"] = t.name;
  out["id"] = t.id;
  out["file"] = t.file;
  return out;
}

ordered_json json_of(alica::role const& r, alica::model const& m) {
  ordered_json out;
  out["role"] = r.name;
  out["id"] = r.id;
  out["file"] = r.file;
  out["default_priority"] = r.default_priority;
  out["priorities"] = list_of(r.priorities, [&](alica::task_priority const& p) {
    auto const* t = m.find_task(r.root, p.task);
    ordered_json priority;
    priority["task"] = t != nullptr ? t->name : std::string();
    priority["id"] = p.task;
    priority["priority"] = p.priority;
    return priority;
  });
  return out;
}

ordered_json json_of(alica::diagnostic const& d) {
  ordered_json out;
  out["severity"] = to_string(d.severity);
  out["file"] = d.file;
  out["place"] = d.place;
  out["id"] = or_null(d.id);
  out["reason"] = d.reason;
  return out;
}

ordered_json json_of(named_change const& c) {
  ordered_json out;
  out["agent"] = c.agent;
  if (c.plan) out["plan"] = *c.plan;
  out["task"] = c.task;
  return out;
}

ordered_json json_of(sim::length_statistics const& s) {
  ordered_json out;
  out["median"] = s.percentile_ms(50);
  out["p99"] = s.percentile_ms(99);
  out["max"] = s.longest_ms();
  return out;
}

ordered_json json_of(sim::scenario what, std::string_view resolution, sim::figures const& f) {
  ordered_json out;
  out["name"] = to_string(what);
  out["resolution"] = resolution;
  out["conflict_share"] = f.conflict_share();
  out["episodes"] = f.episodes.count();
  out["episode_ms"] = json_of(f.episodes);
  out["cycles"] = f.cycles;
  out["detections"] = f.detections;
  out["reigns"] = f.reigns;
  out["renewals"] = f.renewals;
  out["right_share"] = nullptr;
  if (f.terms() > 0) out["right_share"] = f.right_share();
  out["resolved"] = f.resolved();
  out["right"] = f.right;
  auto led = ordered_json::object();
  for (std::size_t i = 0; i < f.led.size(); ++i)
    if (f.led[i] > 0) led[std::to_string(i + 1)] = f.led[i];
  out["led"] = std::move(led);
  out["measured_ns"] = f.measured.ns;
  out["in_conflict_ns"] = f.in_conflict.ns;
  out["deliberations"] = f.deliberations;
  out["broadcasts"] = f.messages;
  out["perception_digest"] = std::to_string(f.perception_digest);
  auto const& p = f.pursuit;
  out["not_one_attacker_share"] = f.not_one_share();
  out["wrong_attacker_share"] = f.wrong_share();
  out["reactions"] = p.reactions.count();
  out["reaction_ms"] = nullptr;
  if (p.reactions.count() > 0)
    out["reaction_ms"] = {{"mean", p.reactions.mean_ms()}, {"p95", p.reactions.percentile_ms(95)}};
  out["missed_changes"] = p.missed;
  return out;
}

}  // namespace

std::string as_json(alica::model const& m) {
  auto const plain = [](auto const& x) { return json_of(x); };
  auto const within = [&](auto const& x) { return json_of(x, m); };
  ordered_json out;
  out["files"] = list_of(m.documents, plain);
  out["plans"] = list_of(m.plans, plain);
  out["plan_types"] = list_of(m.plan_types, within);
  out["tasks"] = list_of(m.tasks, plain);
  out["roles"] = list_of(m.roles, within);
  out["diagnostics"] = list_of(m.diagnostics, plain);
  out["errors"] = m.count(severity::error);
  out["warnings"] = m.count(severity::warning);
  out["ignored"] = m.count(severity::ignored);
  // File names need not be UTF-8; JSON does.
  return out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

std::string as_json(named_answer const& a) {
  auto const change = [](named_change const& c) { return json_of(c); };
  ordered_json out;
  out["plan"] = a.plan;
  out[a.cost ? "cost" : "utility"] = a.cost.value_or(a.utility);
  out["optimal"] = a.optimal;
  if (!a.optimal) out["gap"] = a.gap;
  out["assignment"] = list_of(
      a.assignment, [](auto const& pair) { return json_of(named_change{pair.first, std::nullopt, pair.second}); });
  out["idle"] = a.idle;
  out["event"]["added"] = list_of(a.added, change);
  out["event"]["removed"] = list_of(a.removed, change);
  if (a.decision) {
    out["decision"]["keep"] = a.decision->keep;
    out["decision"]["reason"] = a.decision->reason;
  }
  if (a.stats) {
    auto& stats = out["stats"];
    auto const& work = a.stats->work;
    stats["searches"] = work.searches;
    stats["augmentations"] = work.augmentations;
    stats["relaxations"] = work.relaxations;
    stats["nodes"] = work.nodes;
    stats["leaves"] = work.leaves;
    stats["pruned"] = work.pruned;
    stats["microseconds"] = a.stats->microseconds;
  }
  return out.dump() + '\n';
}

std::string refusal_as_json(std::string const& reason) {
  ordered_json out;
  out["plan"] = nullptr;
  out["reason"] = reason;
  return out.dump() + '\n';
}

named_allocation read_allocation(std::string const& file) {
  auto const tree = parse_json(read_text(file), file);

  auto const need = [&](bool holds, std::string const& place, std::string const& reason) {
    if (!holds) throw input_error(file, place, reason);
  };
  need(tree.is_object(), "/", "not an allocation: a JSON object is expected");
  for (auto const& [key, value] : tree.items()) {
    using type = nlohmann::json::value_t;
    // The program does not use what it prints beside the allocation, but checks its types.
    static std::map<std::string, type, std::less<>> const keys = {
        {"plan", type::discarded},    {"utility", type::number_float}, {"optimal", type::boolean},
        {"cost", type::number_float}, {"assignment", type::array},     {"idle", type::array},
        {"event", type::object},      {"decision", type::object},      {"reason", type::string},
        {"gap", type::number_float},  {"stats", type::object}};
    auto const at = keys.find(key);
    need(at != keys.end(), '/' + key, "an allocation has no such key");
    bool const fits = at->second == type::discarded || at->second == value.type() ||
                      (at->second == type::number_float && value.is_number());
    need(fits, '/' + key,
         at->second == type::number_float ? "not a number"
         : at->second == type::boolean    ? "neither true nor false"
         : at->second == type::array      ? "not a list"
         : at->second == type::string     ? "not a text"
                                          : "not an object");
  }
  need(tree.contains("plan"), "/", "the key \"plan\" is missing");
  named_allocation a;
  auto const& plan = tree["plan"];
  need(plan.is_null() || plan.is_string(), "/plan", "neither a name nor null");
  if (plan.is_string()) a.plan = plan.get<std::string>();
  need(!a.plan || !a.plan->empty(), "/plan", "a plan without a name");
  need(tree.contains("assignment") || !a.plan, "/", "the key \"assignment\" is missing");
  if (!tree.contains("assignment")) return a;
  auto const& all = tree["assignment"];
  need(a.plan || all.empty(), "/assignment", "tasks without a plan");
  std::set<std::string> agents;
  for (std::size_t i = 0; i < all.size(); ++i) {
    auto const place = "/assignment/" + std::to_string(i);
    need(all[i].is_object(), place, "not an object");
    for (auto const& [key, value] : all[i].items())
      need(key == "agent" || key == "task", place + '/' + key, "only \"agent\" and \"task\" belong here");
    for (auto const* key : {"agent", "task"}) {
      need(all[i].contains(key), place, "the key \"" + std::string(key) + "\" is missing");
      need(all[i][key].is_string() && !all[i][key].get_ref<std::string const&>().empty(), place + '/' + key,
           "not a name");
    }
    a.assignment.push_back({all[i]["agent"].get<std::string>(), all[i]["task"].get<std::string>(), place});
    need(agents.insert(a.assignment.back().agent).second, place,
         "the agent " + in_quotes(a.assignment.back().agent) + " has two tasks");
  }
  if (!tree.contains("idle")) return a;
  auto const& idle = tree["idle"];
  for (std::size_t i = 0; i < idle.size(); ++i) {
    auto const place = "/idle/" + std::to_string(i);
    need(idle[i].is_string() && !idle[i].get_ref<std::string const&>().empty(), place, "not a name");
    auto const name = idle[i].get<std::string>();
    need(agents.insert(name).second, place, "the agent " + in_quotes(name) + " stands twice");
  }
  return a;
}

std::string as_json(sim::scenario what, bool resolution, std::uint64_t seed, std::string const& stamp,
                    sim::figures const& f) {
  auto out = json_of(what, resolution ? "on" : "off", f);
  out["seed"] = seed;
  out["stamp"] = stamp;
  return out.dump(2) + '\n';
}

std::string as_json(evaluation const& e, std::uint64_t seed, std::string const& stamp) {
  ordered_json timing;
  timing["two_cycles_ms"] = e.timing.two_cycles_ms;
  timing["four_cycles_ms"] = e.timing.four_cycles_ms;
  timing["two_cycles_ms_at_200"] = e.timing_at_200.two_cycles_ms;
  timing["four_cycles_ms_at_200"] = e.timing_at_200.four_cycles_ms;
  timing["two_detected_ms"] = e.timing.two_detected_ms;
  timing["four_detected_ms"] = e.timing.four_detected_ms;
  timing["samples"] = e.timing.samples;
  auto scenarios = ordered_json::array();
  for (auto const& r : e.rows) {
    scenarios.push_back(json_of(r.what, "off", r.off));
    scenarios.push_back(json_of(r.what, "as published", r.published));
    if (r.on) scenarios.push_back(json_of(r.what, "on", *r.on));
  }
  ordered_json out;
  out["timing"] = std::move(timing);
  out["scenarios"] = std::move(scenarios);
  out["seed"] = seed;
  out["stamp"] = stamp;
  return out.dump(2) + '\n';
}

std::string as_json(std::vector<monitor_row> const& rows, std::uint64_t seed) {
  ordered_json out;
  auto list = ordered_json::array();
  for (auto const& r : rows) {
    ordered_json row;
    row["monitor"] = r.name;
    row["cycles"] = r.cycles;
    row["detection_ms"] = r.detection_ms;
    row["fights_missed"] = r.fights_missed;
    row["missed"] = r.missed;
    row["false_alarms_per_robot_minute"] = r.alarms;
    list.push_back(std::move(row));
  }
  out["monitors"] = std::move(list);
  out["seed"] = seed;
  return out.dump(2) + '\n';
}

std::string as_json(std::vector<budget_row> const& rows, std::uint64_t seed) {
  ordered_json out;
  auto list = ordered_json::array();
  for (auto const& r : rows) {
    ordered_json row;
    row["wanted_per_second"] = r.wanted;
    row["news_at_once"] = r.news;
    row["sent_per_second"] = r.sent;
    row["conflict_share"] = r.conflict;
    row["episode_ms"]["median"] = r.median_ms;
    row["episode_ms"]["p99"] = r.p99_ms;
    row["sent_per_second_fighting"] = r.fight_sent;
    row["detection_ms"] = std::vector<double>{r.detected_ms, r.detected_20_ms, r.detected_60_ms};
    row["taken_over_ms"] = r.taken_over_ms;
    row["false_alarms_per_robot_minute"] = r.alarms;
    row["silence_s"] = r.silence_s;
    list.push_back(std::move(row));
  }
  out["budgets"] = std::move(list);
  out["seed"] = seed;
  return out.dump(2) + '\n';
}

std::string as_json(campaign_summary const& s) {
  ordered_json seen;
  for (auto const& [what, times] : s.seen) seen[what] = times;
  ordered_json out;
  out["kept"] = !s.broken;
  if (s.broken) {
    out["broken"]["promise"] = s.broken->promise;
    out["broken"]["at_ms"] = s.broken->at_ms;
    out["broken"]["robot"] = s.broken->robot;
    out["broken"]["reason"] = s.broken->reason;
    out["broken"]["again"] = s.broken->again;
  }
  out["runs"] = s.runs;
  out["seen"] = std::move(seen);
  out["seed"] = s.seed;
  return out.dump(2) + '\n';
}

std::string as_json(std::vector<fault_row> const& rows, std::uint64_t runs, std::uint64_t seed) {
  auto list = ordered_json::array();
  for (auto const& r : rows) {
    ordered_json row;
    row["figure"] = r.name;
    row["here"] = r.here;
    row["wanted"] = r.wanted ? ordered_json(*r.wanted) : ordered_json();
    row["unit"] = r.share ? "1" : "ms";
    list.push_back(std::move(row));
  }
  ordered_json out;
  out["figures"] = std::move(list);
  out["runs"] = runs;
  out["seed"] = seed;
  return out.dump(2) + '\n';
}

namespace {

/// What a cell consists of, for writing and for reading: `field(key, member)`.
template <class Cell, class Field>
void each_field(Cell& c, Field const& field) {
  field("trouble", c.trouble);
  field("robots", c.robots);
  field("loss", c.loss);
  field("period_ms", c.period_ms);
  field("system", c.system);
  field("cycles", c.cycles);
  field("reign", c.reign);
  field("reign_s", c.reign_s);
  field("stamp", c.stamp);
  field("news", c.news);
  field("hysteresis", c.hysteresis);
  field("change_cost", c.change_cost);
  field("minutes", c.minutes);
}

ordered_json json_of(estimate const& e) {
  ordered_json out;
  out["mean"] = e.games > 0 ? ordered_json(e.mean) : ordered_json();
  out["within"] = or_null(e.within);
  out["games"] = e.games;
  return out;
}

}  // namespace

std::string as_json(std::vector<stamp_cell> const& cells, std::uint64_t seed, std::uint64_t seeds) {
  auto list = ordered_json::array();
  for (auto const& c : cells) {
    ordered_json cell;
    cell["stamp"] = c.stamp;
    cell["possible"] = c.possible;
    cell["scenario"] = c.scenario;
    cell["right_share"] = json_of(c.right);
    cell["wrong_attacker_share"] = json_of(c.wrong);
    cell["not_one_attacker_share"] = json_of(c.not_one);
    cell["conflict_share"] = json_of(c.conflict);
    cell["reaction_mean_ms"] = json_of(c.reaction_ms);
    cell["reaction_p95_ms"] = json_of(c.reaction_p95_ms);
    cell["missed_share"] = json_of(c.missed);
    list.push_back(std::move(cell));
  }
  ordered_json out;
  out["stamps"] = std::move(list);
  out["seed"] = seed;
  out["seeds"] = seeds;
  return out.dump(2) + '\n';
}

std::string as_json(sweep_table const& t) {
  auto list = ordered_json::array();
  for (auto const& l : t.lines) {
    ordered_json line;
    each_field(l.cell, [&](char const* key, auto const& value) { line[key] = value; });
    for (std::size_t m = 0; m < quantities; ++m) {
      line[std::string(name_of(static_cast<quantity>(m)))] = json_of(l.figures[m]);
    }
    list.push_back(std::move(line));
  }
  ordered_json out;
  out["table"] = t.name.empty() ? ordered_json() : ordered_json(t.name);
  out["plan"] = t.plan;
  out["lines"] = std::move(list);
  out["seeds"] = t.seeds;
  out["seed"] = t.seed;
  return out.dump(2) + '\n';
}

std::string_view row_start() { return R"({"rota_sweep":1,)"; }

std::string as_line(sweep_row const& row) {
  ordered_json out;
  out["rota_sweep"] = 1;
  out["version"] = row.version;
  out["plan"] = row.plan;
  each_field(row.cell, [&](char const* key, auto const& value) { out[key] = value; });
  out["seed"] = row.seed;
  for (std::size_t m = 0; m < kept_quantities; ++m)
    out[std::string(name_of(static_cast<quantity>(m)))] = or_null(row.figures[m]);
  return out.dump();
}

std::optional<sweep_row> read_row(std::string const& line) {
  if (!line.starts_with(row_start())) return std::nullopt;
  auto const tree = nlohmann::json::parse(line, nullptr, false);
  if (!tree.is_object() || tree.size() != 17 + kept_quantities) return std::nullopt;
  sweep_row row;
  bool sound = true;
  auto const read = [&](char const* key, auto& into) {
    using type = std::remove_cvref_t<decltype(into)>;
    auto const at = tree.find(key);
    sound = sound && at != tree.end() &&
            (std::is_same_v<type, std::string> ? at->is_string()
             : std::is_same_v<type, double>    ? at->is_number()
                                               : at->is_number_unsigned());
    if (sound) into = at->template get<type>();
  };
  read("version", row.version);
  read("plan", row.plan);
  each_field(row.cell, read);
  read("seed", row.seed);
  for (std::size_t m = 0; m < kept_quantities && sound; ++m) {
    auto const at = tree.find(std::string(name_of(static_cast<quantity>(m))));
    sound = at != tree.end() && (at->is_null() || at->is_number());
    if (sound && at->is_number()) row.figures[m] = at->get<double>();
  }
  if (!sound) return std::nullopt;
  return row;
}

}  // namespace rota::cli
