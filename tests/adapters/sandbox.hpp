#pragma once

#include <rota/adapters/alica/convert.hpp>
#include <rota/adapters/alica/draft.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace rota::test {

namespace fs = std::filesystem;

// The reader, compiled once (reader.cpp): it brings the parsers of JSON and XML, 20 s in each unit that includes it.
[[nodiscard]] alica::model load(std::vector<fs::path> const& paths, alica::load_options const& limits = {});
[[nodiscard]] inline alica::model load(fs::path const& path, alica::load_options const& limits = {}) {
  return load(std::vector{path}, limits);
}
[[nodiscard]] alica::detail::draft read_document(std::string_view bytes, alica::file_kind kind);

/// A folder of its own, gone at the end.
class sandbox {
public:
  sandbox() {
    auto pattern = (fs::temp_directory_path() / "rota-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) std::abort();
    folder_ = fs::canonical(pattern);
  }
  sandbox(sandbox const&) = delete;
  sandbox& operator=(sandbox const&) = delete;
  ~sandbox() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  [[nodiscard]] fs::path const& folder() const { return folder_; }
  [[nodiscard]] std::string path(std::string const& name) const { return (folder_ / name).string(); }
  /// Writes a file, with its folders. @return its path
  std::string write(std::string const& name, std::string_view bytes) const {
    auto const p = folder_ / name;
    fs::create_directories(p.parent_path());
    std::ofstream(p, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return p.string();
  }
  [[nodiscard]] alica::model load(alica::load_options const& limits = {}) const { return test::load(folder_, limits); }

private:
  fs::path folder_;
};

inline std::string slurp(fs::path const& p) {
  std::ifstream in(p, std::ios::binary);
  std::stringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

inline std::vector<alica::diagnostic> only(alica::model const& m, alica::severity s) {
  std::vector<alica::diagnostic> out;
  for (auto const& d : m.diagnostics)
    if (d.severity == s) out.push_back(d);
  return out;
}

/// All errors, one a line, for messages.
inline std::string errors_of(alica::model const& m) {
  std::string out;
  for (auto const& d : only(m, alica::severity::error)) out += d.file + ':' + d.place + ": " + d.reason + '\n';
  return out;
}

/// The folder of the plan files that the project ships.
inline fs::path own_files() { return fs::path(ROTA_SOURCE_DIR) / "examples" / "data" / "soccer"; }

/// The folder of ALICA's own files, where it is there.
inline fs::path real_files() {
  auto const* const elsewhere = std::getenv("ROTA_ALICA_DATA");
  return elsewhere != nullptr ? fs::path(elsewhere) : fs::path(ROTA_SHARED_ALICA);
}

}  // namespace rota::test
