#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/limits.hpp>
#include <rota/dense/pairs/detail/child_bounds.hpp>
#include <rota/dense/pairs/detail/cut_account.hpp>
#include <rota/dense/pairs/detail/model.hpp>
#include <rota/dense/pairs/detail/price_table.hpp>
#include <rota/dense/pairs/detail/search_path.hpp>
#include <rota/dense/pairs/detail/suffix_bounds.hpp>
#include <rota/dense/pairs/instance.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// The best assignment that a search has seen, by the caller's numbers.
struct pair_best {
  bool found = false;
  std::int64_t value = pair_model::nothing;
  buffer<slot> assignment;
};

/// Depth-first branch and bound over agents by rank, the most promising slot first; iterative.
///
/// A child is cut when its bound, by `suffix_bounds` and `price_table`, is not above the best value; when its counts grow into
/// no final counts; when it contains something forbidden; or when an interchangeable agent before it took a later slot. Class invariant: cut, open and evaluated assignments add up to all. O(n·m·stride) memory.
class pair_branch {
public:
  void prepare(pair_model const& model, suffix_bounds const& suffix, price_table& prices,
               std::span<std::uint32_t const> lower, std::span<std::uint32_t const> upper, pair_observer* observer) {
    model_ = &model;
    path_.prepare(model, suffix, lower, upper);
    bar_ = {};
    account_.prepare(model, observer);
    children_.prepare(model, suffix, prices, path_, bar_, account_);
    complete_.resize(model.agents());
    bound_ = pair_model::nothing;
  }

  /// Improves on the best until it is proved to be the best, or the budget is spent. @return whether it is proved
  bool run(pair_best& best, std::uint64_t budget, stop_request const& stop) {
    settling_ = false;
    aim(best, best.value);
    return descend(best, budget, stop) == end::exhausted;
  }

  /// Among equals of the best: finds the lexicographically smallest assignment. @return whether it is proved
  ///
  /// Agent by agent in the caller's order: is there an equal one with a smaller slot here and the same slots before?
  /// These searches look at disjoint parts, so that all together cost about one proof. The account stays as it is.
  /// @pre `run` has proved the best
  bool settle(pair_best& best, std::uint64_t budget, stop_request const& stop) {
    settling_ = true;
    account_.pause();
    bool proved = true;
    for (std::size_t a = 0; a < best.assignment.size() && proved; ++a) {
      std::size_t const rank = model_->rank_of(a);
      while (proved) {
        std::uint64_t const earlier = (std::uint64_t{1} << best.assignment[a]) - 1;
        if ((earlier & path_.present(rank)) == 0) break;
        path_.restrict_to(rank, earlier);
        aim(best, best.value - 1);
        end const how = descend(best, budget, stop);
        if (how == end::exhausted) break;
        proved = how == end::found;
      }
      path_.restrict_to(rank, std::uint64_t{1} << best.assignment[a]);
    }
    account_.resume();
    return proved;
  }

  /// Whether some other assignment may be worth as much as the best.
  [[nodiscard]] bool tied() const { return bar_.tied; }
  /// Placements tried.
  [[nodiscard]] std::uint64_t nodes() const { return children_.placements(); }
  /// If `run` was stopped: no assignment that is still open is worth more.
  [[nodiscard]] std::int64_t open_bound() const { return bound_; }
  [[nodiscard]] std::span<pair_tally const> account() const { return account_.tallies(); }

private:
  enum class end { exhausted, stopped, found };
  static constexpr std::uint64_t poll_every = 512;

  /// From now on, subtrees that allow no value above `value` are cut.
  void aim(pair_best const& best, std::int64_t value) {
    bar_.enough = model_->quanta(value);
    // Only a cut that allows exactly the best value can hide an equal of the best.
    bool const hides = best.found && model_->exact(bar_.enough) == best.value;
    bar_.par = hides ? bar_.enough : value_bar::none;
  }

  end descend(pair_best& best, std::uint64_t budget, stop_request const& stop) {
    std::size_t const last = model_->agents() - 1;
    std::uint64_t pause = (std::min)(nodes() + poll_every, budget);
    path_.start();
    std::size_t d = 0;
    children_.grow(0, {});
    for (;;) {
      pair_node& node = path_.node(d);
      if (node.next == node.last) {
        if (d == 0) return end::exhausted;
        path_.back_to(--d);
        continue;
      }
      if (nodes() >= pause) {
        if (nodes() >= budget || stop()) return leave_open(d);
        pause = (std::min)(nodes() + poll_every, budget);
      }
      pair_child const c = *node.next++;
      if (bar_.cuts(c.allowed)) {  // the best has become better since the child was made
        account_.tell_bound(path_.at(), d, c.at, c.allowed);
        ++account_.tally(d + 1).by_bound;
      } else if (d == last) {
        path_.complete(c.at);
        ++account_.tally(d + 1).leaves;
        if (evaluate(best)) return end::found;
      } else {
        path_.enter(d++, c);
        children_.grow(d, c);
      }
    }
  }

  /// Stopped: counts the open subtrees, and bounds them.
  end leave_open(std::size_t d) {
    for (std::size_t i = 0; i <= d; ++i) {
      pair_node const& node = path_.node(i);
      if (node.next == node.last) continue;
      account_.tally(i + 1).open += static_cast<std::uint64_t>(node.last - node.next);
      bound_ = (std::max)(bound_, model_->exact(node.next->allowed));  // the first allows most
    }
    return end::stopped;
  }

  /// A complete assignment. @return whether that is all that was asked for
  bool evaluate(pair_best& best) {
    for (std::size_t r = 0; r < complete_.size(); ++r) complete_[model_->agent_at(r)] = path_.at()[r];
    std::int64_t const value = model_->values().value(complete_);
    if (settling_) {
      if (value < best.value) return false;
      best.assignment = complete_;
      return true;
    }
    if (value <= best.value) {
      bar_.tied |=
          best.found && value == best.value && !std::equal(complete_.begin(), complete_.end(), best.assignment.begin());
      return false;
    }
    best.found = true;
    best.value = value;
    best.assignment = complete_;
    bar_.tied = false;
    aim(best, value);
    return false;
  }

  pair_model const* model_ = nullptr;
  search_path path_;
  value_bar bar_;
  cut_account account_;
  child_bounds children_;
  bool settling_ = false;  // any equal of the best is looked for
  std::int64_t bound_ = 0;
  buffer<slot> complete_;  // [agent]
};

}  // namespace rota::dense::detail
