#pragma once

#include "text.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace rota::cli {

/// Says on a terminal what is going on, on one line that is wiped in the end.
class progress {
public:
  progress() = default;
  progress(progress const&) = delete;
  progress& operator=(progress const&) = delete;
  ~progress() {
    if (shown_) std::fprintf(stderr, "\r\x1b[K");
  }
  void next(std::size_t steps, std::string const& what) {
    ++step_;
    if (shown_) std::fprintf(stderr, "\r\x1b[K[%zu/%zu] %s", step_, steps, what.c_str());
  }

private:
  std::size_t step_ = 0;
  bool shown_ = isatty(STDERR_FILENO) == 1;
};

/// Columns as wide as they need to be.
template <std::size_t N>
[[nodiscard]] std::string laid_out(std::vector<std::array<std::string, N>> const& rows) {
  std::array<std::size_t, N> width{};
  for (auto const& row : rows)
    for (std::size_t i = 0; i < N; ++i) width[i] = std::max(width[i], row[i].size());
  std::string out;
  for (auto const& row : rows) {
    std::string line = "  ";
    for (std::size_t i = 0; i < N; ++i) line += i + 1 < N ? padded(row[i], width[i] + 2) : row[i];
    out += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return out;
}

}  // namespace rota::cli
