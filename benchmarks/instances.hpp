#pragma once

#include "peers/additive.hpp"
#include "peers/pairwise.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

/// Families of instances, each the same on every machine: a seed, the Mersenne twister, integers and one square root.
namespace instances {

using peers::additive_instance;
using peers::cardinalities;
using peers::pairwise_instance;

struct size {
  std::size_t agents;
  std::size_t tasks;

  /// So many agents a task takes at most, so that all fit and compete.
  std::uint32_t room() const { return static_cast<std::uint32_t>((agents + tasks - 1) / tasks); }
};

/// Utilities are integers: 1 is so many of them.
inline constexpr std::int64_t one = std::int64_t{1} << 20;

/// A number in [0, 1).
inline std::int64_t fraction(std::mt19937_64& random) { return static_cast<std::int64_t>(random() >> 44); }

struct point {
  std::int64_t x;
  std::int64_t y;
};

/// Points of the unit square.
inline std::vector<point> points(std::mt19937_64& random, std::size_t n) {
  std::vector<point> all(n);
  for (point& p : all) {
    p.x = fraction(random);
    p.y = fraction(random);
  }
  return all;
}

/// The difference of squares is exact and so is the rounding, hence no flag of the compiler matters.
inline std::int64_t distance(point a, point b) {
  auto const dx = a.x - b.x;
  auto const dy = a.y - b.y;
  return std::llround(std::sqrt(static_cast<double>(dx * dx + dy * dy)));
}

/// Tasks with just enough room for all, every fourth of them needing half of it; then idling, open to all.
inline cardinalities congested_bounds(size s) {
  cardinalities c;
  for (std::size_t t = 0; t < s.tasks; ++t) {
    c.lower.push_back(t % 4 == 0 ? (s.room() + 1) / 2 : 0);
    c.upper.push_back(s.room());
  }
  c.lower.push_back(0);
  c.upper.push_back(static_cast<std::uint32_t>(s.agents));
  return c;
}

/// Every slot takes one.
inline cardinalities one_each(size s) {
  return {std::vector<std::uint32_t>(s.tasks, 1), std::vector<std::uint32_t>(s.tasks, 1)};
}

/// Fills the matrix with utility(agent, task), and 0 for slots beyond the tasks.
template <class F>
additive_instance additive(size s, cardinalities bounds, F&& utility) {
  additive_instance in{s.agents, std::move(bounds), {}};
  in.utility.reserve(s.agents * in.slots());
  for (std::size_t a = 0; a < s.agents; ++a)
    for (std::size_t t = 0; t < in.slots(); ++t) in.utility.push_back(t < s.tasks ? utility(a, t) : 0);
  return in;
}

/// Uniform utilities in [0, scale).
inline additive_instance uniform(size s, cardinalities bounds, std::uint64_t seed, std::int64_t scale = 1) {
  std::mt19937_64 random(seed);
  return additive(s, std::move(bounds), [&](auto, auto) { return fraction(random) * scale; });
}

/// Agents and tasks in the unit square; 2 - distance, times scale.
inline additive_instance distances(size s, cardinalities bounds, std::uint64_t seed, std::int64_t scale = 1) {
  std::mt19937_64 random(seed);
  auto const agents = points(random, s.agents);
  auto const tasks = points(random, s.tasks);
  return additive(s, std::move(bounds),
                  [&](auto a, auto t) { return (2 * one - distance(agents[a], tasks[t])) * scale; });
}

/// Uniform utilities, to which each task adds what it is worth to anybody: many want the same.
inline additive_instance contested(size s, cardinalities bounds, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::int64_t> worth(s.tasks);
  for (auto& u : worth) u = fraction(random);
  return additive(s, std::move(bounds), [&](auto, auto t) { return fraction(random) + worth[t]; });
}

/// Integers from 0 to 9: optima abound.
inline additive_instance digits(size s, cardinalities bounds, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  return additive(s, std::move(bounds), [&](auto, auto) { return static_cast<std::int64_t>(random() % 10) * one; });
}

/// Uniform utilities, but there are only `kinds` kinds of agents.
inline additive_instance classes(size s, cardinalities bounds, std::uint64_t seed, std::size_t kinds) {
  std::mt19937_64 random(seed);
  std::vector<std::int64_t> rows(kinds * s.tasks);
  for (auto& u : rows) u = fraction(random);
  std::vector<std::size_t> kind(s.agents);
  for (auto& k : kind) k = random() % kinds;
  return additive(s, std::move(bounds), [&](auto a, auto t) { return rows[kind[a] * s.tasks + t]; });
}

/// AttackPlay of the ALICA plans of robot soccer: Attack 1..1, Block 0..1, Defend 0..1, ReceivePassInGame 1..1.
inline cardinalities attack_play(std::size_t robots) {
  return {{1, 0, 0, 1, 0}, {1, 1, 1, 1, static_cast<std::uint32_t>(robots)}};
}

/// Tasks with room to spare, the first of them needing one; nobody idles.
inline cardinalities roomy_bounds(size s) {
  cardinalities c{std::vector<std::uint32_t>(s.tasks, 0), std::vector<std::uint32_t>(s.tasks, s.room() + 1)};
  c.lower[0] = 1;
  return c;
}

/// Unary and pair tables uniform in [0, 1).
inline pairwise_instance pairwise_uniform(size s, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  pairwise_instance in(s.agents, roomy_bounds(s));
  for (auto& u : in.unary) u = fraction(random);
  for (auto& u : in.pairs) u = fraction(random);
  return in;
}

/// Agents and tasks in the unit square: whoever works together wants to be near, by how much flows between them.
inline pairwise_instance pairwise_distances(size s, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  pairwise_instance in(s.agents, roomy_bounds(s));
  auto const agents = points(random, s.agents);
  auto const tasks = points(random, s.tasks);
  for (std::size_t a = 0; a < s.agents; ++a)
    for (std::size_t t = 0; t < s.tasks; ++t) in.unary[a * s.tasks + t] = -distance(agents[a], tasks[t]);
  for (std::size_t a = 1; a < s.agents; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      auto const flow = fraction(random);
      for (std::size_t t = 0; t < s.tasks; ++t)
        for (std::size_t u = 0; u < s.tasks; ++u) in.pair(a, t, b, u) = -(flow * distance(tasks[t], tasks[u]) / one);
    }
  return in;
}

/// Agents that are all alike, whoever works together being worth something.
inline pairwise_instance pairwise_one_class(size s, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  pairwise_instance in(s.agents, roomy_bounds(s));
  for (std::size_t t = 0; t < s.tasks; ++t) {
    auto const u = fraction(random);
    for (std::size_t a = 0; a < s.agents; ++a) in.unary[a * s.tasks + t] = u;
    for (std::size_t v = 0; v <= t; ++v) {
      auto const together = fraction(random);
      for (std::size_t a = 1; a < s.agents; ++a)
        for (std::size_t b = 0; b < a; ++b) in.pair(a, t, b, v) = in.pair(a, v, b, t) = together;
    }
  }
  return in;
}

}  // namespace instances
