// An entry state of another enumeration.
// fails: (mode.*soccer::state)
// fails: error.*plan_task::entry is not of
#include "world.hpp"

enum class mode { get_ball };

int main() {
  auto const normal = game::plan::make(
      {.plan = soccer::plan::normal, .tasks = {{soccer::task::attack, {1, 1}, mode::get_ball}}, .utility = nearest});
}
