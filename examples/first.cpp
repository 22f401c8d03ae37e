#include <rota/rota.hpp>

int main() {
  double const worth[]{3, 1, 2, 2, 1, 1};                   // of agents 0, 1 and 2: as attacker, as defender
  auto const best = rota::assign(worth, {{1, 1}, {0, 2}});  // one attacks, at most two defend

  using game = rota::domain<>;  // names known at run time; rota::domain<soccer, beliefs> for your own enums and beliefs
  game::atoms const defends{{{7}, {3}, {2}}}, attacks{{{7}, {3}, {1}}};  // In(a, p, τ): agent, plan, task

  auto const e_m = rota::difference(defends, attacks);  // a message: agent 7 says that it attacks
  auto const e_r = rota::difference(attacks, defends);  // our reallocation: no, it defends
  bool const loop = rota::is_cycle(e_m, e_r, {7});      // Def. 5
  return best->total == 6 && loop ? 0 : 1;
}
