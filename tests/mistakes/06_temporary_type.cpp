// A problem of a temporary plan type.
// fails: error.*(deleted|delete)
// fails: a problem is a view: what it views must be variables
#include "world.hpp"

int main() {
  game::team const members{soccer::agent::left};
  view const world;
  rota::problem const here{right_play(), members, world};
}
