#include "load.hpp"

#include "command.hpp"

#include <rota/adapters/alica.hpp>

#include <nlohmann/json.hpp>

#include <string_view>

namespace rota::cli {

alica::model load_plans(std::vector<std::filesystem::path> const& paths) { return alica::load(paths); }

std::string choice_name(alica::model const& m, alica::plan_type const& t, alica::plan_choice const& c) {
  auto const* p = m.find_plan(t.root, c.plan);
  return p != nullptr && !p->name.empty() ? p->name : std::to_string(c.plan);
}

nlohmann::json parse_json(std::string const& text, std::string const& file) {
  std::string_view const view = text;
  alica::load_options const limits;
  alica::detail::json_guard guard{view, limits};
  if (!nlohmann::json::sax_parse(view, &guard)) throw input_error(file, guard.place, guard.reason);
  return nlohmann::json::parse(view, nullptr, false);
}

}  // namespace rota::cli
