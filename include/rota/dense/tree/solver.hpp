#pragma once

#include <rota/core/config.hpp>
#include <rota/dense/hidden.hpp>
#include <rota/dense/instance.hpp>
#include <rota/dense/outcome.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace rota::dense {

/// Answers the questions that a tree search asks about assignments.
class tree_oracle {
public:
  /// The value of a complete assignment within all bounds; nothing if it is not valid. `sum` is its additive utility in the
  /// instance. The search has no use for a value of at most `to_beat`: the answer may then be nothing, too.
  virtual std::optional<std::int64_t> leaf(std::span<slot const> assignment, std::int64_t sum,
                                           std::optional<std::int64_t> to_beat) = 0;
  /// No valid completion of the prefix is worth more; `no_bound` if nothing is known.
  virtual std::int64_t bound(std::span<slot const> prefix, std::int64_t sum) = 0;
  /// True only if no completion of the prefix is valid.
  virtual bool hopeless(std::span<slot const> prefix) = 0;
  /// As `leaf`, for an assignment in a subtree that a bound cut off: an audit compares its value with that bound.
  virtual std::optional<std::int64_t> probe(std::span<slot const> assignment, std::int64_t sum) {
    return leaf(assignment, sum, std::nullopt);
  }

protected:
  ~tree_oracle() = default;
};

/// What became of the s^n assignments. A search that ends by itself, short of `tree_options::enough`, has covered all.
struct tree_account {
  std::uint64_t nodes = 0;     ///< placements tried
  std::uint64_t leaves = 0;    ///< complete assignments evaluated
  std::uint64_t pairs = 0;     ///< subtrees skipped: a forbidden pair, a full slot, or a lower bound out of reach
  std::uint64_t bounded = 0;   ///< subtrees skipped: nothing in them could be better
  std::uint64_t hopeless = 0;  ///< subtrees skipped: nothing in them is valid
  std::uint64_t mirrored = 0;  ///< subtrees skipped: equal to others with interchangeable agents swapped
  std::uint64_t covered = 0;   ///< the number of assignments in all these, modulo `modulus`

  static constexpr std::uint64_t modulus = (std::uint64_t{1} << 61) - 1;  // a prime, so that no s^n is 0

  friend bool operator==(tree_account const&, tree_account const&) = default;
};

/// A bound of the oracle that is too low, and an assignment that refutes it.
struct refuted_bound {
  std::span<slot const> assignment{};  ///< a view of the solver's memory, as in an outcome
  std::size_t depth = 0;               ///< the bound is that of its first `depth` agents
  std::int64_t bound = 0;
  std::int64_t value = 0;
};

/// What a tree search uses besides the instance and the oracle.
struct tree_options {
  work_limit limit{};                 ///< a step is a placement tried
  std::int64_t enough = no_bound;     ///< no valid assignment is worth more: the search ends at the first of this value
  std::span<row_index const> twin{};  ///< for each agent an earlier one that it is interchangeable with, or itself
  std::span<slot const> known{};      ///< a valid assignment to begin with, or empty
  std::int64_t known_value = 0;       ///< the value of `known`
  bool audit = false;                 ///< evaluate one assignment in each subtree that a bound cuts off
};

/// What a tree search found.
struct tree_outcome : outcome {
  tree_account account;
  std::optional<refuted_bound> lie{};  ///< if present, nothing is proved: `status` and `bound` rely on a wrong bound
};

namespace detail {
class tree_search;
}

/// Finds the assignment of greatest value by depth-first branch and bound, for any value that an oracle computes.
///
/// Canonical: agents and slots are tried in order, and only a greater value replaces the best, so of equally good assignments
/// the lexicographically smallest is found. The search skips a subtree if lower bounds of slots are out of reach, if its
/// bound is no better than the best, if the oracle calls it hopeless, or if interchangeable agents would take slots in
/// descending order.
/// Certificate: `tree_outcome::account`; `covered` is s^n modulo `tree_account::modulus` if all assignments are accounted for.
///
/// Memory is reused. A copy of a solver begins with no memory; a move keeps it, and assignments that outcomes show stay valid.
/// Complexity: s^n placements at worst, each O(s) and the oracle's answers; iterative, O(n·s) memory.
class tree_solver {
public:
  /// Searches until done, until an assignment is worth `options.enough`, or until the limit is met. If the oracle throws, so
  /// does this, and the solver can be used again.
  /// @pre the preconditions of `instance`; all agents take part; `known` is within all bounds
  tree_outcome solve(instance const& in, tree_oracle& oracle, tree_options const& options = {});

private:
  hidden<detail::tree_search> search_;
};

}  // namespace rota::dense

#ifndef ROTA_COMPILED
#include <rota/dense/tree/detail/search.hpp>
#endif
