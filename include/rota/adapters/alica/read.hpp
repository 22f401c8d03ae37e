#pragma once

#include <rota/adapters/alica/json.hpp>
#include <rota/adapters/alica/xml.hpp>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace rota::alica::detail {

/// Reads from one file what allocation needs, the same way for both formats. Each defect gives one error.
template <class Cursor>
class content_reader {
public:
  content_reader(draft& out, load_options const& limits) : out_(out), limits_(limits) {}

  /// The whole file. @pre the depth of the document is bounded
  void read(Cursor const& top) {
    auto const id = take_id(top, to_string(out_.kind));
    out_.id = id;
    out_.name = take(top.text("name"), top, "name", id).value_or("");
    top.survey(out_, sort_of_root(out_.kind));
    switch (out_.kind) {
    case file_kind::plan: read_plan(top, id.value_or(0)); break;
    case file_kind::plan_type: read_plan_type(top, id.value_or(0)); break;
    case file_kind::task_repository: read_tasks(top, id); break;
    case file_kind::role_set: read_roles(top, id); break;
    case file_kind::role_definitions: read_role_definitions(top, id); break;
    case file_kind::behaviour:
    case file_kind::conditions:
    case file_kind::none: break;
    }
  }

private:
  /// The value of a field. A value of the wrong type is a defect.
  template <class T>
  std::optional<T> take(field<T> f, Cursor const& at, std::string_view key, std::optional<identity> of) {
    if (!f.wrong.empty()) out_.defect(at.place(key), of, std::string(key) + " is " + f.wrong);
    return std::move(f.value);
  }
  std::optional<identity> take_id(Cursor const& at, std::string_view what) {
    auto f = at.natural("id");
    if (!f.value && f.wrong.empty()) out_.defect(at.place(), {}, "the " + std::string(what) + " has no id");
    return take(std::move(f), at, "id", std::nullopt);
  }
  std::vector<Cursor> take_list(Cursor const& at, std::string_view key, std::optional<identity> of) {
    auto list = take(at.list(key), at, key, of);
    return list ? *std::move(list) : std::vector<Cursor>{};
  }

  /// minCardinality and maxCardinality. An absent one sets no bound.
  cardinality read_bounds(Cursor const& at, identity of, bool expected) {
    constexpr identity unlimited = 2147483647;
    auto const bound = [&](std::string_view key, identity otherwise) {
      auto f = at.natural(key);
      if (f.value && *f.value > unlimited) f = {{}, std::to_string(*f.value) + ", above 2147483647 (no limit)"};
      if (expected && !f.value && f.wrong.empty())
        out_.say(severity::warning, at.place(), of,
                 "no " + std::string(key) + ": taken as " + (otherwise == 0 ? "0" : "no limit"));
      return take(std::move(f), at, key, of);
    };
    auto const before = out_.diagnostics.size();
    auto const min = bound("minCardinality", 0);
    auto const max = bound("maxCardinality", unlimited);
    bool const sound =
        std::none_of(out_.diagnostics.begin() + static_cast<std::ptrdiff_t>(before), out_.diagnostics.end(),
                     [](diagnostic const& d) { return d.severity == severity::error; });
    auto const upper = !max || *max == unlimited ? cardinality::unbounded : static_cast<std::uint32_t>(*max);
    auto const made = cardinality::make(static_cast<std::uint32_t>(min.value_or(0)), upper);
    if (made) return *made;
    if (sound)
      out_.defect(at.place(), of,
                  "minCardinality " + std::to_string(made.error().min) + " is above maxCardinality " +
                      std::to_string(made.error().max));
    return {};
  }

  void read_plan(Cursor const& top, identity id) {
    alica::plan p;
    p.id = id;
    p.name = out_.name;
    p.team_size = read_bounds(top, id, false);
    auto threshold = top.real("utilityThreshold");
    if (threshold.value && !(rota::detail::is_finite(*threshold.value) && *threshold.value >= 0))
      threshold = {{}, "negative or no finite number"};
    p.utility_threshold = take(std::move(threshold), top, "utilityThreshold", id).value_or(0);
    if (auto const pre = take(top.precondition(), top, "preCondition", id)) {
      auto text = take(pre->text("conditionString"), *pre, "conditionString", id).value_or("");
      if (take(pre->flag("enabled"), *pre, "enabled", id).value_or(true)) p.precondition = std::move(text);
    }
    auto const entries = take_list(top, "entryPoints", id);
    if (entries.size() > limits_.max_entry_points)
      return out_.defect(top.place("entryPoints"), id,
                         "more than " + std::to_string(limits_.max_entry_points) + " entry points");
    std::map<identity, std::string_view> states;
    for (declaration const& d : out_.declared)
      if (d.what == sort::state) states.emplace(d.id, d.name);
    for (Cursor const& e : entries) read_entry_point(e, p, states);
    if (p.entry_points.empty() && !out_.refused()) out_.defect(top.place(), id, "the plan has no entry point");
    std::sort(p.entry_points.begin(), p.entry_points.end(),
              [](entry_point const& a, entry_point const& b) { return a.id < b.id; });
    if (!out_.refused()) check_team_size(p, top);
    out_.plan = std::move(p);
  }

