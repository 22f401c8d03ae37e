#include "command.hpp"
#include "text.hpp"

#include <rota/adapters/alica.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

namespace rota::cli {
namespace {

using alica::severity;
using nlohmann::ordered_json;

struct options {
  std::vector<std::string> paths;
  bool json = false;
};

ordered_json bounds_of(cardinality c) {
  return {{"min", c.min()}, {"max", c.is_bounded() ? ordered_json(c.max()) : ordered_json(nullptr)}};
}

std::string choice_name(alica::model const& m, alica::plan_type const& t, alica::plan_choice const& c) {
  auto const* p = m.find_plan(t.root, c.plan);
  return p != nullptr && !p->name.empty() ? p->name : std::to_string(c.plan);
}

std::string as_json(alica::model const& m) {
  ordered_json out;
  out["files"] = ordered_json::array();
  for (auto const& d : m.documents)
    out["files"].push_back(
        {{"file", d.file},
         {"status", to_string(d.status)},
         {"kind", d.kind == alica::file_kind::none ? ordered_json(nullptr) : ordered_json(to_string(d.kind))},
         {"format", d.format == alica::file_format::none ? ordered_json(nullptr) : ordered_json(to_string(d.format))},
         {"id", d.id ? ordered_json(*d.id) : ordered_json(nullptr)},
         {"name", d.name}});
  out["plans"] = ordered_json::array();
  for (auto const& p : m.plans) {
    auto tasks = ordered_json::array();
    for (auto const& e : p.entry_points)
      tasks.push_back({{"task", label(p, e)},
                       {"id", e.task},
                       {"entry_point", e.id},
                       {"cardinality", bounds_of(e.bounds)},
                       {"state", e.state_name}});
    out["plans"].push_back({{"plan", p.name},
                            {"id", p.id},
                            {"file", p.file},
                            {"tasks", tasks},
                            {"team_size", bounds_of(p.team_size)},
                            {"utility_threshold", p.utility_threshold},
                            {"precondition", p.precondition ? ordered_json(*p.precondition) : ordered_json(nullptr)}});
  }
  out["plan_types"] = ordered_json::array();
  for (auto const& t : m.plan_types) {
    auto plans = ordered_json::array();
    for (auto const& c : t.plans)
      plans.push_back({{"plan", choice_name(m, t, c)}, {"id", c.plan}, {"activated", c.activated}});
    out["plan_types"].push_back({{"plan_type", t.name}, {"id", t.id}, {"file", t.file}, {"plans", plans}});
  }
  out["tasks"] = ordered_json::array();
  for (auto const& t : m.tasks) out["tasks"].push_back({{"task", t.name}, {"id", t.id}, {"file", t.file}});
  out["roles"] = ordered_json::array();
  for (auto const& r : m.roles) {
    auto priorities = ordered_json::array();
    for (auto const& p : r.priorities) {
      auto const* t = m.find_task(r.root, p.task);
      priorities.push_back({{"task", t != nullptr ? t->name : ""}, {"id", p.task}, {"priority", p.priority}});
    }
    out["roles"].push_back({{"role", r.name},
                            {"id", r.id},
                            {"file", r.file},
                            {"default_priority", r.default_priority},
                            {"priorities", priorities}});
  }
  out["diagnostics"] = ordered_json::array();
  for (auto const& d : m.diagnostics)
    out["diagnostics"].push_back({{"severity", to_string(d.severity)},
                                  {"file", d.file},
                                  {"place", d.place},
                                  {"id", d.id ? ordered_json(*d.id) : ordered_json(nullptr)},
                                  {"reason", d.reason}});
  out["errors"] = m.count(severity::error);
  out["warnings"] = m.count(severity::warning);
  out["ignored"] = m.count(severity::ignored);
  // File names need not be UTF-8; JSON does.
  return out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

std::string as_text(alica::model const& m) {
  std::string out;
  auto const line = [&](std::string const& s) { out += printable(s) + '\n'; };
  auto const head = [&](std::string const& what, std::string const& name, alica::identity id, std::string const& file) {
    line(what + ' ' + (name.empty() ? "(no name)" : name) + "  id " + std::to_string(id) + "  " + file);
  };
  for (auto const& p : m.plans) {
    head("plan", p.name, p.id, p.file);
    std::size_t width = 0;
    for (auto const& e : p.entry_points) width = std::max(width, label(p, e).size());
    for (auto const& e : p.entry_points)
      line("  " + padded(label(p, e), width) + "  " + interval(e.bounds) +
           (e.state_name.empty() ? "" : "  enters at " + e.state_name));
    line("  team " + interval(p.team_size) + ", hysteresis " + number(p.utility_threshold));
    if (p.precondition)
      line(p.precondition->empty() ? "  a precondition that the file does not spell out"
                                   : "  precondition " + *p.precondition);
  }
  for (auto const& t : m.plan_types) {
    head("plan type", t.name, t.id, t.file);
    for (auto const& c : t.plans)
      line("  " + choice_name(m, t, c) + (c.activated ? "" : "  (not activated: no choice)"));
  }
  for (auto const& d : m.documents) {
    if (d.kind != alica::file_kind::task_repository || d.status != alica::file_status::loaded) continue;
    std::string names;
    std::size_t n = 0;
    for (auto const& t : m.tasks)
      if (t.file == d.file) names += (n++ == 0 ? "" : ", ") + t.name;
    head("tasks", d.name, d.id.value_or(0), d.file);
    line("  " + (n == 0 ? "none" : names));
  }
  for (auto const& r : m.roles) {
    head("role", r.name, r.id, r.file);
    for (auto const& p : r.priorities) {
      auto const* t = m.find_task(r.root, p.task);
      line("  " + (t != nullptr ? t->name : std::to_string(p.task)) + "  " + number(p.priority) +
           (p.priority < 0 ? "  (forbidden)" : ""));
    }
    line("  every other task  " + number(r.default_priority));
  }
  for (auto const& d : m.documents)
    if (d.status == alica::file_status::listed)
      line(std::string(to_string(d.kind)) + "  " + d.file + "  (nothing in it concerns allocation)");
  for (auto const s : {severity::ignored, severity::warning, severity::error})
    for (auto const& d : m.diagnostics)
      if (d.severity == s)
        line(std::string(to_string(s)) + ": " + d.file + (d.place.empty() ? "" : ':' + d.place) + ": " + d.reason +
             (d.id ? " (id " + std::to_string(*d.id) + ')' : ""));
  std::size_t of_status[4] = {};
  for (auto const& d : m.documents) ++of_status[static_cast<std::size_t>(d.status)];
  out += counted(m.documents.size(), "file") + ": " + std::to_string(of_status[0]) + " loaded, " +
         std::to_string(of_status[1]) + " listed, " + std::to_string(of_status[2]) + " refused, " +
         std::to_string(of_status[3]) + " ignored; " + counted(m.plans.size(), "plan") + ", " +
         counted(m.plan_types.size(), "plan type") + ", " + counted(m.tasks.size(), "task") + ", " +
         counted(m.roles.size(), "role") + "; " + counted(m.count(severity::warning), "warning") + ", " +
         counted(m.count(severity::error), "error") + '\n';
  return out;
}

outcome run_check(options const& o) {
  std::vector<std::filesystem::path> paths;
  for (auto const& p : o.paths) {
    std::error_code error;
    if (std::filesystem::symlink_status(p, error).type() == std::filesystem::file_type::not_found)
      throw input_error(p, "", "no such file or folder");
    if (alica::detail::kind_of(p) == alica::file_kind::none && !std::filesystem::is_directory(p, error))
      throw input_error(p, "", std::string(alica::detail::why_ignored(p)));
    paths.emplace_back(p);
  }
  auto const m = alica::load(paths);
  for (auto const& p : o.paths)
    if (std::none_of(m.documents.begin(), m.documents.end(), [&](alica::document const& d) {
          return d.file.starts_with(p) &&
                 (d.status == alica::file_status::refused || alica::detail::kind_of(d.file) != alica::file_kind::none);
        }))
      throw input_error(p, "", "no plan file in this folder");
  return {o.json ? as_json(m) : as_text(m), m.count(severity::error) == 0 ? success : negative};
}

}  // namespace

void add_check(CLI::App& program, chosen_command& chosen) {
  auto const o = std::make_shared<options>();
  auto* const command = program.add_subcommand("check", "Says what plan files hold and what is wrong with them");
  command->add_option("PATH", o->paths, "plan files, or folders with everything below them")
      ->required()
      ->check(check_not_empty);
  command->add_flag("--json", o->json, "print JSON");
  command->footer("Exit status: 0 nothing is wrong, 1 errors found in files, 2 misuse, no plan file.");
  command->callback([o, &chosen] { chosen = [o] { return run_check(*o); }; });
}

}  // namespace rota::cli
