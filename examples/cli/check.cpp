#include "command.hpp"
#include "json.hpp"
#include "load.hpp"
#include "text.hpp"

#include <rota/adapters/alica/text.hpp>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace rota::cli {
namespace {

using alica::severity;

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

}  // namespace

outcome run_check(check_options const& o) {
  std::vector<std::filesystem::path> paths;
  for (auto const& p : o.paths) {
    std::error_code error;
    if (std::filesystem::symlink_status(p, error).type() == std::filesystem::file_type::not_found)
      throw input_error(p, "", "no such file or folder");
    if (alica::detail::kind_of(p) == alica::file_kind::none && !std::filesystem::is_directory(p, error))
      throw input_error(p, "", std::string(alica::detail::why_ignored(p)));
    paths.emplace_back(p);
  }
  auto const m = load_plans(paths);
  for (auto const& p : o.paths)
    if (std::none_of(m.documents.begin(), m.documents.end(), [&](alica::document const& d) {
          return d.file.starts_with(p) &&
                 (d.status == alica::file_status::refused || alica::detail::kind_of(d.file) != alica::file_kind::none);
        }))
      throw input_error(p, "", "no plan file in this folder");
  return {o.json ? as_json(m) : as_text(m), m.count(severity::error) == 0 ? success : negative};
}

}  // namespace rota::cli
