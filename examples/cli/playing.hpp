#pragma once

#include <rota/sim/evaluation.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rota::sim {
enum class oracle : unsigned char;
}

namespace rota::cli {

/// The plan that is played where the command line names none: the shipped one. `ROTA_DATA` in the environment names
/// another folder than the one the program was built with.
[[nodiscard]] std::string default_plan();

/// The plan of a file, or the activated plans of a plan type, with the utilities of soccer. Throws `input_error`.
[[nodiscard]] sim::playbook read_playbook(std::string const& file);

/// Throws `input_error` if so many robots have no valid allocation of any of the plans.
void require_playable(sim::playbook const& book, std::size_t robots, std::string const& file);

/// The stamp policy of this name. @pre `sim::parse_stamp_policy` knows it
[[nodiscard]] sim::stamp_function stamp_of(std::string const& policy);

/// `sim::play_knowing`, which only playing.cpp compiles.
[[nodiscard]] sim::figures play_scenario(sim::playbook const& book, sim::play_options const& options,
                                         std::optional<sim::oracle> what = std::nullopt);
/// What `sim::to_string` calls them.
[[nodiscard]] std::vector<std::pair<sim::oracle, std::string>> oracles();

/// What the evaluation came to: the check figures, and each scenario without resolution, as the paper has it, and as it is now.
struct evaluation {
  struct row {
    sim::scenario what{};
    sim::figures off;
    sim::figures published;
    std::optional<sim::figures> on;  ///< none if only what is published was asked for
  };
  sim::timing_figures timing, timing_at_200;
  std::vector<row> rows;

  [[nodiscard]] row const& of(sim::scenario s) const;
};

/// Plays all scenarios; with these stamps, unless only what is published is asked for. Says before each step how many there are, and what comes next.
[[nodiscard]] evaluation evaluate(sim::playbook const& book, std::uint64_t seed,
                                  std::optional<sim::stamp_function> const& stamp,
                                  std::function<void(std::size_t steps, std::string const& what)> const& next);

/// The names of the plans, in one line.
[[nodiscard]] std::string plan_names(sim::playbook const& book);

/// "5" if robot 5 led always, "5: 9, 4: 1" otherwise, "-" if nobody did.
[[nodiscard]] std::string leaders(sim::figures const& f);

}  // namespace rota::cli
