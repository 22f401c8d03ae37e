#pragma once

#include <rota/model/allocation.hpp>
#include <rota/model/cardinality.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace rota {

/// For teams whose utilities and preconditions read no beliefs.
struct no_beliefs {
  friend bool operator==(no_beliefs, no_beliefs) = default;
};

/// One task of a plan: its cardinality ξ(p, τ), and the state in which an agent that takes it on begins.
template <vocabulary V = runtime_vocabulary>
struct plan_task {
  typename V::task task{};
  cardinality bounds;
  typename V::state entry{};

  friend bool operator==(plan_task const&, plan_task const&) = default;
};

/// What a precondition or a utility may read of an allocation: its atoms, ascending by agent.
template <vocabulary V = runtime_vocabulary>
using allocation_view = std::span<in<V> const>;

/// When Pre(p) must hold.
enum class precondition_scope : bool {
  always,     ///< as long as the plan runs: Def. 1, the default
  entry_only  ///< only when a team that is not executing the plan adopts it
};

/// Pre(p), read over the beliefs and a complete allocation. An empty function holds always.
template <vocabulary V, class Beliefs>
using precondition = std::function<bool(Beliefs const&, allocation_view<V>)>;

/// U_p as a sum over agents: the utility of one agent on one task; an idle agent counts 0. `nullopt` forbids the pair.
///
/// Must return finite numbers of magnitude at most `max_utility`; what it returns for a pair must not depend on the
/// allocation.
template <vocabulary V, class Beliefs>
using additive_utility = std::function<std::optional<double>(typename V::agent, typename V::task, Beliefs const&)>;

/// U_p as any function of the beliefs and a complete allocation.
///
/// `bound`, if given, must be at least the value of every complete allocation that extends the given partial one by
/// tasks for the undecided agents (the others are decided, idle if they have no atom); it lets the search prune.
template <vocabulary V, class Beliefs>
struct general_utility {
  std::function<double(Beliefs const&, allocation_view<V>)> value;
  std::function<double(Beliefs const&, allocation_view<V>, std::span<typename V::agent const> undecided)> bound;
};

template <vocabulary V, class Beliefs>
using utility = std::variant<additive_utility<V, Beliefs>, general_utility<V, Beliefs>>;

/// Refusal: what is wrong with the description of a plan.
template <vocabulary V>
struct plan_defect {
  enum class kind : unsigned char {
    repeated_task,         ///< `task` is listed twice
    no_task,               ///< Tasks(p) is empty
    missing_utility,       ///< the utility holds no function
    threshold_not_finite,  ///< hysteresis is negative, NaN or infinite
  };
  kind what{};
  typename V::task task{};

  friend bool operator==(plan_defect const&, plan_defect const&) = default;
};

/// What a plan is made from; see `plan`.
template <vocabulary V, class Beliefs>
struct plan_description {
  typename V::plan plan{};
  std::vector<plan_task<V>> tasks;
  rota::utility<V, Beliefs> utility;
  rota::precondition<V, Beliefs> precondition{};
  precondition_scope scope = precondition_scope::always;
  cardinality team_size{};  ///< how many agents the plan needs and bears in all
  double hysteresis = 0;    ///< gain in utility below which a running allocation stays (ALICA's utilityThreshold)
};

/// A plan p: a non-empty set of tasks with cardinalities, a precondition Pre(p) and a utility U_p. Immutable.
///
/// Class invariant: tasks strictly ascending and at least one, a callable utility, a finite hysteresis ≥ 0.
template <vocabulary V = runtime_vocabulary, class Beliefs = no_beliefs>
class plan {
public:
  using description = plan_description<V, Beliefs>;

  /// The plan, or the first defect of its description. O(t log t).
  [[nodiscard]] static result<plan, plan_defect<V>> make(description d) {
    using kind = typename plan_defect<V>::kind;
    if (d.tasks.empty()) return refused{plan_defect<V>{kind::no_task, {}}};
    std::sort(d.tasks.begin(), d.tasks.end(), [](auto const& a, auto const& b) { return a.task < b.task; });
    auto const twice = std::adjacent_find(d.tasks.begin(), d.tasks.end(),
                                          [](auto const& a, auto const& b) { return a.task == b.task; });
    if (twice != d.tasks.end()) return refused{plan_defect<V>{kind::repeated_task, twice->task}};
    bool const callable = std::visit(
        [](auto const& u) {
          if constexpr (requires { u.value; })
            return static_cast<bool>(u.value);
          else
            return static_cast<bool>(u);
        },
        d.utility);
    if (!callable) return refused{plan_defect<V>{kind::missing_utility, {}}};
    if (!(d.hysteresis >= 0) || !std::isfinite(d.hysteresis))
      return refused{plan_defect<V>{kind::threshold_not_finite, {}}};
    return plan{std::move(d)};
  }

  [[nodiscard]] typename V::plan id() const noexcept { return d_.plan; }
  /// Tasks(p), ascending.
  [[nodiscard]] std::span<plan_task<V> const> tasks() const noexcept { return d_.tasks; }
  /// The entry of one task, or nullptr if τ ∉ Tasks(p). O(log t).
  [[nodiscard]] plan_task<V> const* find(typename V::task t) const {
    auto const where = std::lower_bound(d_.tasks.begin(), d_.tasks.end(), t,
                                        [](auto const& entry, auto const& key) { return entry.task < key; });
    return where != d_.tasks.end() && where->task == t ? &*where : nullptr;
  }
  [[nodiscard]] rota::utility<V, Beliefs> const& utility() const noexcept { return d_.utility; }
  [[nodiscard]] rota::precondition<V, Beliefs> const& precondition() const noexcept { return d_.precondition; }
  [[nodiscard]] precondition_scope scope() const noexcept { return d_.scope; }
  [[nodiscard]] cardinality team_size() const noexcept { return d_.team_size; }
  [[nodiscard]] double hysteresis() const noexcept { return d_.hysteresis; }

private:
  explicit plan(description d) : d_(std::move(d)) {}

  description d_;
};

}  // namespace rota
