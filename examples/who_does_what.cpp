// Who does what now? A plan with cardinalities, a role that forbids, a utility to maximise.
//
//   maximise  U_p(F ∪ C)   over all C valid for p:   n₁ ≤ |{a : In(a, p, τ) ∈ C}| ≤ n₂  for every task τ of p
#include <rota/print.hpp>
#include <rota/rota.hpp>

#include <iostream>
#include <map>

struct soccer {
  enum class agent { keeper = 1, left, right };
  enum class plan_type { play };
  enum class plan { normal, kickoff };
  enum class task { attack, defend };
  enum class state { get_ball, protect };
  friend char const* to_string(agent a) { return a == agent::keeper ? "keeper" : a == agent::left ? "left" : "right"; }
  friend char const* to_string(plan p) { return p == plan::normal ? "normal" : "kickoff"; }
  friend char const* to_string(task t) { return t == task::attack ? "attack" : "defend"; }
};
struct beliefs {
  std::map<soccer::agent, double> distance_to_ball;
  bool kickoff = false;
};
using game = rota::domain<soccer, beliefs>;

int main() {
  using enum soccer::agent;
  using enum soccer::task;

  auto const nearest_attacks = [](soccer::agent a, soccer::task t, beliefs const& b) {
    return t == attack ? 10 - b.distance_to_ball.at(a) : 1.0;
  };
  auto const normal =
      game::plan::make({.plan = soccer::plan::normal,
                        .tasks = {{attack, {1, 1}, soccer::state::get_ball}, {defend, {0, 2}, soccer::state::protect}},
                        .utility = nearest_attacks});
  auto const kickoff = game::plan::make({.plan = soccer::plan::kickoff,
                                         .tasks = {{attack, {2, 2}, soccer::state::get_ball}},
                                         .utility = nearest_attacks,
                                         .precondition = [](beliefs const& b, auto) { return b.kickoff; }});
  auto const play = game::plan_type::make(soccer::plan_type::play, {*normal, *kickoff});

  game::team members{left, right};
  members.add(keeper, game::role().forbid(attack));

  beliefs world{{{keeper, 0.5}, {left, 2.0}, {right, 3.0}}};
  game::problem const here{*play, members, world};
  rota::workspace space;
  auto const best = rota::best_allocation(here, space);
  std::cout << *best << '\n';

  // The ball moves a little: hysteresis keeps the allocation. It moves a lot: the event says what changes.
  world.distance_to_ball[right] = 1.875;
  auto const same = rota::reallocate(here.running(best->atoms), {.absolute = 0.5}, space);
  world.distance_to_ball[right] = 0.5;
  auto const next = rota::reallocate(here.running(best->atoms), {.absolute = 0.5}, space);
  std::cout << same << '\n' << next << '\n';

  // Why not the keeper? Every violated clause has its witness.
  auto wrong = best->atoms;
  wrong.insert({keeper, soccer::plan::normal, attack});
  auto const report = rota::validate(here, wrong);
  for (auto const& v : report) std::cout << v << '\n';
  return same.event.empty() && next.event.size() == 4 && report.violates(rota::clause::role) ? 0 : 1;
}
