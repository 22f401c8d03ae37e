#pragma once

#include "budget.hpp"
#include "campaign.hpp"
#include "monitors.hpp"
#include "stamps.hpp"
#include "sweep.hpp"
#include <rota/adapters/alica/model.hpp>
#include <rota/search/limits.hpp>
#include <rota/sim/fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rota::cli {

struct evaluation;

// One file writes and reads all JSON of the program, because the JSON library is slow to compile.

/// The content of plan files, and what is wrong with them.
[[nodiscard]] std::string as_json(alica::model const& m);

struct named_change {
  std::string agent;
  std::optional<std::string> plan;  ///< if there are several plans
  std::string task;
};

/// What a running team would do. It does not always change to the best allocation.
struct named_decision {
  bool keep = false;
  std::string reason;
};

/// What a search did and how long it took.
struct search_report {
  search_work work;
  double microseconds = 0;
};

/// What `rota allocate` found, in names only.
struct named_answer {
  std::string plan;
  double utility = 0;
  std::optional<double> cost;  ///< instead of the utility, where the table holds costs
  bool optimal = false;
  double gap = 0;  ///< if it is not proved optimal: the optimum is better by no more than this
  std::vector<std::pair<std::string, std::string>> assignment;  ///< agent, task
  std::vector<std::string> idle;
  std::vector<named_change> added;
  std::vector<named_change> removed;
  std::optional<named_decision> decision;
  std::optional<search_report> stats;
};
[[nodiscard]] std::string as_json(named_answer const& a);

/// Instead of an answer, if there is no valid allocation.
[[nodiscard]] std::string refusal_as_json(std::string const& reason);

/// An allocation as it stands in a file: names only.
struct named_allocation {
  std::optional<std::string> plan;
  struct pair {
    std::string agent;
    std::string task;
    std::string place;
  };
  std::vector<pair> assignment;
};

/// Reads an allocation in the form that `as_json(named_answer const&)` writes. Throws `input_error` for anything else.
[[nodiscard]] named_allocation read_allocation(std::string const& file);

/// One run. Undefined shares are null.
[[nodiscard]] std::string as_json(sim::scenario what, bool resolution, std::uint64_t seed, std::string const& stamp,
                                  sim::figures const& f);

/// All runs, each in the form of one run.
[[nodiscard]] std::string as_json(evaluation const& e, std::uint64_t seed, std::string const& stamp);

/// The table of monitors, a row each.
[[nodiscard]] std::string as_json(std::vector<monitor_row> const& rows, std::uint64_t seed);

/// The table of message budgets, a row each.
[[nodiscard]] std::string as_json(std::vector<budget_row> const& rows, std::uint64_t seed);

/// What a campaign came to.
[[nodiscard]] std::string as_json(campaign_summary const& s);

/// How long a team takes to overcome faults, a row each.
[[nodiscard]] std::string as_json(std::vector<fault_row> const& rows, std::uint64_t runs, std::uint64_t seed);

/// Ways to choose who leads, in each scenario.
[[nodiscard]] std::string as_json(std::vector<stamp_cell> const& cells, std::uint64_t seed, std::uint64_t seeds);

/// A sweep, a line each.
[[nodiscard]] std::string as_json(sweep_table const& t);

/// One game as one line, without its end.
[[nodiscard]] std::string as_line(sweep_row const& row);
/// Reads such a line; nothing if it is none.
[[nodiscard]] std::optional<sweep_row> read_row(std::string const& line);
/// How each such line begins.
[[nodiscard]] std::string_view row_start();

}  // namespace rota::cli
