#pragma once

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include <unistd.h>

namespace peers {

/// A file for another process, which lives as long as this object.
class problem_file {
public:
  /// @param suffix tells some programs the format
  problem_file(std::string const& suffix, std::string_view text) {
    static int count = 0;
    auto const name = "rota-" + std::to_string(::getpid()) + '-' + std::to_string(count++) + suffix;
    path_ = std::filesystem::temp_directory_path() / name;
    std::ofstream(path_) << text;
  }
  ~problem_file() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  problem_file(problem_file const&) = delete;
  problem_file& operator=(problem_file const&) = delete;

  std::string path() const { return path_.string(); }

private:
  std::filesystem::path path_;
};

/// What a command writes to its standard output.
inline std::string output_of(std::string const& command) {
  struct closer {
    void operator()(std::FILE* f) const { ::pclose(f); }
  };
  std::unique_ptr<std::FILE, closer> const pipe(::popen((command + " 2>/dev/null").c_str(), "r"));
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 4096> part{};
  while (auto const n = std::fread(part.data(), 1, part.size(), pipe.get())) text.append(part.data(), n);
  return text;
}

/// The number behind the last `key` in a text.
inline double number_after(std::string const& text, std::string_view key) {
  auto const at = text.rfind(key);
  if (at == std::string::npos) throw std::runtime_error("no " + std::string(key) + " in:\n" + text);
  return std::stod(text.substr(at + key.size()));
}

}  // namespace peers
