#include "monitors.hpp"
#include "command.hpp"
#include "json.hpp"
#include "report.hpp"
#include "text.hpp"

#include <rota/sim/detection_study.hpp>
#include <rota/sim/evaluation.hpp>
#include <rota/team/monitors/literal.hpp>
#include <rota/team/monitors/repetition.hpp>

#include <array>
#include <cstdint>
#include <iterator>
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
  auto const within = [&](std::int64_t usual) { return seconds(o.limit > 0 ? o.limit : usual); };
  shown.next(steps, name + ", n = " + std::to_string(n));
  for (std::uint64_t const robots : {2u, 5u})
    for (double const loss : monitor_row::losses) {
      auto const f = figures(quarrel::fight, robots, loss, within(5), o.runs);
      row.detection_ms.push_back(f.mean_ms);
      row.fights_missed += f.runs - f.detected;
    }
  for (auto const what : {quarrel::no_room, quarrel::join_and_leave, quarrel::insist, quarrel::yield})
    for (double const loss : monitor_row::losses) {
      auto const f = figures(what, 2, loss, within(loss == 0 ? 2 : 5), o.runs);
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
  std::vector<std::array<std::string, 11>> seen;
  seen.push_back(
      {"monitor", "n", "2 robots", "20 %", "60 %", "5 robots", "20 %", "60 %", "100 ms", "200 ms", "400 ms"});
  std::vector<std::array<std::string, 15>> missed;
  missed.push_back({"monitor", "n", "fights", "no room", "20 %", "60 %", "leaves", "20 %", "60 %", "insists", "20 %",
                    "60 %", "yields", "20 %", "60 %"});
  auto const alarms = [](double x) { return number(static_cast<double>(static_cast<int>(x * 1000 + 0.5)) / 1000); };
  for (auto const& r : rows) {
    std::array<std::string, 11> line{r.name, std::to_string(r.cycles)};
    std::size_t at = 2;
    for (double const ms : r.detection_ms) line[at++] = milliseconds_text(ms);
    for (double const rate : r.alarms) line[at++] = alarms(rate);
    seen.push_back(line);
    std::array<std::string, 15> other{r.name, std::to_string(r.cycles), std::to_string(r.fights_missed)};
    at = 3;
    for (double const share : r.missed) other[at++] = percent(share);
    missed.push_back(other);
  }
  auto const limit = [&](std::int64_t usual) { return std::to_string(o.limit > 0 ? o.limit : usual) + " s"; };
  return "Deliberation every 30 ms, messages every 100 ms, 2 ms under way; " + counted(o.runs, "run") +
         " a figure, seed " + std::to_string(o.seed) + ".\n\n" + laid_out(seen) +
         "\n  2 and 5 robots: each is sure that it is closest; the time until the first detection, at 0, 20 and 60 % "
         "loss.\n"
         "  100, 200, 400 ms: false alarms per robot and minute where five see the same, and who is closest changes "
         "that\n"
         "  often on average. both is a robot's default, with n = 4.\n\n" +
         laid_out(missed) + "\n  fights: of the fights above, those not seen within " + limit(5) +
         ". no room, leaves, insists, yields: robot 2 joins and is given\n"
         "  nothing; joins, is given another task and leaves; insists and is given something else each time; yields "
         "for "
         "a\n"
         "  moment each time: the share not seen within " +
         limit(2) + ", and within " + limit(5) + " at 20 and 60 % loss.\n";
}

}  // namespace

sim::study_figures study_of_default(sim::study_options const& options) {
  return sim::study_detection<conflict_monitor<sim::names>>(options);
}

outcome run_monitors(monitors_options const& o) {
  using sim::names;
  struct kind {
    char const* name;
    monitor_row (*study)(std::string const&, std::uint32_t, monitors_options const&, progress&, std::size_t);
  };
  constexpr kind kinds[] = {{"literal", study<literal_monitor<names>>},
                            {"cycles", study<cycle_monitor<names>>},
                            {"insistence", study<insistence_monitor<names>>},
                            {"repetition", study<repetition_monitor<names>>},
                            {"both", study<conflict_monitor<names>>}};
  std::vector<monitor_row> rows;
  progress shown;
  std::uint32_t const first = o.cycles == 0 ? 2 : o.cycles, last = o.cycles == 0 ? 6 : o.cycles;
  std::size_t const steps = (last - first + 1) * (o.monitor.empty() ? std::size(kinds) : 1);
  for (auto n = first; n <= last; ++n)
    for (auto const& k : kinds)
      if (o.monitor.empty() || o.monitor == k.name) rows.push_back(k.study(k.name, n, o, shown, steps));
  return {o.json ? as_json(rows, o.seed) : as_text(rows, o)};
}

outcome run_timing(timing_options const& o) {
  std::vector<std::array<std::string, 5>> table;
  table.push_back({"messages", "n", "theory", "measured", "first of two"});
  auto const tenths = [](double ms) {
    return number(static_cast<double>(static_cast<int>(ms * 10 + 0.5)) / 10) + " ms";
  };
  progress shown;
  for (int const period : {100, 200}) {
    shown.next(2, "messages every " + std::to_string(period) + " ms");
    sim::timing_options t;
    t.seed = o.seed;
    t.runs = o.runs;
    t.message_period = milliseconds(period);
    auto const f = sim::measure_timing(t);
    table.push_back({"every " + std::to_string(period) + " ms", "2", std::to_string(period + 15) + " ms",
                     tenths(f.two_cycles_ms), tenths(f.two_detected_ms)});
    table.push_back(
        {"", "4", std::to_string(3 * period + 15) + " ms", tenths(f.four_cycles_ms), tenths(f.four_detected_ms)});
  }
  return {
      "Two robots fight, " + counted(o.runs, "run") + ", seed " + std::to_string(o.seed) + ".\n\n" + laid_out(table) +
      "\n  measured: at one robot, from the first message that tells it otherwise to the nth reallocation that "
      "undoes\n  one; in theory (n - 1) message periods and half a deliberation period of 30 ms. first of two: from "
      "when both\n  act in conflict until either has counted n cycles. No noise, no loss, resolution off.\n"};
}

}  // namespace rota::cli
