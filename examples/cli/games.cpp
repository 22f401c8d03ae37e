#include "sweep.hpp"

#include <rota/sim/closed/play.hpp>
#include <rota/sim/stamps.hpp>

#include <algorithm>

namespace rota::cli {

std::array<std::optional<double>, quantities> play_cell(sim::playbook const& book, sweep_cell const& cell,
                                                        std::uint64_t seed) {
  using namespace sim::closed;
  game_options o;
  o.what = *parse_trouble(cell.trouble);
  o.robots = cell.robots;
  o.seed = seed;
  o.length = {static_cast<std::int64_t>(cell.minutes * 60e9 + 0.5)};
  o.network.loss = cell.loss;
  o.rules.message_period = milliseconds(cell.period_ms);
  o.rules.gap = {o.rules.message_period.ns / 10};
  o.rules.silence = std::max(o.rules.silence, 8 * o.rules.message_period);
  auto& robot = o.rules.robot;
  robot.pending_age = std::max(robot.pending_age, 4 * o.rules.message_period);
  robot.claim_period = std::max(robot.claim_period, duration{o.rules.message_period.ns * 2 / 5});
  robot.fingerprints = cell.period_ms > 100;
  if (cell.cycles > 0) robot.cycles = cell.cycles;
  if (cell.reign == "fixed") robot.renewals = 0;
  if (cell.reign_s > 0) {
    robot.reign = {static_cast<std::int64_t>(cell.reign_s * 1e9 + 0.5)};
    robot.max_reign = std::max(robot.max_reign, robot.reign);
  }
  robot.change_cost = cell.change_cost;
  o.rules.news = cell.news != "off";
  if (auto const stamp = sim::parse_stamp_policy(cell.stamp)) o.rules.stamp = sim::function_of(*stamp);
  auto sketches = book.plans;
  for (auto& s : sketches) s.hysteresis = cell.hysteresis;
  auto const changed = sim::make_playbook(book.type.id(), std::move(sketches));
  auto const f = play_game(*changed, *parse_way(cell.system), o);

  std::array<std::optional<double>, quantities> out;
  auto const put = [&](quantity m, double x, bool any = true) {
    if (any) out[static_cast<std::size_t>(m)] = x;
  };
  bool const reacted = f.reactions.count() > 0, led = f.reigns > 0, fought = f.episodes.count() > 0;
  bool const ruled = cell.system == "rota" || cell.system == "alica";
  double const robots = static_cast<double>(cell.robots);
  put(quantity::not_one, f.incoherent());
  put(quantity::wrong, f.share(f.wrong));
  put(quantity::conflict, f.share(f.in_conflict));
  put(quantity::median, f.episodes.percentile_ms(50), fought);
  put(quantity::p99, f.episodes.percentile_ms(99), fought);
  put(quantity::reaction, f.reaction_ms(), reacted);
  put(quantity::reaction_p95, f.reactions.percentile_ms(95), reacted);
  put(quantity::missed, f.missed_share(), reacted || f.missed > 0);
  put(quantity::to_ball, f.time_to_ball_ms());
  put(quantity::reigns, f.per_second(f.reigns) * 3600, ruled);
  put(quantity::right, static_cast<double>(f.right) / static_cast<double>(led ? f.reigns : 1), led);
  put(quantity::messages, f.per_second(f.messages) / robots);
  put(quantity::bytes, f.per_second(f.bytes) / robots);
  return out;
}

}  // namespace rota::cli
