#pragma once

#include <rota/core/small_vector.hpp>
#include <rota/dense/buffer.hpp>
#include <rota/search/detail/plan_outcome.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace rota::detail {

/// The best allocation over the plans searched so far, and what is proved of the others.
template <vocabulary V>
class best_so_far {
public:
  /// `assignment` is a buffer to use.
  explicit best_so_far(dense::buffer<dense::slot>& assignment) : assignment_(assignment) {}

  /// Of equally good allocations the first offered one stays. @pre plans are offered in ascending order
  void offer(typename V::plan p, plan_outcome<V>&& found) {
    if (!ignored_) ignored_ = found.ignored;
    if (!lie_) lie_ = std::move(found.lie);
    bound_ = (std::max)(bound_, found.bound);
    if (!found.utility) {
      if (!winner_) refusals_.push_back(found.refusal);
    } else if (winner_ && found.objective <= best_.objective.units) {
      auto const behind = distance(best_.objective.units, found.objective);
      if (!best_.runner_up || behind < best_.runner_up->distance)
        best_.runner_up = runner_up<V>{p, to_double(*found.utility), behind};
    } else {
      take(p, found);
    }
    if (!found.proved) doubt_ = (std::max)(doubt_, found.bound);
  }

  /// The best of all. `problem` names the agents and tasks of the assignment; `work` is what all searches did.
  template <class Beliefs>
  [[nodiscard]] result<solution<V>, no_allocation<V>> conclude(problem<V, Beliefs> const& problem,
                                                               search_work const& work) && {
    if (!winner_) {
      no_allocation<V> none;
      none.plans = std::move(refusals_);
      none.work = work;
      none.ignored = ignored_;
      none.lie = std::move(lie_);
      return refused{std::move(none)};
    }
    auto& s = best_;
    s.work = work;
    s.ignored = ignored_;
    s.lie = std::move(lie_);
    s.proved = proved_ && bound_ <= s.objective.units && before_ < s.objective.units;
    s.gap = bound_ == dense::no_bound ? std::numeric_limits<double>::infinity()
                                      : to_double({bound_}) - to_double(s.objective);
    auto const tasks = problem.type.find(s.plan)->tasks();
    small_vector<in<V>, 8> atoms;
    atoms.append(assignment_.size(), [&](in<V>* out) {
      for (std::size_t a = 0; a < assignment_.size(); ++a)
        if (assignment_[a] < tasks.size()) *out++ = {problem.participants[a], s.plan, tasks[assignment_[a]].task};
      return out;
    });
    s.atoms = allocation_atoms<V>::from_ascending(std::move(atoms));
    return std::move(s);
  }

private:
  static double distance(std::int64_t more, std::int64_t less) { return to_double({more}) - to_double({less}); }

  void take(typename V::plan p, plan_outcome<V> const& found) {
    if (winner_)
      best_.runner_up = runner_up<V>{best_.plan, best_.utility, distance(found.objective, best_.objective.units)};
    before_ = doubt_;
    proved_ = found.proved;
    winner_ = true;
    best_.plan = p;
    best_.objective = {found.objective};
    best_.exact = *found.utility;
    best_.utility = to_double(best_.exact);
    best_.changes = found.changes;
    assignment_.assign(found.assignment.begin(), found.assignment.end());
  }

  solution<V> best_;
  bool winner_ = false;
  bool proved_ = false;                    // the best allocation is the canonical one of its plan
  std::int64_t bound_ = dense::no_value;   // no valid allocation of a plan searched has a greater objective
  std::int64_t doubt_ = dense::no_value;   // the same of those plans that were not searched to the end
  std::int64_t before_ = dense::no_value;  // the same of those before the winner, where a tie would win
  small_vector<plan_refusal<V>, 2> refusals_;
  std::optional<utility_refusal<V>> ignored_{};
  std::optional<bound_lie<V>> lie_{};
  dense::buffer<dense::slot>& assignment_;
};

}  // namespace rota::detail
