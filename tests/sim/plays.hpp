#pragma once

#include <rota/sim/evaluation.hpp>

#include <vector>

/// A plan for five: one attacks, one or two defend, up to two support, and hysteresis is 10 cm.
inline rota::sim::playbook soccer() {
  rota::sim::plan_sketch s;
  s.id = {1};
  s.name = "Play";
  s.tasks = {{{1}, "Attack", {1, 1}, {1}}, {{2}, "Defend", {1, 2}, {2}}, {{3}, "Support", {0, 2}, {3}}};
  s.hysteresis = 0.1;
  return *rota::sim::make_playbook({1}, {s});
}

/// A scenario, short: rounds of twelve seconds, one for each robot.
inline rota::sim::play_options brief(rota::sim::scenario s, bool resolution, std::uint64_t seed = 1) {
  rota::sim::play_options o;
  o.what = s;
  o.length = rota::seconds(60);
  o.world.round = rota::seconds(12);
  o.team.seed = seed;
  o.team.robot.resolution = resolution;
  return o;
}

/// A line of the log, kept.
struct line {
  rota::instant time;
  std::size_t robot = 0;
  rota::sim::happening what{};
  rota::event<rota::in<>> change;
  rota::allocation_atoms<> believed;
  rota::sim::world_state truth;
  std::uint32_t cycles = 0;
  bool detected = false;
  bool leading = false;
  bool superseded = false;
};

/// Keeps every line that says something. The true world only where a robot leads: nobody else's matters.
struct recorder {
  std::vector<line>& lines;
  void operator()(rota::sim::log_record const& r) const {
    using rota::sim::happening;
    bool const decides = r.what == happening::deliberated && (r.leading || r.cycles > 0 || r.detected);
    bool const reigns =
        r.what == happening::reign_began || r.what == happening::reign_renewed || r.what == happening::reign_ended;
    if (r.change.empty() && !decides && !reigns && r.what != happening::entered) return;
    lines.push_back({r.time, r.robot, r.what, r.change, r.believed, r.leading ? r.truth : rota::sim::world_state{},
                     r.cycles, r.detected, r.leading, r.superseded});
  }
};
