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
  agent_stuck,  ///< `witness` is an agent: those that fit only into the slots it may reach are more than these bear
  slot_short    ///< `witness` is a slot: its lower bound cannot be filled together with the others'
};

/// What an additive search found, and its work.
struct additive_outcome {
  additive_end end{};
  std::size_t witness = 0;
  std::int64_t utility = 0;         ///< of the optimum
  std::uint64_t augmentations = 0;  ///< shortest paths pushed: at most n + the sum of the lower bounds
  std::uint64_t relaxations = 0;    ///< arcs looked at: O(s²) per path, and O(n·s + s²) once per agent with ties
};

/// Finds the assignment of greatest total utility, exactly and in polynomial time; buffers are reused between calls.
///
/// A flow from agents through slots to a sink, contracted to its slots: cost W[j][k] is the least loss of moving one
/// agent from slot j to slot k. Every agent starts where it is worth most. Slots above their upper bound then have an
/// excess, slots below their lower bound a deficit, the sink what remains; each unit is sent along a shortest path
/// (Dijkstra on reduced costs). A slot trades places with the sink between its bounds, so lower bounds are arcs that
/// must carry flow, and neither they nor forbidden pairs are big numbers.
///
/// Class invariant while solving: W[j][k] + π_j − π_k ≥ 0 on every residual arc; hence, balanced, optimality.
/// Canonical: of all optima the lexicographically smallest vector (agent → slot) is returned.
/// Complexity: O(n·s) to start, O(s² + s·n) per augmentation, O(n·s²) at worst per agent with ties; O(n + s²) memory.
class additive_solver {
public:
  /// @return `additive_end::optimal` iff an assignment within all bounds exists; then `assignment()` is the optimum
  /// @pre the preconditions of `instance`
  additive_outcome solve(instance const& in) {
    additive_outcome out;
    if (!start(in, out)) return out;
    for (std::size_t s = 0; s <= slots_; ++s)
      while (excess(s) > 0) {
        if (!augment(in, s, out)) return out;
      }
    canonise(in, out);
    for (std::size_t a = 0; a < in.agents; ++a) out.utility += in.at(a, assignment_[a]);
    return out;
  }

  /// The slot of each agent.
  [[nodiscard]] std::span<slot const> assignment() const noexcept { return assignment_; }

private:
  using index = std::uint32_t;
  static constexpr std::int64_t infinite = std::numeric_limits<std::int64_t>::max();

  // The sink is node slots_. A place in a slot is a unit of flow from the slot to the sink.
  [[nodiscard]] std::int64_t excess(std::size_t node) const {
    return node == slots_ ? surplus_
                          : static_cast<std::int64_t>(count_[node]) - static_cast<std::int64_t>(places_[node]);
  }
  [[nodiscard]] bool to_sink(instance const& in, std::size_t s) const { return places_[s] < in.bounds[s].upper; }
  [[nodiscard]] bool from_sink(instance const& in, std::size_t s) const { return places_[s] > in.bounds[s].lower; }

  /// Puts each agent where it is worth most, preferring a slot with room among equals.
  bool start(instance const& in, additive_outcome& out) {
    ROTA_ASSERT(in.utility.size() == in.agents * in.slots());
    slots_ = in.slots();
    assignment_.resize(in.agents);
    count_.assign(slots_, 0);
    places_.resize(slots_);
    price_.assign(slots_ + 1, 0);
    distance_.resize(slots_ + 1);
    next_.resize(slots_ + 1);
    by_.resize(slots_ + 1);
    done_.resize(slots_ + 1);
    queue_.reserve(slots_ + 1);
    loss_.assign(slots_ * slots_, infinite);
    mover_.resize(slots_ * slots_);
    for (std::size_t a = 0; a < in.agents; ++a) {
      std::size_t best = 0;
      for (std::size_t k = 1; k < slots_; ++k) {
        if (in.at(a, k) < in.at(a, best)) continue;
        if (in.at(a, k) > in.at(a, best) || (count_[best] >= in.bounds[best].upper && count_[k] < in.bounds[k].upper))
          best = k;
      }
      if (slots_ == 0 || !in.present(a, best)) {
        out.end = additive_end::agent_stuck;
        out.witness = a;
        return false;
      }
      assignment_[a] = static_cast<slot>(best);
      ++count_[best];
      offer(in, best, a);
    }
    surplus_ = -static_cast<std::int64_t>(in.agents);
    for (std::size_t s = 0; s < slots_; ++s) {
      places_[s] = std::clamp(count_[s], in.bounds[s].lower, std::max(in.bounds[s].lower, in.bounds[s].upper));
      surplus_ += places_[s];
    }
    return true;
  }

