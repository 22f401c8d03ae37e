#pragma once
/// @file
/// Reads the plan models of ALICA: JSON as written today, and the older XML.
///
/// It reads plans with their tasks and cardinalities, plan types, tasks and roles. It does not read behaviours, conditions
/// and state machines, but lists their files. `model::documents` has an entry for every file that was found.

#include <rota/adapters/alica/convert.hpp>
#include <rota/adapters/alica/model.hpp>
#include <rota/adapters/alica/resolve.hpp>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace rota::alica {
namespace detail {

/// Carries out one call of `load`.
class loader {
public:
  explicit loader(load_options const& limits) : limits_(limits) {}

  [[nodiscard]] model run(std::span<std::filesystem::path const> paths) {
    gather(paths);
    follow();
    std::sort(entries_.begin(), entries_.end(), [](entry const& a, entry const& b) {
      return a.shown != b.shown ? a.shown < b.shown : a.canonical < b.canonical;
    });
    check_repeated_ids(entries_);
    directory all{entries_, limits_};
    check_references(entries_, all);
    return assemble(all);
  }

private:
  void gather(std::span<std::filesystem::path const> paths) {
    std::vector<found_file> found;
    std::vector<fs::path> folders;
    for (auto const& given : paths) {
      std::error_code error;
      auto real = fs::canonical(given, error);
      if (!error) folders.push_back(fs::is_directory(real, error) ? std::move(real) : real.parent_path());
      relative_ = relative_ || given.is_relative();
      for (auto& f : files_below(given, limits_.max_entries)) found.push_back(std::move(f));
    }
    common_ = common_folder(folders);
    std::sort(found.begin(), found.end(), [](auto const& a, auto const& b) { return a.shown < b.shown; });
    for (found_file const& f : found) add(f);
  }

  /// Reads one file, unless it was read already.
  void add(found_file const& f) {
    if (!shown_.insert(f.shown).second) return;
    auto const etc = nearest_etc(f.canonical);
    entry e{f.shown, f.canonical, etc.value_or(common_), etc.has_value(), false, {}};
    e.content.kind = kind_of(f.shown);
    if (!f.problem.empty()) {
      e.content.say(f.severity, {}, {}, f.problem);
    } else if (!canonical_.insert(f.canonical).second) {
      e.content.kind = file_kind::none;
      e.content.say(severity::ignored, {}, {}, "the same file was met under another name");
      e.canonical.clear();
    } else if (e.content.kind == file_kind::none) {
      e.content.say(severity::ignored, {}, {}, std::string(why_ignored(f.shown)));
    } else {
      e.content = read(f.canonical, e.content.kind);
    }
    entries_.push_back(std::move(e));
  }

  [[nodiscard]] draft read(fs::path const& file, file_kind kind) const {
    draft out;
    try {
      auto const bytes = read_bytes(file, limits_.max_bytes);
      if (auto const* text = std::get_if<std::string>(&bytes)) return read_document(*text, kind, limits_);
      out.defect({}, {}, std::get<diagnostic>(bytes).reason);
    } catch (std::exception const& e) {
      out = {};
      out.defect({}, {}, std::string("cannot be read: ") + e.what());
    }
    out.kind = kind;
    return out;
  }

  /// Reads the files that needed references lead to, until no new file turns up.
  void follow() {
    directory all{entries_, limits_};
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      auto const needed = entries_[i].content.needed;  // a copy: `entries_` grows
      for (link const& l : needed) {
        auto const wanted = l.wanted == sort::plan ? file_kind::plan : file_kind::task_repository;
        if (kind_of(l.to.file) != wanted) continue;
        if (auto const named = all.literal(i, l)) take_up(*named, i, all);  // before other files of that name
        if (all.resolve(i, l, true)) continue;
        for (fs::path const& file : all.candidates(i, l)) {
          take_up(file, i, all);
          if (all.resolve(i, l, true)) break;
        }
      }
    }
  }

  /// Reads a file that the entry `from` refers to, unless it was read already.
  void take_up(fs::path const& file, std::size_t from, directory& all) {
    if (!canonical_.insert(file).second) return;
    std::error_code error;
    auto const shown = relative_ ? fs::proximate(file, error) : file;
    auto const etc = nearest_etc(file);
    entry e{error ? file.string() : shown.string(), file, etc.value_or(entries_[from].root), etc.has_value(), true, {}};
    e.content = read(file, kind_of(file.string()));
    entries_.push_back(std::move(e));
    all.note(entries_.size() - 1);
  }