  void read_entry_point(Cursor const& at, alica::plan& p, std::map<identity, std::string_view> const& states) {
    entry_point e;
    auto const id = take_id(at, "entry point");
    e.id = id.value_or(0);
    e.name = take(at.text("name"), at, "name", id).value_or("");
    e.bounds = read_bounds(at, e.id, true);
    auto task = at.refers("task");
    if (!task.value && task.wrong.empty()) out_.defect(at.place(), id, "the entry point has no task");
    if (auto const to = take(std::move(task), at, "task", id)) {
      e.task = to->id;
      out_.needed.push_back({*to, sort::task, id, at.place("task")});
    }
    // Allocation needs no states: a missing one gives a warning, like other loose references.
    if (auto const state = at.refers("state").value)
      if (auto const known = states.find(state->id); known != states.end()) {
        e.state = known->first;
        e.state_name = known->second;
      }
    p.entry_points.push_back(std::move(e));
  }

  void check_team_size(alica::plan const& p, Cursor const& top) {
    std::uint64_t least = 0;
    for (entry_point const& e : p.entry_points) least += e.bounds.lower();
    if (p.team_size.is_bounded() && least > p.team_size.upper())
      out_.say(severity::warning, top.place(), p.id,
               "no team can execute the plan: its tasks need " + std::to_string(least) +
                   " agents, and it admits at most " + std::to_string(p.team_size.upper()));
  }

  void read_plan_type(Cursor const& top, identity id) {
    alica::plan_type t;
    t.id = id;
    t.name = out_.name;
    std::set<identity> offered;
    for (Cursor const& c : take_list(top, Cursor::choices, id)) {
      bool const activated = take(c.flag("activated"), c, "activated", id).value_or(true);
      auto plan = c.refers("plan");
      if (!plan.value && plan.wrong.empty()) out_.defect(c.place(), id, "an offered plan is not named");
      auto const to = take(std::move(plan), c, "plan", id);
      if (!to) continue;
      if (!offered.insert(to->id).second) out_.defect(c.place(), to->id, "the plan type offers this plan twice");
      t.plans.push_back({to->id, activated});
      // A plan that is switched off cannot be chosen, so it is not needed.
      (activated ? out_.needed : out_.loose).push_back({*to, sort::plan, id, c.place("plan")});
    }
    auto const any = std::any_of(t.plans.begin(), t.plans.end(), [](auto const& c) { return c.activated; });
    if (!any && !out_.refused()) out_.defect(top.place(), id, "the plan type offers no activated plan");
    std::sort(t.plans.begin(), t.plans.end(), [](auto const& a, auto const& b) { return a.plan < b.plan; });
    out_.plan_type = std::move(t);
  }

  void read_tasks(Cursor const& top, std::optional<identity> id) {
    for (Cursor const& c : take_list(top, "tasks", id)) {
      auto const own = take_id(c, "task");
      auto name = take(c.text("name"), c, "name", own).value_or("");
      out_.tasks.push_back({own.value_or(0), std::move(name), {}, 0});
    }
  }

  void read_roles(Cursor const& top, std::optional<identity> id) {
    auto preset = top.real("defaultPriority");
    if (preset.value && !rota::detail::is_finite(*preset.value)) preset = {{}, "no finite number"};
    double const otherwise = take(std::move(preset), top, "defaultPriority", id).value_or(0);
    out_.roles_are_elsewhere = Cursor::format == file_format::xml && !take_list(top, "mappings", id).empty();
    for (Cursor const& c : take_list(top, out_.roles_are_elsewhere ? "mappings" : "roles", id)) {
      role r;
      r.default_priority = otherwise;
      r.name = take(c.text("name"), c, "name", id).value_or("");
      if (out_.roles_are_elsewhere) {
        auto to = c.refers("role");
        if (!to.value && to.wrong.empty()) out_.defect(c.place(), id, "the mapping names no role");
        if (auto const whose = take(std::move(to), c, "role", id)) r.id = whose->id;
      } else {
        r.id = take_id(c, "role").value_or(0);
      }
      read_priorities(c, r);
      out_.roles.push_back(std::move(r));
    }
  }

