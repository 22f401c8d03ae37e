#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rota::cli {

/// What a campaign came to.
struct campaign_summary {
  struct failure {
    std::string promise;
    double at_ms = 0;
    std::size_t robot = 0;  ///< its id
    std::string reason;
    std::string again;  ///< the command that plays this run again
  };
  std::uint64_t seed = 0;
  std::uint64_t runs = 0;
  std::vector<std::pair<std::string, std::uint64_t>> seen{};  ///< how often what happened
  std::optional<failure> broken{};
};

/// A figure of `rota campaign --figures`, and how much was wished for at most.
struct fault_row {
  std::string name;
  double here = 0;
  std::optional<double> wanted{};
  bool share = false;  ///< of time; else in ms
};

}  // namespace rota::cli
