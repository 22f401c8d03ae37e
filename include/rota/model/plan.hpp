#pragma once

#include <rota/model/allocation.hpp>
#include <rota/model/cardinality.hpp>
#include <rota/model/parts.hpp>
#include <rota/model/utility.hpp>

#include <algorithm>
#include <concepts>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace rota {

namespace detail {

/// Stands for an entry state that was not given.
struct missing {};

// Functions of their own, so that compilers name both types.

template <class Given, class Wanted>
constexpr void check_task() {
  static_assert(std::is_convertible_v<Given, Wanted>, "plan_task::task is not of the vocabulary's task type");
}
template <class Given, class Wanted>
constexpr void check_entry() {
  static_assert(!std::is_same_v<Given, missing>,
                "plan_task::entry is missing: write {task, {min, max}, state}, with the state that an agent begins in");
  static_assert(std::is_same_v<Given, missing> || std::is_convertible_v<Given, Wanted>,
                "plan_task::entry is not of the vocabulary's state type");
}

}  // namespace detail

/// For teams whose utilities and preconditions read no beliefs.
struct no_beliefs {
  friend bool operator==(no_beliefs, no_beliefs) = default;
};

/// One task of a plan: its cardinality ξ(p, τ), and the state in which an agent begins the task.
template <vocabulary V = runtime_vocabulary>
struct plan_task {
  typename V::task task;
  cardinality bounds;
  typename V::state entry;

  constexpr plan_task(typename V::task t, cardinality c, typename V::state z) : task(t), bounds(c), entry(z) {}

  // What people write instead, so that the compiler says what is wrong with it.

  template <class Task>
  constexpr plan_task(Task const& t, cardinality c) : plan_task(t, c, detail::missing{}) {}
  template <class Task, class State>
    requires(!std::convertible_to<Task, typename V::task> || !std::convertible_to<State, typename V::state>)
  constexpr plan_task(Task const&, cardinality c, State const&) : plan_task({}, c, {}) {
    detail::check_task<Task, typename V::task>();
    detail::check_entry<State, typename V::state>();
  }

  friend bool operator==(plan_task const&, plan_task const&) = default;
};

/// When Pre(p) must hold.
enum class precondition_scope : bool {
  always,     ///< as long as the plan runs: Def. 1, the default
  entry_only  ///< when a team adopts the plan, but not while it runs
};

/// Pre(p), a condition on the beliefs and a complete allocation. An empty function always holds.
template <vocabulary V, class Beliefs>
using precondition = detail::function<bool(Beliefs const&, allocation_view<V>)>;

/// What a partial allocation can say about Pre(p).
enum class possibility : unsigned char {
  no,       ///< it holds on no completion
  perhaps,  ///< unknown
  certain   ///< it holds on every completion
};

/// Judges Pre(p) on a partial allocation, so that a search can skip what can no longer hold. Agents that are not `undecided`
/// have their task, or idle.
template <vocabulary V, class Beliefs>
using precondition_outlook =
    detail::function<possibility(Beliefs const&, allocation_view<V>, std::span<typename V::agent const> undecided)>;

/// Refusal: what is wrong with the description of a plan.
template <vocabulary V>
struct plan_defect {
  enum class kind : unsigned char {
    repeated_task,         ///< `task` is listed twice
    no_task,               ///< Tasks(p) is empty
    missing_utility,       ///< the utility, or a part of it, holds no function
    weight_not_finite,     ///< a weight is NaN or infinite
    threshold_not_finite,  ///< hysteresis is negative, NaN or infinite
    empty_cardinality,     ///< the `bounds` of `task` have min > max
    empty_team_size,       ///< the team size `bounds` has min > max
  };
  kind what{};
  typename V::task task{};
  cardinality bounds{};

  friend bool operator==(plan_defect const&, plan_defect const&) = default;
};

/// The refusal in words, without names: `result` prints it where a refused plan is taken for a plan.
template <vocabulary V>
[[nodiscard]] constexpr char const* reason_of(plan_defect<V> const& d) noexcept {
  using kind = typename plan_defect<V>::kind;
  switch (d.what) {
  case kind::repeated_task: return "repeated_task: a task is listed twice";
  case kind::no_task: return "no_task: the plan has no task";
  case kind::missing_utility: return "missing_utility: the utility, or a part of it, is missing";
  case kind::weight_not_finite: return "weight_not_finite: a weight of the utility is not a finite number";
  case kind::threshold_not_finite: return "threshold_not_finite: the hysteresis is negative or not a finite number";
  case kind::empty_cardinality: return "empty_cardinality: a task wants more agents than it may have";
  case kind::empty_team_size: return "empty_team_size: the plan wants more agents than it may have";
  }
  return "?";
}

