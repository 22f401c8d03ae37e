#pragma once

#include <rota/search/detail/plan_memory.hpp>
#include <rota/search/detail/plan_view.hpp>
#include <rota/search/detail/ratings.hpp>
#include <rota/search/solution.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace rota::detail {

/// Writes what U_p says of agents one by one, less change costs, into the matrix of a plan. Forbidden pairs are absent.
///
/// Rows that are as the memory holds them stay; `plan_memory::changed` lists the others.
template <vocabulary V, class Beliefs>
class utility_matrix {
public:
  /// @pre `write_bounds` has written the bounds of `memory`
  utility_matrix(plan_view<V, Beliefs> const& view, plan_memory& memory) : view_(view), memory_(memory) {}

  /// @return why the plan has no valid allocation, if the matrix shows it at once
  [[nodiscard]] std::optional<plan_refusal<V>> write() {
    auto const cost = weigh(1, view_.problem.change_cost);
    if (!cost || cost.value().units < 0) {
      auto r = refusal(no_plan_reason::change_cost_refused);
      r.fault = cost ? utility_fault::negative : cost.error();
      return r;
    }
    cost_ = cost.value().units;
    std::size_t const n = view_.agents();
    std::size_t const slot_count = view_.slot_count();
    auto& m = memory_;
    bool const anew = m.units.size() != n * slot_count || !m.seen;
    if (anew) {
      m.units.assign(n * slot_count, dense::absent);
      m.keys.resize(n * slot_count);
    }
    m.changed.clear();
    std::uint64_t greatest = 0;
    std::size_t greatest_at = 0;
    for (std::size_t a = 0; a < n; ++a)
      if (auto const magnitude = write_row(a); magnitude > greatest) greatest = magnitude, greatest_at = a;
    m.up_to_date = true;
    if (!m.changed.empty()) m.forget();
    if (!dense::fits(n, slot_count, greatest)) {
      m.forget();
      auto r = refusal(no_plan_reason::utilities_too_great);
      r.agent = view_.problem.participants[greatest_at];
      r.fault = utility_fault::out_of_range;
      return r;
    }
    write_keys(greatest, anew);
    return obstacle();
  }

  /// What a change costs, in units. Nothing if it is not a valid cost.
  [[nodiscard]] std::int64_t change_cost() const noexcept { return cost_; }
  /// The first term left out because it is no utility.
  [[nodiscard]] std::optional<utility_refusal<V>> const& ignored() const noexcept { return ignored_; }
  /// Terms left out as faulty are a likelier reason than the cardinalities.
  [[nodiscard]] std::optional<plan_refusal<V>> blame() const {
    if (!ignored_) return std::nullopt;
    return refusal_of(view_.plan.id(), *ignored_);
  }

private:
  [[nodiscard]] plan_refusal<V> refusal(no_plan_reason reason) const {
    plan_refusal<V> r;
    r.plan = view_.plan.id();
    r.reason = reason;
    return r;
  }

  /// One agent's utilities into its row, and notes it if that changes. @return the greatest magnitude, change cost included
  std::uint64_t write_row(std::size_t a) {
    auto const tasks = view_.plan.tasks();
    auto const who = view_.problem.participants[a];
    ROTA_ASSERT(a == 0 || view_.problem.participants[a - 1] < who);
    auto const* const role = view_.problem.members.role_of(who);
    auto const* const bounds = memory_.bounds.data();
    auto const now = view_.now()[a];
    auto* const row = memory_.units.data() + a * (tasks.size() + 1);
    std::uint64_t greatest = 0;
    bool changed = false;
    auto const write = [&](std::size_t s, std::int64_t units) {
      changed |= row[s] != units;
      row[s] = units;
    };
    auto const offer = [&, cost = cost_](std::size_t s, std::int64_t units) {
      // With the cost, so that sums fit both with and without it: what an agent gains by moving may be all its cost.
      auto const magnitude = units < 0 ? 0 - static_cast<std::uint64_t>(units) : static_cast<std::uint64_t>(units);
      greatest = (std::max)(greatest, magnitude + static_cast<std::uint64_t>(cost));
      bool const beyond = magnitude > static_cast<std::uint64_t>(dense::max_total);  // then the plan is refused
      write(s, beyond ? dense::absent : s != now ? units - cost : units);
    };
    for (std::size_t s = 0; s < tasks.size(); ++s) {
      if (role == nullptr || bounds[s].upper == 0 || !role->permits(tasks[s].task)) {
        write(s, dense::absent);
        continue;
      }
      in<V> const x{who, view_.plan.id(), tasks[s].task};
      if (auto const units = rate(view_.problem, view_.plan, x)) {
        offer(s, units.value().units);
      } else {
        write(s, dense::absent);
        if (units.error() != utility_fault::forbidden_pair && !ignored_)
          ignored_ = utility_refusal<V>{units.error(), x, std::nullopt};
      }
    }
    if (bounds[tasks.size()].upper > 0)
      offer(tasks.size(), 0);
    else
      write(tasks.size(), dense::absent);
    if (changed) memory_.changed.push_back(static_cast<dense::row_index>(a));
    return greatest;
  }

  /// Breaks the ties of the rows that changed, or of all if the rule has changed. @pre `dense::fits`
  void write_keys(std::uint64_t greatest, bool anew) {
    auto& m = memory_;
    std::size_t const n = view_.agents();
    std::size_t const slot_count = view_.slot_count();
    dense::tie_rule const ties(n, slot_count, greatest);
    bool const all = anew || !(ties == m.ties);
    m.ties = ties;
    if (all) {
      m.changed.resize(n);
      for (std::size_t a = 0; a < n; ++a) m.changed[a] = static_cast<dense::row_index>(a);
      m.forget();
    }
    for (auto const a : m.changed) ties.keys(a, m.units.data() + a * slot_count, m.keys.data() + a * slot_count);
  }

  /// A task that too few agents may do, or an agent that may do nothing.
  [[nodiscard]] std::optional<plan_refusal<V>> obstacle() const {
    std::size_t const n = view_.agents();
    std::size_t const slot_count = view_.slot_count();
    for (std::size_t s = 0; s + 1 < slot_count; ++s) {
      if (memory_.bounds[s].lower == 0) continue;
      std::size_t able = 0;
      for (std::size_t a = 0; a < n; ++a) able += memory_.units[a * slot_count + s] != dense::absent;
      if (able >= memory_.bounds[s].lower) continue;
      if (auto const fault = blame()) return fault;
      auto r = refusal(no_plan_reason::task_short);
      r.task = view_.plan.tasks()[s].task;
      r.count = able;
      r.bounds = view_.plan.tasks()[s].bounds;
      return r;
    }
    for (std::size_t a = 0; a < n; ++a) {
      std::span<std::int64_t const> const row{memory_.units.data() + a * slot_count, slot_count};
      if (std::any_of(row.begin(), row.end(), [](auto u) { return u != dense::absent; })) continue;
      if (auto const fault = blame()) return fault;
      auto r = refusal(no_plan_reason::agent_without_task);
      r.agent = view_.problem.participants[a];
      return r;
    }
    return std::nullopt;
  }

  plan_view<V, Beliefs> const& view_;
  plan_memory& memory_;
  std::int64_t cost_ = 0;
  std::optional<utility_refusal<V>> ignored_{};
};

}  // namespace rota::detail
