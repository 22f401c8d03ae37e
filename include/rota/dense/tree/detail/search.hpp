#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/tree/solver.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace rota::dense {

namespace detail {

/// What `tree_solver` does and remembers.
class tree_search {
public:
  tree_outcome solve(instance const& in, tree_oracle& oracle, tree_options const& options) {
    prepare(in);
    tree_outcome out;
    found_ = known_ = !options.known.empty();
    bool complete = true;
    if (known_) {
      out.value = options.known_value;
      std::copy(options.known.begin(), options.known.end(), best_.begin());
    }
    bound_[0] = oracle.bound({}, 0);
    if (oracle.hopeless({})) {
      leave(out.account.hopeless, 0, out);
    } else if (!fillable(in, 0)) {
      leave(out.account.pairs, 0, out);
    } else if (in.agents == 0) {
      consider_leaf(oracle, 0, out);
    } else {
      complete = descend(in, oracle, options, out);
    }
    out.status =
        found_ ? (complete ? status::optimal : status::feasible) : (complete ? status::infeasible : status::unknown);
    if (complete) out.bound = found_ ? out.value : no_value;
    if (found_) out.assignment = best_;
    if (out.lie) out.lie->assignment = refuter_;
    out.work.nodes = out.account.nodes;
    out.work.leaves = out.account.leaves;
    out.work.pruned = out.account.pairs + out.account.bounded + out.account.hopeless + out.account.mirrored;
    return out;
  }

private:
  void prepare(instance const& in) {
    ROTA_ASSERT(in.utility.size() == in.agents * in.slot_count());
    slots_ = in.slot_count();
    assignment_.assign(in.agents, no_slot);
    best_.assign(in.agents, no_slot);
    refuter_.assign(in.agents, no_slot);
    count_.assign(slots_, 0);
    next_.assign(in.agents + 1, 0);
    sum_.assign(in.agents + 1, 0);
    bound_.assign(in.agents + 1, no_bound);
    below_.assign(in.agents + 1, 1);
    able_.assign((in.agents + 1) * slots_, 0);
    for (std::size_t a = in.agents; a-- > 0;) {
      below_[a] = times_slots(below_[a + 1]);
      for (std::size_t s = 0; s < slots_; ++s)
        able_[a * slots_ + s] = able_[(a + 1) * slots_ + s] + (in.present(a, s) ? 1u : 0u);
    }
  }

  /// Tries placements until none is left. @return false if the limit was met
  bool descend(instance const& in, tree_oracle& oracle, tree_options const& options, tree_outcome& out) {
    auto const& limit = options.limit;
    for (std::size_t depth = 0;;) {
      std::size_t k = next_[depth];
      while (k < slots_ && !open(in, options.twin, depth, k, out)) ++k;
      if (k == slots_) {
        if (depth == 0) return true;
        undo(--depth);
        continue;
      }
      next_[depth] = static_cast<slot>(k + 1);
      auto const nodes = out.account.nodes;
      if (nodes >= limit.steps || (nodes % 1024 == 0 && limit.stop())) {
        next_[depth] = static_cast<slot>(k);
        out.bound = frontier(depth, out);
        return false;
      }
      ++out.account.nodes;
      place(depth, k);
      std::int64_t const sum = sum_[depth] + in.at(depth, k);
      std::span<slot const> const prefix{assignment_.data(), depth + 1};
      if (!fillable(in, depth + 1)) {
        leave(out.account.pairs, depth + 1, out);
      } else if (depth + 1 == in.agents) {
        consider_leaf(oracle, sum, out);
        if (found_ && !known_ && out.value >= options.enough) return true;
      } else if (oracle.hopeless(prefix)) {
        leave(out.account.hopeless, depth + 1, out);
      } else {
        bound_[depth + 1] = (std::min)(bound_[depth], oracle.bound(prefix, sum));
        if (found_ && (known_ ? bound_[depth + 1] < out.value : bound_[depth + 1] <= out.value)) {
          leave(out.account.bounded, depth + 1, out);
          if (known_ && std::equal(prefix.begin(), prefix.end(), best_.begin()))
            compare(best_, out.value, depth + 1, out);
          if (options.audit && !out.lie) audit(in, oracle, depth + 1, sum, out);
        } else {
          ++depth;
          next_[depth] = 0;
          sum_[depth] = sum;
          continue;
        }
      }
      undo(depth);
    }
  }

