#pragma once

#include <rota/search/instance.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rota::dense {

/// How an additive search ended.
enum class additive_end : unsigned char {
  optimal,      ///< the assignment is the canonical optimum
  agent_stuck,  ///< `witness` is an agent: it and the agents before it do not fit under the upper bounds
  slot_short    ///< `witness` is a slot: no assignment fills all lower bounds, and the best one leaves it short
};

/// What an additive search found, and its work.
struct additive_outcome {
  additive_end end{};
  std::size_t witness = 0;
  std::int64_t utility = 0;         ///< of the optimum
  std::uint64_t augmentations = 0;  ///< paths pushed: one per agent
  std::uint64_t relaxations = 0;    ///< arcs looked at; O(n·s³) in all, for s slots
};

/// Finds the assignment of greatest total utility, exactly and in polynomial time; buffers are reused between calls.
///
/// Works on the contracted graph whose nodes are the slots: W[j][k] = the best gain of moving one agent from slot j to
/// slot k. Agents are inserted one at a time along the best augmenting path (successive shortest paths: each prefix of
/// the agents is placed optimally). A path's value is the pair (places under a lower bound filled, utility) in
/// lexicographic order, so lower bounds need no big number.
///
/// Canonical: of all optima the lexicographically smallest vector (agent → slot) is returned.
/// Complexity: O(n·(s³ + n·s)) time, O(n + s²) memory for s slots.
class additive_solver {
public:
  /// @return `additive_end::optimal` iff an assignment within all bounds exists; then `assignment()` is the optimum
  additive_outcome solve(instance const& in) {
    prepare(in);
    additive_outcome out;
    for (std::size_t a = 0; a < in.agents; ++a) {
      if (!insert(in, a, out)) {
        out.end = additive_end::agent_stuck;
        out.witness = a;
        return out;
      }
      ++out.augmentations;
    }
    for (std::size_t s = 0; s < slots_; ++s) {
      if (count_[s] >= in.bounds[s].lower) continue;
      out.end = additive_end::slot_short;
      out.witness = s;
      return out;
    }
    canonise(in, out);
    for (std::size_t a = 0; a < in.agents; ++a) out.utility += in.at(a, assignment_[a]);
    return out;
  }

  /// The slot of each agent.
  [[nodiscard]] std::span<slot const> assignment() const noexcept { return assignment_; }

private:
  static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

  void prepare(instance const& in) {
    ROTA_ASSERT(in.utility.size() == in.agents * in.slots());
    slots_ = in.slots();
    assignment_.assign(in.agents, no_slot);
    count_.assign(slots_, 0);
    gain_.assign(slots_ * slots_, absent);
    mover_.assign(slots_ * slots_, nobody);
    distance_.resize(slots_ + 1);
    from_.resize(slots_ + 1);
    by_.resize(slots_ + 1);
  }

  /// Improves row j of W by what its member a offers.
  void offer(instance const& in, std::size_t j, std::size_t a) {
    std::int64_t const here = in.at(a, j);
    for (std::size_t k = 0; k < slots_; ++k) {
      if (k == j || !in.present(a, k)) continue;
      std::int64_t const gain = in.at(a, k) - here;
      if (gain <= gain_[j * slots_ + k]) continue;
      gain_[j * slots_ + k] = gain;
      mover_[j * slots_ + k] = static_cast<std::uint32_t>(a);
    }
  }

  void rebuild(instance const& in, std::size_t j, std::size_t inserted) {
    auto const row = static_cast<std::ptrdiff_t>(j * slots_);
    std::fill_n(gain_.begin() + row, slots_, absent);
    std::fill_n(mover_.begin() + row, slots_, nobody);
    for (std::size_t a = 0; a < inserted; ++a)
      if (assignment_[a] == j) offer(in, j, a);
  }