  /// Improves row j of W by what its member a offers.
  void offer(instance const& in, std::size_t j, std::size_t a) {
    std::int64_t const here = in.at(a, j);
    for (std::size_t k = 0; k < slots_; ++k) {
      if (k == j || !in.present(a, k)) continue;
      std::int64_t const loss = here - in.at(a, k);
      if (loss >= loss_[j * slots_ + k]) continue;
      loss_[j * slots_ + k] = loss;
      mover_[j * slots_ + k] = static_cast<index>(a);
    }
  }

  void rebuild(instance const& in, std::size_t j) {
    std::fill_n(loss_.begin() + static_cast<std::ptrdiff_t>(j * slots_), slots_, infinite);
    for (std::size_t a = 0; a < in.agents; ++a)
      if (assignment_[a] == j) offer(in, j, a);
  }

  /// Sends one unit from `source` to the nearest node with a deficit.
  bool augment(instance const& in, std::size_t source, additive_outcome& out) {
    std::size_t const target = shortest_path(in, source, out);
    if (target == no_slot) {
      explain(source, out);
      return false;
    }
    ++out.augmentations;
    for (std::size_t v = 0; v <= slots_; ++v)
      if (done_[v]) price_[v] -= distance_[target] - distance_[v];
    // From the target backwards, so that each row still names its mover when its own agent leaves.
    if (target == slots_) ++surplus_;
    if (source == slots_) --surplus_;
    for (std::size_t k = target; k != source;) {
      std::size_t const j = next_[k];
      if (k == slots_) {
        ++places_[j];
      } else if (j == slots_) {
        --places_[k];
      } else {
        std::size_t const a = mover_[j * slots_ + k];
        assignment_[a] = static_cast<slot>(k);
        --count_[j];
        ++count_[k];
        offer(in, k, a);
        rebuild(in, j);
      }
      k = j;
    }
    return true;
  }

  /// Dijkstra on reduced costs until a node with a deficit is settled; next_[v] is the node before v.
  std::size_t shortest_path(instance const& in, std::size_t source, additive_outcome& out) {
    std::fill(distance_.begin(), distance_.end(), infinite);
    std::fill(done_.begin(), done_.end(), char{0});
    distance_[source] = 0;
    for (;;) {
      std::size_t v = no_slot;
      std::int64_t least = infinite;
      for (std::size_t x = 0; x <= slots_; ++x)
        if (!done_[x] && distance_[x] < least) least = distance_[x], v = x;
      if (v == no_slot || excess(v) < 0) return v;
      done_[v] = 1;
      out.relaxations += slots_;
      std::int64_t const base = least + price_[v];
      auto relax = [&](std::size_t k, std::int64_t cost) {
        std::int64_t const d = base + cost - price_[k];
        if (d >= distance_[k]) return;
        distance_[k] = d;
        next_[k] = static_cast<slot>(v);
      };
      if (v == slots_) {
        for (std::size_t k = 0; k < slots_; ++k)
          if (!done_[k] && from_sink(in, k)) relax(k, 0);
        continue;
      }
      if (!done_[slots_] && to_sink(in, v)) relax(slots_, 0);
      for (std::size_t k = 0; k < slots_; ++k)
        if (!done_[k] && loss_[v * slots_ + k] != infinite) relax(k, loss_[v * slots_ + k]);
    }
  }