  void read_priorities(Cursor const& at, role& r) {
    auto all = take(at.priorities(), at, "taskPriorities", r.id);
    if (!all) return;
    for (auto& p : *all) {
      if (!p.to) {
        out_.defect(p.place, r.id, in_quotes(p.key) + " refers to no task");
        continue;
      }
      if (p.value.value && !rota::detail::is_finite(*p.value.value)) p.value = {{}, "no finite number"};
      if (!p.value.wrong.empty()) {
        out_.defect(p.place, r.id, "the priority is " + p.value.wrong);
        continue;
      }
      r.priorities.push_back({p.to->id, p.value.value.value_or(0)});
      out_.needed.push_back({*p.to, sort::task, r.id, p.place});
    }
    auto const by_task = [](task_priority const& a, task_priority const& b) { return a.task < b.task; };
    std::sort(r.priorities.begin(), r.priorities.end(), by_task);
    auto const twice = std::adjacent_find(r.priorities.begin(), r.priorities.end(),
                                          [](auto const& a, auto const& b) { return a.task == b.task; });
    if (twice != r.priorities.end())
      out_.defect(at.place(), r.id, "two priorities for the task " + std::to_string(twice->task));
  }

  void read_role_definitions(Cursor const& top, std::optional<identity> id) {
    for (Cursor const& c : take_list(top, "roles", id)) {
      role r;
      r.id = take_id(c, "role").value_or(0);
      r.name = take(c.text("name"), c, "name", r.id).value_or("");
      out_.roles.push_back(std::move(r));
    }
  }

  draft& out_;
  load_options const& limits_;
};

/// The name of the root element of an XML file of this kind.
[[nodiscard]] constexpr std::string_view root_element(file_kind k) noexcept {
  switch (k) {
  case file_kind::plan: return "Plan";
  case file_kind::plan_type: return "PlanType";
  case file_kind::task_repository: return "TaskRepository";
  case file_kind::role_set: return "RoleSet";
  case file_kind::role_definitions: return "RoleDefinitionSet";
  case file_kind::behaviour: return "Behaviour";
  case file_kind::conditions:
  case file_kind::none: break;
  }
  return "";
}

inline void read_json(draft& out, std::string_view text, load_options const& limits) {
  out.format = file_format::json;
  json_guard guard{text, limits};
  if (!guard.passes()) {
    out.defect(guard.place, {}, guard.reason);
    return;
  }
  auto const tree = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!tree.is_object()) return out.defect("/", {}, "the file holds no JSON object");
  content_reader<json_cursor>{out, limits}.read(json_cursor{tree, ""});
}

inline void read_xml(draft& out, std::string_view text, load_options const& limits) {
  out.format = file_format::xml;
  line_index const lines{text};
  if (auto const offence = find_offence(text, limits))
    return out.defect(lines.place(offence->offset), {}, offence->reason);
  pugi::xml_document tree;
  auto const parsed =
      tree.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
  if (!parsed) {
    auto const offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0));
    bool const cut_off = offset + 1 >= text.size() || parsed.status == pugi::status_no_document_element;
    return out.defect(lines.place(offset), {},
                      cut_off ? "cut off: the XML text ends too early"
                              : std::string("no XML: ") + parsed.description());
  }
  auto const place = [&](pugi::xml_node n) { return xml_cursor{n, lines}.place(); };
  pugi::xml_node top;
  for (auto const child : tree.children()) {
    if (child.type() == pugi::node_doctype)
      return out.defect(lines.place(text.find("<!DOCTYPE")), {},
                        "a document type declaration (DOCTYPE), which no plan file needs");
    if (child.type() != pugi::node_element) continue;
    if (top) return out.defect(place(child), {}, "more than one root element");
    top = child;
  }
  if (auto const n = too_deep(tree, limits.max_depth))
    return out.defect(place(n), {}, "nested deeper than " + std::to_string(limits.max_depth) + " levels");
  if (auto const expected = root_element(out.kind); local_name(top.name()) != expected && !expected.empty())
    return out.defect(place(top), {},
                      "the root element is " + in_quotes(top.name()) + ", not a " + std::string(expected));
  content_reader<xml_cursor>{out, limits}.read(xml_cursor{top, lines});
}

/// Reads one file from its bytes. Every defect becomes a diagnostic, including ids that are repeated within the file.
[[nodiscard]] inline draft read_document(std::string_view bytes, file_kind kind, load_options const& limits = {}) {
  draft out;
  out.kind = kind;
  auto const bad = first_bad_byte(bytes);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  auto const first = bytes.find_first_not_of(" \t\r\n");
  if (bad) {
    out.defect("byte " + std::to_string(*bad), {}, "not UTF-8");
  } else if (first == std::string_view::npos) {
    out.defect("", {}, "the file is empty");
  } else if (bytes[first] == '<') {
    read_xml(out, bytes, limits);
  } else if (bytes[first] == '{' || bytes[first] == '[') {
    read_json(out, bytes, limits);
  } else {
    out.defect("1:1", {}, "neither JSON nor XML");
  }
  return out;
}

}  // namespace rota::alica::detail
