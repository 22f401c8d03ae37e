#include "command.hpp"
#include "text.hpp"

#include <cstdio>
#include <exception>

namespace {

/// Prints what is wrong in one readable line, whatever characters the message has.
int complain(std::string const& what) {
  constexpr std::size_t limit = 2000;
  auto line = rota::cli::printable(what);
  if (line.size() > limit) {
    auto cut = limit;
    while ((static_cast<unsigned char>(line[cut]) & 0xC0U) == 0x80) --cut;
    line = line.substr(0, cut) + "…";
  }
  std::fprintf(stderr, "rota: %s\n", line.c_str());
  return rota::cli::misuse;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    auto const chosen = rota::cli::parse_command_line(argc, argv);
    auto const done = chosen();
    bool const written = std::fwrite(done.output.data(), 1, done.output.size(), stdout) == done.output.size();
    if (!written || std::fflush(stdout) != 0) return complain("the output cannot be written");
    return done.status;
  } catch (std::exception const& e) {
    return complain(e.what());
  }
}
