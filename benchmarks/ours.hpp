#pragma once

#include "peers/pairwise.hpp"

#include <rota/search/additive.hpp>
#include <rota/search/general.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
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
  bool solve() override { return solver().solve(instance_).end == rota::dense::additive_end::optimal; }
  peers::assignment answer() const override { return {solver().assignment().begin(), solver().assignment().end()}; }

private:
  static rota::dense::additive_solver& solver() {
    static rota::dense::additive_solver one;
    return one;
  }

  std::vector<rota::dense::slot_bounds> bounds_;
  rota::dense::instance instance_;
};

/// The tree search, with what the agents left could earn at best as its bound.
///
/// @pre the instance outlives it; `answer` is asked for before another instance is solved
class pairwise : public peers::peer, private rota::dense::tree_oracle {
public:
  explicit pairwise(peers::pairwise_instance const& in)
      : in_(in), bounds_(bounds_of(in.bounds)), instance_{in.agents, in.unary, bounds_}, rest_(in.agents + 1) {
    for (std::size_t a = in.agents; a-- > 0;) {
      auto const row = in.unary.begin() + static_cast<std::ptrdiff_t>(a * in.slots());
      rest_[a] = rest_[a + 1] + *std::max_element(row, row + static_cast<std::ptrdiff_t>(in.slots()));
      for (std::size_t b = 0; b < a; ++b) {
        auto const table = in.pairs.begin() + static_cast<std::ptrdiff_t>(in.table(a, b));
        rest_[a] += *std::max_element(table, table + static_cast<std::ptrdiff_t>(in.slots() * in.slots()));
      }
    }
  }
  /// Larger ones do not end in a second yet.
  static bool takes(peers::pairwise_instance const& in) { return in.agents <= 8; }
  bool solve() override {
    auto const out = solver().solve(instance_, *this, std::numeric_limits<std::uint64_t>::max());
    return out.found && out.complete;
  }
  peers::assignment answer() const override { return {solver().assignment().begin(), solver().assignment().end()}; }

private:
  using prefix = std::span<rota::dense::slot const>;

  static rota::dense::tree_solver& solver() {
    static rota::dense::tree_solver one;
    return one;
  }
  std::int64_t together(prefix p) const {
    std::int64_t sum = 0;
    for (std::size_t a = 1; a < p.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) sum += in_.pair(a, p[a], b, p[b]);
    return sum;
  }
  std::optional<std::int64_t> leaf(prefix all, std::int64_t sum, std::optional<std::int64_t>) override {
    return sum + together(all);
  }
  std::optional<std::int64_t> bound(prefix p, std::int64_t sum) override { return sum + together(p) + rest_[p.size()]; }

  peers::pairwise_instance const& in_;
  std::vector<rota::dense::slot_bounds> bounds_;
  rota::dense::instance instance_;
  std::vector<std::int64_t> rest_;  // what the agents from one on earn at most, alone and with those before them
};

}  // namespace ours
