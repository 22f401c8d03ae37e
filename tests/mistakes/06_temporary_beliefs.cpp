// A problem of temporary beliefs.
// fails: error.*(deleted|delete)
// fails: a problem is a view: what it views must be variables
#include "world.hpp"

int main() {
  auto const type = right_play();
  game::team const members{soccer::agent::left};
  rota::problem const here{type, members, view{0.25}};
}
