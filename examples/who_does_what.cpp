// Who does what now? A plan with cardinalities, a role that forbids, a utility to maximise.
//
//   maximise  U_p(F ∪ C)   over all C valid for p:   n₁ ≤ |{a : In(a, p, τ) ∈ C}| ≤ n₂  for every task τ of p
#include <rota/rota.hpp>

#include <cstdio>
#include <map>

struct soccer {
  enum class agent { keeper = 1, left, right };
  enum class plan_type { play };
  enum class plan { normal, kickoff };
  enum class task { attack, defend };
  enum class state { get_ball, protect };
};
struct beliefs {
  std::map<soccer::agent, double> distance_to_ball;
  bool kickoff = false;
};

int main() {
  using plan = rota::plan<soccer, beliefs>;
  using enum soccer::agent;
  using enum soccer::task;

  auto const nearest_attacks = [](soccer::agent a, soccer::task t, beliefs const& b) -> std::optional<double> {
    return t == attack ? 10 - b.distance_to_ball.at(a) : 1.0;
  };
  auto const normal =
      plan::make({.plan = soccer::plan::normal,
                  .tasks = {{attack, {1, 1}, soccer::state::get_ball}, {defend, {0, 2}, soccer::state::protect}},
                  .utility = rota::additive_utility<soccer, beliefs>(nearest_attacks)});
  auto const kickoff = plan::make({.plan = soccer::plan::kickoff,
                                   .tasks = {{attack, {2, 2}, soccer::state::get_ball}},
                                   .utility = rota::additive_utility<soccer, beliefs>(nearest_attacks),
                                   .precondition = [](beliefs const& b, auto) { return b.kickoff; }});
  auto const play = rota::plan_type<soccer, beliefs>::make(soccer::plan_type::play, {*normal, *kickoff});

  rota::team<soccer> members{left, right};
  members.add(keeper, rota::role<soccer>().forbid(attack));

  beliefs world{{{keeper, 0.5}, {left, 2.0}, {right, 3.0}}};
  rota::workspace space;
  rota::problem const here{*play, members, world};

  auto const best = rota::best_allocation(here, space);
  if (!best) return 1;
  std::printf("plan %d, utility %.1f, %s\n", int(best->plan), best->utility, best->optimal ? "optimal" : "a bound");
  for (auto const& x : best->atoms) std::printf("  agent %d: task %d\n", int(x.agent), int(x.task));

  // The ball moves a little: hysteresis keeps the allocation. It moves a lot: the event says what changes.
  world.distance_to_ball[right] = 1.9;
  auto const same = rota::reallocate(here.running(best->atoms), {.absolute = 0.5}, space);
  world.distance_to_ball[right] = 0.5;
  auto const next = rota::reallocate(here.running(best->atoms), {.absolute = 0.5}, space);
  std::printf("moved a little: %zu changes; moved a lot: %zu changes\n", same.event.size(), next.event.size());

  // Why not the keeper? Every violated clause has its witness.
  auto wrong = best->atoms;
  wrong.insert({keeper, soccer::plan::normal, attack});
  bool forbidden = false, crowded = false;
  for (auto const& v : rota::validate(here, wrong)) {
    forbidden |= v.what == rota::clause::role;
    crowded |= v.what == rota::clause::cardinality;
  }
  return same.event.empty() && next.event.size() == 4 && forbidden && crowded ? 0 : 1;
}
