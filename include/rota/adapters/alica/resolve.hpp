#pragma once

#include <rota/adapters/alica/files.hpp>
#include <rota/adapters/alica/read.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rota::alica::detail {

/// One file while the model is built.
struct entry {
  std::string shown;
  fs::path canonical;
  fs::path root;           ///< ids are unique within it
  bool below_etc = false;  ///< the root is a folder `etc`; only such roots are searched
  bool followed = false;
  draft content;
};

/// Finds declarations by root and id, and by file, and so resolves references.
///
/// A view of the entries. Its indices stay valid while no entry is removed.
class directory {
public:
  explicit directory(std::vector<entry>& entries, load_options const& limits) : entries_(entries), limits_(limits) {
    for (std::size_t i = 0; i < entries_.size(); ++i) note(i);
  }

  struct target {
    std::size_t file = 0;
    declaration const* object = nullptr;
  };

  /// Adds the entry at this index.
  void note(std::size_t i) {
    by_path_.emplace(entries_[i].canonical, i);
    auto& ids = by_id_[entries_[i].root];
    auto const& declared = entries_[i].content.declared;
    for (std::size_t k = 0; k < declared.size(); ++k) {
      auto& places = ids[declared[k].id];  // a repetition within the file does not change what a reference means
      bool const repeated = std::any_of(places.begin(), places.end(), [&](auto const& p) {
        return p.first == i && declared[p.second].what == declared[k].what;
      });
      if (!repeated) places.push_back({i, k});
    }
  }

  /// The object that a reference in a file means. It is looked for in the named file, then in other files of that name within
  /// the root, because ALICA's JSON names files without their folders. A bare id means an object of the same file; if it is
  /// `needed`, of any file of the root (older role sets name tasks so).
  ///
  /// Of several declarations it prefers one of the wanted sort in a file without errors.
  [[nodiscard]] std::optional<target> resolve(std::size_t from, link const& l, bool needed) {
    std::vector<target> found;
    auto const add = [&](fs::path const& root, auto const& admits) {
      auto const& ids = by_id_.at(root);
      auto const at = ids.find(l.to.id);
      if (at == ids.end()) return;
      for (auto const& [file, k] : at->second)
        if (admits(file)) found.push_back({file, &entries_[file].content.declared[k]});
    };
    auto const& root = entries_[from].root;
    if (l.to.file.empty()) {
      add(root, [&](std::size_t file) { return needed || file == from; });
    } else {
      if (auto const named = loaded_as(path_of(from, l)))
        add(entries_[*named].root, [&](std::size_t file) { return file == *named; });
      auto const name = fs::path(l.to.file).filename();
      if (found.empty()) add(root, [&](std::size_t file) { return fs::path(entries_[file].shown).filename() == name; });
    }
    if (found.empty()) return std::nullopt;
    auto const rank = [&](target const& t) {
      return (t.object->what == l.wanted ? 0 : 2) + (entries_[t.file].content.refused() ? 1 : 0);
    };
    return *std::min_element(found.begin(), found.end(),
                             [&](target const& a, target const& b) { return rank(a) < rank(b); });
  }

  [[nodiscard]] std::vector<link> const& needs(std::size_t file) const { return entries_[file].content.needed; }

  /// The path of a reference's file, taken literally.
  [[nodiscard]] fs::path path_of(std::size_t from, link const& l) const {
    auto const base = entries_[from].canonical.parent_path();
    return (base / l.to.file).lexically_normal();
  }
  [[nodiscard]] bool is_loaded(fs::path const& canonical) const { return by_path_.contains(canonical); }

  /// The file at the literal path of a reference, if it is on disk.
  [[nodiscard]] std::optional<fs::path> literal(std::size_t from, link const& l) const {
    if (l.to.file.empty() || fs::path(l.to.file).is_absolute()) return std::nullopt;
    auto const file = look_at(path_of(from, l), true);
    if (!file || !file->problem.empty()) return std::nullopt;
    return file->canonical;
  }
  /// The files on disk that a reference may mean: the literal one, then files of that name within the root, if that is a
  /// folder `etc`. Other folders may hold anything, so they are not searched.
  [[nodiscard]] std::vector<fs::path> candidates(std::size_t from, link const& l) {
    std::vector<fs::path> out;
    if (l.to.file.empty() || fs::path(l.to.file).is_absolute()) return out;
    if (auto const named = literal(from, l)) out.push_back(*named);
    if (!entries_[from].below_etc) return out;
    auto const& in_root = below(entries_[from].root).files;
    if (auto const at = in_root.find(fs::path(l.to.file).filename().string()); at != in_root.end())
      out.insert(out.end(), at->second.begin(), at->second.end());
    return out;
  }

