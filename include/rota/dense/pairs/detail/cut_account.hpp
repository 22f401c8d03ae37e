#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/model.hpp>
#include <rota/dense/pairs/instance.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// The size of a set of slots, given as bits. Sets are small, so counting bit by bit is quick on any processor.
inline std::uint64_t size_of(std::uint64_t slot_set) {
  std::uint64_t count = 0;
  for (; slot_set != 0; slot_set &= slot_set - 1) ++count;
  return count;
}

/// What became of each subtree: counted by depth, and told to an observer if there is one.
class cut_account {
public:
  void prepare(pair_model const& model, pair_observer* observer) {
    model_ = &model;
    observer_ = observer;
    partial_.resize(model.agents());
    tallies_.assign(model.agents() + 1, {});
  }

  /// Of prefixes of so many agents.
  [[nodiscard]] pair_tally& tally(std::size_t placed) { return tallies_[placed]; }
  [[nodiscard]] std::span<pair_tally const> tallies() const { return tallies_; }

  /// Until `resume`, the observer hears nothing, and tallies do not count.
  void pause() {
    saved_ = tallies_;
    paused_ = observer_;
    observer_ = nullptr;
  }
  void resume() {
    tallies_.swap(saved_);
    observer_ = paused_;
  }

  [[nodiscard]] bool heard() const { return observer_ != nullptr; }
  /// Tells of the child of a node in slot x, or of the node itself if x is no_slot: nothing in it exceeds the bound.
  /// @param path the slots of the d agents placed, by rank
  void tell_bound(slot const* path, std::size_t d, slot x, std::int32_t quanta) {
    if (heard()) (*observer_)(partial(path, d, x), pair_cut::bound, model_->exact(quanta));
  }
  /// Tells of the children in these slots.
  void tell_all(slot const* path, std::size_t d, std::uint64_t slot_set, pair_cut reason) {
    if (!heard()) return;
    for (; slot_set != 0; slot_set &= slot_set - 1)
      (*observer_)(partial(path, d, static_cast<slot>(std::countr_zero(slot_set))), reason, pair_model::nothing);
  }

private:
  std::span<slot const> partial(slot const* path, std::size_t d, slot x) {
    std::fill(partial_.begin(), partial_.end(), no_slot);
    for (std::size_t r = 0; r < d; ++r) partial_[model_->agent_at(r)] = path[r];
    if (x != no_slot) partial_[model_->agent_at(d)] = x;
    return partial_;
  }

  pair_model const* model_ = nullptr;
  pair_observer* observer_ = nullptr;
  pair_observer* paused_ = nullptr;
  buffer<slot> partial_;        // [agent]
  buffer<pair_tally> tallies_;  // [depth]
  buffer<pair_tally> saved_;
};

}  // namespace rota::dense::detail
