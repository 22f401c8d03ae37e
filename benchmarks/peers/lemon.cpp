// LEMON's network simplex and cost scaling. Set-up is building the graph and handing over its maps; solving is run(),
// which initialises basis and potentials anew each time. C++17, since LEMON 1.3.1 is no C++20.

#include "network.hpp"

#include <lemon/cost_scaling.h>
#include <lemon/network_simplex.h>
#include <lemon/static_graph.h>

#include <limits>
#include <utility>

namespace peers {
namespace {

using graph = lemon::StaticDigraph;
using network_simplex = lemon::NetworkSimplex<graph, int, std::int64_t>;
using cost_scaling = lemon::CostScaling<graph, int, std::int64_t>;

/// @tparam Algorithm one of LEMON's, with its defaults: the block search pivot rule; partial augmentation by factor 16.
/// Of their other options none was faster at most sizes.
template <class Algorithm>
class lemon_peer : public peer {
public:
  /// @param pair_capacity of an arc from an agent, which carries at most one unit whatever this says
  lemon_peer(additive_instance const& in, int pair_capacity) : agents_(in.agents), net_(in), algorithm_(build()) {
    graph::ArcMap<std::int64_t> cost(graph_);
    graph::ArcMap<int> capacity(graph_);
    graph::NodeMap<int> supply(graph_);
    for (std::size_t e = 0; e < net_.arcs.size(); ++e) {
      auto const arc = graph_.arc(static_cast<int>(e));
      cost[arc] = net_.arcs[e].cost;
      capacity[arc] = e < net_.pairs ? pair_capacity : net_.arcs[e].capacity;
    }
    for (std::size_t v = 0; v < net_.supply.size(); ++v) supply[graph_.node(static_cast<int>(v))] = net_.supply[v];
    algorithm_.costMap(cost).upperMap(capacity).supplyMap(supply);
  }

  bool solve() override { return algorithm_.run() == Algorithm::OPTIMAL; }

  assignment answer() const override {
    return net_.read(agents_, [&](std::size_t e) { return algorithm_.flow(graph_.arc(static_cast<int>(e))) > 0; });
  }

private:
  graph const& build() {
    std::vector<std::pair<int, int>> ends;
    ends.reserve(net_.arcs.size());
    for (auto const& arc : net_.arcs) ends.emplace_back(arc.from, arc.to);
    graph_.build(static_cast<int>(net_.supply.size()), ends.begin(), ends.end());
    return graph_;
  }

  std::size_t agents_;
  network net_;
  graph graph_;
  Algorithm algorithm_;
};

/// Without capacities nothing has to pivot to a bound: 1.4 times as fast, but from about 100 slots on it is the reverse.
class lemon_network_simplex : public lemon_peer<network_simplex> {
public:
  explicit lemon_network_simplex(additive_instance const& in)
      : lemon_peer(in, in.slots() < 100 ? std::numeric_limits<int>::max() : 1) {}
};

class lemon_cost_scaling : public lemon_peer<cost_scaling> {
public:
  explicit lemon_cost_scaling(additive_instance const& in) : lemon_peer(in, 1) {}
};

effort of_simplex(additive_instance const& in) {
  return in.utility.size() <= 2'000'000 ? effort::quick : effort::never;
}
effort of_scaling(additive_instance const& in) {
  return in.utility.size() <= 100'000 ? effort::quick : of_simplex(in) == effort::never ? effort::never : effort::slow;
}
[[maybe_unused]] bool const added = add<lemon_network_simplex>("lemon_network_simplex", of_simplex) &&
                                    add<lemon_cost_scaling>("lemon_cost_scaling", of_scaling);

}  // namespace
}  // namespace peers
