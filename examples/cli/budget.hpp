#pragma once

namespace rota::cli {

/// What a team does that sends so much.
struct budget_row {
  unsigned wanted = 0;        ///< messages a second and robot
  bool news = false;          ///< news at once, and seldom otherwise; or one message after the other
  double sent = 0;            ///< messages a second and robot, claims included, in an hour of play …
  double conflict = 0;        ///< … the share of it in conflict
  double median_ms = 0;       ///< … of its episodes of conflict
  double p99_ms = 0;          ///< …
  double fight_sent = 0;      ///< as `sent`, where the cause of conflict never goes away
  double detected_ms = 0;     ///< the first of two that fight detects it: on average
  double detected_20_ms = 0;  ///< … at 20 % loss
  double detected_60_ms = 0;  ///< … at 60 % loss
  double taken_over_ms = 0;   ///< the attacker leaves, and another attacks: on average
  double alarms = 0;          ///< false alarms per robot and minute
  double silence_s = 0;       ///< so long a robot that fell silent is believed
};

}  // namespace rota::cli
