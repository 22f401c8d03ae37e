#pragma once

#include <rota/search/solution.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace rota::detail {

/// The search for the best allocation of one plan: translates it into a dense instance and picks the solver.
///
/// Leaves the assignment in `workspace.candidate`.
template <vocabulary V, class Beliefs>
class plan_search final : private dense::tree_oracle {
public:
  using agent = typename V::agent;
  struct outcome {
    std::optional<fixed_utility> utility;  ///< of the best valid allocation; otherwise see `refusal`
    bool optimal = false;
    plan_refusal<V> refusal{};
  };

  plan_search(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p, bool running, workspace& w)
      : problem_(problem),
        plan_(p),
        work_(w),
        precondition_(p.precondition() && !(running && p.scope() == precondition_scope::entry_only)),
        additive_(std::get_if<additive_utility<V, Beliefs>>(&p.utility())),
        general_(std::get_if<general_utility<V, Beliefs>>(&p.utility())) {}

  outcome run(search_budget budget, search_work& done) {
    if (!set_bounds() || !set_pairs()) return refuse();
    dense::instance const in{problem_.participants.size(), work_.utility, work_.bounds};
    auto const first = work_.additive.solve(in);
    done.augmentations += first.augmentations;
    done.relaxations += first.relaxations;
    if (!first.found()) {
      explain(first);
      return refuse();
    }
    if (additive_ != nullptr) {
      if (first.utility < 0) return negative(first.utility);
      auto const assignment = work_.additive.assignment();
      if (!precondition_ || leaf(assignment, first.utility, {})) return accept(assignment, first.utility, true);
      set_suffix(in);
    }
    auto const tree = additive_ != nullptr ? work_.tree.solve(in, *this, budget.nodes, first.utility)
                                           : work_.tree.solve(in, *this, budget.nodes);
    done.nodes += tree.nodes;
    if (tree.found && tree.value >= 0) return accept(work_.tree.assignment(), tree.value, tree.complete);
    if (!tree.complete) return refuse(no_plan_reason::search_incomplete);
    if (tree.found) return negative(tree.value);
    if (general_fault_) {
      refusal_.fault = *general_fault_;
      return refuse(no_plan_reason::utility_refused);
    }
    return refuse(precondition_threw_ ? no_plan_reason::precondition_threw : no_plan_reason::precondition_never_holds);
  }

  /// The first thing that is no utility.
  [[nodiscard]] std::optional<utility_refusal<V>> ignored() const {
    if (ignored_) return ignored_;
    if (general_fault_) return utility_refusal<V>{*general_fault_, {}};
    return std::nullopt;
  }

private:
  outcome refuse() {
    refusal_.plan = plan_.id();
    return {std::nullopt, false, refusal_};
  }
  outcome refuse(no_plan_reason why) {
    refusal_.why = why;
    return refuse();
  }
  outcome negative(std::int64_t units) {
    refusal_.value = to_double({units});
    return refuse(no_plan_reason::negative_utility);
  }
  outcome accept(std::span<dense::slot const> assignment, std::int64_t units, bool optimal) {
    work_.candidate.assign(assignment.begin(), assignment.end());
    return {fixed_utility{units}, optimal, {}};
  }
  bool fail(no_plan_reason why, std::size_t count, cardinality bounds) {
    refusal_.why = why;
    refusal_.count = count;
    refusal_.bounds = bounds;
    return false;
  }