/// What a plan is made from. The utility may be a plain callable: `.utility = [](agent a, task t, Beliefs const& b) { … }`.
template <vocabulary V, class Beliefs>
struct plan_description {
  typename V::plan plan{};
  std::vector<plan_task<V>> tasks;
  rota::utility<V, Beliefs> utility;
  rota::precondition<V, Beliefs> precondition{};
  precondition_outlook<V, Beliefs> outlook{};  ///< optional; must agree with `precondition`
  precondition_scope scope = precondition_scope::always;
  cardinality team_size{};  ///< how many agents may have a task of the plan, in all
  double hysteresis = 0;    ///< a running allocation stays unless another gains more (ALICA's utilityThreshold)
};

/// A plan p: a non-empty set of tasks with cardinalities, a precondition Pre(p) and a utility U_p. Immutable.
///
/// Class invariant: tasks strictly ascending and at least one, no bounds empty, a callable utility, a finite hysteresis ≥ 0.
template <vocabulary V = runtime_vocabulary, class Beliefs = no_beliefs>
class plan {
public:
  using description = plan_description<V, Beliefs>;

  /// The plan, or the first defect of its description. O(t log t).
  [[nodiscard]] static result<plan, plan_defect<V>> make(description d) {
    using kind = typename plan_defect<V>::kind;
    if (d.tasks.empty()) return refused{plan_defect<V>{kind::no_task}};
    std::sort(d.tasks.begin(), d.tasks.end(), [](auto const& a, auto const& b) { return a.task < b.task; });
    auto const twice = std::adjacent_find(d.tasks.begin(), d.tasks.end(),
                                          [](auto const& a, auto const& b) { return a.task == b.task; });
    if (twice != d.tasks.end()) return refused{plan_defect<V>{kind::repeated_task, twice->task}};
    for (plan_task<V> const& t : d.tasks)
      if (t.bounds.is_empty()) return refused{plan_defect<V>{kind::empty_cardinality, t.task, t.bounds}};
    if (d.team_size.is_empty()) return refused{plan_defect<V>{kind::empty_team_size, {}, d.team_size}};
    if (!detail::callable(d.utility)) return refused{plan_defect<V>{kind::missing_utility}};
    if (!detail::weights_are_finite(d.utility)) return refused{plan_defect<V>{kind::weight_not_finite}};
    if (!detail::is_finite(d.hysteresis) || d.hysteresis < 0)
      return refused{plan_defect<V>{kind::threshold_not_finite}};
    return plan{std::move(d)};
  }

  [[nodiscard]] typename V::plan id() const noexcept { return d_.plan; }
  /// Tasks(p), ascending.
  [[nodiscard]] std::span<plan_task<V> const> tasks() const noexcept { return d_.tasks; }
  /// One task, or nullptr if τ ∉ Tasks(p). O(log t).
  [[nodiscard]] plan_task<V> const* find(typename V::task t) const {
    auto const where = std::lower_bound(d_.tasks.begin(), d_.tasks.end(), t,
                                        [](auto const& entry, auto const& key) { return entry.task < key; });
    return where != d_.tasks.end() && where->task == t ? &*where : nullptr;
  }
  [[nodiscard]] rota::utility<V, Beliefs> const& utility() const noexcept { return d_.utility; }
  [[nodiscard]] rota::precondition<V, Beliefs> const& precondition() const noexcept { return d_.precondition; }
  [[nodiscard]] precondition_outlook<V, Beliefs> const& outlook() const noexcept { return d_.outlook; }
  [[nodiscard]] precondition_scope scope() const noexcept { return d_.scope; }
  [[nodiscard]] cardinality team_size() const noexcept { return d_.team_size; }
  [[nodiscard]] double hysteresis() const noexcept { return d_.hysteresis; }

private:
  explicit plan(description d) : d_(std::move(d)) {}

  description d_;
};

}  // namespace rota
