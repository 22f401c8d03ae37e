// Who wants nothing but numbers: rota::dense knows no plan.
#include <rota/dense/flow/solver.hpp>

#include <array>

int main() {
  std::array<std::int64_t, 4> const worth{3, 1, 2, 2};  // two agents, two slots
  std::array<rota::dense::slot_bounds, 2> const one_each{{{1, 1}, {1, 1}}};
  rota::dense::flow_solver solver;
  return solver.solve({2, worth, one_each}).value == 5 ? 0 : 1;
}