  /// Says why a reference does not resolve.
  [[nodiscard]] std::string why_missing(std::size_t from, link const& l) {
    std::string why = "not found";
    if (l.to.file.empty()) return why;
    bool const on_disk = !candidates(from, l).empty();
    std::string const cut_short = entries_[from].below_etc ? below(entries_[from].root).cut_short : std::string{};
    if (!cut_short.empty())
      why += ": the search of " + entries_[from].root.string() + " was given up, " + cut_short;
    else if (!on_disk)
      why += ": there is no such file";
    auto const& ids = by_id_.at(entries_[from].root);
    if (auto const at = ids.find(l.to.id); at != ids.end())
      why += "; the id stands in " + entries_[at->second.front().first].shown;
    return why;
  }

private:
  /// The plan files below a root, by name.
  struct listing {
    std::map<std::string, std::vector<fs::path>> files;
    std::string cut_short;  ///< why the list is incomplete
  };

  listing const& below(fs::path const& root) {
    auto const [at, fresh] = on_disk_.try_emplace(root);
    if (fresh)
      for (found_file const& f : files_below(root, limits_.max_entries)) {
        if (f.canonical == root) at->second.cut_short = f.problem;
        if (f.problem.empty() && kind_of(f.shown) != file_kind::none)
          at->second.files[fs::path(f.shown).filename().string()].push_back(f.canonical);
      }
    return at->second;
  }

  /// The entry of a file, also if the path leads to it through links.
  std::optional<std::size_t> loaded_as(fs::path const& p) {
    auto const [real, fresh] = real_.try_emplace(p);
    if (fresh) {
      std::error_code error;
      real->second = fs::canonical(p, error);
    }
    auto const at = by_path_.find(real->second);
    return at == by_path_.end() || real->second.empty() ? std::nullopt : std::optional(at->second);
  }

  std::vector<entry>& entries_;
  load_options const& limits_;
  std::map<fs::path, std::size_t> by_path_;
  std::map<fs::path, std::map<identity, std::vector<std::pair<std::size_t, std::size_t>>>> by_id_;
  std::map<fs::path, listing> on_disk_;
  std::map<fs::path, fs::path> real_;
};

/// Reports ids that two files of one root declare: an error in the later file, by name, if allocation needs the object, else a
/// warning. Refused files do not count.
inline void check_repeated_ids(std::vector<entry>& entries) {
  std::map<std::pair<fs::path, identity>, std::pair<std::size_t, declaration const*>> first;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].content.refused()) continue;
    auto& draft = entries[i].content;
    for (declaration const& d : draft.declared) {
      auto const [at, fresh] = first.try_emplace({entries[i].root, d.id}, i, &d);
      if (fresh) continue;
      auto const& [file, earlier] = at->second;
      bool const grave = d.what != sort::other || earlier->what != sort::other;
      auto const where = file == i ? earlier->place : entries[file].shown + ' ' + earlier->place;
      draft.say(grave ? severity::error : severity::warning, d.place, d.id,
                "the id " + std::to_string(d.id) + " stands twice: already in " + where);
    }
    if (!draft.refused()) continue;
    for (auto at = first.begin(); at != first.end();) at = at->second.first == i ? first.erase(at) : std::next(at);
  }
}

/// Reports references that do not resolve: an error if allocation needs them, else a warning.
inline void check_references(std::vector<entry>& entries, directory& all) {
  auto const order = [](file_kind k) {  // files that others need come first; there are no cycles
    return k == file_kind::plan_type ? 2 : k == file_kind::plan || k == file_kind::role_set ? 1 : 0;
  };
  for (int pass = 0; pass < 3; ++pass) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      auto& draft = entries[i].content;
      if (order(draft.kind) != pass || draft.refused()) continue;
      std::set<std::pair<std::string, identity>> said;  // a missing task is reported once
      for (link const& l : draft.needed) {
        auto const found = all.resolve(i, l, true);
        std::string why;
        if (!found) {
          why = all.why_missing(i, l);
        } else if (found->object->what != l.wanted) {
          why = "a " + std::string(to_string(found->object->what)) + ", not a " + std::string(to_string(l.wanted));
        } else if (entries[found->file].content.refused()) {
          why = "unusable: " + entries[found->file].shown + " was refused";
        }
        if (why.empty() || !said.insert({l.to.file, l.to.id}).second) continue;
        draft.defect(l.place, l.from, "the " + std::string(to_string(l.wanted)) + ' ' + l.to.text() + " is " + why);
      }
      for (link const& l : draft.loose) {
        if (all.resolve(i, l, false)) continue;
        auto const on_disk = all.candidates(i, l);
        if (std::any_of(on_disk.begin(), on_disk.end(), [&](auto const& p) { return !all.is_loaded(p); })) continue;
        draft.say(severity::warning, l.place, l.from, l.to.text() + " is " + all.why_missing(i, l));
      }
    }
  }
}

}  // namespace rota::alica::detail
