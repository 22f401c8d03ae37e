// A task of another enumeration.
// fails: (duty.*soccer::task)
// fails: error.*plan_task::task is not of
#include "world.hpp"

enum class duty { attack };

int main() {
  auto const normal = game::plan::make(
      {.plan = soccer::plan::normal, .tasks = {{duty::attack, {1, 1}, soccer::state::get_ball}}, .utility = nearest});
}