  [[nodiscard]] model assemble(directory& all) {
    model m;
    std::set<std::string> roots;
    for (entry const& e : entries_) roots.insert(e.root.string());
    m.roots.assign(roots.begin(), roots.end());
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      entry& e = entries_[i];
      auto const root = static_cast<std::size_t>(std::distance(roots.begin(), roots.find(e.root.string())));
      for (diagnostic d : e.content.diagnostics) {
        d.file = e.shown;
        m.diagnostics.push_back(std::move(d));
      }
      m.documents.push_back(
          {e.shown, root, e.content.kind, e.content.format, status(e), e.content.id, e.content.name, e.followed});
      if (e.content.refused()) continue;
      auto const place = [&](auto x) {
        x.file = e.shown;
        x.root = root;
        return x;
      };
      for (task const& t : e.content.tasks) m.tasks.push_back(place(t));
      if (e.content.plan_type) m.plan_types.push_back(place(*e.content.plan_type));
      if (e.content.plan) m.plans.push_back(place(named(*e.content.plan, i, all)));
      for (role const& r : e.content.roles) m.roles.push_back(place(r));
    }
    name_roles(m);
    auto const by_root_and_id = [](auto const& a, auto const& b) {
      return std::pair(a.root, a.id) < std::pair(b.root, b.id);
    };
    std::sort(m.tasks.begin(), m.tasks.end(), by_root_and_id);
    std::sort(m.plans.begin(), m.plans.end(), by_root_and_id);
    std::sort(m.plan_types.begin(), m.plan_types.end(), by_root_and_id);
    std::sort(m.roles.begin(), m.roles.end(), [](role const& a, role const& b) {
      return std::tie(a.root, a.id, a.file) < std::tie(b.root, b.id, b.file);
    });
    return m;
  }

  [[nodiscard]] static file_status status(entry const& e) {
    if (e.content.refused()) return file_status::refused;
    if (e.content.format == file_format::none) return file_status::ignored;
    bool const useless = e.content.kind == file_kind::behaviour || e.content.kind == file_kind::conditions;
    return useless ? file_status::listed : file_status::loaded;
  }

  /// The plan with the names of its tasks. @pre every needed reference resolves
  [[nodiscard]] static plan named(plan p, std::size_t file, directory& all) {
    std::map<identity, link const*> by_entry;
    for (link const& l : all.needs(file)) by_entry.emplace(l.from.value_or(0), &l);
    for (entry_point& e : p.entry_points)
      if (auto const at = by_entry.find(e.id); at != by_entry.end())
        if (auto const found = all.resolve(file, *at->second, true)) e.task_name = found->object->name;
    return p;
  }

  /// An older role set gives priorities to roles that a .rdefset file defines. Joins the two into one role.
  void name_roles(model& m) const {
    std::set<std::string> mappings;
    std::set<std::string> definitions;
    for (entry const& e : entries_) {
      if (e.content.roles_are_elsewhere) mappings.insert(e.shown);
      if (e.content.kind == file_kind::role_definitions) definitions.insert(e.shown);
    }
    std::map<std::pair<std::size_t, identity>, std::string> names;
    for (role const& r : m.roles)
      if (definitions.contains(r.file)) names[{r.root, r.id}] = r.name;
    std::set<std::pair<std::size_t, identity>> mapped;
    for (role& r : m.roles) {
      if (!mappings.contains(r.file)) continue;
      mapped.insert({r.root, r.id});
      if (auto const n = names.find({r.root, r.id}); n != names.end()) r.name = n->second;
    }
    std::erase_if(m.roles,
                  [&](role const& r) { return definitions.contains(r.file) && mapped.contains({r.root, r.id}); });
  }

  load_options const& limits_;
  std::vector<entry> entries_;
  std::set<std::string> shown_;
  std::set<fs::path> canonical_;
  fs::path common_;
  bool relative_ = false;
};

}  // namespace detail

/// The plan model of these files and folders, and everything that is wrong with them.
///
/// Folders are read with everything below them. If a plan needs a file that is not among them, it is searched on disk: first
/// where the reference says, then by its name within the nearest folder called `etc`. Without such a folder nothing else is
/// searched, and ids are unique within the folder common to all paths. A file with an error is refused whole and named in
/// `diagnostics`; the others are loaded. The result depends neither on the order of `paths` nor on the order in which folders
/// list their files. Throws only for lack of memory.
[[nodiscard]] inline model load(std::span<std::filesystem::path const> paths, load_options const& limits = {}) {
  return detail::loader{limits}.run(paths);
}
[[nodiscard]] inline model load(std::filesystem::path const& path, load_options const& limits = {}) {
  return load(std::span(&path, 1), limits);
}

}  // namespace rota::alica
