#include "command.hpp"

#include <rota/sim/closed/ways.hpp>
#include <rota/sim/closed/world.hpp>
#include <rota/sim/scenario.hpp>
#include <rota/sim/stamp_policy.hpp>
#include <rota/sim/world.hpp>

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdlib>
#include <memory>
#include <system_error>
#include <type_traits>

namespace rota::cli {
namespace {

/// An empty value is a mistake of the calling script; the option was not left out.
std::string check_not_empty(std::string const& text) { return text.empty() ? "an empty value" : ""; }

/// Whether the text is a plain decimal number within these bounds. CLI11's own conversion takes "0x1" and "nan", wraps
/// -1 and caps 2^64.
template <class Number>
bool is_within(std::string const& text, Number low, Number high) {
  Number x{};
  auto const* const end = text.data() + text.size();
  auto const [rest, error] = std::from_chars(text.data(), end, x);
  bool const octal = std::is_integral_v<Number> && text.size() > 1 && text.front() == '0';  // CLI11 would read it so
  return error == std::errc{} && rest == end && x >= low && x <= high && !octal;
}

/// A check for CLI11: is the text a number between these? `what` describes such numbers.
template <class Number>
auto within(Number low, Number high, std::string const& what) {
  return [=](std::string const& text) {
    return is_within(text, low, high) ? std::string{} : '"' + text + "\" is not " + what;
  };
}

std::string check_seed(std::string const& text) {
  return within(std::uint64_t{0}, UINT64_MAX, "a whole number from 0 to 18446744073709551615")(text);
}

/// Adds a subcommand. If the command line names it, `run` is called with the options that were read.
template <class Options>
CLI::App& add(CLI::App& program, command& chosen, std::shared_ptr<Options> const& o, outcome (*run)(Options const&),
              std::string const& name, std::string const& description) {
  CLI::App& sub = *program.add_subcommand(name, description);
  sub.callback([=, &chosen] { chosen = [=] { return run(*o); }; });
  return sub;
}

void add_check(CLI::App& program, command& chosen) {
  auto const o = std::make_shared<check_options>();
  CLI::App& sub = add(program, chosen, o, run_check, "check", "Says what plan files hold and what is wrong with them");
  sub.add_option("PATH", o->paths, "plan files, or folders with everything below them")
      ->required()
      ->check(check_not_empty);
  sub.add_flag("--json", o->json, "print JSON");
  sub.footer("Exit status: 0 nothing is wrong, 1 errors found in files, 2 misuse, no plan file.");
}

void add_allocate(CLI::App& program, command& chosen) {
  auto const o = std::make_shared<allocate_options>();
  CLI::App& sub =
      add(program, chosen, o, run_allocate, "allocate", "Finds the best allocation of a plan, and says why");
  sub.add_option("--plan", o->plans, "plan files or folders; what they need is found beside them")
      ->required()
      ->check(check_not_empty);
  sub.add_option("--plan-type", o->plan_type, "name or id of the plan type whose best plan is wanted")
      ->check(check_not_empty);
  sub.add_option("--utilities", o->utilities,
                 "CSV: header agent,TASK,... (PLAN/TASK with a plan type), one row per agent, empty = forbidden")
      ->required()
      ->check(check_not_empty);
  sub.add_flag(
      "--minimise,--minimize", o->minimise,
      "the table holds costs, not negated: a task for as many agents as can have one, at the least total cost");
  sub.add_flag("--no-idle", o->no_idle, "every agent must have a task");
  sub.add_option("--current", o->current, "JSON, as --json prints it: the allocation to compare with")
      ->check(check_not_empty);
  sub.add_option("--budget", o->budget,
                 "give up proving after so many steps (a step looks at one way to move an agent)")
      ->check(within(std::uint64_t{0}, UINT64_MAX, "a whole number from 0 to 18446744073709551615"));
  sub.add_option("--deadline", o->deadline,
                 "give up proving after so many ms; what is found then depends on the machine")
      ->check(within(0.0, 86'400'000.0, "a time from 0 to 86400000 ms"));
  sub.add_flag("--stats", o->stats, "print what the search did");
  sub.add_flag("--json", o->json, "print JSON");
  sub.footer("Utilities count in steps of 2^-20, each cell rounded to the nearest (0.0000001 counts 0), so that\n"
             "equal tables give equal answers everywhere. They add up over agents; an idle agent counts 0.\n"
             "So negated costs would leave everybody idle: write costs as they are, and add --minimise.\n"
             "The event leads from --current to the best allocation; the decision says whether a running team\n"
             "would change at all, given the hysteresis of the plan and that equals change nothing.\n"
             "A search that gives up prints the best valid allocation it found, and how far it may be from the best.\n"
             "Exit status: 0 found, 1 no valid allocation, 2 misuse or a wrong input file.");
}

/// Adds --stamp, which names the policy that decides who leads.
CLI::Option& add_stamp(CLI::App& sub, std::string& name, std::string const& what) {
  std::string names;
  for (auto const p : sim::all_stamp_policies) names += (names.empty() ? "" : ", ") + std::string(to_string(p));
  return *sub.add_option("--stamp", name, what + names)->check([names](std::string const& text) {
    return sim::parse_stamp_policy(text) ? std::string{} : '"' + text + "\" is no stamp policy; there are " + names;
  });
}

void add_stamps(CLI::App& program, command& chosen) {
  auto const o = std::make_shared<stamps_options>();
  CLI::App& sub = add(program, chosen, o, run_stamps, "stamps",
                      "Who should lead: how often each stamp policy lets the right robot lead, and what comes of it");
  sub.add_option("--seeds", o->seeds, "so many games of each scenario")
      ->check(within(std::uint64_t{1}, std::uint64_t{10'000}, "a whole number from 1 to 10000"))
      ->capture_default_str();
  sub.add_option("--seed", o->seed, "of the first game; the next has the next seed")
      ->check(check_seed)
      ->capture_default_str();
  sub.add_option("--minutes", o->minutes, "of each game; by default 60 of hour, otherwise 5")
      ->check(within(0.01, 1440.0, "a number of minutes from 0.01 to 1440"));
  add_stamp(sub, o->stamp, "only this one: ");
  sub.add_option("--plan", o->plan, "a plan or plan type of ALICA; by default the shipped soccer plan")
      ->check(check_not_empty);
  sub.add_flag("--json", o->json, "print JSON");
}

void add_simulate(CLI::App& program, command& chosen) {
  auto const o = std::make_shared<simulate_options>(default_simulation());
  CLI::App& sub = add(program, chosen, o, run_simulate, "simulate", "Plays one scenario and measures its conflicts");
  std::string names;
  for (auto const s : sim::all_scenarios) names += (names.empty() ? "" : ", ") + std::string(to_string(s));
  sub.add_option("--scenario", o->scenario, names)->required()->check([names](std::string const& name) {
    return sim::parse_scenario(name) ? std::string{} : name + " is no scenario; there are " + names;
  });
  sub.add_option("--plan", o->plan, "a plan or plan type of ALICA; by default the shipped soccer plan")
      ->check(check_not_empty);
  sub.add_option("--seed", o->seed, "equal seeds give equal output")->check(check_seed)->capture_default_str();
  sub.add_option("--minutes", o->minutes, "simulated time; by default 60 for hour, otherwise 5")
      ->check(within(0.01, 1440.0, "a number of minutes from 0.01 to 1440"));
  sub.add_option("--robots", o->robots, "size of the team, 2 to 11")
      ->check(within(std::size_t{2}, std::size_t{sim::max_robots},
                     "a whole number from 2 to " + std::to_string(sim::max_robots)))
      ->capture_default_str();
  sub.add_option("--loss", o->loss, "probability that a message is lost")
      ->check(within(0.0, 1.0, "a probability from 0 to 1"))
      ->capture_default_str();
  sub.add_option("--latency", o->latency, "least delay of a message in ms")
      ->check(within(0.0, 10'000.0, "a delay from 0 to 10000 ms"))
      ->capture_default_str();
  sub.add_option("--cycles", o->cycles, "n: subsequent cycles that make a detection")
      ->check(within(1, 1'000'000, "a whole number from 1 to 1000000"))
      ->capture_default_str();
  sub.add_option("--reign", o->reign, "how long a leader decides, in seconds")
      ->check(within(0.01, 3600.0, "a time from 0.01 to 3600 seconds"))
      ->capture_default_str();
  sub.add_option("--resolution", o->resolution, "on, or off: detect only")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  add_stamp(sub, o->stamp, "who leads: ").capture_default_str();
  sub.add_flag("--json", o->json, "print JSON");
}

void add_reproduce(CLI::App& program, command& chosen) {
  auto const o = std::make_shared<reproduce_options>();
  CLI::App& sub = add(program, chosen, o, run_reproduce, "reproduce",
                      "The paper's evaluation: every scenario without resolution, as published, and as it is now");
  sub.add_option("--seed", o->seed, "equal seeds give equal output")->check(check_seed)->capture_default_str();
  sub.add_option("--plan", o->plan, "a plan or plan type of ALICA; by default the shipped soccer plan")
      ->check(check_not_empty);
  add_stamp(sub, o->stamp, "who leads as it is now: ").capture_default_str();
  sub.add_flag("--as-published", o->as_published, "only as the paper has it: the literal monitor, fixed reigns, ids");
  sub.add_flag("--json", o->json, "print JSON");
}

void add_monitors(CLI::App& program, command& chosen) {
  auto const o = std::make_shared<monitors_options>();
  CLI::App& sub = add(program, chosen, o, run_monitors, "monitors",
                      "Monitors side by side: how soon each sees a conflict, what it misses, its false alarms");
  sub.add_option("--runs", o->runs,
                 "so many runs a figure, and a fifth as many minutes of five robots for false alarms")
      ->check(within(std::size_t{5}, std::size_t{1'000'000}, "a whole number from 5 to 1000000"))
      ->capture_default_str();
  sub.add_option("--cycles", o->cycles, "only this n; by default 2 to 6")
      ->check(within(1, 1'000'000, "a whole number from 1 to 1000000"));
  sub.add_option("--monitor", o->monitor, "only this one; both (cycles and insistence) is a robot's default")
      ->check(CLI::IsMember({"literal", "cycles", "insistence", "repetition", "both"}));
  sub.add_option("--limit", o->limit,
                 "so many seconds until a conflict counts as missed; by default 5, and 2 for some without loss")
      ->check(within(1, 3600, "a whole number from 1 to 3600"));
  sub.add_option("--seed", o->seed, "equal seeds give equal output")->check(check_seed)->capture_default_str();
  sub.add_flag("--json", o->json, "print JSON");
}

void add_timing(CLI::App& program, command& chosen) {
  auto const o = std::make_shared<timing_options>();
  CLI::App& sub = add(program, chosen, o, run_timing, "timing", "How long two and four cycles take, beside the theory");
  sub.add_option("--runs", o->runs, "so many fights of two robots")
      ->check(within(std::size_t{1}, std::size_t{10'000'000}, "a whole number from 1 to 10000000"))
      ->capture_default_str();
  sub.add_option("--seed", o->seed, "equal seeds give equal output")->check(check_seed)->capture_default_str();
}

void add_budget(CLI::App& program, command& chosen) {
  auto const o = std::make_shared<budget_options>();
  CLI::App& sub =
      add(program, chosen, o, run_budget, "budget",
          "What five robots lose by sending less: conflicts and reactions at 2, 5 and 10 messages a second");
  sub.add_option("--runs", o->runs, "so many runs of each study: detection, taking over, a minute of false alarms")
      ->check(within(std::size_t{1}, std::size_t{1'000'000}, "a whole number from 1 to 1000000"))
      ->capture_default_str();
  sub.add_option("--minutes", o->minutes, "simulated time of each game")
      ->check(within(0.01, 1440.0, "a number of minutes from 0.01 to 1440"))
      ->capture_default_str();
  sub.add_option("--loss", o->loss, "probability that a message is lost")
      ->check(within(0.0, 1.0, "a probability from 0 to 1"))
      ->capture_default_str();
  sub.add_option("--seed", o->seed, "equal seeds give equal output")->check(check_seed)->capture_default_str();
  sub.add_option("--plan", o->plan, "a plan or plan type of ALICA; by default the shipped soccer plan")
      ->check(check_not_empty);
  sub.add_flag("--json", o->json, "print JSON");
}

void add_campaign(CLI::App& program, command& chosen) {
  auto const o = std::make_shared<campaign_options>(default_campaign());
  CLI::App& sub = add(program, chosen, o, run_campaign, "campaign",
                      "Plays teams in which much goes wrong, and checks at every step what docs/protocol.md promises");
  auto* const ticks =
      sub.add_option("--ticks", o->ticks, "stop after so many deliberations, of all robots together")
          ->check(within(std::uint64_t{1}, std::uint64_t{1'000'000'000'000}, "a whole number from 1 to 1000000000000"))
          ->capture_default_str();
  sub.add_option("--runs", o->runs, "stop after so many runs; with --figures, so many for each figure (200)")
      ->check(within(std::uint64_t{1}, std::uint64_t{1'000'000'000}, "a whole number from 1 to 1000000000"))
      ->excludes(ticks);
  sub.add_option("--seed", o->seed, "of the first run; the next has the next seed")
      ->check(check_seed)
      ->capture_default_str();
  auto* const robots = sub.add_option("--robots", o->robots, "size of the team, 2 to 11; by default the seed decides")
                           ->check(within(std::size_t{2}, std::size_t{sim::max_robots},
                                          "a whole number from 2 to " + std::to_string(sim::max_robots)));
  auto* const delay =
      sub.add_option("--delay", o->delay,
                     "hold teams to this greatest delay in ms, whatever their radios do: to see a broken promise")
          ->check(within(0.0, 10'000.0, "a delay from 0 to 10000 ms"));
  auto* const figures =
      sub.add_flag("--figures", o->figures, "measure how long five robots take to overcome each fault instead")
          ->excludes(ticks)
          ->excludes(robots)
          ->excludes(delay);
  sub.add_option("--opening", o->opening, "how long a new claim is repeated every 30 ms, in ms")
      ->check(within(0.0, 2'000.0, "a time from 0 to 2000 ms"))
      ->capture_default_str()
      ->needs(figures);
  sub.add_flag("--json", o->json, "print JSON");
  sub.footer("The first broken promise ends a campaign, and is printed with the command that plays its run again.\n"
             "Exit status: 0 every promise was kept, 1 one was broken, 2 misuse.");
}

void add_sweep(CLI::App& program, command& chosen) {
  auto const o = std::make_shared<sweep_options>();
  CLI::App& sub =
      add(program, chosen, o, run_sweep, "sweep",
          "Ways of coordinating side by side, in a world that decisions move, over many settings and seeds");
  auto const words = [](auto const& all) {
    std::vector<std::string> out;
    for (auto const x : all) out.emplace_back(to_string(x));
    return out;
  };
  auto const list = [&](std::string const& name, auto& values, std::string const& what) {
    return sub.add_option(name, values, what + ", separated by commas")->delimiter(',');
  };
  sub.add_option("--table", o->table, "a table of docs/evaluation.md; the other options then change it")
      ->check(CLI::IsMember(sweep_table_names()));
  list("--system", o->systems, "who decides how")->check(CLI::IsMember(words(sim::closed::all_ways)));
  list("--trouble", o->troubles, "what goes wrong with the robots")
      ->check(CLI::IsMember(words(sim::closed::all_troubles)));
  list("--loss", o->losses, "probabilities that a message is lost")
      ->check(within(0.0, 1.0, "a probability from 0 to 1"));
  list("--robots", o->robots, "sizes of the team")
      ->check(within(std::uint64_t{2}, std::uint64_t{sim::max_robots},
                     "a whole number from 2 to " + std::to_string(sim::max_robots)));
  list("--period", o->periods, "ms between messages; news a tenth of that after the last one")
      ->check(within(20, 1000, "a whole number from 20 to 1000"));
  list("--cycles", o->cycles, "n, of rota")->check(within(1, 1000, "a whole number from 1 to 1000"));
  list("--reign", o->reigns, "how long rota's leaders reign")->check(CLI::IsMember({"fixed", "renewed"}));
  list("--reign-length", o->reign_lengths, "seconds that a claim of rota holds")
      ->check(within(0.5, 60.0, "a number of seconds from 0.5 to 60"));
  list("--stamp", o->stamps, "who of rota's claimants leads")->check(CLI::IsMember(words(sim::all_stamp_policies)));
  list("--news", o->news, "whether rota says what is new at once, or in its next slot")
      ->check(CLI::IsMember({"on", "off"}));
  list("--hysteresis", o->hystereses, "metres that a new allocation must save; by default the plan's own")
      ->check(within(0.0, 1000.0, "a number of metres from 0 to 1000"));
  list("--change-cost", o->change_costs, "metres that rota's search counts for each robot that gets another task")
      ->check(within(0.0, 1000.0, "a number of metres from 0 to 1000"));
  sub.add_option("--minutes", o->minutes, "simulated time of each game")
      ->check(within(0.01, 1440.0, "a number of minutes from 0.01 to 1440"))
      ->capture_default_str();
  sub.add_option("--seeds", o->seeds, "so many games of each setting")
      ->check(within(std::uint64_t{1}, std::uint64_t{10'000}, "a whole number from 1 to 10000"))
      ->capture_default_str();
  sub.add_option("--seed", o->seed, "of the first game; the next has the next seed")
      ->check(check_seed)
      ->capture_default_str();
  sub.add_option("--rows", o->rows, "append each game to this file (JSON Lines), and play none that it has")
      ->check(check_not_empty);
  sub.add_option("--chart", o->chart, "write an SVG of reaction time against time without exactly one attacker")
      ->check(check_not_empty);
  sub.add_option("--jobs", o->jobs, "so many games at once; by default as many as there are cores")
      ->check(within(std::size_t{1}, std::size_t{1024}, "a whole number from 1 to 1024"));
  sub.add_flag("--json", o->json, "print JSON");
  sub.footer(
      "What is printed does not depend on --jobs. A sweep that was interrupted goes on where it was stopped, if it is\n"
      "called again with the same --rows: games that are there whole are not played again.");
}

}  // namespace

command parse_command_line(int argc, char** argv) {
  CLI::App program{"Who does what now: looks at plan files, allocates tasks, and shows why.", "rota"};
  program.set_version_flag("--version", "rota " ROTA_VERSION);
  program.require_subcommand(1);
  command chosen;
  add_check(program, chosen);
  add_allocate(program, chosen);
  add_simulate(program, chosen);
  add_reproduce(program, chosen);
  add_stamps(program, chosen);
  add_monitors(program, chosen);
  add_timing(program, chosen);
  add_budget(program, chosen);
  add_campaign(program, chosen);
  add_sweep(program, chosen);
  try {
    program.parse(argc, argv);
  } catch (CLI::ParseError const& e) {
    if (e.get_exit_code() == 0) std::exit(program.exit(e));  // after printing the help or the version
    throw input_error(std::string(e.what()) + " (see rota --help)");
  }
  return chosen;
}

}  // namespace rota::cli
