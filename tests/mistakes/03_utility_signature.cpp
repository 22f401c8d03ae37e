// A lambda with two parameters instead of three as utility.
// fails: error.*double or std::optional<double> \(agent, task, Beliefs const&\)
#include "world.hpp"

int main() {
  auto const normal = game::plan::make({.plan = soccer::plan::normal,
                                        .tasks = {{soccer::task::attack, {1, 1}, soccer::state::get_ball}},
                                        .utility = [](soccer::agent, soccer::task) { return 1.0; }});
}
