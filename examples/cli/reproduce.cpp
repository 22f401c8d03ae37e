#include "command.hpp"
#include "json.hpp"
#include "playing.hpp"
#include "report.hpp"
#include "text.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rota::cli {
namespace {

/// What is told in words, side by side.
std::string told(evaluation const& e) {
  using sim::scenario;
  auto const longest = [](sim::figures const& f) { return milliseconds_text(f.episodes.longest_ms()); };
  auto const wrong = [](sim::figures const& f) {
    return f.terms() == 0 ? std::string("no reign") : percent(1 - f.right_share()) + " wrong";
  };
  auto const bullied = [&](sim::figures const& (*of)(evaluation::row const&)) {
    auto const figures = [&](scenario s) -> sim::figures const& { return of(e.of(s)); };
    auto const& two = figures(scenario::phantom_two);
    auto const& none = figures(scenario::phantom_none);
    auto const& hour = figures(scenario::hour);
    return std::vector<std::string>{
        "longest episode " + longest(figures(scenario::ball_fight)),
        "longest " + longest(two) + ", " + longest(none),
        wrong(two) + ", " + wrong(none) + "; led by " + leaders(two),
        counted(hour.reigns, "reign") + " an hour",
        wrong(hour) + "; mislocalised: " + wrong(figures(scenario::mislocalised)),
        percent(hour.not_one_share()) + ", " + percent(hour.wrong_share()) + " of the hour",
    };
  };
  auto const published = bullied([](auto const& r) -> sim::figures const& { return r.published; });
  bool const both = e.rows.front().on.has_value();
  auto const now = both ? bullied([](auto const& r) -> sim::figures const& { return *r.on; }) : published;
  constexpr std::array words{"ball: \"reliably detected and solved\"",
                             "phantom: \"two robots pursue the ball, or none\", solved",
                             "phantom: solution \"arbitrary\", that of the highest id",
                             "\"one hour of playing\": bullying \"twelve times\"",
                             "\"one third\" incorrect, by bad localisation",
                             "(not exactly one attacker, a wrong one)"};
  std::vector<std::array<std::string, 3>> rows{{"the paper", "as published", both ? "now" : ""}};
  for (std::size_t i = 0; i < words.size(); ++i) rows.push_back({words[i], published[i], both ? now[i] : ""});
  std::vector<std::array<std::string, 2>> timing{
      {"the paper", "here"},
      {"two subsequent cycles take 115 ms on average",
       number(static_cast<double>(static_cast<int>(e.timing.two_cycles_ms * 10 + 0.5)) / 10) + " ms"},
      {"(n = 4, as it was used)", milliseconds_text(e.timing.four_cycles_ms)},
      {"(messages every 200 ms: n = 2, n = 4)",
       milliseconds_text(e.timing_at_200.two_cycles_ms) + ", " + milliseconds_text(e.timing_at_200.four_cycles_ms)},
      {"ball: \"a conflict persisted for several minutes\" before",
       longest(e.of(scenario::ball_fight).off) + " of 5.0 min"},
      {"phantom: without resolution", "longest " + longest(e.of(scenario::phantom_two).off) + ", " +
                                          longest(e.of(scenario::phantom_none).off) + " of 5.0 min"}};
  return laid_out(timing) + '\n' + laid_out(rows);
}

std::string as_text(evaluation const& e, sim::playbook const& book, reproduce_options const& o) {
  std::vector<std::array<std::string, 12>> table;
  table.push_back({"scenario", "resolution", "in conflict", "episodes", "median", "p99", "longest", "cycles",
                   "detected", "reigns", "right", "led by"});
  auto const add = [&](std::string const& what, std::string const& how, sim::figures const& f) {
    table.push_back({what, how, percent(f.conflict_share()), std::to_string(f.episodes.count()),
                     milliseconds_text(f.episodes.percentile_ms(50)), milliseconds_text(f.episodes.percentile_ms(99)),
                     milliseconds_text(f.episodes.longest_ms()), std::to_string(f.cycles), std::to_string(f.detections),
                     std::to_string(f.reigns), f.terms() == 0 ? "-" : percent(f.right_share()), leaders(f)});
  };
  for (auto const& r : e.rows) {
    add(std::string(to_string(r.what)), "off", r.off);
    add("", "as published", r.published);
    if (r.on) add("", "now", *r.on);
  }
  return "Five robots play " + plan_names(book) + ", seed " + std::to_string(o.seed) +
         ": deliberation every 30 ms, messages every 100 ms, n = 4 cycles, reigns of 2 s.\n\n" + laid_out(table) +
         "\n  As published: the literal monitor, reigns of fixed length, the greatest id leads." +
         (o.as_published
              ? std::string()
              : " Now: the default monitor,\n  reigns renewed for as long as their cause, stamps: " + o.stamp + ".") +
         "\n  An episode of conflict ends when agreement has lasted 300 ms. Right: reigns that imposed the attacker "
         "whom\n"
         "  the true world asks for. All see the same, bit for bit.\n\n" +
         told(e) +
         "\n  The simulated world is stated in include/rota/sim (scenario.hpp, perception.hpp, network.hpp) and not\n"
         "  fitted to the paper: how often conflicts arise, how long they linger and who is right depend on it.\n";
}

}  // namespace

outcome run_reproduce(reproduce_options const& o) {
  auto const file = o.plan.empty() ? default_plan() : o.plan;
  auto const book = read_playbook(file);
  require_playable(book, sim::play_options{}.robots, file);
  progress shown;
  auto const stamp = o.as_published ? std::nullopt : std::optional(stamp_of(o.stamp));
  auto const e =
      evaluate(book, o.seed, stamp, [&](std::size_t steps, std::string const& what) { shown.next(steps, what); });
  return {o.json ? as_json(e, o.seed, o.as_published ? "id" : o.stamp) : as_text(e, book, o)};
}

}  // namespace rota::cli
