#pragma once

#include <rota/dense/instance.hpp>
#include <rota/dense/outcome.hpp>
#include <rota/search/solution.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace rota::detail {

/// What the search of one plan found. Values are in units.
template <vocabulary V>
struct plan_outcome {
  /// Of the best valid allocation found. A solver owns it, and overwrites it in its next search.
  std::span<dense::slot const> assignment{};
  std::optional<fixed_utility> utility{};  ///< U_p of it; none if nothing was found: then see `refusal`
  std::int64_t objective = 0;              ///< U_p less change costs
  std::int64_t bound = dense::no_bound;    ///< proven: no valid allocation of the plan has a greater objective
  bool proved = false;                     ///< it is the canonical optimum, or no allocation is valid
  std::size_t changes = 0;
  plan_refusal<V> refusal{};
  std::optional<utility_refusal<V>> ignored{};
  std::optional<bound_lie<V>> lie{};
};

/// Proved: no allocation of the plan is valid.
template <vocabulary V>
[[nodiscard]] plan_outcome<V> nothing_valid(plan_refusal<V> const& reason) {
  plan_outcome<V> out;
  out.refusal = reason;
  out.bound = dense::no_value;
  out.proved = true;
  return out;
}

/// Nothing valid was found, but `bound` leaves room for it.
template <vocabulary V>
[[nodiscard]] plan_outcome<V> nothing_found(plan_refusal<V> const& reason, std::int64_t bound = dense::no_bound) {
  plan_outcome<V> out;
  out.refusal = reason;
  out.bound = bound;
  return out;
}

/// A refusal for a reason that needs no witness.
template <vocabulary V>
[[nodiscard]] plan_refusal<V> refusal_of(typename V::plan p, no_plan_reason reason) {
  plan_refusal<V> r;
  r.plan = p;
  r.reason = reason;
  return r;
}

/// The plan needs a utility that is none.
template <vocabulary V>
[[nodiscard]] plan_refusal<V> refusal_of(typename V::plan p, utility_refusal<V> const& fault) {
  auto r = refusal_of<V>(p, no_plan_reason::utility_refused);
  r.fault = fault.reason;
  if (fault.atom) r.about_atom = true, r.agent = fault.atom->agent, r.task = fault.atom->task;
  if (fault.other) r.about_pair = true, r.other = *fault.other;
  return r;
}

/// U_p is at most so much, which is below 0, on every allocation.
template <vocabulary V>
[[nodiscard]] plan_refusal<V> negative_refusal(typename V::plan p, std::int64_t units) {
  auto r = refusal_of<V>(p, no_plan_reason::negative_utility);
  r.value = to_double({units});
  return r;
}

}  // namespace rota::detail
