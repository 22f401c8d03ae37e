#pragma once

#include <rota/dense/flow/detail/canonical.hpp>
#include <rota/dense/flow/detail/hasty_fill.hpp>
#include <rota/dense/flow/detail/opening.hpp>
#include <rota/dense/flow/detail/slot_graph.hpp>
#include <rota/dense/flow/solver.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace rota::dense {

namespace detail {

/// What `flow_solver` does and remembers.
class flow_search {
public:
  flow_outcome solve(instance const& in, work_limit const& limit) {
    graph_.reset(in);
    return begin(in, limit);
  }

  flow_outcome resolve(instance const& in, std::span<row_index const> changed, work_limit const& limit) {
    flow_outcome out;
    if (warm_ && graph_.adopt(in) && replace(in, changed) && tighten(in).obstacle == flow_obstacle::none) {
      graph_.open_places(agents_);
      out = finish(in, limit, true);
    }
    if (!out.found()) out = solve(in, limit);  // so the witness of a refusal does not depend on history either
    out.work.changed_rows = changed.size();
    return out;
  }

  [[nodiscard]] slot_graph const& graph() const noexcept { return graph_; }

private:
  using value = slot_graph::value;

  flow_outcome begin(instance const& in, work_limit const& limit) {
    ROTA_ASSERT(in.utility.size() == in.agents * in.slot_count());
    ROTA_ASSERT(in.taking_part.empty() || in.taking_part.size() == in.agents);
    warm_ = false;
    agents_ = 0;
    for (std::size_t a = 0; a < in.agents; ++a) agents_ += in.takes_part(a);
    if (auto const w = tighten(in); w.obstacle != flow_obstacle::none) return refused(w);
    if (in.slot_count() == 0) return placed(status::optimal, 0, 0, false);
    if (!opening_.play(graph_, agents_, limit)) return refused({flow_obstacle::agent_stuck, opening_.homeless()});
    return finish(in, limit, false);
  }

  /// Puts the agents of changed rows into their best slots; false if all pairs of one of them are forbidden.
  bool replace(instance const& in, std::span<row_index const> changed) {
    for (auto const a : changed) {
      if (graph_.who().home(a) != no_slot) {
        graph_.take(a);
        --agents_;
      }
      if (!in.takes_part(a)) continue;
      if (!graph_.place(a)) return false;
      ++agents_;
    }
    return true;
  }

  /// Why there is no assignment, and of what this is true.
  struct obstruction {
    flow_obstacle obstacle = flow_obstacle::none;
    std::size_t witness = 0;
  };
  [[nodiscard]] flow_outcome refused(obstruction why) const {
    auto out = counted();
    out.status = status::infeasible;
    out.bound = no_value;
    out.obstacle = why.obstacle;
    out.witness = why.witness;
    return out;
  }
  [[nodiscard]] flow_outcome placed(status how, value worth, value bound, bool warm) const {
    auto out = counted();
    out.status = how;
    out.assignment = graph_.who().homes();
    out.value = worth;
    out.bound = bound;
    out.warm = warm;
    return out;
  }
  /// An outcome that says so far only what was done.
  [[nodiscard]] flow_outcome counted() const {
    flow_outcome out;
    out.work.searches = graph_.done().searches;
    out.work.augmentations = graph_.done().augmentations;
    out.work.relaxations = graph_.done().relaxations;
    return out;
  }

  /// Sets the bounds that the number of agents implies: a slot must take the agents that the others cannot, and cannot take
  /// those that the others need. @return an obstruction if they contradict each other
  obstruction tighten(instance const& in) {
    value least = 0;
    value most = 0;
    for (auto const b : in.bounds) least += b.lower, most += b.upper;
    auto const n = static_cast<value>(agents_);
    if (n > most) return {flow_obstacle::agent_stuck, first_taking_part(in)};
    for (std::size_t k = 0; k < in.slot_count(); ++k) {
      auto const [lower, upper] = in.bounds[k];
      value const implied_upper = n - (least - value{lower});
      if (lower > upper || value{lower} > implied_upper) return {flow_obstacle::slot_short, k};
      graph_.set_bounds(k, {static_cast<std::uint32_t>((std::max)(value{lower}, n - (most - value{upper}))),
                            static_cast<std::uint32_t>((std::min)(value{upper}, implied_upper))});
    }
    return {};
  }
  [[nodiscard]] static std::size_t first_taking_part(instance const& in) {
    std::size_t a = 0;
    while (!in.takes_part(a)) ++a;
    return a;
  }

