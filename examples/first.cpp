#include <rota/rota.hpp>

int main() {
  // In(a, p, τ): agent 7 attacks (task 1) or defends (task 2) within plan 3. Names may also be enums of your own.
  using atoms = rota::atom_set<rota::in<>>;
  atoms const defends{{{7}, {3}, {2}}}, attacks{{{7}, {3}, {1}}};

  auto const e_m = rota::difference(defends, attacks);  // a message: agent 7 says that it attacks
  auto const e_r = rota::difference(attacks, defends);  // our reallocation: no, it defends

  bool const loop = rota::is_cycle(e_m, e_r, {7});                                      // Def. 5
  bool const no_group = rota::compose(e_m, e_m) == e_m;                                 // Def. 4: e∘e = e
  bool const group = rota::delta(e_m) + rota::delta(e_r) == rota::delta<rota::in<>>{};  // ℤ^(Atoms)
  return loop && no_group && group ? 0 : 1;
}
