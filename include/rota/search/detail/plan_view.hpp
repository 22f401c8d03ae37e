#pragma once

#include <rota/allocation/utility.hpp>
#include <rota/core/small_vector.hpp>
#include <rota/dense/buffer.hpp>
#include <rota/dense/instance.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

namespace rota::detail {

/// One plan of a problem as the solvers see it: row a is participant number a, slot s is task number s of the plan, and the
/// last slot is idling.
template <vocabulary V, class Beliefs>
class plan_view {
public:
  using agent = typename V::agent;
  using atom_type = in<V>;

  /// `now` is a buffer to use.
  plan_view(rota::problem<V, Beliefs> const& p, rota::plan<V, Beliefs> const& candidate,
            dense::buffer<dense::slot>& now)
      : problem(p), plan(candidate), now_(now) {
    now.assign(agents(), idle());
    auto atom = problem.current.begin();
    auto const end = problem.current.end();
    for (std::size_t a = 0; a < agents(); ++a) {
      while (atom != end && atom->agent < problem.participants[a]) ++atom;
      if (atom != end && atom->agent == problem.participants[a]) now[a] = slot_of(*atom);
    }
    bool const runs = std::any_of(problem.current.begin(), problem.current.end(),
                                  [&](in<V> const& x) { return x.plan == plan.id(); });
    conditional_ = plan.precondition() && !(runs && plan.scope() == precondition_scope::entry_only);
    for_each_part<V, Beliefs>(plan.utility(), [&](double, auto const& part) {
      using part_type = std::remove_cvref_t<decltype(part)>;
      general_ |= std::same_as<part_type, general_utility<V, Beliefs>>;
      pairwise_ |= std::same_as<part_type, pairwise_utility<V, Beliefs>>;
    });
  }

  rota::problem<V, Beliefs> const& problem;
  rota::plan<V, Beliefs> const& plan;

  [[nodiscard]] std::size_t agents() const noexcept { return problem.participants.size(); }
  [[nodiscard]] std::size_t slot_count() const noexcept { return plan.tasks().size() + 1; }
  [[nodiscard]] dense::slot idle() const noexcept { return static_cast<dense::slot>(plan.tasks().size()); }
  [[nodiscard]] in<V> atom(std::size_t a, std::size_t s) const {
    return {problem.participants[a], plan.id(), plan.tasks()[s].task};
  }

  /// The slot of each agent in the running allocation; `no_slot` for those that execute another plan.
  [[nodiscard]] std::span<dense::slot const> now() const noexcept { return {now_.data(), now_.size()}; }
  /// How many agents would do something else than now.
  [[nodiscard]] std::size_t changes(std::span<dense::slot const> assignment) const {
    std::size_t count = 0;
    for (std::size_t a = 0; a < assignment.size(); ++a) count += assignment[a] != now_[a];
    return count;
  }

  /// Whether Pre(p) is asked.
  [[nodiscard]] bool conditional() const noexcept { return conditional_; }
  /// Whether some part of U_p reads two agents at a time.
  [[nodiscard]] bool pairwise() const noexcept { return pairwise_; }
  /// Whether some part of U_p reads the whole allocation.
  [[nodiscard]] bool general() const noexcept { return general_; }
  /// Whether U_p is more than a sum over agents.
  [[nodiscard]] bool coupled() const noexcept { return pairwise_ || general_; }

  /// The atoms of an assignment, or of its first agents; valid until the next call.
  [[nodiscard]] allocation_view<V> atoms(std::span<dense::slot const> assignment) {
    auto const tasks = plan.tasks();
    auto const* who = problem.participants.data();
    atoms_.clear();
    atoms_.append(assignment.size(), [&, id = plan.id()](in<V>* out) {
      for (auto const s : assignment) {
        if (s < tasks.size()) *out++ = {*who, id, tasks[s].task};
        ++who;
      }
      return out;
    });
    return {atoms_.data(), atoms_.size()};
  }
  /// The agents that an assignment of the first `decided` agents leaves open.
  [[nodiscard]] std::span<agent const> undecided(std::size_t decided) const {
    return problem.participants.subspan(decided);
  }

private:
  [[nodiscard]] dense::slot slot_of(in<V> const& x) const {
    if (!(x.plan == plan.id())) return dense::no_slot;
    auto const* const task = plan.find(x.task);
    return task == nullptr ? dense::no_slot : static_cast<dense::slot>(task - plan.tasks().data());
  }

  dense::buffer<dense::slot>& now_;
  bool conditional_ = false;
  bool general_ = false;
  bool pairwise_ = false;
  small_vector<in<V>, 8> atoms_;
};

}  // namespace rota::detail
