#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/flow/solver.hpp>
#include <rota/dense/pairs/detail/branch.hpp>
#include <rota/dense/pairs/detail/local_search.hpp>
#include <rota/dense/pairs/detail/model.hpp>
#include <rota/dense/pairs/detail/plain_search.hpp>
#include <rota/dense/pairs/detail/price_table.hpp>
#include <rota/dense/pairs/detail/suffix_bounds.hpp>
#include <rota/dense/pairs/instance.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace rota::dense {

/// Finds the best assignment when utilities come in pairs, exactly; buffers are reused between calls.
///
/// Canonical: of all optima the lexicographically smallest vector (agent → slot) is returned, by the caller's numbers.
/// The same on every machine, compiler and run, and so is every number in the outcome.
/// Anytime: what a spent budget or `stop` leaves is the best valid assignment seen, and a proven bound.
///
/// How: what has at most eight agents and slots, and mostly ends soon, has a plain search with plain bounds
/// (`plain_search`). Otherwise an assignment is improved by local search (`local_search`); the tables are reparametrised
/// and rounded up to 16 bits, an agent per lane (`pair_model`); the last half of the agents, those coupled least, are
/// solved for all counts of agents per slot at once (`suffix_bounds`); and depth-first branch and bound
/// (`pair_branch`) adds to these what the unplaced get from the placed at best, slots having prices
/// (`price_table`). Ties are settled only where bounds do not exclude them.
///
/// Memory O(n²·m²), at most 45 MB (1 MB for n ≤ 20, m ≤ 8), and bounds by counts in tables of fixed size, at most 75 MB.
/// Recursion at most n + m deep.
class pair_solver {
public:
  /// How the work is divided. It changes no answer that is complete.
  pair_effort effort;

  /// Searches until the canonical optimum is proved, about `limit.steps` nodes have been tried, or `limit.stop` says so,
  /// which is asked every few hundred nodes, those of the plain search aside, and now and then before there are any.
  ///
  /// @pre the preconditions of `pair_instance`
  pair_outcome solve(pair_instance const& in, work_limit const& limit = {}, pair_observer* observer = nullptr) {
    detail::no_observer nobody;
    pair_outcome out = observer ? run(in, limit, *observer) : run(in, limit, nobody);
    if (out.found()) out.assignment = best_.assignment;
    for (auto const& t : tallies_) {
      out.work.leaves += t.leaves;
      out.work.pruned += t.by_bound + t.by_cardinality + t.by_absence + t.by_symmetry;
    }
    return out;
  }

  /// What became of all assignments, by the number of agents placed. Ties are settled afterwards, and do not count.
  [[nodiscard]] std::span<pair_tally const> account() const noexcept { return tallies_; }

private:
  template <class Observer>
  pair_outcome run(pair_instance const& in, work_limit const& limit, Observer& observer) {
    auto budget = limit.steps;
    stop_request const& stop = limit.stop;
    ROTA_ASSERT(in.agents <= max_pair_agents && in.slot_count() <= max_pair_slots);
    pair_outcome out;
    std::size_t const n = in.agents;
    best_ = {false, detail::pair_model::nothing, std::move(best_.assignment)};
    best_.assignment.assign(n, no_slot);
    tallies_.assign(n + 1, {});
    if (n == 0 || in.slot_count() == 0) return nothing_to_choose(in);
    if (detail::plain_search::suits(n, in.slot_count())) {
      auto const plainly = (std::min)(effort.plain_nodes, budget / 2);
      detail::no_observer nobody;
      std::int64_t value = 0;
      auto const found = small_.solve(in, plainly, best_.assignment, value, tallies_, nobody);
      out.work.nodes = small_.nodes();
      if (found) {
        if constexpr (!std::is_same_v<Observer,
                                      detail::no_observer>) {  // once more, to be heard: of what is given up it is not
          tallies_.assign(n + 1, {});
          (void)small_.solve(in, plainly, best_.assignment, value, tallies_, observer);
        }
        return proved(out, *found, value);
      }
      budget -= out.work.nodes;
      best_.assignment.assign(n, no_slot);
      tallies_.assign(n + 1, {});
    }
    if (!start(in, budget, stop)) {
      ++tallies_[0].by_cardinality;
      if constexpr (!std::is_same_v<Observer, detail::no_observer>)
        observer(std::span<slot const>(best_.assignment), pair_cut::cardinality, detail::pair_model::nothing);
      return proved(out, false, 0);
    }
    bound_suffixes(budget, stop);
    search_.prepare(model_, suffix_, prices_, lower_, upper_);
    std::uint64_t const spent = suffix_.work();
    std::uint64_t const left = budget - (std::min)(budget, spent);
    bool const exhausted = search_.run(best_, left, stop, observer);
    tallies_.assign(search_.account().begin(), search_.account().end());
    std::uint64_t const nodes = search_.nodes();
    bool settled = exhausted;
    if (exhausted && best_.found && search_.tied()) settled = search_.settle(best_, left, stop);
    out.work.nodes += spent + search_.nodes();
    out.tie_nodes = search_.nodes() - nodes;
    if (exhausted) {
      proved(out, best_.found, best_.value);
      if (!settled) out.status = status::feasible;  // the optimum, yet not the canonical one
      return out;
    }
    out.status = best_.found ? status::feasible : status::unknown;
    out.value = best_.found ? best_.value : 0;
    out.bound = (std::max)(best_.value, search_.open_bound());
    return out;
  }

