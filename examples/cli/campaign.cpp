#include "campaign.hpp"
#include "command.hpp"
#include "json.hpp"
#include "report.hpp"
#include "text.hpp"

#include <rota/sim/fault_figures.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rota::cli {
namespace {

duration in_milliseconds(double ms) { return {static_cast<std::int64_t>(ms * 1e6 + 0.5)}; }

std::string again(campaign_options const& o, std::uint64_t seed) {
  std::string command = "rota campaign --runs 1 --seed " + std::to_string(seed);
  if (o.robots) command += " --robots " + std::to_string(*o.robots);
  if (o.delay) command += " --delay " + number(*o.delay);
  return command;
}

/// To the millisecond.
std::string time_text(instant t) {
  return t == never ? "the end" : std::to_string((t.ns + 500'000) / 1'000'000) + " ms";
}
std::string time_text(sim::spell s) { return "from " + time_text(s.from) + " to " + time_text(s.until); }

/// What goes wrong in a run, a line each.
std::string told(sim::campaign_run const& run) {
  auto const& f = run.team.faults;
  std::string out = "  " + counted(run.robots, "robot") + "; the world is calm from " + time_text(run.world.calm) +
                    " on, nothing goes wrong from " + time_text(run.promised.healed) + " on\n";
  auto const line = [&](std::string const& what) { out += "  " + what + '\n'; };
  auto const robot = [](std::size_t i) { return "robot " + std::to_string(i + 1); };
  if (f.bursts)
    line("losses " + time_text(f.bursts->when) + ": begins " + number(f.bursts->begins) + ", ends " +
         number(f.bursts->ends) + ", loss " + number(f.bursts->loss));
  if (f.late)
    line("late copies " + time_text(f.late->when) + ": " + percent(f.late->probability) + ", up to " +
         milliseconds_text(to_milliseconds(f.late->most)));
  if (f.flips) line("flipped bits " + time_text(f.flips->when) + ": " + percent(f.flips->probability));
  for (auto const& x : f.partitions) {
    std::string side;
    for (std::size_t i = 0; i < run.robots; ++i)
      if (x.side >> i & 1U) side += (side.empty() ? "" : ", ") + std::to_string(i + 1);
    line("partition " + time_text(x.when) + ": " + side + " on one side");
  }
  for (auto const& x : f.broken) line(robot(x.to) + " hears nothing of " + robot(x.from) + ' ' + time_text(x.when));
  for (auto const& x : f.crashes) {
    constexpr std::array words{"a greater", "an equal", "a smaller"};
    bool const gone = x.down == sim::crash::for_good;
    line(robot(x.robot) + " crashes at " + time_text(x.at) +
         (gone ? std::string()
               : ", and is back at " + time_text(x.at + x.down) + " with " + words[static_cast<std::size_t>(x.as)] +
                     " incarnation"));
  }
  for (auto const& x : f.drifts) line(robot(x.robot) + "'s clock is fast by " + std::to_string(x.ppm) + " ppm");
  for (auto const& x : f.stuck) line(robot(x.robot) + "'s sensor is stuck " + time_text(x.when));
  for (auto const& x : f.blind) line(robot(x.robot) + " is blind " + time_text(x.when));
  for (auto const& x : f.absences) line(robot(x.robot) + " does not take part " + time_text(x.when));
  for (auto const& x : f.confidences)
    line(robot(x.robot) + " has confidence " + std::to_string(x.confidence) + " from " + time_text(x.at) + " on");
  return out;
}

campaign_summary summary_of(campaign_options const& o, sim::campaign_report const& r) {
  auto const& s = r.seen;
  campaign_summary out{o.seed, r.runs};
  out.seen = {{"ticks", s.ticks},         {"steps", s.records},     {"detections", s.detections},
              {"reigns", s.reigns},       {"renewals", s.renewals}, {"answers", s.answers},
              {"given way", s.given_way}, {"stale", s.stale},       {"refused", s.refused},
              {"deletions", s.deletions}, {"crashes", s.crashes},   {"restarts", s.restarts},
              {"absences", s.absences}};
  constexpr std::array outcomes{"adopted", "revised", "repeated", "expired", "outranked", "challenged"};
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    out.seen.emplace_back(std::string("claims ") + outcomes[i], s.claims[i]);
  if (r.broken)
    out.broken =
        campaign_summary::failure{std::string(to_string(r.broken->what)), to_milliseconds(r.broken->at - instant{}),
                                  r.broken->robot + 1, r.broken->reason, again(o, r.failed)};
  return out;
}

std::string as_text(campaign_options const& o, campaign_summary const& s, sim::campaign_report const& r) {
  std::string out = counted(s.runs, "run") + " from seed " + std::to_string(s.seed) + " on: ";
  if (s.broken) {
    out += "a promise was broken.\n\n  " + s.broken->promise + ": at " + time_text(r.broken->at) + ", robot " +
           std::to_string(s.broken->robot) + ": " + s.broken->reason + "\n  again: " + s.broken->again + "\n\n" +
           told(sim::make_run(r.failed, o.robots)) + '\n';
  } else {
    out += "every promise was kept at every step.\n\n";
  }
  std::vector<std::array<std::string, 2>> table;
  for (auto const& [what, times] : s.seen) table.push_back({what, std::to_string(times)});
  return out + laid_out(table) + "\n  A tick is one deliberation of one robot.\n";
}

std::vector<fault_row> rows_of(sim::fault_figures const& f) {
  // Beside each what the project has set itself, at most.
  std::vector<fault_row> rows{
      {"a dead robot is believed in, 60 % loss, longest", f.dead_believed_ms, 2600.0},
      {"a partition heals: last disagreement, longest", f.disagreement_ms, 300.0},
      {"a restart with a greater incarnation is heard by all, longest", f.greater_heard_ms},
      {"... with an equal one", f.equal_heard_ms},
      {"the greatest robot is blind: not exactly one attacker", f.blind_wrong_share, 0.03, true},
      {"... while another is closest to the ball", f.others_wrong_share, std::nullopt, true},
      {"... and if it is not blind", f.seeing_wrong_share, std::nullopt, true}};
  constexpr double settled[] = {28, 100, 320};
  constexpr double two[] = {33, 319, 1027};
  for (std::size_t i = 0; i < f.settled.size(); ++i) {
    auto const& s = f.settled[i];
    auto const at = ", " + percent(s.loss) + " loss";
    rows.push_back({"five are led by one, p95 of " + std::to_string(s.cascades) + at, s.settled_ms_p95, settled[i]});
    rows.push_back({"two lead at once" + at + ", longest", s.two_leaders_ms, two[i]});
  }
  return rows;
}

std::string as_text(std::vector<fault_row> const& rows, sim::fault_study const& study) {
  std::vector<std::array<std::string, 3>> table{{"", "here", "wanted"}};
  for (auto const& r : rows) {
    auto const shown = [&](double x) { return r.share ? percent(x) : milliseconds_text(x); };
    table.push_back({r.name, shown(r.here), r.wanted ? "<= " + shown(*r.wanted) : ""});
  }
  return "Five robots, deliberation every 30 ms, messages every 100 ms, 2 to 5 ms under way, silence 2 s, reigns of 2 "
         "s;\n"
         "a new claim is repeated every 30 ms for " +
         milliseconds_text(to_milliseconds(study.robot.opening)) + "; " + counted(study.runs, "run") +
         " a figure, seed " + std::to_string(study.seed) + ".\n\n" + laid_out(table);
}

}  // namespace

campaign_options default_campaign() {
  campaign_options o;
  o.opening = to_milliseconds(robot_options{}.opening);
  return o;
}

outcome run_campaign(campaign_options const& o) {
  progress shown;
  if (o.figures) {
    sim::fault_study study;
    study.seed = o.seed;
    if (o.runs) study.runs = *o.runs;
    study.robot.opening = in_milliseconds(o.opening);
    auto const rows = rows_of(sim::measure_faults(
        study, [&](std::size_t steps, std::string_view what) { shown.next(steps, std::string(what)); }));
    return {o.json ? as_json(rows, study.runs, study.seed) : as_text(rows, study)};
  }
  sim::campaign_options options;
  options.seed = o.seed;
  options.ticks = o.ticks;
  options.runs = o.runs;
  options.robots = o.robots;
  if (o.delay) options.delay = in_milliseconds(*o.delay);
  std::uint64_t percent_done = 0;
  auto const report = sim::run_campaign(options, [&](std::uint64_t runs, std::uint64_t ticks) {
    auto const done = o.runs ? runs * 100 / *o.runs : ticks * 100 / o.ticks;
    for (; percent_done <= done && percent_done < 100; ++percent_done)
      shown.next(100, "run " + std::to_string(runs + 1) + ", " + std::to_string(ticks) + " ticks");
  });
  auto const summary = summary_of(o, report);
  return {o.json ? as_json(summary) : as_text(o, summary, report), report.broken ? negative : success};
}

}  // namespace rota::cli
