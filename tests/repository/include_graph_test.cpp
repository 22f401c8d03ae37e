#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

using sources = std::map<std::string, std::string>;  // header name as included, such as rota/core/in.hpp, to its text

sources public_headers() {
  namespace fs = std::filesystem;
  fs::path const root = fs::path{ROTA_SOURCE_DIR} / "include";
  sources result;
  for (auto const& entry : fs::recursive_directory_iterator{root}) {
    if (entry.path().extension() != ".hpp") continue;
    std::ostringstream text;
    text << std::ifstream{entry.path()}.rdbuf();
    result.emplace(entry.path().lexically_relative(root).generic_string(), text.str());
  }
  return result;
}

std::vector<std::string> includes_of(std::string const& text) {
  std::vector<std::string> result;
  std::istringstream lines{text};
  for (std::string line; std::getline(lines, line);) {
    std::erase_if(line, [](char c) { return c == ' ' || c == '\t'; });
    if (!line.starts_with("#include<") && !line.starts_with("#include\"")) continue;
    auto const first = std::string_view{"#include<"}.size();
    result.push_back(line.substr(first, line.find_first_of(">\"", first) - first));
  }
  return result;
}

/// The first folder below rota/: rooms may have rooms of their own. Empty for the umbrella.
std::string room_of(std::string const& header) {
  auto const rest = header.substr(std::string_view{"rota/"}.size());
  auto const slash = rest.find('/');
  return slash == std::string::npos ? "" : rest.substr(0, slash);
}

/// The height of a header's room. The umbrella lies above team and below sim; adapters and testing above all, side by
/// side.
int height(std::string const& header) {
  static std::vector<std::string> const rooms{"core", "algebra", "model", "allocation", "search",
                                              "team", "",        "sim",   "adapters"};
  // Rooms side by side on one floor: neither may see the other.
  static std::map<std::string, std::string> const beside{{"testing", "adapters"}, {"dense", "algebra"}};
  auto const room = room_of(header);
  auto const floor = beside.find(room);
  auto const found = std::find(rooms.begin(), rooms.end(), floor == beside.end() ? room : floor->second);
  return found == rooms.end() ? -1 : static_cast<int>(found - rooms.begin());
}

/// The solvers on numbers are for search, and for who compiles everything at once: other rooms know plans or know nothing of
/// them.
bool may_see_numbers(std::string const& header) {
  return room_of(header) == "search" || height(header) > height("rota/team/fwd.hpp");
}

std::string folder_of(std::string const& header) {
  return std::filesystem::path{header}.parent_path().generic_string();
}

/// X/detail/ is seen only from below X/. rota/compiled.hpp compiles the details of the solvers for everybody else.
bool may_see_details(std::string const& header, std::string const& included) {
  auto const detail = included.rfind("/detail/");
  return detail == std::string::npos || header == "rota/compiled.hpp" ||
         header.starts_with(included.substr(0, detail + 1));
}

std::vector<std::string> upward_includes(sources const& headers) {
  std::vector<std::string> result;
  for (auto const& [header, text] : headers) {
    if (height(header) < 0) result.push_back(header + " lies in no known room");
    for (auto const& included : includes_of(text)) {
      bool const ours = included.starts_with("rota/");
      if (!ours && headers.contains(folder_of(header) + "/" + included))
        result.push_back(header + " includes " + included + " by a relative name");
      else if (ours && !headers.contains(included))
        result.push_back(header + " includes " + included + ", which does not exist");
      else if (ours && room_of(included) != room_of(header) && height(included) >= height(header))
        result.push_back(header + " includes " + included + " from a room that is not below it");
      else if (ours && room_of(included) == "dense" && room_of(header) != "dense" && !may_see_numbers(header))
        result.push_back(header + " includes " + included + ", which is for search");
      else if (ours && !may_see_details(header, included))
        result.push_back(header + " includes " + included + ", a detail of another folder");
    }
  }
  return result;
}

using names = std::set<std::string>;

/// All that including `header` includes, ours and not.
names reached_from(sources const& headers, std::string const& header) {
  names reached{header};
  for (std::vector<std::string> open{header}; !open.empty();) {
    auto const text = headers.find(open.back());
    open.pop_back();
    if (text == headers.end()) continue;
    for (auto const& included : includes_of(text->second))
      if (reached.insert(included).second) open.push_back(included);
  }
  return reached;
}

/// Those with a folder or an extension, hence not the standard library's, that are not ours.
names foreign_headers(sources const& headers, std::string const& header) {
  auto result = reached_from(headers, header);
  std::erase_if(result, [&](std::string const& name) {
    return headers.contains(name) || name.find_first_of("/.") == std::string::npos;
  });
  return result;
}

TEST(rooms, include_only_downwards) {
  auto const headers = public_headers();
  EXPECT_FALSE(headers.empty());
  for (auto const& complaint : upward_includes(headers)) ADD_FAILURE() << complaint;
}

