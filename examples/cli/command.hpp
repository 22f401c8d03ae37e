#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

namespace CLI {
class App;
}

namespace rota::cli {

/// How the program ends.
enum exit_status : int {
  success = 0,
  negative = 1,  ///< an honest "no": errors found in files, no valid allocation
  misuse = 2     ///< the command line or an input file is wrong
};

/// Wrong input: one line that says file, place and reason. `main` prints it and ends with `misuse`.
class input_error : public std::runtime_error {
public:
  explicit input_error(std::string const& line) : std::runtime_error(line) {}
  input_error(std::string const& file, std::string const& place, std::string const& reason)
      : std::runtime_error(file + (place.empty() ? "" : ':' + place) + ": " + reason) {}
};

/// What a subcommand yields: the whole output, written at once or not at all, and the exit status.
struct outcome {
  std::string output;
  exit_status status = success;
};

/// For CLI11: an option whose value is empty is a mistake of the calling script, not one that was left out.
[[nodiscard]] inline std::string check_not_empty(std::string const& text) {
  return text.empty() ? "an empty value" : "";
}

/// The subcommand that the command line chose.
using chosen_command = std::function<outcome()>;

/// Each adds one subcommand to the program: its options, and a callback that sets the chosen command. One file each.
void add_check(CLI::App& program, chosen_command& chosen);
void add_allocate(CLI::App& program, chosen_command& chosen);
void add_simulate(CLI::App& program, chosen_command& chosen);
void add_reproduce(CLI::App& program, chosen_command& chosen);

}  // namespace rota::cli
