// A problem of a temporary team.
// fails: error.*(deleted|delete)
// fails: a problem is a view: what it views must be variables
#include "world.hpp"

int main() {
  auto const type = right_play();
  view const world;
  rota::problem const here{type, game::team{soccer::agent::left}, world};
}
