#include "stamps.hpp"

#include "command.hpp"
#include "json.hpp"
#include "playing.hpp"
#include "report.hpp"
#include "text.hpp"

#include <rota/sim/stamp_policy.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace rota::cli {
namespace {

/// Who chooses the stamps of a game.
struct chooser {
  std::string name;
  std::optional<sim::oracle> oracle;
};

stamp_cell measure(sim::playbook const& book, chooser const& c, sim::scenario what, stamps_options const& o,
                   progress& shown, std::size_t steps) {
  std::vector<double> right, wrong, not_one, conflict, reaction, p95, missed;
  shown.next(steps, c.name + ", " + std::string(to_string(what)));
  for (std::uint64_t i = 0; i < o.seeds; ++i) {
    sim::play_options p;
    p.what = what;
    p.team.seed = o.seed + i;
    if (o.minutes) p.length = duration{static_cast<std::int64_t>(*o.minutes * 60e9 + 0.5)};
    if (!c.oracle) p.team.stamp = stamp_of(c.name);
    auto const f = play_scenario(book, p, c.oracle);
    if (f.terms() > 0) right.push_back(f.right_share());
    wrong.push_back(f.wrong_share());
    not_one.push_back(f.not_one_share());
    conflict.push_back(f.conflict_share());
    auto const& reactions = f.pursuit.reactions;
    if (reactions.count() > 0) {
      reaction.push_back(reactions.mean_ms());
      p95.push_back(reactions.percentile_ms(95));
    }
    if (auto const changes = reactions.count() + f.pursuit.missed; changes > 0)
      missed.push_back(static_cast<double>(f.pursuit.missed) / static_cast<double>(changes));
  }
  return {c.name,           !c.oracle,          std::string(to_string(what)), estimated(right),
          estimated(wrong), estimated(not_one), estimated(conflict),          estimated(reaction),
          estimated(p95),   estimated(missed)};
}

std::string tenths(double x) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", x);
  return text.data();
}

std::string in_percent(estimate const& e) {
  if (e.games == 0) return "-";
  return tenths(100 * e.mean) + (e.within ? " ±" + tenths(100 * *e.within) : "");
}

std::string in_ms(estimate const& e) {
  if (e.games == 0) return "-";
  return number(static_cast<double>(static_cast<std::int64_t>(e.mean + 0.5))) +
         (e.within ? " ±" + number(static_cast<double>(static_cast<std::int64_t>(*e.within + 0.5))) : "");
}

std::string as_text(std::vector<stamp_cell> const& cells, sim::playbook const& book, stamps_options const& o) {
  constexpr auto scenarios = sim::all_scenarios.size();
  using line = std::array<std::string, scenarios + 1>;
  auto const table = [&](std::string const& corner, estimate stamp_cell::* figure) {
    std::vector<line> out;
    line head{corner};
    for (std::size_t i = 0; i < scenarios; ++i) head[i + 1] = to_string(sim::all_scenarios[i]);
    out.push_back(head);
    for (std::size_t i = 0; i < cells.size(); i += scenarios) {
      line row{cells[i].stamp};
      for (std::size_t j = 0; j < scenarios; ++j) row[j + 1] = in_percent(cells[i + j].*figure);
      out.push_back(row);
    }
    return laid_out(out);
  };
  std::vector<std::array<std::string, 6>> play;
  play.push_back({"hour", "in conflict", "not one", "reaction", "p95", "missed"});
  for (std::size_t i = scenarios - 1; i < cells.size(); i += scenarios) {
    auto const& c = cells[i];
    play.push_back({c.stamp, in_percent(c.conflict), in_percent(c.not_one), in_ms(c.reaction_ms),
                    in_ms(c.reaction_p95_ms), in_percent(c.missed)});
  }
  return "Five robots play " + plan_names(book) + ", " + counted(o.seeds, "game") + " of each scenario, seeds from " +
         std::to_string(o.seed) + "; a mean ± half of its 95 % interval.\n\n" +
         table("right leaders, %", &stamp_cell::right) + '\n' +
         table("a wrong attacker, % of the time", &stamp_cell::wrong) + '\n' + laid_out(play) +
         "\n  Right: of all reigns and renewals, those in which the leader imposed the attacker whom the true world "
         "asks for.\n"
         "  in conflict, not one (attacker), missed (changes) in %, reactions in ms. What no robot can know: confused: "
         "that it sees\n"
         "  a phantom or has lost its place, and then leads last. All but distance: what is true, but not how far "
         "the ball is: that\n"
         "  is seen, with bias and noise. Right: that its choice is that of the true world.\n";
}

}  // namespace

outcome run_stamps(stamps_options const& o) {
  auto const file = o.plan.empty() ? default_plan() : o.plan;
  auto const book = read_playbook(file);
  require_playable(book, sim::play_options{}.robots, file);
  std::vector<chooser> choosers;
  for (auto const p : sim::all_stamp_policies)
    if (o.stamp.empty() || o.stamp == to_string(p)) choosers.push_back({std::string(to_string(p)), std::nullopt});
  if (o.stamp.empty())
    for (auto const& [what, name] : oracles()) choosers.push_back({name, what});
  std::vector<stamp_cell> cells;
  progress shown;
  for (auto const& c : choosers)
    for (auto const s : sim::all_scenarios)
      cells.push_back(measure(book, c, s, o, shown, choosers.size() * sim::all_scenarios.size()));
  return {o.json ? as_json(cells, o.seed, o.seeds) : as_text(cells, book, o)};
}

}  // namespace rota::cli
