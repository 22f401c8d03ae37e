#include "command.hpp"
#include "json.hpp"
#include "sweep.hpp"
#include "text.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>

namespace rota::cli {
namespace {

/// Writes all of it; 0, or why not.
int write_all(int file, std::string_view text) {
  while (!text.empty()) {
    auto const n = ::write(file, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

std::string read_all(int file, std::string const& path) {
  std::string text;
  char buffer[1 << 16];
  for (;;) {
    auto const n = ::read(file, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw input_error(path, "", std::strerror(errno));
    if (n == 0) return text;
    text.append(buffer, static_cast<std::size_t>(n));
  }
}

}  // namespace

row_file::row_file(std::string path) : path_(std::move(path)) {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0) complain(std::strerror(errno));
  try {
    struct stat status{};
    if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode)) complain("not a regular file");
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) complain("another sweep writes it");
    auto const text = read_all(file_, path_);
    std::size_t line = 1, from = 0;
    for (std::size_t end; (end = text.find('\n', from)) != std::string::npos; from = end + 1, ++line) {
      auto const row = read_row(text.substr(from, end - from));
      if (!row) throw input_error(path_, std::to_string(line), "not a row of a sweep");
      rows_.push_back(*row);
    }
    size_ = static_cast<long long>(from);
    if (from == text.size()) return;
    std::string_view const rest = std::string_view(text).substr(from), start = row_start();
    if (!rest.starts_with(start.substr(0, rest.size())))
      throw input_error(path_, std::to_string(line), "not a row of a sweep");
    if (::ftruncate(file_, size_) != 0) complain(std::strerror(errno));
  } catch (...) {
    ::close(file_);
    throw;
  }
}

row_file::~row_file() { ::close(file_); }

void row_file::complain(std::string const& what) const { throw input_error(path_, "", what); }

void row_file::append(sweep_row const& row) {
  auto const line = as_line(row) + '\n';
  if (int const why = write_all(file_, line); why != 0) {
    if (::ftruncate(file_, size_) != 0) complain(std::string(std::strerror(why)) + "; its last line is cut off");
    complain(std::string(std::strerror(why)) + "; " + counted(rows_.size(), "row") + " of it are whole");
  }
  size_ += static_cast<long long>(line.size());
  rows_.push_back(row);
}

void write_whole(std::string const& path, std::string const& text) {
  struct stat there{};
  if (::stat(path.c_str(), &there) == 0 && !S_ISREG(there.st_mode)) throw input_error(path, "", "not a regular file");
  auto const draft = path + ".new";
  int const file = ::open(draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) throw input_error(path, "", std::strerror(errno));
  int why = write_all(file, text);
  if (::close(file) != 0 && why == 0) why = errno;
  if (why == 0 && ::rename(draft.c_str(), path.c_str()) != 0) why = errno;
  if (why == 0) return;
  ::unlink(draft.c_str());
  throw input_error(path, "", std::strerror(why));
}

}  // namespace rota::cli
