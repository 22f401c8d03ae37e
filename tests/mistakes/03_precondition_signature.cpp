// A precondition that does not take the allocation.
// fails: bool ?\((const view ?&|view const ?&), std::span<(const rota::in<soccer>|rota::in<soccer> const)
#include "world.hpp"

int main() {
  auto const normal = game::plan::make({.plan = soccer::plan::normal,
                                        .tasks = {{soccer::task::attack, {1, 1}, soccer::state::get_ball}},
                                        .utility = nearest,
                                        .precondition = [](view const&) { return true; }});
}
