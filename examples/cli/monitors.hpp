#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rota::cli {

/// What one monitor does with one n.
struct monitor_row {
  static constexpr double losses[] = {0, 0.2, 0.6};
  static constexpr std::int64_t jumps_ms[] = {100, 200, 400};

  std::string name;
  std::uint32_t cycles = 0;
  std::vector<double> detection_ms{};  ///< 2 robots at each loss, then 5 robots
  std::size_t fights_missed = 0;       ///< of all these runs
  std::vector<double> missed{};        ///< no room, leaves, insists, yields: each without loss and at 60 %
  std::vector<double> alarms{};        ///< per robot and minute, for each of `jumps_ms`
};

}  // namespace rota::cli
