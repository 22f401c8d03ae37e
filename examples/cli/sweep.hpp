#pragma once

#include <rota/sim/playbook.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rota::cli {

/// One setting of a sweep. What does not apply to its system is 0, or "-".
struct sweep_cell {
  std::string trouble;
  std::uint64_t robots = 0;
  double loss = 0;
  std::int64_t period_ms = 0;
  std::string system;
  std::uint32_t cycles = 0;
  std::string reign;
  double reign_s = 0;
  std::string stamp;
  std::string news;
  double hysteresis = 0;  ///< of the plan, in its own unit
  double change_cost = 0;
  double minutes = 0;

  friend bool operator==(sweep_cell const&, sweep_cell const&) = default;
};

/// What is measured in each game, in the order of the columns. `sim::closed::tally` defines it.
enum class quantity : unsigned char {
  not_one,   ///< share of time without exactly one attacker
  wrong,     ///< … with one, and clearly the wrong one
  conflict,  ///< … in conflict
  median,    ///< ms until a conflict is resolved
  p99,
  reaction,  ///< ms until a true change of the ball is acted on, mean
  reaction_p95,
  missed,    ///< share of such changes
  to_ball,   ///< ms a ball lies free, for each that is reached
  reigns,    ///< an hour
  right,     ///< share of reigns
  messages,  ///< a second and robot
  bytes,
  not_right  ///< share of time without exactly one attacker, or with the wrong one: follows from the first two
};
inline constexpr std::size_t quantities = 14;
/// Those that rows hold; the rest follows from them.
inline constexpr std::size_t kept_quantities = 13;

/// One game. A figure is missing if there was nothing to measure.
struct sweep_row {
  sweep_cell cell;
  std::uint64_t seed = 0;
  std::string plan;     ///< the names of the plans
  std::string version;  ///< of the program
  std::array<std::optional<double>, quantities> figures{};
};

/// A figure over all seeds: its mean, and half the width of the interval that holds the true mean with 95 %.
struct estimate {
  std::size_t games = 0;
  double mean = 0;
  std::optional<double> within;  ///< of two games or more
};
struct sweep_line {
  sweep_cell cell;
  std::array<estimate, quantities> figures;
};
struct sweep_table {
  std::string name;  ///< of the table, or empty
  std::uint64_t seed = 0;
  std::uint64_t seeds = 0;
  std::string plan;
  std::vector<sweep_line> lines;
};

/// Mean and 95 % interval (Student's t).
[[nodiscard]] estimate estimated(std::vector<double> const& values);

/// The name of a quantity in JSON.
[[nodiscard]] std::string_view name_of(quantity m);

/// Plays one game, which only games.cpp compiles.
[[nodiscard]] std::array<std::optional<double>, quantities> play_cell(sim::playbook const& book, sweep_cell const& cell,
                                                                      std::uint64_t seed);

/// What a cell adds to the names of system and trouble, where it differs from the other lines: "n = 4, 20.0 % loss".
[[nodiscard]] std::string differences(sweep_table const& t, sweep_cell const& cell);

/// Two pictures side by side, one of all games without delusions and one with, where the table has such: reaction time against
/// time without exactly one attacker, a point for each line.
[[nodiscard]] std::string as_chart(sweep_table const& t);

/// Rows of former sweeps, one a line. Throws `input_error` where the file holds something else or cannot be written; then it is
/// as it was before. A half line at the end, of a sweep that was interrupted, is dropped.
class row_file {
public:
  explicit row_file(std::string path);
  row_file(row_file const&) = delete;
  row_file& operator=(row_file const&) = delete;
  ~row_file();

  [[nodiscard]] std::vector<sweep_row> const& rows() const { return rows_; }
  void append(sweep_row const& row);

private:
  [[noreturn]] void complain(std::string const& what) const;

  std::string path_;
  int file_ = -1;
  long long size_ = 0;
  std::vector<sweep_row> rows_;
};

/// Replaces a file by this text, or leaves it as it was and throws `input_error`.
void write_whole(std::string const& path, std::string const& text);

}  // namespace rota::cli
