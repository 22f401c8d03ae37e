// The * before plan::make forgotten.
// fails: error.*this is the result of plan::make, which may be refused
#include "world.hpp"

int main() {
  auto const normal = game::plan::make({.plan = soccer::plan::normal,
                                        .tasks = {{soccer::task::attack, {1, 1}, soccer::state::get_ball}},
                                        .utility = nearest});
  auto const type = game::plan_type::make(soccer::plan_type::play, {normal});
}
