#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/count_space.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// All states of counts that a few agents can have, listed by how many agents they are.
///
/// A state says how many agents each slot takes. A state of k agents has a number among those of k agents: 0, 1, …
/// O(m) memory per state.
class count_states {
public:
  /// No state: one agent more would exceed the upper bound of the slot.
  static constexpr std::uint32_t none = count_space::none;
  /// So many states of equally many agents are listed at most.
  static constexpr std::size_t most_states = 4096;

  void clear() {
    longest_ = 0;
    largest_ = 0;
    states_.clear();
  }

  /// Lists the states of up to `wished` agents of n, or of fewer where those would be too many.
  void prepare(std::span<std::uint32_t const> upper, std::size_t agents, std::size_t wished) {
    clear();
    slots_ = upper.size();
    longest_ = wished;
    space_.prepare(upper, agents, longest_);
    while (longest_ > 0 &&
           (space_.size_of_largest(longest_) > most_states || space_.indices() > count_space::most_indices))
      space_.prepare(upper, agents, --longest_);
    if (longest_ == 0) return;
    list(upper);
    number();
    link(upper);
  }

  /// The most agents whose states are listed; 0 if none are.
  [[nodiscard]] std::size_t longest() const { return longest_; }
  /// How many states there are, over all numbers of agents.
  [[nodiscard]] std::size_t total() const { return states_.size(); }
  /// How many states k agents have.
  [[nodiscard]] std::size_t size(std::size_t k) const { return first_[k + 1] - first_[k]; }
  /// How many states fewer than k agents have.
  [[nodiscard]] std::size_t total_before(std::size_t k) const { return first_[k]; }
  /// The most states that any number of agents has.
  [[nodiscard]] std::size_t largest() const { return largest_; }
  [[nodiscard]] count_space const& space() const { return space_; }

  [[nodiscard]] packed_counts counts(std::size_t k, std::size_t number) const { return states_[first_[k] + number]; }
  /// What count_space::index says of it.
  [[nodiscard]] std::size_t index(std::size_t k, std::size_t number) const { return index_[first_[k] + number]; }
  /// The numbers of the states of k agents, by index.
  [[nodiscard]] std::uint16_t const* number_by_index(std::size_t k) const {
    return &number_by_index_[k * space_.indices()];
  }
  /// The number of the state with one agent more in that slot, for each slot; or `none`. @pre k < longest()
  [[nodiscard]] std::uint32_t const* next(std::size_t k, std::size_t number) const {
    return &next_[(first_[k] + number) * slots_];
  }

private:
  void list(std::span<std::uint32_t const> upper) {
    first_.resize(longest_ + 2);
    no_lower_.assign(slots_, 0);
    for (std::size_t k = 0; k <= longest_; ++k) {
      first_[k] = states_.size();
      space_.list(no_lower_, upper, k, states_);
      largest_ = (std::max)(largest_, states_.size() - first_[k]);
    }
    first_[longest_ + 1] = states_.size();
  }

  void number() {
    index_.resize(states_.size());
    number_by_index_.resize((longest_ + 1) * space_.indices());
    for (std::size_t k = 0; k <= longest_; ++k)
      for (std::size_t i = 0; i < size(k); ++i) {
        std::size_t const index = space_.index(counts(k, i));
        index_[first_[k] + i] = static_cast<std::uint32_t>(index);
        number_by_index_[k * space_.indices() + index] = static_cast<std::uint16_t>(i);
      }
  }

  void link(std::span<std::uint32_t const> upper) {
    next_.assign(states_.size() * slots_, none);
    for (std::size_t k = 0; k < longest_; ++k)
      for (std::size_t i = first_[k]; i < first_[k + 1]; ++i)
        for (std::size_t x = 0; x < slots_; ++x)
          if (space_.count(states_[i], x) < upper[x])
            next_[i * slots_ + x] = static_cast<std::uint32_t>(space_.rank(states_[i] + space_.unit(x), k + 1));
  }

  std::size_t slots_ = 0;
  std::size_t longest_ = 0;
  std::size_t largest_ = 0;
  count_space space_;
  buffer<std::uint32_t> no_lower_;
  buffer<packed_counts> states_;           // by number of agents, then by number of state
  buffer<std::size_t> first_;              // [agents]: where their states begin
  buffer<std::uint32_t> index_;            // [state]
  buffer<std::uint16_t> number_by_index_;  // [agents, index]
  buffer<std::uint32_t> next_;             // [state, slot]
};

}  // namespace rota::dense::detail