TEST(rooms, upward_includes_would_be_found) {
  auto const complaints = [](std::string const& header, std::string const& text) {
    sources headers{
        {"rota/core/in.hpp", ""},         {"rota/algebra/event.hpp", ""}, {"rota/team/robot.hpp", ""},
        {"rota/sim/world.hpp", ""},       {"rota/rota.hpp", ""},          {"rota/adapters/eigen.hpp", ""},
        {"rota/testing/laws.hpp", ""},    {"rota/dense/buffer.hpp", ""},  {"rota/dense/flow/detail/graph.hpp", ""},
        {"rota/core/detail/bits.hpp", ""}};
    headers.insert_or_assign(header, text);
    return upward_includes(headers).size();
  };
  EXPECT_EQ(complaints("rota/core/a.hpp", "#include <rota/algebra/event.hpp>\n"), 1u);
  EXPECT_EQ(complaints("rota/algebra/a.hpp", "#pragma once\n\n#  include \"rota/team/robot.hpp\"\n"), 1u);
  EXPECT_EQ(complaints("rota/team/a.hpp", "#include <rota/sim/world.hpp>"), 1u);
  for (auto const* room : {"model", "allocation", "team"})
    EXPECT_EQ(complaints("rota/" + std::string(room) + "/a.hpp", "#include <rota/dense/buffer.hpp>"), 1u) << room;
  EXPECT_EQ(complaints("rota/search/a.hpp", "#include <rota/dense/buffer.hpp>"), 0u);
  EXPECT_EQ(complaints("rota/team/a.hpp", "#include <rota/rota.hpp>"), 1u);
  EXPECT_EQ(complaints("rota/sim/a.hpp", "#include <rota/adapters/eigen.hpp>"), 1u);
  EXPECT_EQ(complaints("rota/rota.hpp", "#include <rota/sim/world.hpp>"), 1u);
  EXPECT_EQ(complaints("rota/adapters/a.hpp", "#include <rota/testing/laws.hpp>"), 1u);
  EXPECT_EQ(complaints("rota/core/a.hpp", "#include \"in.hpp\"\n"), 1u);
  EXPECT_EQ(complaints("rota/core/a.hpp", "#include <rota/core/absent.hpp>\n"), 1u);
  EXPECT_EQ(complaints("rota/attic/a.hpp", ""), 1u);
  // Numbers know no plan and no event, and events know no solver.
  EXPECT_EQ(complaints("rota/dense/a.hpp", "#include <rota/algebra/event.hpp>\n"), 1u);
  EXPECT_EQ(complaints("rota/algebra/a.hpp", "#include <rota/dense/buffer.hpp>\n"), 1u);
  EXPECT_EQ(complaints("rota/dense/flow/a.hpp", "#include <rota/core/in.hpp>\n"), 0u);
  // What is private says so by its place.
  EXPECT_EQ(complaints("rota/team/a.hpp", "#include <rota/core/detail/bits.hpp>\n"), 1u);
  EXPECT_EQ(complaints("rota/dense/tree/a.hpp", "#include <rota/dense/flow/detail/graph.hpp>\n"), 1u);
  EXPECT_EQ(complaints("rota/dense/flow/a.hpp", "#include <rota/dense/flow/detail/graph.hpp>\n"), 0u);
  EXPECT_EQ(complaints("rota/dense/flow/detail/a.hpp", "#include <rota/dense/flow/detail/graph.hpp>\n"), 0u);
  EXPECT_EQ(complaints("rota/algebra/a.hpp", "#include <rota/core/in.hpp>\n#include <vector>\n"), 0u);
  EXPECT_EQ(complaints("rota/rota.hpp", "#include <rota/team/robot.hpp>\n"), 0u);
  EXPECT_EQ(complaints("rota/sim/a.hpp", "#include <rota/rota.hpp>\n"), 0u);
  EXPECT_EQ(complaints("rota/core/a.hpp", "// #include <rota/team/robot.hpp>\n"), 0u);
}

TEST(umbrella, reaches_the_standard_library_only) {
  auto const headers = public_headers();
  if (!headers.contains("rota/rota.hpp")) GTEST_SKIP() << "no umbrella yet";
  EXPECT_EQ(foreign_headers(headers, "rota/rota.hpp"), names{});
}

TEST(umbrella, foreign_headers_would_be_found) {
  sources const headers{
      {"rota/rota.hpp", "#include <rota/core/a.hpp>\n#include <vector>\n"},
      {"rota/core/a.hpp", "#include <rota/core/b.hpp>\n"},
      {"rota/core/b.hpp", "#include <rota/core/a.hpp>\n#include <Eigen/Core>\n#include <rapidcheck.h>\n"}};
  EXPECT_EQ(foreign_headers(headers, "rota/rota.hpp"), (names{"Eigen/Core", "rapidcheck.h"}));
}

TEST(umbrella, holds_every_room_from_core_to_team) {
  auto const headers = public_headers();
  if (!headers.contains("rota/rota.hpp")) GTEST_SKIP() << "no umbrella yet";
  auto const reached = reached_from(headers, "rota/rota.hpp");
  // The bridge to std::chrono costs more to compile than all else together: it is for those who ask. So is printing.
  // What compiled.hpp defines is for one source file of a program.
  names const apart{"rota/core/chrono.hpp", "rota/compiled.hpp"};
  for (auto const& [header, text] : headers)
    EXPECT_TRUE(height(header) > height("rota/rota.hpp") || reached.contains(header) || apart.contains(header) ||
                header.ends_with("/fwd.hpp") || header.ends_with("/print.hpp") || header == "rota/format.hpp" ||
                header == "rota/hash.hpp")
        << header;
}

}  // namespace
