#pragma once

#include <rota/sim/playbook.hpp>
#include <rota/team/robot.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace rota::sim {

/// What happened to a robot, or what it did.
enum class happening : unsigned char {
  entered,        ///< it began to execute the plan type, alone
  left,           ///< it stopped executing the plan type
  crashed,        ///< it has lost all that it knew, and does nothing any more
  restarted,      ///< it lives again; that it enters comes next
  deliberated,    ///< `change` is by deletion and reallocation; `cycles` and `detected` are from the monitor
  heard_plan,     ///< it received a plan message of `other`; `change` is e_m
  heard_claim,    ///< it received a claim of `other`; `change` is what the claim imposed
  said_plan,      ///< it broadcast a plan message
  said_claim,     ///< it broadcast a claim: a new one, a new version, or a repetition
  reign_began,    ///< it leads from now on: it has just `detected` a conflict, or it answers a smaller claim
  reign_renewed,  ///< it goes on leading, with a new claim, since others would do otherwise
  reign_ended     ///< it leads no more; `superseded` if it obeys a greater claim instead
};

[[nodiscard]] constexpr std::string_view to_string(happening h) noexcept {
  constexpr std::string_view words[] = {"entered",     "left",        "crashed",       "restarted",
                                        "deliberated", "heard-plan",  "heard-claim",   "said-plan",
                                        "said-claim",  "reign-began", "reign-renewed", "reign-ended"};
  return words[static_cast<std::size_t>(h)];
}

/// One record of the log that an observer sees, in order of simulated time. Valid during the call only: copy what you need.
struct log_record {
  instant time;
  std::size_t robot = 0;  ///< index; its id is one more
  happening what{};
  event<in<names>> const& change;           ///< of the robot's belief about the plan type; may be empty
  allocation_atoms<names> const& believed;  ///< the belief afterwards
  world_state const& truth;
  std::size_t other = 0;
  std::uint32_t cycles = 0;
  bool detected = false;
  bool leading = false;  ///< whether the robot leads afterwards
  bool superseded = false;
  std::optional<claim_outcome> claim{};
  message<names> const* content = nullptr;    ///< what was heard or said
  rota::verdict verdict = verdict::accepted;  ///< on what was heard
  refusal reason = refusal::none;             ///< … if it was refused
  bool genuine = true;                        ///< what was heard is what `other` has said
  std::optional<bool> abstains{};             ///< of a deliberation that searched: it found no valid allocation
  bool changed = false;  ///< it was refused or stale, and has changed the robot's digest: see `simulation_options`
};

template <class F>
concept observer = std::invocable<F&, log_record const&>;

}  // namespace rota::sim
