#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace rota::cli {

/// How the program ends.
enum exit_status : int {
  success = 0,
  negative = 1,  ///< the answer is no: errors found in files, no valid allocation, a broken promise
  misuse = 2     ///< the command line or an input file is wrong
};

/// Wrong input: one line that says file, place and reason. `main` prints it and ends with `misuse`.
class input_error : public std::runtime_error {
public:
  explicit input_error(std::string const& line) : std::runtime_error(line) {}
  input_error(std::string const& file, std::string const& place, std::string const& reason)
      : std::runtime_error(file + (place.empty() ? "" : ':' + place) + ": " + reason) {}
};

/// The result of a subcommand: its exit status and its whole output, which is written at once or not at all.
struct outcome {
  std::string output;
  exit_status status = success;
};

/// The subcommand that the command line chose, with its options.
using command = std::function<outcome()>;

/// Reads the command line. If it asks for help or the version, prints that and ends. Throws `input_error`.
[[nodiscard]] command parse_command_line(int argc, char** argv);

// The subcommands, one file each. They know nothing of the command line.

struct check_options {
  std::vector<std::string> paths;
  bool json = false;
};
[[nodiscard]] outcome run_check(check_options const& o);

struct allocate_options {
  std::vector<std::string> plans;
  std::string plan_type;  ///< empty: find it
  std::string utilities;
  std::string current;    ///< empty: none
  bool minimise = false;  ///< the table holds costs
  bool no_idle = false;
  std::optional<std::uint64_t> budget;  ///< steps; none: until done
  std::optional<double> deadline;       ///< ms; none: until done
  bool stats = false;
  bool json = false;
};
[[nodiscard]] outcome run_allocate(allocate_options const& o);

struct simulate_options {
  std::string scenario;  ///< one that `sim::parse_scenario` knows
  std::string plan;      ///< empty: the shipped one
  std::uint64_t seed = 1;
  std::optional<double> minutes;  ///< none: as long as the scenario says
  std::size_t robots = 0;
  double loss = 0;
  double latency = 0;  ///< ms
  std::uint32_t cycles = 0;
  double reign = 0;  ///< s
  std::string resolution = "on";
  std::string stamp = "id";  ///< one that `sim::parse_stamp_policy` knows
  bool json = false;
};
/// The defaults, which are those of the simulation.
[[nodiscard]] simulate_options default_simulation();
[[nodiscard]] outcome run_simulate(simulate_options const& o);

struct reproduce_options {
  std::uint64_t seed = 1;
  std::string plan;                 ///< empty: the shipped one
  std::string stamp = "consensus";  ///< one that `sim::parse_stamp_policy` knows
  bool as_published = false;        ///< as the paper has it, and nothing else
  bool json = false;
};
[[nodiscard]] outcome run_reproduce(reproduce_options const& o);

struct monitors_options {
  std::size_t runs = 200;
  std::uint32_t cycles = 0;  ///< n; 0: 2 to 6
  std::string monitor;       ///< empty: each
  std::int64_t limit = 0;    ///< in seconds: so long a conflict may take to be seen; 0: 5, and 2 for some without loss
  std::uint64_t seed = 1;
  bool json = false;
};
[[nodiscard]] outcome run_monitors(monitors_options const& o);

struct stamps_options {
  std::uint64_t seeds = 10;
  std::uint64_t seed = 1;         ///< the first
  std::optional<double> minutes;  ///< none: as long as each scenario says
  std::string stamp;              ///< only this one; empty: each, and what robots could do that know more
  std::string plan;               ///< empty: the shipped one
  bool json = false;
};
[[nodiscard]] outcome run_stamps(stamps_options const& o);

struct timing_options {
  std::size_t runs = 10'000;
  std::uint64_t seed = 1;
};
[[nodiscard]] outcome run_timing(timing_options const& o);

struct budget_options {
  double minutes = 20;
  double loss = 0.02;
  std::size_t runs = 200;
  std::uint64_t seed = 1;
  std::string plan;  ///< empty: the shipped one
  bool json = false;
};
[[nodiscard]] outcome run_budget(budget_options const& o);

struct campaign_options {
  std::uint64_t ticks = 1'000'000;
  std::optional<std::uint64_t> runs;  ///< none: as `ticks` says, or 200 for each figure
  std::uint64_t seed = 1;
  std::optional<std::size_t> robots;
  std::optional<double> delay;  ///< ms
  bool figures = false;
  double opening = 0;  ///< ms; of each robot, for the figures
  bool json = false;
};
[[nodiscard]] campaign_options default_campaign();
[[nodiscard]] outcome run_campaign(campaign_options const& o);

struct sweep_options {
  std::string table;  ///< empty: none; what is not named below is as the table says
  std::vector<std::string> systems, troubles, reigns, stamps, news;
  std::vector<double> losses, reign_lengths, hystereses, change_costs;
  std::vector<std::uint64_t> robots;
  std::vector<std::int64_t> periods;  ///< ms
  std::vector<std::uint32_t> cycles;
  double minutes = 10;
  std::uint64_t seeds = 10;
  std::uint64_t seed = 1;
  std::string rows;      ///< the file that keeps what was played; empty: none
  std::string chart;     ///< the picture to write; empty: none
  std::size_t jobs = 0;  ///< threads; 0: as many as there are cores
  bool json = false;
};
[[nodiscard]] outcome run_sweep(sweep_options const& o);
/// The tables that it knows.
[[nodiscard]] std::vector<std::string> sweep_table_names();

}  // namespace rota::cli
