#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/lane_kernels.hpp>
#include <rota/dense/pairs/detail/model.hpp>
#include <rota/dense/pairs/detail/suffix_bounds.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// A child of a node: the next agent in one slot.
struct pair_child {
  std::int32_t allowed = 0;         ///< nothing in it is worth more
  std::int32_t value = 0;           ///< of the agents placed
  std::int32_t rest = 0;            ///< bound on the unplaced at the prices of that version
  std::uint32_t price_version = 0;  ///< see `price_table`
  slot at = 0;
};

/// A node on the path: so many agents are placed, and its children wait.
struct pair_node {
  pair_child* next = nullptr;
  pair_child* last = nullptr;
  packed_counts counts = 0;   ///< of the agents placed, where suffixes are bounded by counts
  std::uint64_t open = 0;     ///< slots that take more, as bits
  std::uint64_t wanting = 0;  ///< slots below their lower bound
  std::int32_t value = 0;     ///< of the agents placed
  std::uint32_t missing = 0;  ///< agents that lower bounds still ask for
};

/// The nodes from the root to where the search stands. O(n·m·stride) memory.
class search_path {
public:
  void prepare(pair_model const& model, suffix_bounds const& suffix, std::span<std::uint32_t const> lower,
               std::span<std::uint32_t const> upper) {
    model_ = &model;
    space_ = suffix.counted(model.agents()) ? &suffix.space() : nullptr;
    lower_ = lower;
    upper_ = upper;
    agents_ = model.agents();
    slots_ = model.slot_count();
    row_ = slots_ * model.stride();
    nodes_.resize(agents_ + 1);
    fields_.resize((agents_ + 1) * row_);
    at_.assign(agents_, no_slot);
    choice_.assign(agents_, ~std::uint64_t{0});
    candidates_.resize(agents_);
  }

  /// Restricts the agent of that rank to these slots, from the next start on.
  void restrict_to(std::size_t rank, std::uint64_t slot_set) { choice_[rank] = slot_set; }
  /// The slots that the agent of that rank may take at all.
  [[nodiscard]] std::uint64_t present(std::size_t rank) const {
    std::uint64_t present = 0;
    for (std::size_t x = 0; x < slots_; ++x) present |= model_->present(rank, x) ? std::uint64_t{1} << x : 0;
    return present;
  }

  /// Back to the root.
  void start() {
    std::copy(model_->fields().begin(), model_->fields().end(), fields_.begin());
    for (std::size_t r = 0; r < agents_; ++r) {
      std::uint64_t const present = this->present(r);
      candidates_[r] = present & choice_[r];
      for (std::uint64_t out = present & ~choice_[r]; out != 0; out &= out - 1)
        fields_[static_cast<std::size_t>(std::countr_zero(out)) * model_->stride() + model_->lane_of(r)] =
            model_->repellent(r);
    }
    count_.assign(slots_, 0);
    pair_node& root = nodes_[0];
    root = {};
    for (std::size_t s = 0; s < slots_; ++s) {
      root.missing += lower_[s];
      root.open |= upper_[s] > 0 ? std::uint64_t{1} << s : 0;
      root.wanting |= lower_[s] > 0 ? std::uint64_t{1} << s : 0;
    }
  }

  /// Goes from the node at depth d to that child.
  void enter(std::size_t d, pair_child const& child) {
    slot const x = child.at;
    at_[d] = x;
    place(lanes(d), model_->table(d, x), &fields_[(d + 1) * row_]);
    std::uint32_t const count = ++count_[x];
    std::uint64_t const bit = std::uint64_t{1} << x;
    pair_node const& from = nodes_[d];
    pair_node& to = nodes_[d + 1];
    to.value = child.value;
    to.counts = space_ != nullptr ? from.counts + space_->unit(x) : 0;
    to.missing = from.missing - (count <= lower_[x] ? 1 : 0);
    to.open = count == upper_[x] ? from.open & ~bit : from.open;
    to.wanting = count == lower_[x] ? from.wanting & ~bit : from.wanting;
  }
  /// Puts the last agent into x, which makes the assignment complete.
  void complete(slot x) { at_[agents_ - 1] = x; }
  /// Leaves a node for its parent, at depth d.
  void back_to(std::size_t d) { --count_[at_[d]]; }

  [[nodiscard]] pair_node& node(std::size_t d) { return nodes_[d]; }
  /// For the kernels: the fields of the agents after the next one, at the node.
  [[nodiscard]] lane_node lanes(std::size_t d) const {
    return {&fields_[d * row_], slots_, model_->stride(), model_->lane_of(d + 1), model_->floor()};
  }
  /// The slots of the agents placed, by rank.
  [[nodiscard]] slot const* at() const { return at_.data(); }

  [[nodiscard]] std::uint64_t all_slots() const {
    return slots_ == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << slots_) - 1;
  }
  /// The slots that take the next agent, counts considered.
  [[nodiscard]] std::uint64_t open(std::size_t d) const {
    pair_node const& node = nodes_[d];
    return node.missing >= agents_ - d ? node.open & node.wanting : node.open;
  }
  /// The slots that the agent of that rank may take, counts aside.
  [[nodiscard]] std::uint64_t candidates(std::size_t rank) const { return candidates_[rank]; }
  /// The slots before that of the next interchangeable agent before.
  [[nodiscard]] std::uint64_t before_twin(std::size_t rank) const {
    std::uint32_t const twin = model_->twin_before(rank);
    return twin == no_slot ? 0 : (std::uint64_t{1} << at_[twin]) - 1;
  }
  /// Whether one agent more fills the slot.
  [[nodiscard]] bool filled_by_one_more(std::size_t x) const { return count_[x] + 1 == upper_[x]; }
  [[nodiscard]] bool full(std::size_t x) const { return count_[x] == upper_[x]; }

private:
  pair_model const* model_ = nullptr;
  count_space const* space_ = nullptr;  // null where suffixes are not bounded by counts
  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::size_t row_ = 0;  // lanes of the fields of a node
  std::span<std::uint32_t const> lower_;
  std::span<std::uint32_t const> upper_;
  buffer<pair_node> nodes_;           // [depth]
  buffer<lane> fields_;               // [depth, slot, lane]
  buffer<slot> at_;                   // [rank]
  buffer<std::uint32_t> count_;       // [slot]
  buffer<std::uint64_t> choice_;      // [rank]: slots that it is restricted to, as bits
  buffer<std::uint64_t> candidates_;  // [rank]: of these, the ones it may take
};

}  // namespace rota::dense::detail
