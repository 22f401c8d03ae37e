#pragma once

#include <rota/search/instance.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rota::dense {

/// What a tree search asks about assignments.
class tree_oracle {
public:
  /// The value of a complete assignment within all bounds, or nothing if it is not admissible. `sum` is its additive
  /// utility over the instance; a value of at most `to_beat` is worth nothing, so the answer may be nothing as well.
  virtual std::optional<std::int64_t> leaf(std::span<slot const> assignment, std::int64_t sum,
                                           std::optional<std::int64_t> to_beat) = 0;
  /// At least the value of every admissible completion of the prefix, or nothing if unknown.
  virtual std::optional<std::int64_t> bound(std::span<slot const> prefix, std::int64_t sum) = 0;

protected:
  ~tree_oracle() = default;
};

/// What a tree search found.
struct tree_outcome {
  bool found = false;       ///< `assignment()` is the best admissible one seen
  bool complete = false;    ///< nothing was cut off by the budget: the best, or proof that there is none
  std::int64_t value = 0;   ///< of the best
  std::uint64_t nodes = 0;  ///< placements tried
};

/// Depth-first branch and bound over agents in order, slots in order; iterative, O(n·s) memory.
///
/// Leaves come in lexicographic order and only a strict improvement replaces the best: hence the canonical rule of
/// `additive_solver` holds here too. A subtree is left when its lower bounds cannot be filled any more, or when nothing
/// in it can be better than the best. Every node counts against the budget.
class tree_solver {
public:
  /// Searches until done, until a leaf of value `enough` is found, or until `budget` nodes have been visited.
  ///
  /// @pre no admissible assignment is worth more than `enough`
  tree_outcome solve(instance const& in, tree_oracle& oracle, std::uint64_t budget,
                     std::int64_t enough = std::numeric_limits<std::int64_t>::max()) {
    prepare(in);
    tree_outcome out;
    out.complete = true;
    if (in.agents == 0) {
      consider_leaf(oracle, 0, out);
      return out;
    }
    std::size_t depth = 0;
    next_[0] = 0;
    sum_[0] = 0;
    for (;;) {
      std::size_t k = next_[depth];
      while (k < slots_ && (!in.present(depth, k) || count_[k] >= in.bounds[k].upper)) ++k;
      if (k == slots_) {
        if (depth == 0) return out;
        undo(--depth);
        continue;
      }
      next_[depth] = static_cast<slot>(k + 1);
      if (out.nodes == budget) {
        out.complete = false;
        return out;
      }
      ++out.nodes;
      place(depth, k);
      std::int64_t const sum = sum_[depth] + in.at(depth, k);
      bool keep = fillable(in, depth + 1);
      if (keep && depth + 1 == in.agents) {
        consider_leaf(oracle, sum, out);
        if (out.found && out.value >= enough) return out;
        keep = false;
      }
      if (keep && out.found) {
        auto const bound = oracle.bound({assignment_.data(), depth + 1}, sum);
        keep = !bound || *bound > out.value;
      }
      if (!keep) {
        undo(depth);
        continue;
      }
      ++depth;
      next_[depth] = 0;
      sum_[depth] = sum;
    }
  }

  /// The best assignment of the last search.
  [[nodiscard]] std::span<slot const> assignment() const noexcept { return best_; }

private:
  void prepare(instance const& in) {
    ROTA_ASSERT(in.utility.size() == in.agents * in.slots());
    slots_ = in.slots();
    assignment_.assign(in.agents, no_slot);
    best_.assign(in.agents, no_slot);
    count_.assign(slots_, 0);
    next_.assign(in.agents, 0);
    sum_.assign(in.agents, 0);
    able_.assign((in.agents + 1) * slots_, 0);
    for (std::size_t a = in.agents; a-- > 0;)
      for (std::size_t s = 0; s < slots_; ++s)
        able_[a * slots_ + s] = able_[(a + 1) * slots_ + s] + (in.present(a, s) ? 1u : 0u);
  }

  void place(std::size_t a, std::size_t s) {
    assignment_[a] = static_cast<slot>(s);
    ++count_[s];
  }
  void undo(std::size_t a) { --count_[assignment_[a]]; }

  /// Whether the agents from `first` on could still fill every lower bound and find a place, pair by pair and in number.
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
    auto const value = oracle.leaf(assignment_, sum, out.found ? std::optional{out.value} : std::nullopt);
    if (!value || (out.found && *value <= out.value)) return;
    out.found = true;
    out.value = *value;
    std::copy(assignment_.begin(), assignment_.end(), best_.begin());
  }

  std::size_t slots_ = 0;
  std::vector<slot> assignment_;
  std::vector<slot> best_;
  std::vector<std::uint32_t> count_;
  std::vector<slot> next_;
  std::vector<std::int64_t> sum_;
  std::vector<std::uint32_t> able_;  // [a·s]: how many agents from a on may take each slot
};

}  // namespace rota::dense
