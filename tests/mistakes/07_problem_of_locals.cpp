// A function that returns a problem of its locals.
// clang warns: \[-W(return-stack-address|dangling)
#include "world.hpp"

game::problem dangling() {
  auto const type = right_play();
  game::team const members{soccer::agent::left};
  view const world;
  return {type, members, world};
}

int main() { return static_cast<int>(dangling().participants.size()); }
