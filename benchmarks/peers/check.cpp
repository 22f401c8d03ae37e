// Solves small instances with every solver there is, rota's own among them, and asserts that all agree.
//
//   check_peers [INSTANCES]    of each shape; 20 unless told

#include "value.hpp"

#include "../instances.hpp"
#include "../ours.hpp"

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace {

int failures = 0;
std::map<std::string, int> solved;

/// Compares all that take the instance in up to about a tenth of a second, and counts how many did.
template <class Ours, class Instance>
void compare(std::string const& what, Instance const& in) {
  Ours us(in);
  auto const expected = peers::optimum(in, us);
  ++solved["rota"];
  for (auto const& entry : peers::all<Instance>()) {
    if (entry.needs(in) != peers::effort::quick) continue;
    auto const found = peers::optimum(in, *entry.make(in));
    ++solved[entry.name];
    if (found == expected) continue;
    ++failures;
    auto text = [](auto const& v) { return v ? std::to_string(*v) : std::string("none"); };
    std::printf("%s: rota %s, %s %s\n", what.c_str(), text(expected).c_str(), entry.name, text(found).c_str());
  }
}

/// Makes pairs impossible and bounds odd, so that some instances have no solution.
void spoil(peers::additive_instance& in, std::mt19937_64& random) {
  for (auto& u : in.utility)
    if (random() % 4 == 0) u = peers::forbidden;
  for (std::size_t s = 0; s < in.slots(); ++s) {
    in.bounds.upper[s] = static_cast<std::uint32_t>(random() % 4);
    in.bounds.lower[s] = static_cast<std::uint32_t>(random() % (in.bounds.upper[s] + 1));
  }
}

/// Makes utilities so small that a rounding shows.
peers::additive_instance coarse(peers::additive_instance in) {
  for (auto& u : in.utility) u %= 10;
  return in;
}
peers::pairwise_instance coarse(peers::pairwise_instance in) {
  for (auto& u : in.unary) u %= 4;
  for (auto& u : in.pairs) u %= 4;
  return in;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace instances;
  auto const count = static_cast<std::uint64_t>(argc > 1 ? std::atoi(argv[1]) : 20);
  std::mt19937_64 random(count);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    auto additive = [&](char const* family, peers::additive_instance const& in) {
      compare<ours::additive>(std::string(family) + " seed " + std::to_string(seed), in);
    };
    for (size const s : {size{5, 3}, size{8, 4}, size{7, 7}, size{50, 10}}) {
      additive("congested", uniform(s, congested_bounds(s), seed));
      additive("distances", distances(s, congested_bounds(s), seed, 1000));
      additive("digits", digits(s, congested_bounds(s), seed));
      additive("coarse", coarse(uniform(s, congested_bounds(s), seed)));
      additive("classes", classes(s, congested_bounds(s), seed, 3));
      auto in = digits(s, congested_bounds(s), seed);
      spoil(in, random);
      additive("spoilt", in);
    }
    for (size const s : {size{1, 1}, size{2, 2}, size{7, 7}, size{40, 40}}) {
      additive("square", uniform(s, one_each(s), seed));
      additive("square, distances", distances(s, one_each(s), seed));
      additive("square, digits", digits(s, one_each(s), seed));
      additive("square, coarse", coarse(uniform(s, one_each(s), seed)));
    }
    for (std::size_t robots = 3; robots <= 6; ++robots)
      additive("AttackPlay", uniform({robots, 4}, attack_play(robots), seed));
    for (size const s : {size{2, 2}, size{5, 3}, size{7, 4}, size{9, 3}}) {
      auto pairwise = [&](char const* family, peers::pairwise_instance const& in) {
        compare<ours::pairwise>(std::string(family) + " seed " + std::to_string(seed), in);
      };
      pairwise("pairwise", pairwise_uniform(s, seed));
      pairwise("pairwise, distances", pairwise_distances(s, seed));
      pairwise("pairwise, coarse", coarse(pairwise_uniform(s, seed)));
    }
  }
  for (auto const& [name, times] : solved) std::printf("%-24s solved %d instances\n", name.c_str(), times);
  std::printf(failures == 0 ? "all agree\n" : "%d disagree\n", failures);
  return failures == 0 ? 0 : 1;
}