  static pair_outcome& proved(pair_outcome& out, bool found, std::int64_t value) {
    out.status = found ? status::optimal : status::infeasible;
    out.value = found ? value : 0;
    out.bound = found ? value : no_value;
    return out;
  }

  pair_outcome nothing_to_choose(pair_instance const& in) {
    pair_outcome out;
    bool const found =
        in.agents == 0 && std::all_of(in.bounds.begin(), in.bounds.end(), [](slot_bounds b) { return b.lower == 0; });
    if (found)
      ++tallies_[0].leaves;
    else if (in.agents == 0)
      ++tallies_[0].by_cardinality;
    return proved(out, found, 0);
  }

  /// A first assignment, made better. @return false if the bounds of the slots cannot be met
  bool start(pair_instance const& in, std::uint64_t budget, stop_request const& stop) {
    std::size_t const n = in.agents;
    lower_.resize(in.slot_count());
    upper_.resize(in.slot_count());
    for (std::size_t s = 0; s < in.slot_count(); ++s) {
      lower_[s] = in.bounds[s].lower;
      upper_[s] = static_cast<std::uint32_t>(std::min<std::size_t>(in.bounds[s].upper, n));
    }
    model_.prepare(in, effort.symmetry);
    instance alone{n, model_.centred(), in.bounds};
    alone.unique = true;  // any optimum is a start as good
    auto const flow = alone_.solve(alone);
    if (!flow.found()) return false;
    std::copy(flow.assignment.begin(), flow.assignment.end(), best_.assignment.begin());
    std::size_t const rounds = static_cast<std::size_t>(std::min<std::uint64_t>(n, budget / n));
    best_.value = local_.improve(model_, in.bounds, best_.assignment, rounds, stop);
    best_.found = best_.value > detail::pair_model::nothing;
    if (!best_.found) best_.value = detail::pair_model::nothing;
    sort_twins();
    return true;
  }

  /// Interchangeable agents: the smaller number takes the smaller slot.
  void sort_twins() {
    std::size_t const n = best_.assignment.size();
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 1; b < n; ++b)
        if (model_.kind_of(a) == model_.kind_of(b) && best_.assignment[b] < best_.assignment[a])
          std::swap(best_.assignment[a], best_.assignment[b]);
  }

  void bound_suffixes(std::uint64_t budget, stop_request const& stop) {
    using detail::price_table;
    std::size_t const n = model_.agents();
    auto plan = detail::suffix_plan::fitting(n, upper_.size(), budget / 4);
    if (effort.exact_suffix != pair_effort::automatic) plan.enumerated = effort.exact_suffix;
    if (effort.bounded_suffix != pair_effort::automatic) plan.expanded = effort.bounded_suffix;
    if (upper_.size() > price_table::most_slots || !detail::count_space::fits(upper_.size(), n) ||
        price_table::number_of_finals(lower_, upper_, n) > price_table::most_finals(n))
      plan = {};
    suffix_.prepare(model_, upper_, plan, stop);
    if (suffix_.counted(n)) prices_.prepare(model_, suffix_, lower_, upper_);
  }

  detail::pair_best best_;
  buffer<pair_tally> tallies_;
  buffer<std::uint32_t> lower_;
  buffer<std::uint32_t> upper_;
  detail::plain_search small_;
  detail::pair_model model_;
  flow_solver alone_;
  detail::local_search local_;
  detail::suffix_bounds suffix_;
  detail::price_table prices_;
  detail::pair_branch search_;
};

}  // namespace rota::dense
