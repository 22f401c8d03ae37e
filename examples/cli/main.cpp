#include "command.hpp"
#include "text.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>

namespace {

/// Says what is wrong in one line that people can read, whatever the message holds.
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
  using namespace rota::cli;
  try {
    CLI::App program{"Who does what now: looks at plan files, allocates tasks, and shows why.", "rota"};
    program.set_version_flag("--version", "rota " ROTA_VERSION);
    program.require_subcommand(1);
    chosen_command chosen;
    add_check(program, chosen);
    add_allocate(program, chosen);
    add_simulate(program, chosen);
    add_reproduce(program, chosen);
    try {
      program.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
      if (e.get_exit_code() == 0) return program.exit(e);  // --help, --version
      return complain(std::string(e.what()) + " (see rota --help)");
    }
    auto const done = chosen();
    bool const written = std::fwrite(done.output.data(), 1, done.output.size(), stdout) == done.output.size();
    if (!written || std::fflush(stdout) != 0) return complain("the output cannot be written");
    return done.status;
  } catch (std::exception const& e) {
    return complain(e.what());
  }
}
