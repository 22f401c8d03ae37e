#pragma once

#include <rota/core/assert.hpp>
#include <rota/team/decision.hpp>

#include <algorithm>

namespace rota {

/// Options of a robot that sends about one message per `gap`, claims included, and reacts as quickly as one that sends ten a
/// second: it says at once what is news, and otherwise speaks every 2.5 gaps. What depends on how often robots are heard
/// follows: silence, the age of pending changes, and how often a claim is repeated, at first and then. All robots of a team need the same gap.
///
/// It sends more while a conflict lasts, up to ten messages a second, and less where all agree. docs/protocol.md has the
/// figures, which `rota budget` measures. @pre 1 ms ≤ gap ≤ reign / 2, or who missed a leader's first claims would not be led
[[nodiscard]] constexpr robot_options sparing(duration gap, robot_options o = {}) noexcept {
  ROTA_ASSERT(gap >= milliseconds(1) && 2 * gap <= o.reign);
  o.message_period = {gap.ns * 5 / 2};
  o.change_period = (std::min)(gap, milliseconds(100));
  o.claim_period = (std::max)(o.claim_period, gap);
  o.opening_period = (std::max)(o.opening_period, duration{gap.ns / 10});
  o.silence = (std::max)(o.silence, 8 * o.message_period);
  o.pending_age = (std::max)(o.pending_age, 4 * o.message_period);
  o.forget = (std::max)(o.forget, 3 * o.silence);
  o.fingerprints = true;
  return o;
}

}  // namespace rota