  flow_outcome finish(instance const& in, work_limit const& limit, bool warm) {
    auto flow = graph_.balance(limit);
    bool const close = graph_.normalise();
    if (flow == slot_graph::flow::interrupted) return hurry(in);
    if (!close) {  // prices drifted apart in parts of the graph that hardly meet: narrow searches from 0 do not let them
      graph_.clear();
      std::fill(graph_.prices().begin(), graph_.prices().end(), 0);
      for (row_index a = 0; a < in.agents; ++a)
        if (in.takes_part(a)) graph_.place(a);
      graph_.keep_ledgers();
      graph_.open_places(agents_);
      flow = graph_.balance(limit, false);
      graph_.normalise();
      if (flow == slot_graph::flow::interrupted) return hurry(in);
    }
    if (flow == slot_graph::flow::stuck) {
      warm_ = true;
      return explain(graph_.stuck_at());
    }
    return optimum(in, warm);
  }
  /// @pre the graph is balanced
  flow_outcome optimum(instance const& in, bool warm) {
    warm_ = true;
    if (!in.unique) canonical_.make(graph_);
    auto const total = graph_.who().total();
    return placed(status::optimal, total, total, warm);
  }

  /// The limit was met: any assignment within the bounds, and by how much the certificate exceeds it.
  flow_outcome hurry(instance const& in) {
    warm_ = false;
    if (!hasty_fill_.play(graph_, agents_)) return explain(hasty_fill_.stuck_at());
    std::uint64_t gap = 0;
    auto const add = [&](value amount, std::uint64_t times) {  // saturates; amounts are not negative
      auto const most = (std::numeric_limits<std::uint64_t>::max)();
      auto const x = static_cast<std::uint64_t>(amount);
      gap = x != 0 && times > (most - gap) / x ? most : gap + x * times;
    };
    auto const price = std::as_const(graph_).prices();
    for (std::size_t a = 0; a < in.agents; ++a) {
      auto const here = graph_.who().home(a);
      if (here == no_slot) continue;
      auto const best = kernel::best(in.row(a), price.data(), in.slot_count());
      add(in.at(a, best) - price[best] - (in.at(a, here) - price[here]), 1);
    }
    for (std::size_t k = 0; k < in.slot_count(); ++k)
      price[k] > 0 ? add(price[k], graph_.bounds(k).upper - graph_.who().count(k))
                   : add(-price[k], graph_.who().count(k) - graph_.bounds(k).lower);
    if (gap == 0) return optimum(in, false);
    auto const total = graph_.who().total();
    auto const headroom = static_cast<std::uint64_t>(no_bound - (std::max)(total, value{0}));
    return placed(status::feasible, total, total + static_cast<value>((std::min)(gap, headroom)), false);
  }

  /// @param stuck a node with an excess that nothing can take
  [[nodiscard]] flow_outcome explain(std::size_t stuck) const {
    if (stuck == graph_.sink()) {
      std::size_t k = 0;
      while (graph_.room(k) <= 0) ++k;
      return refused({flow_obstacle::slot_short, k});
    }
    auto least = graph_.who().first(stuck);
    for (auto a = least; a != membership::nobody; a = graph_.who().next(a)) least = (std::min)(least, a);
    return refused({flow_obstacle::agent_stuck, least});
  }

  slot_graph graph_;
  opening opening_;
  canonical_choice canonical_;
  hasty_fill hasty_fill_;
  std::size_t agents_ = 0;  // that take part
  bool warm_ = false;       // the graph is balanced, or was proved to have no balance
};

}  // namespace detail

ROTA_INLINE flow_outcome flow_solver::solve(instance const& in, work_limit const& limit) {
  return search_.made().solve(in, limit);
}

ROTA_INLINE flow_outcome flow_solver::resolve(instance const& in, std::span<row_index const> changed,
                                              work_limit const& limit) {
  return search_.made().resolve(in, changed, limit);
}

ROTA_INLINE std::span<std::int64_t const> flow_solver::prices() const noexcept {
  auto const* const search = search_.get();
  return search != nullptr ? search->graph().prices() : std::span<std::int64_t const>{};
}

ROTA_INLINE slot_bounds flow_solver::bounds(std::size_t k) const noexcept {
  ROTA_ASSERT(search_.get() != nullptr);
  return search_.get()->graph().bounds(k);
}

ROTA_INLINE std::int64_t flow_solver::most(std::span<std::int64_t const> row) const noexcept {
  auto const price = prices();
  ROTA_ASSERT(!row.empty() && row.size() + 1 == price.size());
  auto const best = detail::kernel::best(row.data(), price.data(), row.size());
  return row[best] - price[best];
}

}  // namespace rota::dense
