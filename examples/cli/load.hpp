#pragma once

#include <rota/adapters/alica/model.hpp>

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace rota::cli {

// One file compiles the two parsers, because they are in headers and slow to compile.

/// `alica::load`.
[[nodiscard]] alica::model load_plans(std::vector<std::filesystem::path> const& paths);

/// The name of a plan that a plan type offers; its id where it has none.
[[nodiscard]] std::string choice_name(alica::model const& m, alica::plan_type const& t, alica::plan_choice const& c);

/// Parses a JSON text as strictly as a plan file. Throws `input_error` that names the file and the place.
[[nodiscard]] nlohmann::json parse_json(std::string const& text, std::string const& file);

}  // namespace rota::cli
