#pragma once

#include <rota/adapters/alica/text.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rota::alica {

/// Limits of what `load` reads. Beyond a limit there is an error, never a crash.
struct load_options {
  std::size_t max_bytes = std::size_t{64} << 20U;  ///< of one file
  std::size_t max_depth = 64;                      ///< of nested objects or elements
  std::size_t max_elements = 1'000'000;            ///< values or elements of one file
  std::size_t max_entry_points = 4096;             ///< of one plan
  std::size_t max_entries = 100'000;               ///< files and folders visited below one path
};

}  // namespace rota::alica

namespace rota::alica::detail {

/// The kinds of objects with ids that allocation needs to tell apart.
enum class sort : unsigned char { other, plan, plan_type, entry_point, state, task, role };

[[nodiscard]] constexpr std::string_view to_string(sort s) noexcept {
  constexpr std::string_view names[] = {"object", "plan", "plan type", "entry point", "state", "task", "role"};
  return names[static_cast<std::size_t>(s)];
}

[[nodiscard]] constexpr sort sort_of_root(file_kind k) noexcept {
  return k == file_kind::plan ? sort::plan : k == file_kind::plan_type ? sort::plan_type : sort::other;
}

/// The kind of the objects in a list of this name. Both formats use the same names.
[[nodiscard]] constexpr sort sort_of_list(std::string_view name) noexcept {
  return name == "entryPoints" ? sort::entry_point
         : name == "states"    ? sort::state
         : name == "tasks"     ? sort::task
         : name == "roles"     ? sort::role
                               : sort::other;
}

/// An object that declares an id.
struct declaration {
  identity id = 0;
  sort what = sort::other;
  std::string name;
  std::string place;
};

/// A reference, the object that makes it, and its place in the file.
struct link {
  reference to;
  sort wanted = sort::other;
  std::optional<identity> from;
  std::string place;
};

/// One file as it was read, before its references are resolved.
///
/// The file is refused if a `needed` reference does not resolve; for a `loose` one there is a warning.
struct draft {
  file_kind kind = file_kind::none;
  file_format format = file_format::none;
  std::optional<identity> id;
  std::string name;
  std::vector<diagnostic> diagnostics;  ///< `file` is filled in later
  std::vector<declaration> declared;
  std::vector<link> needed;
  std::vector<link> loose;
  std::optional<alica::plan> plan;
  std::optional<alica::plan_type> plan_type;
  std::vector<task> tasks;
  std::vector<role> roles;
  bool roles_are_elsewhere = false;  ///< the older role sets: `role::id` refers to a .rdefset

  void say(severity s, std::string place, std::optional<identity> of, std::string reason) {
    refused_ = refused_ || s == severity::error;
    diagnostics.push_back({s, {}, std::move(place), of, std::move(reason)});
  }
  void defect(std::string place, std::optional<identity> of, std::string reason) {
    say(severity::error, std::move(place), of, std::move(reason));
  }
  [[nodiscard]] bool refused() const noexcept { return refused_; }

private:
  bool refused_ = false;
};

/// A field of an object: absent (both members empty), present, or of the wrong type (`wrong` completes "KEY is …").
template <class T>
struct field {
  std::optional<T> value;
  std::string wrong;
};

/// One entry of a role's task priorities.
struct priority_entry {
  std::optional<reference> to;
  field<double> value;
  std::string key;
  std::string place;
};

}  // namespace rota::alica::detail
