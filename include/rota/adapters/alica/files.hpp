#pragma once

#include <rota/adapters/alica/draft.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

namespace rota::alica::detail {

namespace fs = std::filesystem;

/// A file that was found, with its real path; or why it is not read.
struct found_file {
  std::string shown;  ///< the path that the user gave, or that follows from it
  fs::path canonical;
  std::string problem;  ///< empty: a regular file
  alica::severity severity = alica::severity::error;
};

/// Looks at one path. @return nothing for a folder that is to be entered
[[nodiscard]] inline std::optional<found_file> look_at(fs::path const& p, bool given) {
  bool const plan_name = kind_of(p.filename().string()) != file_kind::none;
  auto const grave = plan_name || given ? severity::error : severity::ignored;
  std::error_code error;
  auto const status = fs::status(p, error);
  if (status.type() == fs::file_type::directory) {
    if (plan_name) return found_file{p.string(), p, "a folder with the name of a plan file", severity::error};
    if (!given && fs::is_symlink(p, error))
      return found_file{p.string(), p, "a symbolic link to a folder: not followed", severity::ignored};
    return std::nullopt;
  }
  if (status.type() == fs::file_type::not_found) {
    bool const dangling = fs::is_symlink(p, error);
    return found_file{p.string(), p, dangling ? "a symbolic link to nothing" : "no such file or folder", grave};
  }
  if (status.type() == fs::file_type::none || error)
    return found_file{p.string(), p, "cannot be reached: " + error.message(), grave};
  if (status.type() != fs::file_type::regular) return found_file{p.string(), p, "not a regular file", grave};
  auto real = fs::canonical(p, error);
  if (error) return found_file{p.string(), p, "cannot be reached: " + error.message(), grave};
  return found_file{p.string(), std::move(real), "", grave};
}

/// Every file below a path (or the file itself), ascending by name; links to folders are not followed.
[[nodiscard]] inline std::vector<found_file> files_below(fs::path const& given, std::size_t max_entries) {
  std::vector<found_file> out;
  if (auto single = look_at(given, true)) {
    out.push_back(*std::move(single));
    return out;
  }
  std::vector<fs::path> folders{given};
  std::size_t visited = 0;
  while (!folders.empty()) {
    auto const folder = std::move(folders.back());
    folders.pop_back();
    std::error_code error;
    auto it = fs::directory_iterator(folder, error);
    for (; !error && it != fs::directory_iterator{}; it.increment(error)) {
      if (++visited > max_entries) {
        out.assign(1, {given.string(), given, "more than " + std::to_string(max_entries) + " files and folders"});
        return out;
      }
      if (auto file = look_at(it->path(), false))
        out.push_back(*std::move(file));
      else
        folders.push_back(it->path());
    }
    if (error) out.push_back({folder.string(), folder, "the folder cannot be listed: " + error.message()});
  }
  std::sort(out.begin(), out.end(), [](auto const& a, auto const& b) { return a.shown < b.shown; });
  return out;
}

/// The bytes of a file, or why they cannot be read.
[[nodiscard]] inline std::variant<std::string, diagnostic> read_bytes(fs::path const& p, std::size_t max_bytes) {
  auto const refuse = [](std::string why) { return diagnostic{severity::error, {}, {}, {}, std::move(why)}; };
  std::error_code error;
  auto const size = fs::file_size(p, error);
  auto const too_large = "larger than " + std::to_string(max_bytes) + " bytes";
  if (!error && size > max_bytes) return refuse(too_large);
  std::ifstream in(p, std::ios::binary);
  if (!in) return refuse("cannot be opened");
  std::string bytes;
  char block[1 << 14];
  while (in.read(block, sizeof block), in.gcount() > 0) {
    bytes.append(block, static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > max_bytes) return refuse(too_large);  // it grew meanwhile, or its size was wrong
  }
  if (in.bad()) return refuse("cannot be read");
  return bytes;
}

/// The nearest folder called `etc` above a canonical path, if any.
[[nodiscard]] inline std::optional<fs::path> nearest_etc(fs::path const& canonical) {
  for (auto p = canonical.parent_path(); p.has_relative_path(); p = p.parent_path())
    if (p.filename() == "etc") return p;
  return std::nullopt;
}

/// The deepest folder that holds all these canonical folders.
[[nodiscard]] inline fs::path common_folder(std::vector<fs::path> const& folders) {
  if (folders.empty()) return {};
  fs::path common = folders.front();
  for (fs::path const& f : folders) {
    fs::path shared;
    auto a = common.begin();
    auto b = f.begin();
    for (; a != common.end() && b != f.end() && *a == *b; ++a, ++b) shared /= *a;
    common = std::move(shared);
  }
  return common;
}

}  // namespace rota::alica::detail
