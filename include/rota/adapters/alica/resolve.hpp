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

/// One file on its way into the model.
struct entry {
  std::string shown;
  fs::path canonical;
  fs::path root;
  bool followed = false;
  draft content;
};

/// Everything declared, by root and id, and by file; resolves references.
///
/// Views the entries; indices stay valid as long as none is removed.
class directory {
public:
  explicit directory(std::vector<entry>& entries, load_options const& limits) : entries_(entries), limits_(limits) {
    for (std::size_t i = 0; i < entries_.size(); ++i) note(i);
  }

  struct target {
    std::size_t file = 0;
    declaration const* object = nullptr;
  };

  /// Takes up the entry at this index.
  void note(std::size_t i) {
    by_path_.emplace(entries_[i].canonical, i);
    auto& ids = by_id_[entries_[i].root];
    auto const& declared = entries_[i].content.declared;
    for (std::size_t k = 0; k < declared.size(); ++k) {
      auto& places = ids[declared[k].id];  // a repetition within the file would answer no reference differently
      bool const repeated = std::any_of(places.begin(), places.end(), [&](auto const& p) {
        return p.first == i && declared[p.second].what == declared[k].what;
      });
      if (!repeated) places.push_back({i, k});
    }
  }

  /// What a reference in a file means: the named file if it holds the id, else the id within the root; bare ids only
  /// within the file itself, unless they are `needed` (the older role sets name tasks so).
  ///
  /// Among several declarations one of the wanted sort in a sound file is preferred.
  [[nodiscard]] std::optional<target> resolve(std::size_t from, link const& l, bool needed) const {
    std::vector<target> found;
    auto const add = [&](fs::path const& root, std::optional<std::size_t> only) {
      auto const& ids = by_id_.at(root);
      auto const at = ids.find(l.to.id);
      if (at == ids.end()) return;
      for (auto const& [file, k] : at->second)
        if (!only || *only == file) found.push_back({file, &entries_[file].content.declared[k]});
    };
    if (l.to.file.empty() && !needed) {
      add(entries_[from].root, from);
    } else {
      if (!l.to.file.empty())
        if (auto const named = by_path_.find(path_of(from, l)); named != by_path_.end())
          add(entries_[named->second].root, named->second);
      if (found.empty()) add(entries_[from].root, std::nullopt);
    }
    if (found.empty()) return std::nullopt;
    auto const rank = [&](target const& t) {
      return (t.object->what == l.wanted ? 0 : 2) + (entries_[t.file].content.refused() ? 1 : 0);
    };
    return *std::min_element(found.begin(), found.end(),
                             [&](target const& a, target const& b) { return rank(a) < rank(b); });
  }

  [[nodiscard]] std::vector<link> const& needs(std::size_t file) const { return entries_[file].content.needed; }

  /// Where a reference's file would lie, followed literally.
  [[nodiscard]] fs::path path_of(std::size_t from, link const& l) const {
    auto const base = entries_[from].canonical.parent_path();
    return (base / l.to.file).lexically_normal();
  }
  [[nodiscard]] bool is_loaded(fs::path const& canonical) const { return by_path_.contains(canonical); }

  /// The files that a reference may mean, on disk: the literal path, then files of that name within the root.
  [[nodiscard]] std::vector<fs::path> candidates(std::size_t from, link const& l) {
    std::vector<fs::path> out;
    if (l.to.file.empty() || fs::path(l.to.file).is_absolute()) return out;
    auto const literal = look_at(path_of(from, l), true);
    if (literal && literal->problem.empty()) out.push_back(literal->canonical);
    auto const& in_root = names_below(entries_[from].root);
    if (auto const at = in_root.find(fs::path(l.to.file).filename().string()); at != in_root.end())
      out.insert(out.end(), at->second.begin(), at->second.end());
    return out;
  }

private:
  using names = std::map<std::string, std::vector<fs::path>>;

  names const& names_below(fs::path const& root) {
    auto const [at, fresh] = on_disk_.try_emplace(root);
    if (fresh)
      for (found_file const& f : files_below(root, limits_.max_entries))
        if (f.problem.empty() && kind_of(f.shown) != file_kind::none)
          at->second[fs::path(f.shown).filename().string()].push_back(f.canonical);
    return at->second;
  }

  std::vector<entry>& entries_;
  load_options const& limits_;
  std::map<fs::path, std::size_t> by_path_;
  std::map<fs::path, std::map<identity, std::vector<std::pair<std::size_t, std::size_t>>>> by_id_;
  std::map<fs::path, names> on_disk_;
};

/// Ids that stand twice in one root: an error in the later file (in order of names) where allocation cares, else a
/// warning. Refused files take no ids away from others.
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

/// References that do not resolve: an error where allocation needs them, a warning elsewhere.
inline void check_references(std::vector<entry>& entries, directory& all) {
  auto const order = [](file_kind k) {  // what is needed first; needs never form a circle
    return k == file_kind::plan_type ? 2 : k == file_kind::plan || k == file_kind::role_set ? 1 : 0;
  };
  for (int pass = 0; pass < 3; ++pass) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      auto& draft = entries[i].content;
      if (order(draft.kind) != pass || draft.refused()) continue;
      std::set<std::pair<std::string, identity>> said;  // one missing task is one defect, however often it is needed
      for (link const& l : draft.needed) {
        auto const found = all.resolve(i, l, true);
        std::string why;
        if (!found) {
          why = all.candidates(i, l).empty() && !l.to.file.empty() ? "not found: there is no such file" : "not found";
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
        draft.say(severity::warning, l.place, l.from,
                  l.to.text() + (on_disk.empty() && !l.to.file.empty() ? " is not found: there is no such file"
                                                                       : " is not found"));
      }
    }
  }
}

}  // namespace rota::alica::detail
