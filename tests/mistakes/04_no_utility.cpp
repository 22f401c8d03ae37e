// The utility left out, and the result not looked into.
// ends: missing_utility
#include "world.hpp"

int main() {
  auto const normal = game::plan::make(
      {.plan = soccer::plan::normal, .tasks = {{soccer::task::attack, {1, 1}, soccer::state::get_ball}}});
  return normal->tasks().empty();
}
