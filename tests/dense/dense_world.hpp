#pragma once
/// @file
/// Random dense problems as plain numbers, and two oracles on them: enumeration, and GLPK's out-of-kilter method.
/// Includes nothing of search/, so that it shares no code with what it judges.

#include "support/dice.hpp"

#include <glpk.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace dense_world {

using rota_test::any_seed;
using rota_test::dice;

/// What may be part of a random problem; `levels` different utilities, few of which make ties.
struct flavour {
  int agents = 6;
  int slots = 5;
  int levels = 10;
  int forbidden = 20;  // per cent of pairs
  bool squares = false;
};

/// n agents, m slots, a utility or nothing for each pair, bounds of each slot, and who takes part.
struct problem {
  std::size_t agents = 0;
  std::size_t slots = 0;
  std::vector<std::optional<std::int64_t>> utility;
  std::vector<std::pair<unsigned, unsigned>> bounds;
  std::vector<unsigned char> part;

  std::optional<std::int64_t> const& at(std::size_t a, std::size_t s) const { return utility[a * slots + s]; }
};

inline std::optional<std::int64_t> draw_utility(dice& d, flavour const& f) {
  if (d.chance(f.forbidden)) return std::nullopt;
  return d.below(f.levels) - f.levels / 3;
}

inline problem random_problem(dice& d, flavour const& f) {
  problem p;
  p.agents = static_cast<std::size_t>(d.below(f.agents + 1));
  p.slots = static_cast<std::size_t>(1 + d.below(f.slots));
  if (f.squares) p.slots = std::max<std::size_t>(p.agents, 1);
  auto const forbidden = d.chance(50) ? 0 : f.forbidden;
  flavour g = f;
  g.forbidden = forbidden;
  for (std::size_t i = 0; i < p.agents * p.slots; ++i) p.utility.push_back(draw_utility(d, g));
  auto const share = static_cast<int>(p.agents / p.slots + 1);
  for (std::size_t s = 0; s < p.slots; ++s) {
    auto const lower = static_cast<unsigned>(d.chance(60) ? 0 : d.below(share + 1));
    p.bounds.push_back({lower, lower + static_cast<unsigned>(d.below(share + 2))});
    if (d.chance(20)) p.bounds.back().second = static_cast<unsigned>(std::max(p.agents, std::size_t{lower}));
  }
  if (f.squares) p.bounds.assign(p.slots, {1, 1});
  p.part.assign(p.agents, 1);
  if (d.chance(40))
    for (auto& x : p.part) x = d.chance(90);
  return p;
}

/// An optimum: its total, and the lexicographically smallest assignment that has it (agents who take no part: −1).
struct optimum {
  std::int64_t total = 0;
  std::vector<int> slot;
};

/// Tries every assignment.
inline std::optional<optimum> enumerate(problem const& p) {
  std::optional<optimum> best;
  std::vector<int> x(p.agents);
  for (std::size_t a = 0; a < p.agents; ++a) x[a] = p.part[a] ? 0 : -1;
  for (;;) {
    bool valid = true;
    std::int64_t total = 0;
    std::vector<unsigned> count(p.slots, 0);
    for (std::size_t a = 0; a < p.agents && valid; ++a) {
      if (x[a] < 0) continue;
      auto const& u = p.at(a, static_cast<std::size_t>(x[a]));
      valid = u.has_value();
      total += u.value_or(0);
      ++count[static_cast<std::size_t>(x[a])];
    }
    for (std::size_t s = 0; s < p.slots && valid; ++s)
      valid = count[s] >= p.bounds[s].first && count[s] <= p.bounds[s].second;
    if (valid && (!best || total > best->total)) best = optimum{total, x};
    std::size_t a = p.agents;
    for (; a > 0; --a) {
      if (x[a - 1] < 0) continue;
      if (++x[a - 1] < static_cast<int>(p.slots)) break;
      x[a - 1] = 0;
    }
    if (a == 0) return best;
  }
}

/// The greatest total by GLPK, as a flow from agents through slots to a sink; nothing if there is none.
inline std::optional<std::int64_t> greatest_by_glpk(problem const& p) {
  struct node {
    double supply;
  };
  struct arc {
    double lower, upper, cost, flow;
  };
  glp_graph* const graph = glp_create_graph(sizeof(node), sizeof(arc));
  int const agents = static_cast<int>(p.agents);
  int const slots = static_cast<int>(p.slots);
  glp_add_vertices(graph, agents + slots + 1);
  auto const supply = [&](int v) -> double& { return static_cast<node*>(graph->v[v]->data)->supply; };
  auto const connect = [&](int from, int to, double lower, double upper, double cost) {
    *static_cast<arc*>(glp_add_arc(graph, from, to)->data) = {lower, upper, cost, 0};
  };
  for (int v = 1; v <= agents + slots + 1; ++v) supply(v) = 0;
  for (std::size_t a = 0; a < p.agents; ++a) {
    if (!p.part[a]) continue;
    supply(static_cast<int>(a) + 1) = 1;
    supply(agents + slots + 1) -= 1;
    for (std::size_t s = 0; s < p.slots; ++s)
      if (p.at(a, s))
        connect(static_cast<int>(a) + 1, agents + static_cast<int>(s) + 1, 0, 1, -static_cast<double>(*p.at(a, s)));
  }
  for (std::size_t s = 0; s < p.slots; ++s)
    connect(agents + static_cast<int>(s) + 1, agents + slots + 1, p.bounds[s].first, p.bounds[s].second, 0);
  double total = 0;
  int const end = glp_mincost_okalg(graph, offsetof(node, supply), offsetof(arc, lower), offsetof(arc, upper),
                                    offsetof(arc, cost), &total, offsetof(arc, flow), -1);
  glp_delete_graph(graph);
  if (end != 0) return std::nullopt;
  return -static_cast<std::int64_t>(total);
}

}  // namespace dense_world
