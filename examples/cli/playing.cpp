#include "playing.hpp"

#include "command.hpp"
#include "target.hpp"
#include "text.hpp"

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <system_error>
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

std::string printed(char const* format, double x) {
  char text[64];
  std::snprintf(text, sizeof text, format, x);
  return text;
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

std::string check_seed(std::string const& text) {
  std::uint64_t seed = 0;
  auto const* const end = text.data() + text.size();
  auto const [rest, error] = std::from_chars(text.data(), end, seed);
  bool const octal = text.size() > 1 && text.front() == '0';  // to CLI11
  return error == std::errc{} && rest == end && !octal
             ? ""
             : '"' + text + "\" is not a whole number from 0 to 18446744073709551615";
}

nlohmann::ordered_json as_json(sim::scenario what, bool resolution, sim::figures const& f) {
  nlohmann::ordered_json led = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < f.led.size(); ++i)
    if (f.led[i] > 0) led[std::to_string(i + 1)] = f.led[i];
  return {{"name", to_string(what)},
          {"resolution", resolution ? "on" : "off"},
          {"conflict_share", f.conflict_share()},
          {"episodes", f.episodes.count()},
          {"episode_ms",
           {{"median", f.episodes.percentile_ms(50)},
            {"p99", f.episodes.percentile_ms(99)},
            {"max", f.episodes.longest_ms()}}},
          {"cycles", f.cycles},
          {"detections", f.detections},
          {"reigns", f.reigns},
          {"right_share", f.reigns == 0 ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(f.right_share())},
          {"resolved", f.resolved()},
          {"right", f.right},
          {"led", led},
          {"measured_ns", f.measured.ns},
          {"in_conflict_ns", f.in_conflict.ns},
          {"deliberations", f.deliberations},
          {"broadcasts", f.messages},
          {"perception_digest", std::to_string(f.perception_digest)}};
}

std::string percent(double share) { return printed("%.1f %%", share * 100); }

std::string milliseconds_text(double ms) {
  if (ms < 1000) return printed("%.0f ms", ms);
  if (ms < 60'000) return printed("%.1f s", ms / 1000);
  return printed("%.1f min", ms / 60'000);
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
