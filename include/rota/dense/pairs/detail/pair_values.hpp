#pragma once

#include <rota/core/assert.hpp>
#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/instance.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// |v|, also of the lowest number.
constexpr std::uint64_t magnitude(std::int64_t v) {
  return v < 0 ? 0 - static_cast<std::uint64_t>(v) : static_cast<std::uint64_t>(v);
}

/// The numbers of a pairwise instance as tables for every two agents, both ways round; and which agents can be exchanged.
/// O(n²·m²) time and memory.
class pair_values {
public:
  /// Stands for a forbidden slot or combination: one of it in a sum, and the sum is below every valid value.
  static constexpr std::int64_t forbidden = -2 * max_pair_total;
  /// Below every valid value, and above every sum with something forbidden in it.
  static constexpr std::int64_t nothing = -max_pair_total - 1;

  /// @pre the preconditions of `pair_instance`
  void prepare(pair_instance const& in, bool symmetry) {
    ROTA_ASSERT(in.agents <= max_pair_agents && in.slot_count() <= max_pair_slots);
    ROTA_ASSERT(in.unary.size() == in.agents * in.slot_count());
    agents_ = in.agents;
    slots_ = in.slot_count();
    total_ = 0;
    read_unary(in.unary);
    read_couplings(in.couplings);
    ROTA_ASSERT(total_ <= static_cast<std::uint64_t>(max_pair_total));
    find_kinds(symmetry);
  }

  [[nodiscard]] std::size_t agents() const { return agents_; }
  [[nodiscard]] std::size_t slot_count() const { return slots_; }
  /// Σ_i max|u_i| + Σ_{i<j} max|w_ij|.
  [[nodiscard]] std::uint64_t total() const { return total_; }
  /// Whether some combination of slots is forbidden to two agents.
  [[nodiscard]] bool forbids_pairs() const { return forbids_pairs_; }
  [[nodiscard]] bool coupled(std::size_t a, std::size_t b) const { return coupled_[a * agents_ + b] != 0; }

  /// u_a(x), or `forbidden`.
  [[nodiscard]] std::int64_t unary(std::size_t a, std::size_t x) const { return unary_[a * slots_ + x]; }
  [[nodiscard]] buffer<std::int64_t> const& unary() const { return unary_; }
  /// What a in x is worth with each agent in each slot: agents·slots values, 0 for itself.
  [[nodiscard]] std::int64_t const* pairs(std::size_t a, std::size_t x) const {
    return &pairs_[(a * slots_ + x) * agents_ * slots_];
  }
  /// The exact value of an assignment; below `nothing` if something forbidden is in it.
  [[nodiscard]] std::int64_t value(std::span<slot const> assignment) const {
    std::int64_t sum = 0;
    for (std::size_t a = 0; a < agents_; ++a) {
      sum += unary(a, assignment[a]);
      std::int64_t const* const with = pairs(a, assignment[a]);
      for (std::size_t b = a + 1; b < agents_; ++b) sum += with[b * slots_ + assignment[b]];
    }
    return sum;
  }

  /// The first agent that this one can be exchanged with, maybe itself: an equivalence.
  [[nodiscard]] std::size_t kind_of(std::size_t agent) const { return kind_[agent]; }

private:
  [[nodiscard]] std::int64_t& pair_at(std::size_t a, std::size_t x, std::size_t b, std::size_t y) {
    return pairs_[((a * slots_ + x) * agents_ + b) * slots_ + y];
  }
  void add_to_total(std::uint64_t greatest) { total_ += std::min<std::uint64_t>(greatest, max_pair_total + 1); }

  void read_unary(std::span<std::int64_t const> unary) {
    unary_.resize(agents_ * slots_);
    for (std::size_t a = 0; a < agents_; ++a) {
      std::uint64_t greatest = 0;
      for (std::size_t i = a * slots_; i < (a + 1) * slots_; ++i) {
        unary_[i] = unary[i] == absent ? forbidden : unary[i];
        if (unary[i] != absent) greatest = (std::max)(greatest, magnitude(unary[i]));
      }
      add_to_total(greatest);
    }
  }

  void read_couplings(std::span<coupling const> couplings) {
    forbids_pairs_ = false;
    pairs_.assign(agents_ * slots_ * agents_ * slots_, 0);
    coupled_.assign(agents_ * agents_, 0);
    for (coupling const& c : couplings) {
      ROTA_ASSERT(c.first < agents_ && c.second < agents_ && c.first != c.second);
      ROTA_ASSERT(c.table.size() == slots_ * slots_);
      coupled_[c.first * agents_ + c.second] = coupled_[c.second * agents_ + c.first] = 1;
      std::uint64_t greatest = 0;
      std::int64_t const* w = c.table.data();
      for (std::size_t x = 0; x < slots_; ++x)
        for (std::size_t y = 0; y < slots_; ++y, ++w) {
          std::int64_t& here = pair_at(c.first, x, c.second, y);
          if (*w == absent) {
            here = forbidden;
            forbids_pairs_ = true;
          } else if (here != forbidden) {
            here += *w;
            greatest = (std::max)(greatest, magnitude(*w));
          }
          pair_at(c.second, y, c.first, x) = here;
        }
      add_to_total(greatest);
    }
  }

  void find_kinds(bool symmetry) {
    kind_.resize(agents_);
    for (std::size_t a = 0; a < agents_; ++a) {
      kind_[a] = static_cast<std::uint32_t>(a);
      for (std::size_t b = 0; b < a && symmetry; ++b)
        if (kind_[b] == b && equal_rows(b, a) && equal_tables(b, a)) {
          kind_[a] = static_cast<std::uint32_t>(b);
          break;
        }
    }
  }

  /// Whether u_a and u_b forbid the same slots and differ by a constant, which does not matter.
  [[nodiscard]] bool equal_rows(std::size_t a, std::size_t b) const {
    std::int64_t difference = 0;
    bool known = false;
    for (std::size_t x = 0; x < slots_; ++x) {
      std::int64_t const u = unary(a, x);
      std::int64_t const v = unary(b, x);
      if ((u == forbidden) != (v == forbidden)) return false;
      if (u == forbidden) continue;
      if (known && v - u != difference) return false;
      difference = v - u;
      known = true;
    }
    return true;
  }

  /// Whether a and b are worth the same to each other both ways round, and to every other agent.
  [[nodiscard]] bool equal_tables(std::size_t a, std::size_t b) const {
    for (std::size_t x = 0; x < slots_; ++x) {
      std::int64_t const* const p = pairs(a, x);
      std::int64_t const* const q = pairs(b, x);
      if (!std::equal(p + b * slots_, p + (b + 1) * slots_, q + a * slots_)) return false;
      for (std::size_t c = 0; c < agents_; ++c)
        if (c != a && c != b && !std::equal(p + c * slots_, p + (c + 1) * slots_, q + c * slots_)) return false;
    }
    return true;
  }

  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::uint64_t total_ = 0;
  bool forbids_pairs_ = false;
  buffer<std::int64_t> unary_;  // [agent, slot]
  buffer<std::int64_t> pairs_;  // [agent, slot, agent, slot]
  buffer<char> coupled_;        // [agent, agent]
  buffer<std::uint32_t> kind_;  // [agent]
};

}  // namespace rota::dense::detail