  /// Whether agent `depth` can go to slot k now; if not, accounts for the subtree.
  bool open(instance const& in, std::span<row_index const> twin, std::size_t depth, std::size_t k, tree_outcome& out) {
    if (!in.present(depth, k) || count_[k] >= in.bounds[k].upper) {
      leave(out.account.pairs, depth + 1, out);
      return false;
    }
    if (!twin.empty() && twin[depth] != depth && k < assignment_[twin[depth]]) {
      leave(out.account.mirrored, depth + 1, out);
      return false;
    }
    return true;
  }
  void leave(std::uint64_t& reason, std::size_t depth, tree_outcome& out) {
    ++reason;
    cover(depth, out);
  }
  void cover(std::size_t depth, tree_outcome& out) {
    out.account.covered = (out.account.covered + below_[depth]) % tree_account::modulus;
  }
  [[nodiscard]] std::uint64_t times_slots(std::uint64_t x) const noexcept {
    std::uint64_t product = 0;
    for (std::uint64_t s = slots_; s != 0; s >>= 1) {  // by doubling, so that nothing overflows
      if (s & 1) product = (product + x) % tree_account::modulus;
      x = 2 * x % tree_account::modulus;
    }
    return product;
  }
  /// No assignment is worth more: the bound of what an interrupted search has found or not entered.
  [[nodiscard]] std::int64_t frontier(std::size_t depth, tree_outcome const& out) const {
    std::int64_t most = found_ ? out.value : no_value;
    for (std::size_t d = 0; d <= depth; ++d)
      if (next_[d] < slots_) most = (std::max)(most, bound_[d]);
    return most;
  }

  void place(std::size_t a, std::size_t s) {
    assignment_[a] = static_cast<slot>(s);
    ++count_[s];
  }
  void undo(std::size_t a) { --count_[assignment_[a]]; }

  /// Whether the agents from `first` on are enough for all lower bounds, in each slot and in total, and not too many.
  [[nodiscard]] bool fillable(instance const& in, std::size_t first) const {
    std::size_t const left = in.agents - first;
    std::size_t needed = 0;
    std::size_t room = 0;
    for (std::size_t s = 0; s < slots_; ++s) {
      room += in.bounds[s].upper - count_[s];
      if (count_[s] >= in.bounds[s].lower) continue;
      std::size_t const need = in.bounds[s].lower - count_[s];
      if (need > able_[first * slots_ + s]) return false;
      needed += need;
    }
    return needed <= left && left <= room;
  }

  void consider_leaf(tree_oracle& oracle, std::int64_t sum, tree_outcome& out) {
    ++out.account.leaves;
    cover(assignment_.size(), out);
    auto const worthless = known_ ? out.value - 1 : out.value;
    auto const value = oracle.leaf(assignment_, sum, found_ ? std::optional{worthless} : std::nullopt);
    if (!value) return;
    compare(assignment_, *value, assignment_.empty() ? 0 : assignment_.size() - 1, out);
    if (found_ && *value <= worthless) return;
    known_ = false;
    found_ = true;
    out.value = *value;
    std::copy(assignment_.begin(), assignment_.end(), best_.begin());
  }

  /// Notes a lie if `value` exceeds the bound of the assignment's first agents, up to `depth` of them.
  void compare(std::span<slot const> assignment, std::int64_t value, std::size_t depth, tree_outcome& out) {
    if (value <= bound_[depth] || out.lie) return;
    depth = 0;
    while (bound_[depth] >= value) ++depth;
    out.lie = refuted_bound{{}, depth, bound_[depth], value};
    std::copy(assignment.begin(), assignment.end(), refuter_.begin());
  }

  /// Completes the prefix, slots that still need agents first, and compares its value with the bound.
  void audit(instance const& in, tree_oracle& oracle, std::size_t depth, std::int64_t sum, tree_outcome& out) {
    std::size_t a = depth;
    for (; a < in.agents; ++a) {
      std::size_t choice = slots_;
      for (std::size_t s = slots_; s-- > 0;)
        if (in.present(a, s) && count_[s] < in.bounds[s].upper &&
            (choice == slots_ || count_[s] < in.bounds[s].lower || count_[choice] >= in.bounds[choice].lower))
          choice = s;
      if (choice == slots_) break;
      place(a, choice);
      sum += in.at(a, choice);
      if (!fillable(in, a + 1)) {
        undo(a);
        break;
      }
    }
    if (a == in.agents)
      if (auto const value = oracle.probe(assignment_, sum)) compare(assignment_, *value, depth, out);
    while (a-- > depth) undo(a);
  }

  std::size_t slots_ = 0;
  bool found_ = false;  // `best_` holds a valid assignment
  bool known_ = false;  // `best_` is the caller's; an equally good one may precede it
  buffer<slot> assignment_;
  buffer<slot> best_;
  buffer<slot> refuter_;
  buffer<std::uint32_t> count_;
  buffer<slot> next_;
  buffer<std::int64_t> sum_;
  buffer<std::int64_t> bound_;   // of the first d agents, descending
  buffer<std::uint64_t> below_;  // s^(n−d) modulo the modulus
  buffer<std::uint32_t> able_;   // [a·s]: how many agents from a on may take each slot
};

}  // namespace detail

ROTA_INLINE tree_outcome tree_solver::solve(instance const& in, tree_oracle& oracle, tree_options const& options) {
  return search_.made().solve(in, oracle, options);
}

}  // namespace rota::dense
