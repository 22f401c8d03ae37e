// More agents needed than may be, and the result not looked into.
// ends: empty_cardinality
#include "world.hpp"

int main() {
  auto const normal = game::plan::make({.plan = soccer::plan::normal,
                                        .tasks = {{soccer::task::attack, {3, 1}, soccer::state::get_ball}},
                                        .utility = nearest});
  return normal->tasks().empty();
}
