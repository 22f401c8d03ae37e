// The algorithm of Jonker and Volgenant (1987) for squares where everybody takes one slot and every slot one agent:
// column reduction, two rounds of augmenting row reduction, then shortest augmenting paths by dense Dijkstra; O(n³).
// Written by hand as a baseline, without tricks of its own. Set-up is copying the costs.

#include "additive.hpp"

#include <algorithm>
#include <limits>

namespace peers {
namespace {

class jonker_volgenant : public peer {
public:
  explicit jonker_volgenant(additive_instance const& in)
      : n_(in.agents),
        cost_(n_ * n_),
        price_(n_),
        slot_(n_),
        agent_(n_),
        free_(n_),
        before_(n_),
        columns_(n_),
        distance_(n_) {
    for (std::size_t i = 0; i < cost_.size(); ++i) cost_[i] = -in.utility[i];
  }

  bool solve() override {
    reduce_columns();
    for (int round = 0; round < 2; ++round) reduce_rows();
    for (std::size_t f = 0; f < free_.size(); ++f) augment(free_[f]);
    return true;
  }

  assignment answer() const override { return {slot_.begin(), slot_.end()}; }

private:
  using index = std::uint32_t;
  static constexpr index nobody = std::numeric_limits<index>::max();

  std::int64_t const* row(index i) const { return cost_.data() + i * n_; }

  /// Prices each slot at its least cost, and gives it to an agent for which that is the least if there is one without a slot.
  void reduce_columns() {
    std::copy_n(cost_.begin(), n_, price_.begin());
    std::vector<index>& cheapest = before_;
    std::fill(cheapest.begin(), cheapest.end(), index{0});
    for (index i = 1; i < n_; ++i)
      for (index j = 0; j < n_; ++j)
        if (row(i)[j] < price_[j]) price_[j] = row(i)[j], cheapest[j] = i;
    std::fill(slot_.begin(), slot_.end(), nobody);
    std::fill(agent_.begin(), agent_.end(), nobody);
    std::fill(columns_.begin(), columns_.end(), index{0});  // how many slots are cheapest for an agent
    for (index j = static_cast<index>(n_); j-- > 0;) {
      index const i = cheapest[j];
      if (columns_[i]++ == 0) slot_[i] = j, agent_[j] = i;
    }
    transfer_reduction();
  }

  /// Lowers the price of a slot by what its agent, if it has one slot only, would lose at least with another.
  void transfer_reduction() {
    free_.clear();
    for (index i = 0; i < n_; ++i) {
      if (slot_[i] == nobody) free_.push_back(i);
      if (columns_[i] != 1) continue;
      std::int64_t least = std::numeric_limits<std::int64_t>::max();
      for (index j = 0; j < n_; ++j)
        if (j != slot_[i]) least = std::min(least, row(i)[j] - price_[j]);
      if (n_ > 1) price_[slot_[i]] -= least - (row(i)[slot_[i]] - price_[slot_[i]]);
    }
  }

  /// Each agent without a slot takes its best, lowers its price until the second best is as good, and displaces.
  void reduce_rows() {
    std::size_t const agents = free_.size();
    std::size_t kept = 0;  // free_[0, kept) remain without a slot
    std::size_t steps = 0;
    for (std::size_t k = 0; k < agents;) {
      index const i = free_[k++];
      index best = 0;
      index second = nobody;
      std::int64_t least = row(i)[0] - price_[0];
      std::int64_t next = std::numeric_limits<std::int64_t>::max();
      for (index j = 1; j < n_; ++j) {
        std::int64_t const c = row(i)[j] - price_[j];
        if (c >= next) continue;
        if (c >= least) {
          next = c, second = j;
        } else {
          next = least, second = best;
          least = c, best = j;
        }
      }
      bool const cheaper = least < next && ++steps < k * n_;  // two agents might bid against each other for long
      if (cheaper) {
        price_[best] -= next - least;
      } else if (least == next && agent_[best] != nobody) {
        best = second;
      }
      index const owner = agent_[best];
      slot_[i] = best;
      agent_[best] = i;
      if (owner == nobody) continue;
      slot_[owner] = nobody;
      if (cheaper) {
        free_[--k] = owner;
      } else {
        free_[kept++] = owner;
      }
    }
    free_.resize(kept);
  }

  /// Dijkstra from an agent without a slot to a slot without an agent; columns_ holds slots done, at hand, and far.
  void augment(index start) {
    for (index j = 0; j < n_; ++j) {
      columns_[j] = j;
      distance_[j] = row(start)[j] - price_[j];
      before_[j] = start;
    }
    std::size_t done = 0;   // columns_[0, done) have been scanned
    std::size_t near = 0;   // columns_[done, near) are at distance `least`
    std::size_t ready = 0;  // columns_[0, ready) were nearer than `least`: their prices change
    std::int64_t least = 0;
    index end = nobody;
    while (end == nobody) {
      if (done == near) {
        ready = done;
        least = distance_[columns_[near]];
        for (std::size_t k = near; k < n_; ++k) {
          index const j = columns_[k];
          if (distance_[j] > least) continue;
          if (distance_[j] < least) near = done, least = distance_[j];
          columns_[k] = columns_[near];
          columns_[near++] = j;
        }
        for (std::size_t k = done; k < near && end == nobody; ++k)
          if (agent_[columns_[k]] == nobody) end = columns_[k];
        continue;
      }
      index const from = columns_[done++];
      index const i = agent_[from];
      std::int64_t const base = row(i)[from] - price_[from] - least;
      for (std::size_t k = near; k < n_; ++k) {
        index const j = columns_[k];
        std::int64_t const d = row(i)[j] - price_[j] - base;
        if (d >= distance_[j]) continue;
        distance_[j] = d;
        before_[j] = i;
        if (d > least) continue;
        if (agent_[j] == nobody) {
          end = j;
          break;
        }
        columns_[k] = columns_[near];
        columns_[near++] = j;
      }
    }
    for (std::size_t k = 0; k < ready; ++k) price_[columns_[k]] += distance_[columns_[k]] - least;
    for (index i = nobody; i != start;) {
      i = before_[end];
      agent_[end] = i;
      std::swap(end, slot_[i]);
    }
  }

  std::size_t n_;
  std::vector<std::int64_t> cost_;
  std::vector<std::int64_t> price_;
  std::vector<index> slot_;   // of an agent
  std::vector<index> agent_;  // of a slot
  std::vector<index> free_;
  std::vector<index> before_;
  std::vector<index> columns_;
  std::vector<std::int64_t> distance_;
};

effort of_squares(additive_instance const& in) {
  auto ones = [](std::vector<std::uint32_t> const& v) {
    return std::all_of(v.begin(), v.end(), [](std::uint32_t x) { return x == 1; });
  };
  bool const one_each = in.agents == in.slots() && ones(in.bounds.lower) && ones(in.bounds.upper);
  bool const all_pairs =
      std::none_of(in.utility.begin(), in.utility.end(), [](std::int64_t u) { return u == forbidden; });
  return one_each && all_pairs ? effort::quick : effort::never;
}

[[maybe_unused]] bool const added = add<jonker_volgenant>("jonker_volgenant", of_squares);

}  // namespace
}  // namespace peers
