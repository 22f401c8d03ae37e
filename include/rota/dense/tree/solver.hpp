#pragma once

#include <rota/core/config.hpp>
#include <rota/dense/detail/hidden.hpp>
#include <rota/dense/instance.hpp>
#include <rota/dense/outcome.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace rota::dense {

/// What a tree search asks about assignments.
class tree_oracle {
public:
  /// The value of a complete assignment within all bounds, or nothing if it is not admissible. `sum` is its additive
  /// utility over the instance; a value of at most `to_beat` is worth nothing, so the answer may be nothing as well.
  virtual std::optional<std::int64_t> leaf(std::span<slot const> assignment, std::int64_t sum,
                                           std::optional<std::int64_t> to_beat) = 0;
  /// At least the value of every admissible completion of the prefix, or `no_bound`.
  virtual std::int64_t bound(std::span<slot const> prefix, std::int64_t sum) = 0;
  /// Whether no completion of the prefix is admissible.
  virtual bool hopeless(std::span<slot const> prefix) = 0;
  /// As `leaf`, of an assignment that was left out: to see whether that was right.
  virtual std::optional<std::int64_t> probe(std::span<slot const> assignment, std::int64_t sum) {
    return leaf(assignment, sum, std::nullopt);
  }

protected:
  ~tree_oracle() = default;
};

/// Which part of the assignments a tree search has dealt with, and how. A search that is complete has dealt with all s^n.
struct tree_account {
  std::uint64_t nodes = 0;   ///< placements tried
  std::uint64_t leaves = 0;  ///< complete assignments asked about
  std::uint64_t pairs = 0;  ///< subtrees left: an absent pair, a full slot, or lower bounds that cannot be met any more
  std::uint64_t bounded = 0;   ///< subtrees left: nothing in them could be better
  std::uint64_t hopeless = 0;  ///< subtrees left: nothing in them is admissible
  std::uint64_t mirrored = 0;  ///< subtrees left: the same with interchangeable agents swapped
  std::uint64_t covered = 0;   ///< how many assignments all these hold, modulo `modulus`

  static constexpr std::uint64_t modulus = (std::uint64_t{1} << 61) - 1;  // a prime, so that no s^n is 0

  friend bool operator==(tree_account const&, tree_account const&) = default;
};

/// A bound that was less than the value of an assignment below it.
struct refuted_bound {
  std::span<slot const> assignment{};  ///< that assignment; it belongs to the solver, as that of an outcome
  std::size_t depth = 0;               ///< the prefix is the first `depth` agents of the assignment
  std::int64_t bound = 0;
  std::int64_t value = 0;
};

/// What a tree search may use besides the instance and the oracle.
struct tree_options {
  work_limit limit{};              ///< steps: placements
  std::int64_t enough = no_bound;  ///< no admissible assignment is worth more: the first of this value ends the search
  std::span<row_index const> twin{};  ///< of each agent one before it that it is interchangeable with, or itself
  std::span<slot const> known{};      ///< an admissible assignment: what is worth less is not looked for
  std::int64_t known_value = 0;
  bool audit = false;  ///< at each subtree left for its bound, try one assignment in it
};

/// What a tree search found.
struct tree_outcome : outcome {
  tree_account account;
  std::optional<refuted_bound> lie{};  ///< then nothing is proved: neither `status` nor `bound` can be relied on
};

namespace detail {
class tree_search;
}

/// Depth-first branch and bound over agents in order, slots in order; iterative, O(n·s) memory.
///
/// Leaves come in lexicographic order and only a strict improvement replaces the best: so of equally good assignments the
/// lexicographically smallest is found. A subtree is left when its lower bounds cannot be filled any more, when nothing in it
/// can be better than the best, when the oracle calls it hopeless, or when it is another one with interchangeable agents
/// swapped: these take slots in ascending order. Every placement is a step of `work_limit`.
class tree_solver {
public:
  /// Searches until done, until a leaf is worth `enough`, or until the limit is met. @pre everybody takes part
  tree_outcome solve(instance const& in, tree_oracle& oracle, tree_options const& options = {});

private:
  detail::hidden<detail::tree_search> search_;
};

}  // namespace rota::dense

#ifndef ROTA_COMPILED
#include <rota/dense/tree/detail/search.hpp>
#endif
