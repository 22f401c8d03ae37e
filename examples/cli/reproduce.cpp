#include "command.hpp"
#include "json.hpp"
#include "playing.hpp"
#include "report.hpp"
#include "text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace rota::cli {
namespace {

std::string as_text(evaluation const& e, sim::playbook const& book, reproduce_options const& o) {
  using sim::scenario;
  std::vector<std::array<std::string, 12>> table;
  table.push_back({"scenario", "resolution", "in conflict", "episodes", "median", "p99", "longest", "cycles",
                   "detected", "reigns", "right", "led by"});
  for (auto const& r : e.rows)
    for (bool const on : {false, true}) {
      auto const& f = on ? r.on : r.off;
      table.push_back({std::string(on ? "" : to_string(r.what)), on ? "on" : "off", percent(f.conflict_share()),
                       std::to_string(f.episodes.count()), milliseconds_text(f.episodes.percentile_ms(50)),
                       milliseconds_text(f.episodes.percentile_ms(99)), milliseconds_text(f.episodes.longest_ms()),
                       std::to_string(f.cycles), std::to_string(f.detections), std::to_string(f.reigns),
                       f.terms() == 0 ? "-" : percent(f.right_share()), leaders(f)});
    }

  auto const& fight = e.of(scenario::ball_fight);
  auto const& two = e.of(scenario::phantom_two);
  auto const& none = e.of(scenario::phantom_none);
  auto const& hour = e.of(scenario::hour);
  auto const wrong = [](sim::figures const& f) {
    return f.terms() == 0 ? std::string("no reign") : percent(1 - f.right_share()) + " wrong";
  };
  auto const longest = [](sim::figures const& f) { return milliseconds_text(f.episodes.longest_ms()); };
  std::vector<std::array<std::string, 2>> words{
      {"the paper", "here"},
      {"two subsequent cycles take 115 ms on average",
       number(static_cast<double>(static_cast<int>(e.timing.two_cycles_ms * 10 + 0.5)) / 10) + " ms"},
      {"(n = 4, as it was used)", milliseconds_text(e.timing.four_cycles_ms)},
      {"(messages every 200 ms: n = 2, n = 4)",
       milliseconds_text(e.timing_at_200.two_cycles_ms) + ", " + milliseconds_text(e.timing_at_200.four_cycles_ms)},
      {"ball: \"a conflict persisted for several minutes\" before", longest(fight.off) + " of 5.0 min"},
      {"ball: \"reliably detected and solved\"", "longest episode " + longest(fight.on)},
      {"phantom: \"two robots pursue the ball, or none\", solved", "longest " + longest(two.off) + ", " +
                                                                       longest(none.off) + "; with resolution " +
                                                                       longest(two.on) + ", " + longest(none.on)},
      {"phantom: solution \"arbitrary\", that of the highest id",
       wrong(two.on) + ", " + wrong(none.on) + "; led by " + leaders(two.on)},
      {"\"one hour of playing\": bullying \"twelve times\"", counted(hour.on.reigns, "reign") + " an hour"},
      {"\"one third\" incorrect, by bad localisation",
       wrong(hour.on) + "; mislocalised: " + wrong(e.of(scenario::mislocalised).on)}};

  return "Five robots play " + plan_names(book) + ", seed " + std::to_string(o.seed) +
         ": deliberation every 30 ms, messages every 100 ms, n = 4 cycles, reigns of 2 s" +
         (o.stamp == "id" ? "" : ", stamps: " + o.stamp) + ".\n\n" + laid_out(table) +
         "\n  An episode of conflict ends when agreement has lasted 300 ms. Right: reigns that imposed the attacker "
         "whom\n"
         "  the true world asks for. Off and on see the same, bit for bit.\n\n" +
         laid_out(words) +
         "\n  The simulated world is stated in include/rota/sim (scenario.hpp, perception.hpp, network.hpp) and not\n"
         "  fitted to the paper: how often conflicts arise, how long they linger and who is right depend on it.\n";
}

}  // namespace

outcome run_reproduce(reproduce_options const& o) {
  auto const file = o.plan.empty() ? default_plan() : o.plan;
  auto const book = read_playbook(file);
  require_playable(book, sim::play_options{}.robots, file);
  progress shown;
  auto const e = evaluate(book, o.seed, stamp_of(o.stamp),
                          [&](std::size_t steps, std::string const& what) { shown.next(steps, what); });
  return {o.json ? as_json(e, o.seed, o.stamp) : as_text(e, book, o)};
}

}  // namespace rota::cli
