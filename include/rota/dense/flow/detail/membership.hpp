#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/instance.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// Which agent is in which slot, and what it is worth there. Each slot lists its members; those who rest come last.
///
/// Complexity: O(1) to put, rest and take; O(n + s) memory.
class membership {
public:
  static constexpr row_index nobody = ~row_index{0};

  /// Begins with no agent in any slot.
  void reset(std::size_t agents, std::size_t slot_count) {
    home_.assign(agents, no_slot);
    worth_.resize(agents);
    next_.resize(agents);
    previous_.resize(agents);
    resting_.resize(agents);
    head_.assign(slot_count, nobody);
    tail_.assign(slot_count, nobody);
    count_.assign(slot_count, 0);
    total_ = 0;
  }

  /// Puts agent a at the head of slot j. @pre a is in no slot
  void put(row_index a, slot j, std::int64_t worth) {
    enter(a, j, worth);
    resting_[a] = 0;
    previous_[a] = nobody;
    next_[a] = head_[j];
    (head_[j] == nobody ? tail_[j] : previous_[head_[j]]) = a;
    head_[j] = a;
  }
  /// Puts agent a at the end of slot j, where it rests. @pre a is in no slot
  void rest(row_index a, slot j, std::int64_t worth) {
    enter(a, j, worth);
    resting_[a] = 1;
    next_[a] = nobody;
    previous_[a] = tail_[j];
    (tail_[j] == nobody ? head_[j] : next_[tail_[j]]) = a;
    tail_[j] = a;
  }
  /// Takes agent a out of its slot.
  void take(row_index a) {
    slot const j = home_[a];
    ROTA_ASSERT(j != no_slot);
    (previous_[a] == nobody ? head_[j] : next_[previous_[a]]) = next_[a];
    (next_[a] == nobody ? tail_[j] : previous_[next_[a]]) = previous_[a];
    --count_[j];
    total_ -= worth_[a];
    home_[a] = no_slot;
  }

  [[nodiscard]] slot home(std::size_t a) const noexcept { return home_[a]; }
  [[nodiscard]] std::span<slot const> homes() const noexcept { return home_; }
  [[nodiscard]] std::int64_t worth(std::size_t a) const noexcept { return worth_[a]; }
  [[nodiscard]] bool rests(std::size_t a) const noexcept { return resting_[a] != 0; }
  [[nodiscard]] std::uint32_t count(std::size_t j) const noexcept { return count_[j]; }
  /// The sum of what all agents are worth in their slots.
  [[nodiscard]] std::int64_t total() const noexcept { return total_; }
  /// The members of a slot: first(j), then next(a) until `nobody`.
  [[nodiscard]] row_index first(std::size_t j) const noexcept { return head_[j]; }
  [[nodiscard]] row_index next(row_index a) const noexcept { return next_[a]; }

private:
  void enter(row_index a, slot j, std::int64_t worth) {
    ROTA_ASSERT(home_[a] == no_slot);
    home_[a] = j;
    worth_[a] = worth;
    total_ += worth;
    ++count_[j];
  }

  buffer<slot> home_;
  buffer<std::int64_t> worth_;
  buffer<row_index> next_, previous_;
  buffer<unsigned char> resting_;
  buffer<row_index> head_, tail_;
  buffer<std::uint32_t> count_;
  std::int64_t total_ = 0;
};

}  // namespace rota::dense::detail