  /// Cardinalities and team size as slot bounds; the team size bounds the idle slot from the other side.
  bool set_bounds() {
    std::size_t const n = problem_.participants.size();
    std::uint64_t least = 0;
    std::uint64_t most = 0;
    work_.bounds.clear();
    for (plan_task<V> const& t : plan_.tasks()) {
      auto const upper = std::min<std::uint64_t>(t.bounds.is_bounded() ? t.bounds.max() : unlimited, n);
      least += t.bounds.min();
      most += t.bounds.is_bounded() ? t.bounds.max() : unlimited;
      work_.bounds.push_back({t.bounds.min(), static_cast<std::uint32_t>(upper)});
    }
    cardinality const size = plan_.team_size();
    std::uint64_t const size_max = size.is_bounded() ? size.max() : unlimited;
    if (least > size_max) return fail(no_plan_reason::contradictory_cardinalities, least, size);
    if (most < size.min()) return fail(no_plan_reason::contradictory_cardinalities, most, size);
    std::uint64_t const needed = std::max<std::uint64_t>(least, size.min());
    if (n < needed) return fail(no_plan_reason::too_few_agents, n, {clip(needed), cardinality::unbounded});
    std::uint64_t const room = std::min(most, size_max);
    if (problem_.idle == idling::forbidden && n > room)
      return fail(no_plan_reason::too_many_agents, n, {0, clip(room)});
    bool const may_idle = problem_.idle == idling::allowed;
    work_.bounds.push_back({static_cast<std::uint32_t>(n - std::min<std::uint64_t>(n, size_max)),
                            static_cast<std::uint32_t>(may_idle ? n - size.min() : 0)});
    return true;
  }

  /// The utility matrix, with forbidden pairs absent.
  bool set_pairs() {
    auto const tasks = plan_.tasks();
    std::size_t const n = problem_.participants.size();
    std::size_t const slots = tasks.size() + 1;
    bool const may_idle = work_.bounds[tasks.size()].upper > 0;
    work_.utility.assign(n * slots, dense::absent);
    std::uint64_t greatest = 0;
    for (std::size_t a = 0; a < n; ++a) {
      agent const who = problem_.participants[a];
      ROTA_ASSERT(a == 0 || problem_.participants[a - 1] < who);
      auto const* const r = problem_.members.role_of(who);
      for (std::size_t s = 0; s < tasks.size() && r != nullptr; ++s) {
        if (work_.bounds[s].upper == 0 || !r->permits(tasks[s].task)) continue;
        std::int64_t units = 0;
        if (additive_ != nullptr && !rate(who, tasks[s].task, units)) continue;
        work_.utility[a * slots + s] = units;
        auto const magnitude = static_cast<std::uint64_t>(units < 0 ? -units : units);
        if (magnitude <= greatest) continue;
        greatest = magnitude;
        refusal_.agent = who;
        refusal_.task = tasks[s].task;
      }
      if (may_idle) work_.utility[a * slots + tasks.size()] = 0;
    }
    if (!dense::fits(n, slots, greatest)) {
      refusal_.fault = utility_fault::out_of_range;
      refusal_.why = no_plan_reason::utility_refused;
      return false;
    }
    refusal_.agent = {};
    refusal_.task = {};
    return every_task_served(n, slots) && every_agent_served(n, slots);
  }

  bool rate(agent who, typename V::task t, std::int64_t& units) {
    auto const term = term_of<V, Beliefs>(*additive_, who, t, problem_.beliefs);
    if (term) {
      units = term.value().units;
      return true;
    }
    if (term.error() != utility_fault::forbidden_pair && !ignored_)
      ignored_ = utility_refusal<V>{term.error(), in<V>{who, plan_.id(), t}};
    return false;
  }

  bool every_task_served(std::size_t n, std::size_t slots) {
    for (std::size_t s = 0; s + 1 < slots; ++s) {
      if (work_.bounds[s].lower == 0) continue;
      std::size_t able = 0;
      for (std::size_t a = 0; a < n; ++a) able += work_.utility[a * slots + s] != dense::absent;
      if (able >= work_.bounds[s].lower) continue;
      if (blame_utility()) return false;
      refusal_.task = plan_.tasks()[s].task;
      return fail(no_plan_reason::task_short, able, plan_.tasks()[s].bounds);
    }
    return true;
  }

  bool every_agent_served(std::size_t n, std::size_t slots) {
    for (std::size_t a = 0; a < n; ++a) {
      auto const row = work_.utility.begin() + static_cast<std::ptrdiff_t>(a * slots);
      if (std::any_of(row, row + static_cast<std::ptrdiff_t>(slots), [](auto u) { return u != dense::absent; }))
        continue;
      if (blame_utility()) return false;
      refusal_.agent = problem_.participants[a];
      refusal_.why = no_plan_reason::agent_without_task;
      return false;
    }
    return true;
  }

