#pragma once

#include <rota/dense/flow/detail/canonical.hpp>
#include <rota/dense/flow/detail/opening.hpp>
#include <rota/dense/flow/detail/slot_graph.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace rota::dense {

/// How an additive search ended.
enum class additive_end : unsigned char {
  optimal,      ///< the assignment is the canonical optimum
  interrupted,  ///< the limit was met: the assignment is within all bounds, and `bound` says how far from the optimum
  agent_stuck,  ///< `witness` is an agent: those that fit only into the slots it may reach are more than these bear
  slot_short    ///< `witness` is a slot: its lower bound cannot be filled together with the others'
};

/// What an additive search found, and its work.
struct additive_outcome {
  additive_end end{};
  std::size_t witness = 0;
  std::int64_t utility = 0;         ///< of the assignment
  std::int64_t bound = 0;           ///< no assignment is worth more
  std::uint64_t searches = 0;       ///< shortest-path searches
  std::uint64_t augmentations = 0;  ///< agents, or chains of agents, moved
  std::uint64_t relaxations = 0;    ///< arcs looked at: the steps of `work_limit`
  bool warm = false;                ///< began where the search before had ended

  [[nodiscard]] bool found() const noexcept { return end <= additive_end::interrupted; }
};

/// Finds the assignment of greatest total utility, exactly and in polynomial time; buffers are reused between calls.
///
/// Canonical: of all optima the lexicographically smallest vector (agent → slot) is returned. So the answer depends on the
/// instance only, and a warm search ends where a cold one would.
/// Certificate: `prices`. With p_k the price of slot k, for every assignment x within the bounds
///   Σ u(a, x_a) ≤ Σ_a max_k (u(a, k) − p_k) + Σ_k (p_k > 0 ? p_k·upper_k : p_k·lower_k),
/// and the optimum meets it. The bounds are those of `bounds()`: what the instance's imply for the number of agents.
///
/// Complexity: cold O(n·s) and E searches of O(s²), E at most n + the sum of the lower bounds and usually far less; warm
/// O(s) a changed row and as many searches as there are changed rows at most. O(n + s²) memory.
class additive_solver {
public:
  /// From nothing. @pre the preconditions of `instance`
  additive_outcome solve(instance const& in, work_limit const& limit = {}) {
    graph_.reset(in);
    return begin(in, limit);
  }

  /// From the assignment of the last search, where utilities or taking part have changed in rows `changed` only; bounds
  /// may have changed anyhow. Cold where there is nothing to begin with.
  /// @pre `changed` names each row that has changed, once
  additive_outcome resolve(instance const& in, std::span<row_index const> changed, work_limit const& limit = {}) {
    if (warm_ && graph_.adopt(in) && replace(in, changed) && !tighten(in)) {
      graph_.open_places(agents_);
      auto const out = finish(in, limit, true);
      if (out.found()) return out;
    }
    return solve(in, limit);  // so that the witness of a refusal does not depend on history either
  }

  /// The slot of each agent, `no_slot` for those who take no part. After an end that `found()` something.
  [[nodiscard]] std::span<slot const> assignment() const noexcept { return graph_.who().homes(); }
  /// The price of each slot, and of the sink, which is 0.
  [[nodiscard]] std::span<std::int64_t const> prices() const noexcept { return std::as_const(graph_).prices(); }
  /// Lower and upper bound of slot k, with what the other slots cannot take or must have.
  [[nodiscard]] slot_bounds bounds(std::size_t k) const noexcept { return graph_.bounds(k); }

private:
  using value = slot_graph::value;

  additive_outcome begin(instance const& in, work_limit const& limit) {
    ROTA_ASSERT(in.utility.size() == in.agents * in.slot_count());
    ROTA_ASSERT(in.taking_part.empty() || in.taking_part.size() == in.agents);
    warm_ = false;
    agents_ = 0;
    for (std::size_t a = 0; a < in.agents; ++a) agents_ += in.takes_part(a);
    if (auto const out = tighten(in)) return *out;
    if (in.slot_count() == 0) return {};
    if (!opening_.play(graph_, agents_, limit)) return refused(additive_end::agent_stuck, opening_.homeless());
    return finish(in, limit, false);
  }

  /// Puts the agents of changed rows where they are worth most now; false if one of them has no pair.
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

  [[nodiscard]] additive_outcome refused(additive_end why, std::size_t witness) const {
    additive_outcome out;
    out.end = why;
    out.witness = witness;
    return counted(out);
  }
  [[nodiscard]] additive_outcome counted(additive_outcome out) const {
    out.searches = graph_.done().searches;
    out.augmentations = graph_.done().augmentations;
    out.relaxations = graph_.done().relaxations;
    return out;
  }

