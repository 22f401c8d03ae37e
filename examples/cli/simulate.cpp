#include "command.hpp"
#include "json.hpp"
#include "playing.hpp"
#include "text.hpp"

#include <cstdint>
#include <string>

namespace rota::cli {
namespace {

duration in_nanoseconds(double amount, double unit) { return {static_cast<std::int64_t>(amount * unit + 0.5)}; }

std::string as_text(sim::playbook const& book, sim::play_options const& o, std::string const& stamp,
                    sim::figures const& f) {
  auto const& robot = o.team.robot;
  std::string out =
      std::string(to_string(o.what)) + ": " + counted(o.robots, "robot") + " play " + plan_names(book) + " for " +
      milliseconds_text(to_milliseconds(f.measured)) + ", seed " + std::to_string(o.team.seed) + "\nresolution " +
      (robot.resolution ? "on: " + std::to_string(robot.cycles) + " cycles, reigns of " +
                              milliseconds_text(to_milliseconds(robot.reign)) + ", stamps: " + stamp
                        : std::string("off")) +
      "; loss " + percent(o.team.network.loss) + ", latency " + number(to_milliseconds(o.team.network.latency)) +
      " to " + number(to_milliseconds(o.team.network.latency + o.team.network.jitter)) + " ms\n\n";
  auto const line = [&](std::string const& name, std::string const& value) {
    out += "  " + padded(name, 26) + value + '\n';
  };
  auto const& e = f.episodes;
  line("time in conflict", percent(f.conflict_share()));
  line("episodes", std::to_string(e.count()));
  line("  median, p99, longest", milliseconds_text(e.percentile_ms(50)) + ", " +
                                     milliseconds_text(e.percentile_ms(99)) + ", " + milliseconds_text(e.longest_ms()));
  line("cycles", std::to_string(f.cycles));
  line("detections", std::to_string(f.detections));
  line("reigns", std::to_string(f.reigns) +
                     (f.terms() == 0 ? "" : ", renewed " + counted(f.renewals, "time") + ", led by " + leaders(f)));
  if (f.terms() > 0) line("  right attacker imposed", percent(f.right_share()));
  auto const& reactions = f.pursuit.reactions;
  line("not exactly one attacker", percent(f.not_one_share()));
  line("a wrong attacker", percent(f.wrong_share()));
  line("another is best",
       counted(reactions.count() + f.pursuit.missed, "time") + ", missed " + std::to_string(f.pursuit.missed));
  if (reactions.count() > 0)
    line("  reaction, p95",
         milliseconds_text(reactions.mean_ms()) + ", " + milliseconds_text(reactions.percentile_ms(95)));
  line("no episode above 4 s", f.resolved() ? "yes" : "no");
  return out;
}

}  // namespace

simulate_options default_simulation() {
  sim::play_options const play;
  simulate_options o;
  o.robots = play.robots;
  o.loss = play.team.network.loss;
  o.latency = to_milliseconds(play.team.network.latency);
  o.cycles = play.team.robot.cycles;
  o.reign = to_seconds(play.team.robot.reign);
  return o;
}

outcome run_simulate(simulate_options const& o) {
  sim::play_options options;
  options.what = *sim::parse_scenario(o.scenario);
  options.robots = o.robots;
  if (o.minutes) options.length = in_nanoseconds(*o.minutes, 60e9);
  options.team.seed = o.seed;
  options.team.network.loss = o.loss;
  options.team.network.latency = in_nanoseconds(o.latency, 1e6);
  options.team.robot.cycles = o.cycles;
  options.team.robot.reign = options.team.robot.max_reign = in_nanoseconds(o.reign, 1e9);
  options.team.robot.resolution = o.resolution == "on";
  options.team.stamp = stamp_of(o.stamp);
  auto const file = o.plan.empty() ? default_plan() : o.plan;
  auto const book = read_playbook(file);
  require_playable(book, o.robots, file);
  auto const f = play_scenario(book, options);
  return {o.json ? as_json(options.what, options.team.robot.resolution, o.seed, o.stamp, f)
                 : as_text(book, options, o.stamp, f)};
}

}  // namespace rota::cli
