#include "command.hpp"
#include "playing.hpp"
#include "text.hpp"

#include <CLI/CLI.hpp>

#include <charconv>
#include <memory>
#include <optional>
#include <system_error>
#include <type_traits>

namespace rota::cli {
namespace {

struct options {
  std::string scenario;
  std::string plan;
  std::uint64_t seed = 1;
  std::optional<double> minutes;
  std::size_t robots = 5;
  double loss = sim::network_options{}.loss;
  double latency = to_milliseconds(sim::network_options{}.latency);
  std::uint32_t cycles = agent_options{}.cycles;
  double reign = to_seconds(agent_options{}.reign);
  std::string resolution = "on";
  bool json = false;
};

/// A check of CLI11 for plain decimal numbers: its own conversion takes "0x1" and "nan", and wraps "-1".
template <class Number>
CLI::Validator within(Number low, Number high, std::string const& what) {
  return CLI::Validator(
      [=](std::string const& text) {
        Number x{};
        auto const* const end = text.data() + text.size();
        auto const [rest, error] = std::from_chars(text.data(), end, x);
        bool const octal = std::is_integral_v<Number> && text.size() > 1 && text.front() == '0';  // to CLI11
        bool const good = error == std::errc{} && rest == end && x >= low && x <= high && !octal;
        return good ? std::string{} : '"' + text + "\" is not " + what;
      },
      "");
}

duration in_nanoseconds(double amount, double unit) { return {static_cast<std::int64_t>(amount * unit + 0.5)}; }

std::string as_text(sim::playbook const& book, sim::play_options const& o, sim::figures const& f) {
  std::string plans;
  for (auto const& p : book.plans) plans += (plans.empty() ? "" : ", ") + p.name;
  auto const& agent = o.team.agent;
  std::string out =
      std::string(to_string(o.what)) + ": " + counted(o.robots, "robot") + " play " + plans + " for " +
      milliseconds_text(to_milliseconds(f.measured)) + ", seed " + std::to_string(o.team.seed) + "\nresolution " +
      (agent.resolution ? "on: " + std::to_string(agent.cycles) + " cycles, reigns of " +
                              milliseconds_text(to_milliseconds(agent.reign))
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
  line("reigns", std::to_string(f.reigns) + (f.reigns == 0 ? "" : ", led by " + leaders(f)));
  if (f.reigns > 0) line("  right attacker imposed", percent(f.right_share()));
  line("no episode above 4 s", f.resolved() ? "yes" : "no");
  return out;
}

outcome run_simulate(options const& o) {
  sim::play_options play;
  play.what = *sim::parse_scenario(o.scenario);
  play.robots = o.robots;
  if (o.minutes) play.length = in_nanoseconds(*o.minutes, 60e9);
  play.team.seed = o.seed;
  play.team.network.loss = o.loss;
  play.team.network.latency = in_nanoseconds(o.latency, 1e6);
  play.team.agent.cycles = o.cycles;
  play.team.agent.reign = play.team.agent.max_reign = in_nanoseconds(o.reign, 1e9);
  play.team.agent.resolution = o.resolution == "on";
  auto const file = o.plan.empty() ? default_plan() : o.plan;
  auto const book = read_playbook(file);
  require_playable(book, o.robots, file);
  auto const f = sim::play(book, play);
  if (!o.json) return {as_text(book, play, f)};
  auto out = as_json(play.what, play.team.agent.resolution, f);
  out["seed"] = o.seed;
  return {out.dump(2) + '\n'};
}

}  // namespace

void add_simulate(CLI::App& program, chosen_command& chosen) {
  auto const o = std::make_shared<options>();
  auto* const command = program.add_subcommand("simulate", "Plays one scenario and measures its conflicts");
  std::string names;
  for (auto const s : sim::all_scenarios) names += (names.empty() ? "" : ", ") + std::string(to_string(s));
  command->add_option("--scenario", o->scenario, names)->required()->check([names](std::string const& name) {
    return sim::parse_scenario(name) ? std::string{} : name + " is no scenario; there are " + names;
  });
  command->add_option("--plan", o->plan, "a plan or plan type of ALICA; by default the shipped soccer plan")
      ->check(check_not_empty);
  command->add_option("--seed", o->seed, "equal seeds give equal output")->check(check_seed)->capture_default_str();
  command->add_option("--minutes", o->minutes, "simulated time; by default 60 for hour, otherwise 5")
      ->check(within(0.01, 1440.0, "a number of minutes from 0.01 to 1440"));
  command->add_option("--robots", o->robots, "size of the team, 2 to 11")
      ->check(within(std::size_t{2}, std::size_t{sim::max_robots},
                     "a whole number from 2 to " + std::to_string(sim::max_robots)))
      ->capture_default_str();
  command->add_option("--loss", o->loss, "probability that a message is lost")
      ->check(within(0.0, 1.0, "a probability from 0 to 1"))
      ->capture_default_str();
  command->add_option("--latency", o->latency, "least delay of a message in ms")
      ->check(within(0.0, 10'000.0, "a delay from 0 to 10000 ms"))
      ->capture_default_str();
  command->add_option("--cycles", o->cycles, "n: subsequent cycles that make a detection")
      ->check(within(1, 1'000'000, "a whole number from 1 to 1000000"))
      ->capture_default_str();
  command->add_option("--reign", o->reign, "how long a leader decides, in seconds")
      ->check(within(0.01, 3600.0, "a time from 0.01 to 3600 seconds"))
      ->capture_default_str();
  command->add_option("--resolution", o->resolution, "on, or off: detect only")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  command->add_flag("--json", o->json, "print JSON");
  command->callback([o, &chosen] { chosen = [o] { return run_simulate(*o); }; });
}

}  // namespace rota::cli