  /// Bounds as the number of agents implies them: what other slots cannot take must come here, what they must have cannot.
  std::optional<additive_outcome> tighten(instance const& in) {
    value least = 0;
    value most = 0;
    for (auto const b : in.bounds) least += b.lower, most += b.upper;
    auto const n = static_cast<value>(agents_);
    if (n > most) return refused(additive_end::agent_stuck, first_taking_part(in));
    for (std::size_t k = 0; k < in.slot_count(); ++k) {
      auto const [lower, upper] = in.bounds[k];
      value const implied_upper = n - (least - value{lower});
      if (lower > upper || value{lower} > implied_upper) return refused(additive_end::slot_short, k);
      graph_.set_bounds(k, {static_cast<std::uint32_t>((std::max)(value{lower}, n - (most - value{upper}))),
                            static_cast<std::uint32_t>((std::min)(value{upper}, implied_upper))});
    }
    return std::nullopt;
  }
  [[nodiscard]] static std::size_t first_taking_part(instance const& in) {
    std::size_t a = 0;
    while (!in.takes_part(a)) ++a;
    return a;
  }

  additive_outcome finish(instance const& in, work_limit const& limit, bool warm) {
    auto flow = graph_.balance(limit);
    bool const close = graph_.normalise();
    if (flow == slot_graph::flow::interrupted) return hurry(in);
    if (!close) {  // prices have drifted apart in parts of the graph that hardly meet: once more, so that they cannot
      graph_.reset(in);
      if (auto const out = tighten(in)) return *out;
      for (row_index a = 0; a < in.agents; ++a)
        if (in.takes_part(a)) graph_.place(a);
      graph_.keep_ledgers();
      graph_.open_places(agents_);
      flow = graph_.balance(limit, false);
      graph_.normalise();
      if (flow == slot_graph::flow::interrupted) return hurry(in);
    }
    warm_ = true;
    if (flow == slot_graph::flow::stuck) return explain();
    if (!in.unique) canonical_.make(graph_);
    additive_outcome out;
    out.warm = warm;
    out.bound = out.utility = graph_.who().total();
    return counted(out);
  }

  /// No time left to balance: anything within the bounds, and how much more the prices leave room for.
  additive_outcome hurry(instance const& in) {
    warm_ = false;
    if (!graph_.fill_anyhow(agents_)) return explain();
    std::uint64_t gap = 0;
    auto const add = [&](value amount, std::uint64_t times) {  // at most what 64 bits hold; amounts are not negative
      auto const most = (std::numeric_limits<std::uint64_t>::max)();
      auto const x = static_cast<std::uint64_t>(amount);
      gap = x != 0 && times > (most - gap) / x ? most : gap + x * times;
    };
    auto const price = prices();
    for (std::size_t a = 0; a < in.agents; ++a) {
      auto const here = graph_.who().home(a);
      if (here == no_slot) continue;
      auto const best = kernel::best(in.row(a), price.data(), in.slot_count());
      add(in.at(a, best) - price[best] - (in.at(a, here) - price[here]), 1);
    }
    for (std::size_t k = 0; k < in.slot_count(); ++k)
      price[k] > 0 ? add(price[k], bounds(k).upper - graph_.who().count(k))
                   : add(-price[k], graph_.who().count(k) - bounds(k).lower);
    additive_outcome out;
    out.end = additive_end::interrupted;
    out.utility = graph_.who().total();
    auto const headroom =
        static_cast<std::uint64_t>((std::numeric_limits<value>::max)() - std::max<value>(out.utility, 0));
    out.bound = out.utility + static_cast<value>((std::min)(gap, headroom));
    return counted(out);
  }

  [[nodiscard]] additive_outcome explain() const {
    auto const stuck = graph_.stuck_at();
    if (stuck == graph_.sink()) {
      std::size_t k = 0;
      while (graph_.room(k) <= 0) ++k;
      return refused(additive_end::slot_short, k);
    }
    auto least = graph_.who().first(stuck);
    for (auto a = least; a != membership::nobody; a = graph_.who().next(a)) least = (std::min)(least, a);
    return refused(additive_end::agent_stuck, least);
  }

  slot_graph graph_;
  opening opening_;
  canonical_choice canonical_;
  std::size_t agents_ = 0;  // that take part
  bool warm_ = false;       // the graph is balanced, or was proved to have no balance
};

}  // namespace rota::dense