  /// Best utility of a path to each slot, Bellman–Ford. No cycle gains, since the present placement is optimal.
  void relax(additive_outcome& out) {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t j = 0; j < slots_; ++j) {
        if (distance_[j] == absent) continue;
        out.relaxations += slots_;
        for (std::size_t k = 0; k < slots_; ++k) {
          if (gain_[j * slots_ + k] == absent) continue;
          std::int64_t const d = distance_[j] + gain_[j * slots_ + k];
          if (d <= distance_[k]) continue;
          distance_[k] = d;
          from_[k] = static_cast<slot>(j);
          changed = true;
        }
      }
    }
  }

  bool insert(instance const& in, std::size_t a, additive_outcome& out) {
    for (std::size_t k = 0; k < slots_; ++k) {
      distance_[k] = in.at(a, k);
      from_[k] = no_slot;
    }
    relax(out);
    std::size_t end = no_slot;
    for (std::size_t k = 0; k < slots_; ++k) {
      if (distance_[k] == absent || count_[k] >= in.bounds[k].upper) continue;
      if (end != no_slot) {
        bool const fills = count_[k] < in.bounds[k].lower;
        bool const filled = count_[end] < in.bounds[end].lower;
        if (fills != filled ? filled : distance_[k] <= distance_[end]) continue;
      }
      end = k;
    }
    if (end == no_slot) return false;
    ++count_[end];
    std::size_t k = end;
    while (from_[k] != no_slot) {
      std::size_t const j = from_[k];
      assignment_[mover_[j * slots_ + k]] = static_cast<slot>(k);
      k = j;
    }
    assignment_[a] = static_cast<slot>(k);
    for (k = end; from_[k] != no_slot;) {
      std::size_t const j = from_[k];
      if (k == end) offer(in, k, mover_[j * slots_ + k]);
      k = j;
      rebuild(in, k, a + 1);
    }
    if (k == end) offer(in, k, a);
    return true;
  }

  /// Dual prices: the greatest gain of a path that ends at each node of the residual graph, node `slots_` being the
  /// sink through which slots with room exchange places with slots above their lower bound.
  void price(instance const& in, additive_outcome& out) {
    std::fill(distance_.begin(), distance_.end(), 0);
    std::int64_t& sink = distance_[slots_];
    for (bool changed = true; changed;) {
      changed = false;
      std::int64_t const before = sink;
      for (std::size_t j = 0; j < slots_; ++j)
        if (count_[j] < in.bounds[j].upper) sink = std::max(sink, distance_[j]);
      changed |= sink != before;
      for (std::size_t j = 0; j < slots_; ++j) {
        if (count_[j] <= in.bounds[j].lower || distance_[j] >= sink) continue;
        distance_[j] = sink;
        changed = true;
      }
      out.relaxations += slots_ * slots_;
      for (std::size_t j = 0; j < slots_; ++j)
        for (std::size_t k = 0; k < slots_; ++k) {
          if (gain_[j * slots_ + k] == absent || distance_[j] + gain_[j * slots_ + k] <= distance_[k]) continue;
          distance_[k] = distance_[j] + gain_[j * slots_ + k];
          changed = true;
        }
    }
  }

  /// Whether some optimum has agent a in slot k, as far as prices tell (complementary slackness).
  [[nodiscard]] bool tight(instance const& in, std::size_t a, std::size_t k) const {
    std::size_t const j = assignment_[a];
    return in.present(a, k) && distance_[j] + (in.at(a, k) - in.at(a, j)) == distance_[k];
  }

  /// Turns the optimum into the lexicographically smallest one.
  ///
  /// Optima differ by cycles of tight arcs. For each agent in order, with the agents before it fixed: from which slots
  /// does a tight path of later agents (or a place exchanged through the sink) lead to its slot? The smallest such slot
  /// that is tight for the agent becomes its own.
  void canonise(instance const& in, additive_outcome& out) {
    price(in, out);
    for (std::size_t a = 0; a < in.agents; ++a) {
      std::size_t const home = assignment_[a];
      bool alternative = false;
      for (std::size_t k = 0; k < home && !alternative; ++k) alternative = tight(in, a, k);
      if (!alternative) continue;
      reach(in, a, home, out);
      std::size_t k = 0;
      while (k < home && !(from_[k] != no_slot && tight(in, a, k))) ++k;
      if (k < home) rotate(a, k, home);
    }
  }

  /// from_[x] ← the next node on a tight path x → … → home that moves agents after `a` only, or no_slot.
  void reach(instance const& in, std::size_t a, std::size_t home, additive_outcome& out) {
    std::size_t const sink = slots_;
    std::fill(from_.begin(), from_.end(), no_slot);
    from_[home] = static_cast<slot>(home);
    queue_.clear();
    queue_.push_back(static_cast<slot>(home));
    for (std::size_t q = 0; q < queue_.size(); ++q) {
      std::size_t const y = queue_[q];
      out.relaxations += slots_;
      auto visit = [&](std::size_t x) {
        from_[x] = static_cast<slot>(y);
        queue_.push_back(static_cast<slot>(x));
      };
      if (y == sink) {
        for (std::size_t x = 0; x < slots_; ++x)
          if (from_[x] == no_slot && distance_[x] == distance_[sink] && count_[x] < in.bounds[x].upper) visit(x);
        continue;
      }
      if (from_[sink] == no_slot && distance_[y] == distance_[sink] && count_[y] > in.bounds[y].lower) visit(sink);
      for (std::size_t b = a + 1; b < in.agents; ++b) {
        std::size_t const x = assignment_[b];
        if (from_[x] != no_slot || !tight(in, b, y)) continue;
        by_[x] = static_cast<std::uint32_t>(b);
        visit(x);
      }
    }
  }

  void rotate(std::size_t a, std::size_t k, std::size_t home) {
    std::size_t const sink = slots_;
    assignment_[a] = static_cast<slot>(k);
    while (k != home) {
      std::size_t const next = from_[k];
      if (next == sink) {
        ++count_[k];
      } else if (k == sink) {
        --count_[next];
      } else {
        assignment_[by_[k]] = static_cast<slot>(next);
      }
      k = next;
    }
  }

  std::size_t slots_ = 0;
  std::vector<slot> assignment_;
  std::vector<std::uint32_t> count_;
  std::vector<std::int64_t> gain_;       // W, row-major
  std::vector<std::uint32_t> mover_;     // whose move W[j][k] is
  std::vector<std::int64_t> distance_;   // path values while inserting, prices afterwards
  std::vector<slot> from_;
  std::vector<std::uint32_t> by_;
  std::vector<slot> queue_;
};

}  // namespace rota::dense
