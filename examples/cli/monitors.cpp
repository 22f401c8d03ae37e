#include "monitors.hpp"
#include "command.hpp"
#include "json.hpp"
#include "report.hpp"
#include "text.hpp"

#include <rota/sim/detection_study.hpp>
#include <rota/team/monitors/literal.hpp>
#include <rota/team/monitors/repetition.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rota::cli {
namespace {

using sim::quarrel;

template <class Monitor>
monitor_row study(std::string const& name, std::uint32_t n, monitors_options const& o, progress& shown,
                  std::size_t steps) {
  monitor_row row;
  row.name = name;
  row.cycles = n;
  auto const figures = [&](quarrel what, std::uint64_t robots, double loss, duration limit, std::size_t runs) {
    sim::study_options s;
    s.what = what;
    s.robots = s.fighters = robots;
    s.loss = loss;
    s.limit = limit;
    s.runs = runs;
    s.seed = o.seed;
    s.robot.cycles = n;
    return sim::study_detection<Monitor>(s);
  };
  shown.next(steps, name + ", n = " + std::to_string(n));
  for (std::uint64_t const robots : {2u, 5u})
    for (double const loss : monitor_row::losses) {
      auto const f = figures(quarrel::fight, robots, loss, seconds(5), o.runs);
      row.detection_ms.push_back(f.mean_ms);
      row.fights_missed += f.runs - f.detected;
    }
  for (auto const what : {quarrel::no_room, quarrel::join_and_leave, quarrel::insist, quarrel::yield})
    for (double const loss : {0.0, 0.6}) {
      auto const f = figures(what, 2, loss, loss == 0 ? seconds(2) : seconds(5), o.runs);
      row.missed.push_back(static_cast<double>(f.runs - f.detected) / static_cast<double>(f.runs));
    }
  for (auto const jumps : monitor_row::jumps_ms) {
    sim::study_options s;
    s.what = quarrel::agree;
    s.robots = 5;
    s.limit = seconds(60);
    s.jumps = milliseconds(jumps);
    s.runs = o.runs / 5;
    s.seed = o.seed;
    s.robot.cycles = n;
    row.alarms.push_back(sim::study_detection<Monitor>(s).alarms_per_minute);
  }
  return row;
}

std::string as_text(std::vector<monitor_row> const& rows, monitors_options const& o) {
  std::vector<std::array<std::string, 18>> table;
  table.push_back({"monitor", "n", "2 robots", "20 %", "60 %", "5 robots", "20 %", "60 %", "no room", "60 %", "leaves",
                   "60 %", "insists", "60 %", "yields", "60 %", "100 ms", "400 ms"});
  auto const alarms = [](double x) { return number(static_cast<double>(static_cast<int>(x * 1000 + 0.5)) / 1000); };
  for (auto const& r : rows) {
    std::array<std::string, 18> line{r.name, std::to_string(r.cycles)};
    std::size_t at = 2;
    for (double const ms : r.detection_ms) line[at++] = milliseconds_text(ms);
    for (double const share : r.missed) line[at++] = percent(share);
    line[at++] = alarms(r.alarms.front());
    line[at++] = alarms(r.alarms.back());
    table.push_back(line);
  }
  return "Deliberation every 30 ms, messages every 100 ms, 2 ms under way; " + counted(o.runs, "run") +
         " a figure, seed " + std::to_string(o.seed) + ".\n\n" + laid_out(table) +
         "\n  2 and 5 robots: each is sure that it is closest; the time until the first detection, at 0, 20 and 60 % "
         "loss.\n"
         "  no room, leaves, insists, yields: robot 2 joins and is given nothing; joins, is given another task and "
         "leaves;\n"
         "  insists and is given something else each time; yields for a moment each time: the share not seen within 2 "
         "s,\n"
         "  and within 5 s at 60 % loss. 100 ms, 400 ms: false alarms per robot and minute where all see the same, and "
         "who\n"
         "  is closest changes that often on average.\n";
}

}  // namespace

outcome run_monitors(monitors_options const& o) {
  std::vector<monitor_row> rows;
  progress shown;
  constexpr std::uint32_t ns[] = {2, 3, 4, 5, 6};
  constexpr std::size_t steps = 5 * std::size(ns);
  using sim::names;
  for (auto const n : ns) {
    rows.push_back(study<literal_monitor<names>>("literal", n, o, shown, steps));
    rows.push_back(study<cycle_monitor<names>>("cycles", n, o, shown, steps));
    rows.push_back(study<insistence_monitor<names>>("insistence", n, o, shown, steps));
    rows.push_back(study<repetition_monitor<names>>("repetition", n, o, shown, steps));
    rows.push_back(study<conflict_monitor<names>>("both (default)", n, o, shown, steps));
  }
  return {o.json ? as_json(rows, o.seed) : as_text(rows, o)};
}

}  // namespace rota::cli
