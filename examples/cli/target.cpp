#include "target.hpp"

#include "command.hpp"
#include "load.hpp"
#include "text.hpp"

#include <rota/adapters/alica/convert.hpp>
#include <rota/adapters/alica/text.hpp>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

namespace rota::cli {
namespace {

using alica::detail::in_quotes;

[[noreturn]] void complain_of(alica::model const& m, alica::diagnostic const& d) {
  auto const errors = m.count(alica::severity::error);
  auto const more = errors > 1 ? " (and " + std::to_string(errors - 1) + " more: rota check)" : "";
  throw input_error(d.file, d.place, d.reason + (d.id ? " (id " + std::to_string(*d.id) + ')' : "") + more);
}

/// Ends because there is no plan to allocate: with the first error of the files, if they have one, else with what is missing.
[[noreturn]] void give_up(alica::model const& m, std::string const& files, std::string const& missing) {
  for (alica::diagnostic const& d : m.diagnostics)
    if (d.severity == alica::severity::error) complain_of(m, d);
  throw input_error(files, "", missing);
}

/// Throws for an error in any of these files.
void require_sound(alica::model const& m, std::set<std::string> const& files) {
  for (alica::diagnostic const& d : m.diagnostics)
    if (d.severity == alica::severity::error && files.contains(d.file)) complain_of(m, d);
}

}  // namespace

alica::plan const& target::plan(vocabulary::plan p) const {
  return **std::find_if(plans.begin(), plans.end(), [&](auto const* x) { return x->id == p.value; });
}

std::string target::name(alica::plan const& p) const {
  auto const same = std::count_if(plans.begin(), plans.end(), [&](auto const* x) { return x->name == p.name; });
  return p.name.empty() || same > 1 ? p.name + '#' + std::to_string(p.id) : p.name;
}

std::string target::name(alica::plan const& p, vocabulary::task t) const {
  for (auto const& e : p.entry_points)
    if (task_key(p, e) == t) return label(p, e);
  return '#' + std::to_string(t.value);
}

std::optional<vocabulary::task> target::find_task(alica::plan const& p, std::string const& wanted) const {
  for (auto const& e : p.entry_points)
    if (label(p, e) == wanted) return task_key(p, e);
  return std::nullopt;
}

std::unique_ptr<target const> find_target(std::vector<std::string> const& files, std::string const& plan_type) {
  std::vector<std::filesystem::path> paths;
  std::set<std::string> named;  // themselves, not by their folder
  bool names_a_type = false;
  for (auto const& f : files) {
    std::error_code error;
    if (!std::filesystem::exists(f, error)) throw input_error(f.empty() ? "\"\"" : f, "", "no such file or folder");
    paths.emplace_back(f);
    if (std::filesystem::is_directory(f, error)) continue;
    auto const kind = alica::detail::kind_of(f);
    if (kind == alica::file_kind::none) throw input_error(f, "", std::string(alica::detail::why_ignored(f)));
    names_a_type = names_a_type || kind == alica::file_kind::plan_type;
    named.insert(f);
  }
  auto t = std::make_unique<target>();
  t->model = load_plans(paths);
  auto const& m = t->model;
  require_sound(m, named);

  std::set<std::string> given;
  std::set<std::string> refused_plans;
  for (auto const& d : m.documents) {
    if (d.followed) continue;
    given.insert(d.file);
    if (d.kind == alica::file_kind::plan && d.status == alica::file_status::refused) refused_plans.insert(d.file);
  }
  if (plan_type.empty()) {
    std::vector<std::string> plans;
    for (auto const& p : m.plans) {
      if (!given.contains(p.file)) continue;
      t->plans.push_back(&p);
      plans.push_back(p.name);
    }
    std::vector<std::string> types;
    for (auto const& pt : m.plan_types) {
      if (!given.contains(pt.file)) continue;
      t->type = &pt;
      types.push_back(pt.name);
    }
    if (types.size() > 1 && (names_a_type || plans.empty()))
      throw input_error(joined(files), "",
                        std::to_string(types.size()) + " plan types (" + joined(types) + "): name one by --plan-type");
    if (types.size() != 1 || !(names_a_type || plans.empty())) {
      t->type = nullptr;
      if (plans.empty()) give_up(m, joined(files), "no plan in it");
      if (plans.size() > 1)
        throw input_error(joined(files), "",
                          std::to_string(plans.size()) + " plans (" + joined(plans) +
                              "): give one, or --plan-type with the plan type that offers them");
      require_sound(m, refused_plans);  // the folder has a plan with errors, which may be the one that was meant
      return t;
    }
  } else {
    for (auto const& pt : m.plan_types) {
      if (pt.name != plan_type && std::to_string(pt.id) != plan_type) continue;
      if (t->type != nullptr)
        throw input_error(joined(files), "",
                          "two plan types are called " + in_quotes(plan_type) + ": name one by its id");
      t->type = &pt;
    }
    if (t->type == nullptr) give_up(m, joined(files), "no plan type is called " + in_quotes(plan_type));
  }
  t->plans.clear();
  for (auto const& c : t->type->plans)
    if (c.activated) t->plans.push_back(m.find_plan(t->type->root, c.plan));
  return t;
}

roster::roster(std::vector<std::string> const& present, std::vector<std::string> const& departed) {
  for (auto const* names : {&present, &departed})
    for (auto const& n : *names) ids_.emplace(n, vocabulary::agent{});
  std::uint64_t next = 0;
  for (auto& [name, id] : ids_) {
    id = {++next};
    names_.emplace(id, &name);
  }
  for (auto const& n : present) present_.push_back(ids_.at(n));
  std::sort(present_.begin(), present_.end());
}

utilities::utilities(utility_table table, target const& t, std::string const& file) : table_(std::move(table)) {
  std::map<std::string, std::pair<vocabulary::plan, vocabulary::task>> known;
  std::vector<std::string> names;
  for (auto const* p : t.plans)
    for (auto const& e : p->entry_points) {
      auto const& name = names.emplace_back((t.type != nullptr ? t.name(*p) + '/' : "") + label(*p, e));
      known.emplace(name, std::pair{vocabulary::plan{p->id}, task_key(*p, e)});
    }
  for (std::size_t i = 0; i < table_.columns.size(); ++i) {
    auto const& c = table_.columns[i];
    auto const at = known.find(c.text);
    if (at == known.end())
      throw input_error(file, c.place(), "no task is called " + in_quotes(c.text) + "; there are " + joined(names));
    columns_.emplace(at->second, i);
  }
  std::vector<std::string> missing;
  for (auto const& name : names)
    if (!columns_.contains(known.at(name))) missing.push_back(name);
  if (!missing.empty())
    throw input_error(file, "1:1",
                      "no column for " + joined(missing) + "; to forbid a task to everybody, leave its cells empty");
  for (std::size_t i = 0; i < table_.agents.size(); ++i) rows_.emplace(table_.agents[i], i);
}

std::optional<double> utilities::operator()(std::string const& agent, vocabulary::plan p, vocabulary::task t) const {
  auto const row = rows_.find(agent);
  auto const column = columns_.find({p, t});
  if (row == rows_.end() || column == columns_.end()) return std::nullopt;
  return table_.cells[row->second][column->second];
}

}  // namespace rota::cli
