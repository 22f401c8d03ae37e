#pragma once

#include <rota/core/size.hpp>
#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/pair_values.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// Iterated local search: goes to the best neighbour until none is better, then makes a few random moves and begins again.
/// A neighbour has one agent moved, or two agents exchanged.
///
/// Stays within the bounds of the slots; forbidden entries are very expensive. Every call draws the same random numbers, so
/// equal inputs give equal assignments. O(n·m) per move, O(n·m + n²) to choose one; O(n·m) memory.
class local_search {
public:
  /// Improves an assignment, and at most `rounds` times begins again; not again once stop() says so.
  /// @return its exact value @pre it is within the bounds
  std::int64_t improve(pair_values const& values, std::span<slot_bounds const> bounds, std::span<slot> best,
                       std::size_t rounds, stop_request const& stop) {
    agents_ = values.agents();
    slots_ = values.slot_count();
    gain_.resize(agents_ * slots_);
    count_.resize(slots_);
    at_.resize(agents_);
    std::uint64_t random = 20090708;
    std::int64_t value = 0;
    for (std::size_t round = 0; round <= rounds; ++round) {
      if (round != 0 && stop()) break;
      start(values, best);
      if (round != 0) disturb(values, bounds, random);
      climb(values, bounds);
      std::int64_t const now = values.value(at_);
      if (round != 0 && now <= value) continue;
      value = now;
      std::copy(at_.begin(), at_.end(), best.begin());
    }
    return value;
  }

private:
  /// A random number below n.
  static std::size_t draw(std::uint64_t& random, std::size_t n) {
    std::uint64_t z = random += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return rota::detail::to_size(((z ^ (z >> 31)) >> 32) * n >> 32);
  }

  /// gain_[a, x] ← the worth of a in x if the others stay where they are.
  void start(pair_values const& values, std::span<slot const> from) {
    std::copy(from.begin(), from.end(), at_.begin());
    std::fill(count_.begin(), count_.end(), 0);
    for (std::size_t a = 0; a < agents_; ++a)
      for (std::size_t x = 0; x < slots_; ++x) gain_[a * slots_ + x] = values.unary(a, x);
    for (std::size_t a = 0; a < agents_; ++a) {
      ++count_[at_[a]];
      std::int64_t const* const with = values.pairs(a, at_[a]);
      for (std::size_t i = 0; i < gain_.size(); ++i) gain_[i] += with[i];
    }
  }

  void move(pair_values const& values, std::size_t a, std::size_t x) {
    std::int64_t const* const without = values.pairs(a, at_[a]);
    std::int64_t const* const with = values.pairs(a, x);
    for (std::size_t i = 0; i < gain_.size(); ++i) gain_[i] += with[i] - without[i];
    --count_[at_[a]];
    ++count_[x];
    at_[a] = static_cast<slot>(x);
  }

  [[nodiscard]] bool movable(std::span<slot_bounds const> bounds, std::size_t a, std::size_t x) const {
    return x != at_[a] && count_[x] < bounds[x].upper && count_[at_[a]] > bounds[at_[a]].lower;
  }

  void disturb(pair_values const& values, std::span<slot_bounds const> bounds, std::uint64_t& random) {
    std::size_t const moves = 2 + draw(random, agents_ / 3 + 1);
    for (std::size_t i = 0; i < moves; ++i) {
      std::size_t const a = draw(random, agents_);
      std::size_t const x = draw(random, slots_);
      if (movable(bounds, a, x)) {
        move(values, a, x);
        continue;
      }
      std::size_t const b = draw(random, agents_);
      std::size_t const y = at_[a];
      if (at_[b] == y) continue;
      move(values, a, at_[b]);
      move(values, b, y);
    }
  }

  /// Goes to the best neighbour until none is better.
  void climb(pair_values const& values, std::span<slot_bounds const> bounds) {
    for (;;) {
      std::int64_t most = 0;
      std::size_t agent = agents_;
      std::size_t other = agents_;
      std::size_t to = 0;
      for (std::size_t a = 0; a < agents_; ++a) {
        std::int64_t const* const gain = &gain_[a * slots_];
        std::int64_t const here = gain[at_[a]];
        for (std::size_t x = 0; x < slots_; ++x)
          if (gain[x] - here > most && movable(bounds, a, x)) most = gain[x] - here, agent = a, other = agents_, to = x;
        std::int64_t const* const from_a = values.pairs(a, at_[a]);
        for (std::size_t b = a + 1; b < agents_; ++b) {
          std::size_t const x = at_[a];
          std::size_t const y = at_[b];
          if (x == y) continue;
          std::int64_t const* const pair_a = values.pairs(a, y) + b * slots_;
          std::int64_t const* const stay_a = from_a + b * slots_;
          std::int64_t const change = gain[y] - here + gain_[b * slots_ + x] - gain_[b * slots_ + y] + pair_a[x] -
                                      pair_a[y] + stay_a[y] - stay_a[x];
          if (change > most) most = change, agent = a, other = b, to = y;
        }
      }
      if (agent == agents_) return;
      std::size_t const home = at_[agent];
      move(values, agent, to);
      if (other != agents_) move(values, other, home);
    }
  }

  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  buffer<slot> at_;              // [agent]
  buffer<std::uint32_t> count_;  // [slot]
  buffer<std::int64_t> gain_;    // [agent, slot]
};

}  // namespace rota::dense::detail
