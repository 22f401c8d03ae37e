// An entry state left out.
// fails: error.*plan_task::entry is missing
#include "world.hpp"

int main() {
  auto const normal =
      game::plan::make({.plan = soccer::plan::normal, .tasks = {{soccer::task::attack, {1, 1}}}, .utility = nearest});
}
