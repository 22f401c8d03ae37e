#pragma once

#include <rota/search/detail/plan_memory.hpp>
#include <rota/search/detail/plan_view.hpp>
#include <rota/search/solution.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace rota::detail {

/// Writes the cardinalities and the team size of a plan as bounds of its slots: the team size bounds the idle slot from the
/// other side. @return why no number of agents fits, if none does
template <vocabulary V, class Beliefs>
[[nodiscard]] std::optional<plan_refusal<V>> write_bounds(plan_view<V, Beliefs> const& view, plan_memory& memory) {
  constexpr std::uint64_t unlimited = std::uint64_t{1} << 40;
  auto const refuse = [&](no_plan_reason reason, std::uint64_t count, cardinality bounds) {
    plan_refusal<V> r;
    r.plan = view.plan.id();
    r.reason = reason;
    r.count = count;
    r.bounds = bounds;
    return r;
  };
  auto const clip = [](std::uint64_t n) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(n, cardinality::unbounded - 1));
  };
  std::size_t const n = view.agents();
  auto const tasks = view.plan.tasks();
  std::uint64_t least = 0;
  std::uint64_t most = 0;
  for (plan_task<V> const& t : tasks) {
    least += t.bounds.lower();
    most += t.bounds.is_bounded() ? t.bounds.upper() : unlimited;
  }
  cardinality const size = view.plan.team_size();
  std::uint64_t const size_max = size.is_bounded() ? size.upper() : unlimited;
  if (least > size_max) return refuse(no_plan_reason::contradictory_cardinalities, least, size);
  if (most < size.lower()) return refuse(no_plan_reason::contradictory_cardinalities, most, size);
  std::uint64_t const needed = std::max<std::uint64_t>(least, size.lower());
  if (n < needed) return refuse(no_plan_reason::too_few_agents, n, {clip(needed), cardinality::unbounded});
  std::uint64_t const room = (std::min)(most, size_max);
  bool const may_idle = view.problem.idle == idling::allowed;
  if (!may_idle && n > room) return refuse(no_plan_reason::too_many_agents, n, {0, clip(room)});

  if (memory.bounds.size() != view.slot_count()) memory.bounds.assign(view.slot_count(), {~0u, ~0u});
  auto const set = [&](std::size_t s, std::uint64_t lower, std::uint64_t upper) {
    dense::slot_bounds const b{static_cast<std::uint32_t>(lower), static_cast<std::uint32_t>(upper)};
    if (memory.bounds[s] == b) return;
    memory.bounds[s] = b;
    memory.outdate();
  };
  for (std::size_t s = 0; s < tasks.size(); ++s) {
    auto const& b = tasks[s].bounds;
    set(s, b.lower(), std::min<std::uint64_t>(b.is_bounded() ? b.upper() : unlimited, n));
  }
  set(view.idle(), n - std::min<std::uint64_t>(n, size_max), may_idle ? n - size.lower() : 0);
  return std::nullopt;
}

}  // namespace rota::detail
