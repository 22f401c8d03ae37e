#include <rota/rota.hpp>

struct soccer {  // a vocabulary: any totally ordered names
  enum class agent { keeper = 1, left, right };
  enum class plan_type { play };
  enum class plan { normal };
  enum class task { attack, defend };
  enum class state { get_ball, protect };
};
using atom = rota::in<soccer>;  // In(a, p, τ): agent a takes on task τ within plan p

int main() {
  constexpr auto left = soccer::agent::left;
  rota::atom_set<atom> const before{{left, soccer::plan::normal, soccer::task::defend}};
  rota::atom_set<atom> const told{{left, soccer::plan::normal, soccer::task::attack}};

  auto const e_m = rota::difference(before, told);  // left says that it attacks
  auto const e_r = rota::difference(told, before);  // we reallocate: no, it defends
  bool const loop = rota::is_cycle(e_m, e_r, left);                                       // Def. 5
  bool const no_group = rota::compose(e_m, e_m) == e_m;                                   // Def. 4: e∘e = e
  bool const group = rota::delta(e_m) + rota::delta(e_m) - rota::delta(e_m) == rota::delta(e_m);  // brackets do not matter
  return loop && no_group && group ? 0 : 1;
}
