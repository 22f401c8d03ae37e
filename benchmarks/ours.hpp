#pragma once

#include "peers/pairwise.hpp"

#include <rota/dense/flow/solver.hpp>
#include <rota/dense/pairs/solver.hpp>
#include <rota/dense/ties.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// rota behind the interface of the peers, so that one loop times and checks both.
namespace ours {

inline std::vector<rota::dense::slot_bounds> bounds_of(peers::cardinalities const& c) {
  std::vector<rota::dense::slot_bounds> bounds;
  for (std::size_t s = 0; s < c.slots(); ++s) bounds.push_back({c.lower[s], c.upper[s]});
  return bounds;
}

/// The additive solver, whose buffers all instances share as in a steady loop.
///
/// @pre the instance outlives it; `answer` is asked for before another instance is solved
class additive : public peers::peer {
public:
  explicit additive(peers::additive_instance const& in)
      : bounds_(bounds_of(in.bounds)), instance_{in.agents, in.utility, bounds_} {
    static_assert(peers::forbidden == rota::dense::absent);
  }
  static bool takes(peers::additive_instance const&) { return true; }
  bool solve() override {
    auto const found = solver().solve(instance_);
    assignment_ = found.assignment;
    return found.status == rota::dense::status::optimal;
  }
  peers::assignment answer() const override { return {assignment_.begin(), assignment_.end()}; }

private:
  static rota::dense::flow_solver& solver() {
    static rota::dense::flow_solver one;
    return one;
  }

  std::vector<rota::dense::slot_bounds> bounds_;

protected:
  rota::dense::instance instance_;
  std::span<rota::dense::slot const> assignment_;
};

/// The same, content with any optimum where there are several.
class any_optimum : public additive {
public:
  explicit any_optimum(peers::additive_instance const& in) : additive(in) { instance_.unique = true; }
};

/// The same on keys that decide ties, which are part of the set-up: how `best_allocation` uses it.
class keyed : public additive {
public:
  explicit keyed(peers::additive_instance const& in) : additive(in), keys_(in.utility.size()) {
    std::uint64_t greatest = 0;
    for (auto const u : in.utility)
      if (u != peers::forbidden) greatest = std::max(greatest, static_cast<std::uint64_t>(u < 0 ? -u : u));
    rota::dense::tie_rule const ties(in.agents, in.slots(), greatest);
    for (std::size_t a = 0; a < in.agents; ++a)
      ties.keys(a, in.utility.data() + a * in.slots(), keys_.data() + a * in.slots());
    instance_.utility = keys_;
    instance_.unique = ties.unique();
  }

private:
  std::vector<std::int64_t> keys_;
};

inline std::vector<rota::dense::coupling> couplings_of(peers::pairwise_instance const& in) {
  std::vector<rota::dense::coupling> all;
  for (std::uint32_t a = 1; a < in.agents; ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      all.push_back({a, b, std::span{in.pairs}.subspan(in.table(a, b), in.slots() * in.slots())});
  return all;
}

/// The pairwise solver, whose buffers all instances share as in a steady loop.
///
/// @pre the instance outlives it; `answer` is asked for before another instance is solved
class pairwise : public peers::peer {
public:
  explicit pairwise(peers::pairwise_instance const& in)
      : bounds_(bounds_of(in.bounds)),
        couplings_(couplings_of(in)),
        instance_{in.agents, in.unary, couplings_, bounds_} {}
  static bool takes(peers::pairwise_instance const&) { return true; }
  bool solve() override {
    auto const found = solver().solve(instance_);
    assignment_ = found.assignment;
    return found.status == rota::dense::status::optimal;
  }
  peers::assignment answer() const override { return {assignment_.begin(), assignment_.end()}; }

private:
  static rota::dense::pair_solver& solver() {
    static rota::dense::pair_solver one;
    return one;
  }

  std::vector<rota::dense::slot_bounds> bounds_;
  std::vector<rota::dense::coupling> couplings_;
  rota::dense::pair_instance instance_;
  std::span<rota::dense::slot const> assignment_;
};

}  // namespace ours
