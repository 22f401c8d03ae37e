#pragma once

#include <rota/sim/simulation.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rota::sim {

/// What holds of a team whatever goes wrong, and what holds once nothing goes wrong any more. docs/protocol.md says each in a
/// sentence, with what it presupposes.
enum class invariant : unsigned char {
  one_leader,        ///< a robot leads with a claim of its own, or obeys one of another
  greater_stamps,    ///< while a claim is in force here, the robot turns to no smaller stamp
  nothing_revives,   ///< a claim that has ended here is not obeyed again, and its end is never put off
  ends_with_leader,  ///< a claim ends here no earlier than at its leader, and no later than that plus the greatest delay
  reigns_bounded,    ///< nobody leads with or obeys one claim for longer than `max_reign`
  answers_inherit,  ///< who leads has detected a conflict, renews its reign since others dissent, or answers a claim; an
                    ///< answer ends when the claim does
  followers_follow,  ///< who obeys believes what the claim says, but for agents that take no part
  silent_forgotten,  ///< nobody is believed who has said nothing for silence + greatest delay + one claim period
  messages_heard,    ///< a plan message is accepted just if it is newer than the last, or its sender was long silent
  claims_heeded,     ///< a claim that its leader still leads with has not ended here: its stamp rules, or a greater one
  no_orphans,        ///< nobody obeys a claim of which it has heard its leader say that it is over
  nothing_refused,   ///< no robot refuses what another has said
  nothing_changed,   ///< a message that is refused or stale changes nothing about its receiver
  smaller_answered,  ///< who hears a claim with a smaller stamp, while nobody rules, answers it, once
  belief_well_formed,  ///< at most one atom for each agent, each about a participant; no more participants than robots
  all_hear_all,        ///< healed, plus one period and delay: everybody believes that everybody takes part
  nobody_rules,        ///< settled: no authority is left
  all_agree            ///< settled: all believe in one allocation with one attacker, and go on believing in it
};

inline constexpr std::size_t invariant_count = static_cast<std::size_t>(invariant::all_agree) + 1;

[[nodiscard]] constexpr std::string_view to_string(invariant i) noexcept {
  constexpr std::array<std::string_view, invariant_count> words{
      "one leader",      "greater stamps",   "nothing revives",  "ends with leader", "reigns bounded",
      "answers inherit", "followers follow", "silent forgotten", "messages heard",   "claims heeded",
      "no orphans",      "nothing refused",  "nothing changed",  "smaller answered", "belief well-formed",
      "all hear all",    "nobody rules",     "all agree"};
  return words[static_cast<std::size_t>(i)];
}

/// The bounds to which a run is held. They follow from its options; to hold a run to others is to test the test.
struct promises {
  duration delay{};            ///< no message is under way for longer
  duration slack{};            ///< of a reign, by different speeds of clocks
  duration silence{};          ///< nobody who has said nothing for longer is believed
  duration forget{};           ///< who was not heard for longer may begin a new life with any number
  duration longest_reign{};    ///< of one claim
  std::uint32_t renewals = 0;  ///< so often a reign is renewed at most
  instant genuine{};     ///< no bit that has flipped counts any more: much is promised only of what was really said
  bool answers = false;  ///< all have equal confidence, and resolution on: who is greater answers
  instant healed{};      ///< nothing goes wrong any more
  instant hearing{};     ///< all hear all
  instant settled{};     ///< nobody rules, and all agree
  bool overdue = false;  ///< messages may be under way for longer than `max_delay`
};

/// What a team with these options promises if all see the same from `calm` on and no message is lost from `healed` on. With P
/// the message period, D the loop, L the greatest delay, T the reign, m robots and A = (m + 1)(P + L + D), by the slowest clock:
///
/// * hearing: healed + P + L; if robots have come back with an equal or smaller incarnation, or bits have flipped, L + `forget`
///   later.
/// * genuine: from the beginning, if no bit flips; else when all hear all and what was forged has ended: hearing + the longest
///   reign + `max_delay` + P + L, for a plan message ends what is left of a forged claim.
/// * settled: hearing + silence + L + one claim period + D until nobody believes in who is gone, A until all agree, T + m·L
///   until the authority of the last detection has ended, and A again.
[[nodiscard]] inline promises promised(simulation_options const& o, std::size_t robots, instant calm) {
  auto const m = static_cast<std::int64_t>(robots);
  faults const& f = o.faults;
  std::int64_t ppm = 0;  // by which the fastest or slowest clock is wrong
  for (std::size_t i = 0; i < robots; ++i) {
    std::int64_t mine = 0;
    for (clock_drift const& d : f.drifts) mine += d.robot == i ? d.ppm : 0;
    ppm = (std::max)(ppm, o.clock.drift_ppm + (mine < 0 ? -mine : mine));
  }
  auto const slow = [ppm](duration d) { return d + nanoseconds(d.ns / 1'000'000 * ppm + ppm + 1'000); };

  promises p;
  p.delay = o.network.latency + o.network.jitter;
  duration const in_time = p.delay;
  if (f.late) p.delay = (std::max)(p.delay, f.late->most);
  p.longest_reign = o.robot.max_reign;
  p.renewals = o.robot.renewals;
  p.slack = 2 * (slow(o.robot.max_reign) - o.robot.max_reign);
  // Whom a claim names is older by at least the delay that the robots expect; a claim that took longer makes it younger.
  duration const unexpected = (std::max)(p.delay - o.robot.max_delay, duration{});
  p.silence = slow(o.robot.silence + o.robot.claim_period) + o.robot.max_delay + m * unexpected;
  p.forget = o.robot.forget;
  p.overdue = unexpected > duration{};
  p.healed = (std::max)(f.healed(), calm);
  bool disorder = f.flips.has_value();
  for (std::size_t i = 0; i < robots; ++i) disorder = disorder || !f.orderly(i);
  p.hearing =
      p.healed + slow(o.robot.message_period) + in_time + (disorder ? in_time + slow(o.robot.forget) : duration{});
  if (f.flips) p.genuine = p.hearing + slow(o.robot.max_reign + o.robot.max_delay + o.robot.message_period) + in_time;
  p.answers = o.robot.resolution && f.confidences.empty() && !o.stamp;
  duration const loop = slow(o.clock.loop + nanoseconds(o.clock.loop.ns / 1'000'000 * o.clock.loop_spread_ppm));
  duration const agreement = (m + 1) * (slow(o.robot.message_period) + in_time + loop);
  p.settled = p.hearing + p.silence + loop + agreement + slow(o.robot.reign) + m * in_time + agreement;
  return p;
}

}  // namespace rota::sim
