#pragma once

#include <rota/sim/evaluation.hpp>

#include <nlohmann/json.hpp>

#include <string>

namespace rota::cli {

/// The plan that is played where the command line names none: the shipped one. `ROTA_DATA` in the environment names
/// another folder than the one the program was built with.
[[nodiscard]] std::string default_plan();

/// The plan of a file, or the activated plans of a plan type, with the utilities of soccer. Throws `input_error`.
[[nodiscard]] sim::playbook read_playbook(std::string const& file);

/// Throws `input_error` if so many robots have no valid allocation of any of the plans.
void require_playable(sim::playbook const& book, std::size_t robots, std::string const& file);

/// For CLI11: what is wrong with the text of a seed, if anything. Its own conversion would wrap -1 and cap 2^64.
[[nodiscard]] std::string check_seed(std::string const& text);

/// One run, in the form that `rota reproduce --json` prints. Undefined shares are null.
[[nodiscard]] nlohmann::ordered_json as_json(sim::scenario what, bool resolution, sim::figures const& f);

/// Numbers for people: "12.3 %", "115 ms", "4.2 s", "5.0 min".
[[nodiscard]] std::string percent(double share);
[[nodiscard]] std::string milliseconds_text(double ms);
/// "5" if robot 5 led always, "5: 9, 4: 1" otherwise, "-" if nobody did.
[[nodiscard]] std::string leaders(sim::figures const& f);

}  // namespace rota::cli
