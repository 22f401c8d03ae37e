#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rota::sim {
struct study_options;
struct study_figures;
}  // namespace rota::sim

namespace rota::cli {

/// What one monitor does with one n.
struct monitor_row {
  static constexpr double losses[] = {0, 0.2, 0.6};
  static constexpr std::int64_t jumps_ms[] = {100, 200, 400};

  std::string name;
  std::uint32_t cycles = 0;
  std::vector<double> detection_ms{};  ///< 2 robots at each loss, then 5 robots
  std::size_t fights_missed = 0;       ///< of all these runs
  std::vector<double> missed{};        ///< no room, leaves, insists, yields: each at each loss
  std::vector<double> alarms{};        ///< per robot and minute, for each of `jumps_ms`
};

/// `sim::study_detection` of a robot's default monitor, which only monitors.cpp compiles.
[[nodiscard]] sim::study_figures study_of_default(sim::study_options const& options);

}  // namespace rota::cli
