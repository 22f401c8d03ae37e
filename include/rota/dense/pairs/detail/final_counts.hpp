#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/count_space.hpp>
#include <rota/dense/pairs/detail/suffix_bounds.hpp>
#include <rota/dense/pairs/instance.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// The counts that a complete assignment may have: all vectors of n agents within the bounds of the slots.
class final_counts {
public:
  /// Whether they are few enough to look at all of them at a node: the nodes saved must pay for it.
  static bool few(std::span<std::uint32_t const> lower, std::span<std::uint32_t const> upper, std::size_t agents) {
    std::size_t const most = agents < 18 ? 1024 : 8192;
    // ways[r]: vectors of the slots so far that r agents have, or one more than `most`.
    std::array<std::size_t, max_pair_agents + 1> ways{};
    ways[0] = 1;
    for (std::size_t s = 0; s < upper.size(); ++s)
      for (std::size_t r = agents + 1; r-- > 0;) {
        std::size_t sum = 0;
        for (std::size_t t = lower[s]; t <= r && t <= upper[s]; ++t) sum += ways[r - t];
        ways[r] = (std::min)(sum, most + 1);
      }
    return ways[agents] <= most;
  }

  void prepare(count_space const& space, std::span<std::uint32_t const> lower, std::span<std::uint32_t const> upper,
               std::size_t agents) {
    space_ = &space;
    all_.clear();
    space.list(lower, upper, agents, all_);
    width_ = (all_.size() + 7) / 8 * 8;
    components_.assign(upper.size() * width_, 0.0F);
    for (std::size_t f = 0; f < all_.size(); ++f)
      for (std::size_t s = 0; s < upper.size(); ++s)
        components_[s * width_ + f] = static_cast<float>(space.count(all_[f], s));
    index_.resize(width_);
    for (std::size_t f = 0; f < all_.size(); ++f) index_[f] = static_cast<std::uint32_t>(space.index(all_[f]));
    reachable_.resize(width_);
    missing_.resize(width_);
  }

  /// How many there are, rounded up so that vectors can be used.
  [[nodiscard]] std::size_t width() const { return width_; }
  /// f_s, as [slot, final].
  [[nodiscard]] float const* components() const { return components_.data(); }
  [[nodiscard]] std::int32_t count(std::size_t final, std::size_t s) const {
    return static_cast<std::int32_t>(space_->count(all_[final], s));
  }

  /// Lists those that the counts of a node can grow to. @param left how many agents are not placed @return how many
  std::size_t list_reachable(packed_counts placed, suffix_bounds const& suffix, std::size_t left) {
    std::size_t reachable = 0;
    for (std::size_t f = 0; f < all_.size(); ++f) {
      reachable_[reachable] = static_cast<std::uint32_t>(f);
      reachable += space_->below(placed, all_[f]) ? 1U : 0U;
    }
    std::uint16_t const* const numbers = suffix.numbers(left);
    std::size_t const placed_index = space_->index(placed);
    for (std::size_t i = 0; i < reachable; ++i) missing_[i] = numbers[index_[reachable_[i]] - placed_index];
    return reachable;
  }
  /// Of the last list: which they are.
  [[nodiscard]] std::uint32_t const* reachable() const { return reachable_.data(); }
  /// Of the last list: the state of the agents not placed that leads to each.
  [[nodiscard]] std::uint32_t const* missing() const { return missing_.data(); }

private:
  count_space const* space_ = nullptr;
  std::size_t width_ = 0;
  buffer<packed_counts> all_;
  buffer<float> components_;
  buffer<std::uint32_t> index_;  // [final]: see count_space::index
  buffer<std::uint32_t> reachable_;
  buffer<std::uint32_t> missing_;
};

}  // namespace rota::dense::detail
