// A decision that nobody looks at, before the plan type was entered.
// warns: unused-result
#include "world.hpp"

#include <rota/team/robot.hpp>

int main() {
  auto const type = right_play();
  game::team const members{soccer::agent::left};
  view const world;
  rota::workspace space;
  rota::robot<soccer> me(soccer::agent::left, members.agents(), {1});
  me.deliberate(type, members, world, rota::instant{}, space);
}
