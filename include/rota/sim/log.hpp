#pragma once

#include <rota/sim/playbook.hpp>
#include <rota/team/robot.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace rota::sim {

/// What a robot did or underwent.
enum class happening : unsigned char {
  entered,      ///< it began to execute the plan type, alone
  deliberated,  ///< `change` is what deletion and reallocation changed, `cycles` and `detected` what the monitor said
  heard_plan,   ///< a plan message of `other` was taken in; `change` is e_m
  heard_claim,  ///< a claim of `other` was taken in; `change` is what it imposed
  said_plan,    ///< it broadcast a plan message
  said_claim,   ///< it broadcast a claim: a new one, a new version, or a repetition
  reign_began,  ///< it leads from now on: it `detected` a conflict just before, or answers a smaller claim
  reign_ended   ///< it leads no more; `superseded` if because it obeys a greater claim now
};

/// One line of the log that an observer sees, in order of simulated time. Valid during the call only: copy what is needed.
struct log_record {
  instant time;
  std::size_t robot = 0;  ///< index; its id is one more
  happening what{};
  event<in<names>> const& change;           ///< of the robot's belief about the plan type; empty if nothing changed
  allocation_atoms<names> const& believed;  ///< the belief afterwards
  world_state const& truth;
  std::size_t other = 0;
  std::uint32_t cycles = 0;
  bool detected = false;
  bool leading = false;  ///< whether the robot leads, afterwards
  bool superseded = false;
  std::optional<claim_outcome> claim{};
};

template <class F>
concept observer = std::invocable<F&, log_record const&>;

}  // namespace rota::sim