  void explain(std::size_t source, additive_outcome& out) const {
    if (source == slots_) {
      out.end = additive_end::slot_short;
      while (excess(out.witness) >= 0) ++out.witness;
    } else {
      out.end = additive_end::agent_stuck;
      while (assignment_[out.witness] != source) ++out.witness;
    }
  }

  /// Whether some optimum has agent a in slot k, as far as prices tell (complementary slackness).
  [[nodiscard]] bool tight(instance const& in, std::size_t a, std::size_t k) const {
    std::size_t const j = assignment_[a];
    return in.present(a, k) && in.at(a, j) - in.at(a, k) + price_[j] == price_[k];
  }

  /// Turns the optimum into the lexicographically smallest one.
  ///
  /// Optima differ by cycles of tight arcs, whichever optimal prices are taken. For each agent in order, with the agents
  /// before it fixed: from which slots does a tight path of later agents (or a place exchanged through the sink) lead to
  /// its slot? The smallest such slot that is tight for the agent becomes its own.
  void canonise(instance const& in, additive_outcome& out) {
    for (std::size_t a = 0; a < in.agents; ++a) {
      std::size_t const home = assignment_[a];
      bool alternative = false;
      for (std::size_t k = 0; k < home && !alternative; ++k) alternative = tight(in, a, k);
      if (!alternative) continue;
      reach(in, a, home, out);
      std::size_t k = 0;
      while (k < home && !(next_[k] != no_slot && tight(in, a, k))) ++k;
      if (k < home) rotate(a, k, home);
    }
  }

  /// next_[x] ← the next node on a tight path x → … → home that moves agents after `a` only, or no_slot.
  void reach(instance const& in, std::size_t a, std::size_t home, additive_outcome& out) {
    std::size_t const sink = slots_;
    std::fill(next_.begin(), next_.end(), no_slot);
    next_[home] = static_cast<slot>(home);
    queue_.clear();
    queue_.push_back(static_cast<slot>(home));
    for (std::size_t q = 0; q < queue_.size(); ++q) {
      std::size_t const y = queue_[q];
      auto visit = [&](std::size_t x) {
        next_[x] = static_cast<slot>(y);
        queue_.push_back(static_cast<slot>(x));
      };
      if (y == sink) {
        out.relaxations += slots_;
        for (std::size_t x = 0; x < slots_; ++x)
          if (next_[x] == no_slot && price_[x] == price_[sink] && to_sink(in, x)) visit(x);
        continue;
      }
      if (next_[sink] == no_slot && price_[y] == price_[sink] && from_sink(in, y)) visit(sink);
      out.relaxations += in.agents - a;
      for (std::size_t b = a + 1; b < in.agents; ++b) {
        std::size_t const x = assignment_[b];
        if (next_[x] != no_slot || !tight(in, b, y)) continue;
        by_[x] = static_cast<index>(b);
        visit(x);
      }
    }
  }

  void rotate(std::size_t a, std::size_t k, std::size_t home) {
    assignment_[a] = static_cast<slot>(k);
    while (k != home) {
      std::size_t const next = next_[k];
      if (next == slots_) {
        ++places_[k];
      } else if (k == slots_) {
        --places_[next];
      } else {
        assignment_[by_[k]] = static_cast<slot>(next);
      }
      k = next;
    }
  }

  std::size_t slots_ = 0;
  std::int64_t surplus_ = 0;  // excess of the sink
  std::vector<slot> assignment_;
  std::vector<std::uint32_t> count_;   // agents in a slot
  std::vector<std::uint32_t> places_;  // units from a slot to the sink; = count_ when balanced
  std::vector<std::int64_t> loss_;     // W, row-major
  std::vector<index> mover_;           // whose move W[j][k] is
  std::vector<std::int64_t> price_;    // π
  std::vector<std::int64_t> distance_;
  std::vector<slot> next_;
  std::vector<index> by_;
  std::vector<char> done_;
  std::vector<slot> queue_;
};

}  // namespace rota::dense
