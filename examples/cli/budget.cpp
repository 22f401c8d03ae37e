#include "budget.hpp"
#include "command.hpp"
#include "json.hpp"
#include "monitors.hpp"
#include "playing.hpp"
#include "report.hpp"
#include "text.hpp"

#include <rota/sim/detection_study.hpp>
#include <rota/team/budget.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rota::cli {
namespace {

/// Robots that send so often, one way or the other.
robot_options options_of(budget_row const& row) {
  duration const gap{seconds(1).ns / row.wanted};
  auto const o = sparing(gap);
  if (row.news) return o;
  robot_options steady;
  steady.message_period = gap;
  steady.claim_period = o.claim_period;
  steady.silence = std::max(steady.silence, 8 * gap);
  steady.pending_age = std::max(steady.pending_age, 4 * gap);
  return steady;
}

void measure(budget_row& row, budget_options const& o, sim::playbook const& book) {
  auto const robot = options_of(row);
  duration const length{static_cast<std::int64_t>(o.minutes * 60e9 + 0.5)};
  auto const game = [&](sim::scenario what) {
    sim::play_options p;
    p.what = what;
    p.length = length;
    p.team.seed = o.seed;
    p.team.robot = robot;
    p.team.network.loss = o.loss;
    return play_scenario(book, p);
  };
  auto const rate = [](sim::figures const& f) {
    return static_cast<double>(f.messages) / to_seconds(f.measured) / static_cast<double>(f.led.size());
  };
  auto const hour = game(sim::scenario::hour);
  row.sent = rate(hour);
  row.conflict = hour.conflict_share();
  row.median_ms = hour.episodes.percentile_ms(50);
  row.p99_ms = hour.episodes.percentile_ms(99);
  row.fight_sent = rate(game(sim::scenario::ball_fight));

  auto const study = [&](sim::quarrel what, std::uint64_t robots, double loss) {
    sim::study_options s;
    s.what = what;
    s.robots = robots;
    s.loss = loss;
    s.robot = robot;
    s.runs = o.runs;
    s.seed = o.seed;
    s.limit = seconds(60);
    if (what == sim::quarrel::agree) s.limit = std::min(s.limit, length);
    return study_of_default(s);
  };
  row.detected_ms = study(sim::quarrel::fight, 2, 0).mean_ms;
  row.detected_20_ms = study(sim::quarrel::fight, 2, 0.2).mean_ms;
  row.detected_60_ms = study(sim::quarrel::fight, 2, 0.6).mean_ms;
  row.taken_over_ms = study(sim::quarrel::hand_over, 5, o.loss).mean_ms;
  row.alarms = study(sim::quarrel::agree, 5, 0).alarms_per_minute;
  row.silence_s = to_seconds(robot.silence);
}

std::string as_text(std::vector<budget_row> const& rows, budget_options const& o) {
  auto const places = [](double x, double unit) {
    return number(static_cast<double>(static_cast<std::int64_t>(x * unit + 0.5)) / unit);
  };
  std::vector<std::array<std::string, 14>> table;
  table.push_back({"wanted", "how", "sent", "20 min", "in conflict", "median", "p99", "fighting", "detected", "20 %",
                   "60 %", "taken over", "alarms", "silence"});
  for (auto const& r : rows)
    table.push_back({std::to_string(r.wanted) + "/s", r.news ? "news at once" : "steadily", places(r.sent, 100) + "/s",
                     std::to_string(static_cast<std::int64_t>(r.sent * 5 * 1200 + 0.5)), percent(r.conflict),
                     milliseconds_text(r.median_ms), milliseconds_text(r.p99_ms), places(r.fight_sent, 100) + "/s",
                     milliseconds_text(r.detected_ms), milliseconds_text(r.detected_20_ms),
                     milliseconds_text(r.detected_60_ms), milliseconds_text(r.taken_over_ms), places(r.alarms, 1000),
                     number(r.silence_s) + " s"});
  return "Five robots play " + number(o.minutes) + " minutes at " + percent(o.loss) + " loss; " +
         counted(o.runs, "run") + " of each study, seed " + std::to_string(o.seed) + ".\n\n" + laid_out(table) +
         "\n  wanted: messages a second and robot. steadily: one after the other. news at once: as the function "
         "sparing "
         "sets\n"
         "  it. sent, 20 min: messages truly sent in play, claims included, per robot and second, and by the team in "
         "20 "
         "minutes.\n"
         "  in conflict, median, p99: of that play, and of its episodes of conflict. fighting: sent where the cause of "
         "conflict\n"
         "  never goes away (ball-fight). detected: two fight; the first has seen it, at 0, 20 and 60 % loss. taken "
         "over: "
         "the\n"
         "  attacker leaves, another attacks. alarms: false ones per robot and minute, as rota monitors counts them. "
         "silence:\n"
         "  so long a robot that broke down is believed.\n";
}

}  // namespace

outcome run_budget(budget_options const& o) {
  auto const file = o.plan.empty() ? default_plan() : o.plan;
  auto const book = read_playbook(file);
  require_playable(book, sim::play_options{}.robots, file);
  std::vector<budget_row> rows;
  progress shown;
  for (bool const news : {false, true})
    for (unsigned const wanted : {10u, 5u, 2u}) {
      budget_row row;
      row.wanted = wanted;
      row.news = news;
      shown.next(6, std::to_string(wanted) + " a second, " + (news ? "news at once" : "steadily"));
      measure(row, o, book);
      rows.push_back(row);
    }
  return {o.json ? as_json(rows, o.seed) : as_text(rows, o)};
}

}  // namespace rota::cli
