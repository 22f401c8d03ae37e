// A running allocation that is gone at the end of the line.
// fails: error.*(deleted|delete)
// fails: a problem is a view: the allocation must outlive it
#include "world.hpp"

int main() {
  auto const type = right_play();
  game::team const members{soccer::agent::left};
  view const world;
  auto const here = game::problem{type, members, world}.running(game::atoms{});
}
