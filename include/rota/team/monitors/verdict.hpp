#pragma once

#include <rota/core/time.hpp>
#include <rota/model/allocation.hpp>
#include <rota/team/belief.hpp>

#include <cstdint>
#include <optional>

namespace rota {

/// When a monitor fires, and what it forgets.
struct monitor_options {
  std::uint32_t cycles = 4;  ///< n of the paper: after so many subsequent cycles the conflict counts as lasting
  duration pending_age = seconds(1);  ///< pending changes older than this are forgotten, and counts reset
  std::uint32_t yielding = 2;         ///< `insistence_monitor`: so many more, if the sender yields between

  friend bool operator==(monitor_options const&, monitor_options const&) = default;
};

/// What a monitor says about one deliberation.
template <vocabulary V>
struct monitor_verdict {
  std::uint32_t cycles = 0;  ///< cycles that this deliberation completed
  std::optional<typename V::agent>
      detected;  ///< the sender whose n-th subsequent cycle this was; the least, if several
};

}  // namespace rota