  /// Where pairs were left out as faulty, that is the likelier reason than the cardinalities.
  bool blame_utility() {
    if (!ignored_) return false;
    refusal_.why = no_plan_reason::utility_refused;
    refusal_.fault = ignored_->why;
    refusal_.agent = ignored_->atom->agent;
    refusal_.task = ignored_->atom->task;
    return true;
  }

  void explain(dense::additive_outcome const& o) {
    if (blame_utility()) return;
    refusal_.why = no_plan_reason::pairs_contradict;
    if (o.end == dense::additive_end::agent_stuck) {
      refusal_.agent = problem_.participants[o.witness];
    } else if (o.witness < plan_.tasks().size()) {
      refusal_.task = plan_.tasks()[o.witness].task;
    }
  }

  void set_suffix(dense::instance const& in) {
    work_.suffix.assign(in.agents + 1, 0);
    for (std::size_t a = in.agents; a-- > 0;) {
      std::int64_t most = dense::absent;
      for (std::size_t s = 0; s < in.slots(); ++s) most = std::max(most, in.at(a, s));
      work_.suffix[a] = work_.suffix[a + 1] + most;
    }
  }

  allocation_view<V> decode(std::span<dense::slot const> assignment) {
    atoms_.clear();
    for (std::size_t a = 0; a < assignment.size(); ++a)
      if (assignment[a] < plan_.tasks().size())
        atoms_.push_back({problem_.participants[a], plan_.id(), plan_.tasks()[assignment[a]].task});
    return {atoms_.data(), atoms_.size()};
  }

  std::optional<std::int64_t> leaf(std::span<dense::slot const> assignment, std::int64_t sum,
                                   std::optional<std::int64_t> to_beat) override {
    if (additive_ != nullptr && to_beat && sum <= *to_beat) return std::nullopt;
    auto const view = decode(assignment);
    if (precondition_) {
      auto const holds = guarded([&] { return plan_.precondition()(problem_.beliefs, view); });
      if (!holds) precondition_threw_ = true;
      if (!holds || !*holds) return std::nullopt;
    }
    if (additive_ != nullptr) return sum;
    auto const value = value_of<V, Beliefs>(*general_, problem_.beliefs, view);
    if (value) return value.value().units;
    if (!general_fault_) general_fault_ = value.error();
    return std::nullopt;
  }

  std::optional<std::int64_t> bound(std::span<dense::slot const> prefix, std::int64_t sum) override {
    if (additive_ != nullptr) return sum + work_.suffix[prefix.size()];
    if (!general_->bound) return std::nullopt;
    auto const view = decode(prefix);
    auto const rest = problem_.participants.subspan(prefix.size());
    auto const b = guarded([&] { return general_->bound(problem_.beliefs, view, rest); });
    if (!b) return std::nullopt;
    auto const fixed = quantise(*b);  // rounding is monotone, so it is still a bound
    if (fixed) return fixed.value().units;
    // Below the range nothing is admissible; above it, or for NaN, the bound says nothing.
    if (*b < 0) return std::numeric_limits<std::int64_t>::min();
    return std::nullopt;
  }

  static constexpr std::uint64_t unlimited = std::uint64_t{1} << 40;
  static constexpr std::uint32_t clip(std::uint64_t n) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(n, cardinality::unbounded - 1));
  }

  problem<V, Beliefs> const& problem_;
  plan<V, Beliefs> const& plan_;
  workspace& work_;
  bool precondition_;
  additive_utility<V, Beliefs> const* additive_;
  general_utility<V, Beliefs> const* general_;
  plan_refusal<V> refusal_{};
  std::optional<utility_refusal<V>> ignored_{};
  std::optional<utility_fault> general_fault_{};
  bool precondition_threw_ = false;
  small_vector<in<V>, 8> atoms_;
};

}  // namespace rota::detail
