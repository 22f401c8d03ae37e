#pragma once

#include <rota/core/assert.hpp>
#include <rota/core/size.hpp>
#include <rota/dense/buffer.hpp>
#include <rota/dense/flow/solver.hpp>
#include <rota/dense/pairs/detail/branch.hpp>
#include <rota/dense/pairs/detail/local_search.hpp>
#include <rota/dense/pairs/detail/model.hpp>
#include <rota/dense/pairs/detail/plain_search.hpp>
#include <rota/dense/pairs/detail/price_table.hpp>
#include <rota/dense/pairs/detail/suffix_bounds.hpp>
#include <rota/dense/pairs/solver.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace rota::dense {

namespace detail {

/// What `pair_solver` does and remembers.
class pair_search {
public:
  pair_outcome solve(pair_instance const& in, pair_effort const& effort, work_limit const& limit,
                     pair_observer* observer) {
    ROTA_ASSERT(in.agents <= max_pair_agents && in.slot_count() <= max_pair_slots);
    forget(in.agents);
    pair_outcome out;
    if (in.agents == 0 || in.slot_count() == 0)
      choose_nothing(in, out);
    else if (!search_plainly(in, effort, limit.steps, observer, out))
      search(in, effort, limit, observer, out);
    if (out.found()) out.assignment = best_.assignment;
    for (pair_tally const& t : tallies_) {
      out.work.leaves += t.leaves;
      out.work.pruned += t.by_bound + t.by_cardinality + t.by_absence + t.by_symmetry;
    }
    return out;
  }

  [[nodiscard]] std::span<pair_tally const> account() const noexcept { return tallies_; }

private:
  void forget(std::size_t agents) {
    best_.found = false;
    best_.value = pair_model::nothing;
    best_.assignment.assign(agents, no_slot);
    tallies_.assign(agents + 1, {});
  }

  static void prove(pair_outcome& out, bool found, std::int64_t value) {
    out.status = found ? status::optimal : status::infeasible;
    out.value = found ? value : 0;
    out.bound = found ? value : no_value;
  }

  void choose_nothing(pair_instance const& in, pair_outcome& out) {
    bool const found =
        in.agents == 0 && std::all_of(in.bounds.begin(), in.bounds.end(), [](slot_bounds b) { return b.lower == 0; });
    if (found)
      ++tallies_[0].leaves;
    else if (in.agents == 0)
      ++tallies_[0].by_cardinality;
    prove(out, found, 0);
  }

  /// @return false if the instance is too large for it, or it has given up
  bool search_plainly(pair_instance const& in, pair_effort const& effort, std::uint64_t budget, pair_observer* observer,
                      pair_outcome& out) {
    if (!plain_search::suits(in.agents, in.slot_count())) return false;
    std::uint64_t const limit = (std::min)(effort.plain_nodes, budget / 2);
    std::int64_t value = 0;
    auto const found = plain_.solve(in, limit, best_.assignment, value, tallies_, nullptr);
    out.work.nodes = plain_.nodes();
    if (!found) {
      forget(in.agents);
      return false;
    }
    if (observer != nullptr) {  // Only now, since it must not hear of a search that was given up.
      tallies_.assign(in.agents + 1, {});
      (void)plain_.solve(in, limit, best_.assignment, value, tallies_, observer);
    }
    prove(out, *found, value);
    return true;
  }

  /// @param out has the work done so far
  void search(pair_instance const& in, pair_effort const& effort, work_limit const& limit, pair_observer* observer,
              pair_outcome& out) {
    std::uint64_t const budget = limit.steps - out.work.nodes;
    if (!start(in, effort, budget, limit.stop)) {
      ++tallies_[0].by_cardinality;
      if (observer != nullptr) (*observer)(best_.assignment, pair_cut::cardinality, pair_model::nothing);
      return prove(out, false, 0);
    }
    bound_suffixes(effort, budget, limit.stop);
    branch_.prepare(model_, suffix_, prices_, lower_, upper_, observer);
    std::uint64_t const left = budget - (std::min)(budget, suffix_.work());
    bool const exhausted = branch_.run(best_, left, limit.stop);
    tallies_.assign(branch_.account().begin(), branch_.account().end());
    std::uint64_t const before_ties = branch_.nodes();
    bool settled = true;
    if (exhausted && best_.found && branch_.tied()) settled = branch_.settle(best_, left, limit.stop);
    out.work.nodes += suffix_.work() + branch_.nodes();
    out.tie_nodes = branch_.nodes() - before_ties;
    if (exhausted) {
      prove(out, best_.found, best_.value);
      if (!settled) out.status = status::feasible;  // an optimum, yet maybe not the canonical one
      return;
    }
    out.status = best_.found ? status::feasible : status::unknown;
    out.value = best_.found ? best_.value : 0;
    out.bound = (std::max)(best_.value, branch_.open_bound());
  }

  /// A first assignment, made better. @return false if the bounds of the slots cannot be met
  bool start(pair_instance const& in, pair_effort const& effort, std::uint64_t budget, stop_request const& stop) {
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
    std::size_t const rounds = rota::detail::to_size(std::min<std::uint64_t>(n, budget / n));
    best_.value = local_.improve(model_.values(), in.bounds, best_.assignment, rounds, stop);
    best_.found = best_.value > pair_model::nothing;
    if (!best_.found) best_.value = pair_model::nothing;
    sort_twins();
    return true;
  }

  /// Interchangeable agents: the smaller number takes the smaller slot.
  void sort_twins() {
    auto& x = best_.assignment;
    for (std::size_t a = 0; a < x.size(); ++a)
      for (std::size_t b = a + 1; b < x.size(); ++b)
        if (model_.values().kind_of(a) == model_.values().kind_of(b) && x[b] < x[a]) std::swap(x[a], x[b]);
  }

  void bound_suffixes(pair_effort const& effort, std::uint64_t budget, stop_request const& stop) {
    std::size_t const n = model_.agents();
    auto plan = suffix_plan::fitting(n, upper_.size(), budget / 4);
    if (effort.exact_suffix != pair_effort::automatic) plan.enumerated = effort.exact_suffix;
    if (effort.bounded_suffix != pair_effort::automatic) plan.expanded = effort.bounded_suffix;
    if (!price_table::suits(lower_, upper_, n)) plan = {};
    suffix_.prepare(model_, upper_, plan, stop);
    if (suffix_.counted(n)) prices_.prepare(model_, suffix_, lower_, upper_);
  }

  pair_best best_;
  buffer<pair_tally> tallies_;
  buffer<std::uint32_t> lower_;  // [slot]
  buffer<std::uint32_t> upper_;  // [slot]: at most the number of agents
  plain_search plain_;
  pair_model model_;
  flow_solver alone_;
  local_search local_;
  suffix_bounds suffix_;
  price_table prices_;
  pair_branch branch_;
};

}  // namespace detail

ROTA_INLINE pair_outcome pair_solver::solve(pair_instance const& in, work_limit const& limit, pair_observer* observer) {
  return search_.made().solve(in, effort, limit, observer);
}

ROTA_INLINE std::span<pair_tally const> pair_solver::account() const noexcept {
  auto const* const search = search_.get();
  return search != nullptr ? search->account() : std::span<pair_tally const>{};
}

}  // namespace rota::dense
