#pragma once

#include <rota/model/cardinality.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rota::alica {

/// The ids of plan files. Each is unique within one root, but not across roots.
using identity = std::uint64_t;

/// How severe a diagnostic is. A file with an error is refused whole. `ignored` is about a file that was not read.
enum class severity : unsigned char { error, warning, ignored };

/// The kind of a file, by its extension.
enum class file_kind : unsigned char {
  none,              ///< not a plan file
  plan,              ///< .pml
  plan_type,         ///< .pty
  task_repository,   ///< .tsk
  role_set,          ///< .rst
  role_definitions,  ///< .rdefset, the older XML only
  behaviour,         ///< .beh, listed only
  conditions         ///< .cnd, listed only
};

enum class file_format : unsigned char { none, json, xml };

/// What `load` did with a file. `listed`: it has no error, and nothing in it concerns allocation.
enum class file_status : unsigned char { loaded, listed, refused, ignored };

[[nodiscard]] constexpr std::string_view to_string(severity s) noexcept {
  constexpr std::string_view names[] = {"error", "warning", "ignored"};
  return names[static_cast<std::size_t>(s)];
}
[[nodiscard]] constexpr std::string_view to_string(file_kind k) noexcept {
  constexpr std::string_view names[] = {
      "none", "plan", "plan type", "task repository", "role set", "role definitions", "behaviour", "conditions"};
  return names[static_cast<std::size_t>(k)];
}
[[nodiscard]] constexpr std::string_view to_string(file_format f) noexcept {
  constexpr std::string_view names[] = {"none", "json", "xml"};
  return names[static_cast<std::size_t>(f)];
}
[[nodiscard]] constexpr std::string_view to_string(file_status s) noexcept {
  constexpr std::string_view names[] = {"loaded", "listed", "refused", "ignored"};
  return names[static_cast<std::size_t>(s)];
}

/// A message about one place of one file.
struct diagnostic {
  alica::severity severity = alica::severity::error;
  std::string file;
  std::string place;           ///< JSON pointer, or line:column with the XML element; empty for the file as a whole
  std::optional<identity> id;  ///< of the object that it is about, if that has one
  std::string reason;

  friend bool operator==(diagnostic const&, diagnostic const&) = default;
};

/// One file that was found.
struct document {
  std::string file;
  std::size_t root = 0;  ///< index into `model::roots`
  file_kind kind = file_kind::none;
  file_format format = file_format::none;
  file_status status = file_status::ignored;
  std::optional<identity> id;
  std::string name;
  bool followed = false;  ///< not among the given paths; a plan needed it

  friend bool operator==(document const&, document const&) = default;
};

/// An entry point of a plan: one task with its bounds. Several entry points of a plan may have the same task.
struct entry_point {
  identity id = 0;
  std::string name;
  identity task = 0;
  std::string task_name;
  cardinality bounds;
  identity state = 0;  ///< the state in which an agent begins; 0 if the file names no existing one
  std::string state_name;

  friend bool operator==(entry_point const&, entry_point const&) = default;
};

struct plan {
  identity id = 0;
  std::string name;
  std::string file;
  std::size_t root = 0;
  std::vector<entry_point> entry_points;  ///< ascending by id, at least one
  cardinality team_size;                  ///< of the plan as a whole: min/maxCardinality of the plan itself
  double utility_threshold = 0;           ///< the default hysteresis
  /// The text of the precondition, if the plan has an enabled one. Empty: ALICA has it in code. It is never evaluated here.
  std::optional<std::string> precondition;

  friend bool operator==(plan const&, plan const&) = default;
};

/// A plan that a plan type offers. Only activated ones can be chosen.
struct plan_choice {
  identity plan = 0;
  bool activated = true;

  friend bool operator==(plan_choice const&, plan_choice const&) = default;
};

struct plan_type {
  identity id = 0;
  std::string name;
  std::string file;
  std::size_t root = 0;
  std::vector<plan_choice> plans;  ///< ascending by plan

  friend bool operator==(plan_type const&, plan_type const&) = default;
};

struct task {
  identity id = 0;
  std::string name;
  std::string file;
  std::size_t root = 0;

  friend bool operator==(task const&, task const&) = default;
};

struct task_priority {
  identity task = 0;
  double priority = 0;

  friend bool operator==(task_priority const&, task_priority const&) = default;
};

/// A role: tasks and their priorities. A negative priority forbids. Other tasks have the default priority of the role set.
struct role {
  identity id = 0;
  std::string name;
  std::string file;
  std::size_t root = 0;
  double default_priority = 0;  ///< `defaultPriority`; ALICA's own reader looks for `priorityDefault` and finds 0
  std::vector<task_priority> priorities;  ///< ascending by task

  friend bool operator==(role const&, role const&) = default;
};

/// Everything in plan files that concerns allocation, and everything that is wrong with them.
///
/// Class invariant: every list is sorted by root and id (documents and diagnostics by file), so that nothing depends on the
/// order in which folders list their files. Everything that an element needs is present.
struct model {
  std::vector<std::string> roots;  ///< folders within which ids are unique
  std::vector<document> documents;
  std::vector<plan> plans;
  std::vector<plan_type> plan_types;
  std::vector<task> tasks;
  std::vector<role> roles;
  std::vector<diagnostic> diagnostics;

  /// The number of diagnostics of this severity. O(n).
  [[nodiscard]] std::size_t count(severity s) const {
    return static_cast<std::size_t>(
        std::count_if(diagnostics.begin(), diagnostics.end(), [s](diagnostic const& d) { return d.severity == s; }));
  }
  /// A plan of one root, or nullptr. O(log n).
  [[nodiscard]] plan const* find_plan(std::size_t root, identity id) const { return find(plans, root, id); }
  [[nodiscard]] task const* find_task(std::size_t root, identity id) const { return find(tasks, root, id); }

  friend bool operator==(model const&, model const&) = default;

private:
  template <class T>
  static T const* find(std::vector<T> const& sorted, std::size_t root, identity id) {
    auto const at = std::lower_bound(sorted.begin(), sorted.end(), std::pair(root, id),
                                     [](T const& x, auto const& key) { return std::pair(x.root, x.id) < key; });
    return at != sorted.end() && at->root == root && at->id == id ? &*at : nullptr;
  }
};

/// Whether another entry point of the plan has the same task.
[[nodiscard]] inline bool shares_task(plan const& p, entry_point const& e) {
  return std::count_if(p.entry_points.begin(), p.entry_points.end(),
                       [&](entry_point const& x) { return x.task == e.task; }) > 1;
}

/// A name for an entry point that is unique within its plan: the name of its task; if several entry points have a task of that
/// name, the entry point's own name; if that is not unique either, "TASK#ID". O(t²).
[[nodiscard]] inline std::string label(plan const& p, entry_point const& e) {
  auto const& all = p.entry_points;
  auto const tasks_named = [&](std::string const& n) {
    return std::count_if(all.begin(), all.end(), [&](entry_point const& x) { return x.task_name == n; });
  };
  if (!e.task_name.empty() && tasks_named(e.task_name) == 1) return e.task_name;
  bool const named = !e.name.empty() && e.name != "MISSING_NAME";  // ALICA's editor writes this where there is no name
  auto const own = std::count_if(all.begin(), all.end(), [&](entry_point const& x) { return x.name == e.name; });
  bool const taken = e.name != e.task_name && tasks_named(e.name) > 0;
  if (named && own == 1 && !taken) return e.name;
  return e.task_name + '#' + std::to_string(e.id);
}

}  // namespace rota::alica
