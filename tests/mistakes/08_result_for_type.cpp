// The * before plan_type::make forgotten.
// fails: error.*deleted
// fails: a result may be refused: pass
#include "world.hpp"

int main() {
  auto const type = game::plan_type::make(soccer::plan_type::play, {});
  game::team const members{soccer::agent::left};
  view const world;
  game::problem const here{type, members, world};
}
