#include "playing.hpp"

#include "command.hpp"
#include "target.hpp"
#include "text.hpp"

#include <rota/adapters/alica/convert.hpp>
#include <rota/sim/oracle.hpp>

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

namespace rota::cli {
namespace {

sim::plan_sketch sketch_of(target const& t, alica::plan const& p) {
  sim::plan_sketch s;
  s.id = {p.id};
  s.name = t.name(p);
  for (auto const& e : p.entry_points) s.tasks.push_back({task_key(p, e), label(p, e), e.bounds, {e.state}});
  s.team_size = p.team_size;
  s.hysteresis = p.utility_threshold;
  return s;
}

}  // namespace

std::string default_plan() {
  char const* const data = std::getenv("ROTA_DATA");
  return std::string(data != nullptr ? data : ROTA_EXAMPLE_DATA) + "/soccer/json/etc/plans/SoccerPlay.pml";
}

sim::playbook read_playbook(std::string const& file) {
  auto const t = find_target({file}, "");
  std::vector<sim::plan_sketch> sketches;
  for (auto const* p : t->plans) sketches.push_back(sketch_of(*t, *p));
  auto const type = t->type != nullptr ? t->type->id : t->plans.front()->id;
  auto made = sim::make_playbook({type}, std::move(sketches));
  if (!made) throw input_error(file, "", made.error());
  return *std::move(made);
}

void require_playable(sim::playbook const& book, std::size_t robots, std::string const& file) {
  sim::perceived anywhere;
  for (std::size_t i = 0; i < robots; ++i) anywhere.robots.push_back(sim::formation_spot(i));
  workspace space;
  auto const members = sim::team_of(robots);
  if (!best_allocation(problem(book.type, members, anywhere), space))
    throw input_error(file, "", counted(robots, "robot") + " cannot play it: no allocation is valid");
}

sim::stamp_function stamp_of(std::string const& policy) { return sim::function_of(*sim::parse_stamp_policy(policy)); }

sim::figures play_scenario(sim::playbook const& book, sim::play_options const& options,
                           std::optional<sim::oracle> what) {
  return sim::play_knowing(book, options, what);
}

std::vector<std::pair<sim::oracle, std::string>> oracles() {
  std::vector<std::pair<sim::oracle, std::string>> all;
  all.reserve(sim::all_oracles.size());
  for (auto const o : sim::all_oracles) all.emplace_back(o, to_string(o));
  return all;
}

evaluation::row const& evaluation::of(sim::scenario s) const {
  return *std::find_if(rows.begin(), rows.end(), [s](row const& r) { return r.what == s; });
}

evaluation evaluate(sim::playbook const& book, std::uint64_t seed, std::optional<sim::stamp_function> const& stamp,
                    std::function<void(std::size_t steps, std::string const& what)> const& next) {
  std::size_t const steps = 2 + (stamp ? 3 : 2) * sim::all_scenarios.size();
  evaluation e;
  sim::timing_options timing;
  timing.seed = seed;
  next(steps, "timing of detection, messages every 100 ms");
  e.timing = sim::measure_timing(timing);
  timing.message_period = milliseconds(200);
  next(steps, "timing of detection, messages every 200 ms");
  e.timing_at_200 = sim::measure_timing(timing);
  for (auto const s : sim::all_scenarios) {
    sim::play_options options;
    options.what = s;
    options.team.seed = seed;
    auto const coming = [&](char const* how) { next(steps, std::string(to_string(s)) + ", resolution " + how); };
    evaluation::row r;
    r.what = s;
    coming("off");
    options.team.robot.resolution = false;
    r.off = play_scenario(book, options);
    options.team.robot.resolution = true;
    coming("as published");
    r.published = sim::play_as_published(book, options);
    if (stamp) {
      coming("on");
      options.team.stamp = *stamp;
      r.on = play_scenario(book, options);
    }
    e.rows.push_back(std::move(r));
  }
  return e;
}

std::string plan_names(sim::playbook const& book) {
  std::string out;
  for (auto const& p : book.plans) out += (out.empty() ? "" : ", ") + p.name;
  return out;
}

std::string leaders(sim::figures const& f) {
  std::string out;
  std::size_t who = 0;
  for (std::size_t i = f.led.size(); i-- > 0;) {
    if (f.led[i] == 0) continue;
    ++who;
    out += (out.empty() ? "" : ", ") + std::to_string(i + 1) + ": " + std::to_string(f.led[i]);
  }
  if (who == 1) out = out.substr(0, out.find(':'));
  return who == 0 ? "-" : out;
}

}  // namespace rota::cli
