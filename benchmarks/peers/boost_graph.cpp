// Boost.Graph's successive shortest paths, on a compressed graph. Set-up is building that graph; solving is the call,
// which fills the residual capacities anew. Its cycle cancelling took eight times as long at 50x10, and is left out.

#include "network.hpp"

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/successive_shortest_path_nonnegative_weights.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace peers {
namespace {

class boost_shortest_path : public peer {
public:
  explicit boost_shortest_path(additive_instance const& in) : agents_(in.agents), net_(in) {
    auto const halves = directed();
    auto const nodes = net_.supply.size() + 2;
    std::vector<std::pair<index, index>> ends;
    for (half const& h : halves) ends.emplace_back(h.from, h.to);
    graph_.emplace(boost::edges_are_sorted, ends.begin(), ends.end(), static_cast<index>(nodes));

    std::vector<edge> edges;
    for (auto [e, end] = boost::edges(*graph_); e != end; ++e) edges.push_back(*e);
    place_.resize(halves.size());
    for (std::size_t i = 0; i < halves.size(); ++i) place_[halves[i].twice] = i;
    for (half const& h : halves) {
      capacity_.push_back(h.capacity);
      weight_.push_back(h.cost);
      reverse_.push_back(edges[place_[h.twice ^ 1]]);
    }
    residual_.resize(halves.size());
    before_.resize(nodes);
    distance_.resize(nodes);
    potential_.resize(nodes);
  }

  bool solve() override {
    auto const id = get(boost::vertex_index, *graph_);
    auto const number = get(boost::edge_index, *graph_);
    auto of_edges = [&](auto& v) { return boost::make_iterator_property_map(v.begin(), number); };
    auto of_nodes = [&](auto& v) { return boost::make_iterator_property_map(v.begin(), id); };
    boost::successive_shortest_path_nonnegative_weights(*graph_, source(), sink(), of_edges(capacity_),
                                                        of_edges(residual_), of_edges(weight_), of_edges(reverse_), id,
                                                        of_nodes(before_), of_nodes(distance_), of_nodes(potential_));
    for (std::size_t i = 0; i < twins(); ++i)
      if (residual_[place_[2 * (net_.arcs.size() + i)]] != 0) return false;
    return true;
  }

  assignment answer() const override {
    return net_.read(agents_, [&](std::size_t e) { return residual_[place_[2 * e]] == 0; });
  }

private:
  using index = std::uint32_t;
  using graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                                   boost::no_property, index, index>;
  using edge = graph::edge_descriptor;

  /// An arc of the residual graph: `twice` is 2e for arc e and 2e + 1 for its reverse.
  struct half {
    index from;
    index to;
    int capacity;
    std::int64_t cost;
    std::size_t twice;
  };

  index source() const { return static_cast<index>(net_.supply.size()); }
  index sink() const { return source() + 1; }
  std::size_t twins() const {
    return static_cast<std::size_t>(
        std::count_if(net_.supply.begin(), net_.supply.end(), [](int s) { return s != 0; }));
  }

  /// The arcs of the network, then one per supply and demand, and the reverse of each; by the node they start from.
  std::vector<half> directed() const {
    std::vector<half> all;
    auto both = [&](index from, index to, int capacity, std::int64_t cost) {
      all.push_back({from, to, capacity, cost, all.size()});
      all.push_back({to, from, 0, -cost, all.size()});
    };
    for (auto const& arc : net_.arcs)
      both(static_cast<index>(arc.from), static_cast<index>(arc.to), arc.capacity, arc.cost);
    for (index v = 0; v < net_.supply.size(); ++v) {
      if (net_.supply[v] > 0) both(source(), v, net_.supply[v], 0);
      if (net_.supply[v] < 0) both(v, sink(), -net_.supply[v], 0);
    }
    std::stable_sort(all.begin(), all.end(), [](half const& x, half const& y) { return x.from < y.from; });
    return all;
  }

  std::size_t agents_;
  network net_;
  std::optional<graph> graph_;
  std::vector<std::size_t> place_;  // where the edges of an arc are
  std::vector<int> capacity_;
  std::vector<int> residual_;
  std::vector<std::int64_t> weight_;
  std::vector<edge> reverse_;
  std::vector<edge> before_;
  std::vector<std::int64_t> distance_;
  std::vector<std::int64_t> potential_;
};

effort of_paths(additive_instance const& in) {
  auto const pairs = in.utility.size();
  return pairs <= 10'000 ? effort::quick : pairs <= 100'000 ? effort::slow : effort::never;
}
[[maybe_unused]] bool const added = add<boost_shortest_path>("boost_shortest_path", of_paths);

}  // namespace
}  // namespace peers
