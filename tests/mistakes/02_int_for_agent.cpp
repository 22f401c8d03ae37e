// A plain int where an agent is wanted.
// fails: error.*int.*soccer::agent|error.*soccer::agent.*int
#include "world.hpp"

int main() {
  game::team members;
  members.add(1);
}
