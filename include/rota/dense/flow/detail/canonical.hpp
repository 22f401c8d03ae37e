#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/flow/detail/slot_graph.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace rota::dense::detail {

/// Turns an optimum into the lexicographically smallest (agent → slot) of all optima.
///
/// Optima differ by cycles of tight arcs, at any optimal prices. So if the tight arcs between slots and sink have no cycle,
/// the optimum is the only one: O(s²). Otherwise each agent in order, with those before it fixed, gets the smallest slot that
/// is tight for it and in which later agents can make room. O(n·s + c·s²/64), c the agents that have a choice; memory O(s²).
class canonical_choice {
public:
  /// @pre `graph` is balanced
  void make(slot_graph& graph) {
    if (unique(graph)) return;
    nodes_ = graph.sink() + 1;
    words_ = (nodes_ + 63) / 64;
    movers_.assign(nodes_ * nodes_, 0);
    before_.assign(nodes_ * words_, 0);
    instance const& in = graph.problem();
    for (row_index a = 0; a < in.agents; ++a)
      if (in.takes_part(a)) count(graph, a, +1);
    for (row_index a = 0; a < in.agents; ++a) {
      if (!in.takes_part(a) || on_no_cycle(graph.who().home(a))) continue;
      count(graph, a, -1);
      fix(graph, a);
    }
  }

private:
  [[nodiscard]] bool unique(slot_graph& graph) {
    auto const slot_count = graph.slot_count();
    heads_.clear();
    begin_.assign(slot_count + 1, 0);
    degree_.assign(slot_count + 1, 0);
    bool somebody = false;
    for (std::size_t j = 0; j < slot_count; ++j) {
      auto const add = [&](std::size_t k) {
        heads_.push_back(static_cast<slot>(k));
        ++degree_[k];
      };
      graph.for_each_tight(j, add);
      somebody |= heads_.size() > begin_[j];
      if (may_give(graph, j)) add(graph.sink());
      if (may_get(graph, j)) ++degree_[j];
      begin_[j + 1] = static_cast<std::uint32_t>(heads_.size());
    }
    if (!somebody) return true;  // trading places alone changes no assignment
    // Strip nodes that no arc leads to; the rest lies on cycles or behind them.
    queue_.clear();
    for (std::size_t v = 0; v <= slot_count; ++v)
      if (degree_[v] == 0) queue_.push_back(static_cast<slot>(v));
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      auto const v = queue_[i];
      auto const strip = [&](std::size_t k) {
        if (--degree_[k] == 0) queue_.push_back(static_cast<slot>(k));
      };
      if (v == graph.sink()) {
        for (std::size_t k = 0; k < slot_count; ++k)
          if (may_get(graph, k)) strip(k);
      } else {
        for (auto arc = begin_[v]; arc < begin_[v + 1]; ++arc) strip(heads_[arc]);
      }
    }
    return queue_.size() == slot_count + 1;
  }
  [[nodiscard]] bool on_no_cycle(std::size_t v) const { return degree_[v] == 0; }

  /// Whether slot k can open or close a place at no cost.
  [[nodiscard]] static bool may_give(slot_graph const& graph, std::size_t k) {
    return graph.price(k) == graph.price(graph.sink()) && graph.may_open(k);
  }
  [[nodiscard]] static bool may_get(slot_graph const& graph, std::size_t k) {
    return graph.price(k) == graph.price(graph.sink()) && graph.may_close(k);
  }

  [[nodiscard]] static bool tight(slot_graph const& graph, row_index a, std::size_t k) {
    instance const& in = graph.problem();
    auto const j = graph.who().home(a);
    return k != j && in.at(a, k) - in.at(a, j) + graph.price(j) == graph.price(k);
  }
  /// Adds `change` to the movers of each arc that agent a could use.
  void count(slot_graph const& graph, row_index a, int change) {
    std::size_t const j = graph.who().home(a);
    if (on_no_cycle(j)) return;
    for (std::size_t k = 0; k < graph.slot_count(); ++k) {
      if (!tight(graph, a, k)) continue;
      auto& movers = movers_[j * nodes_ + k];
      movers += static_cast<std::uint32_t>(change);
      auto const bit = std::uint64_t{1} << j % 64;
      auto& word = before_[k * words_ + j / 64];
      word = movers != 0 ? word | bit : word & ~bit;
    }
  }

  /// Gives agent a the smallest slot in which later agents can make room. @pre `count` has taken a out
  void fix(slot_graph& graph, row_index a) {
    std::size_t const home = graph.who().home(a);
    std::size_t k = 0;
    while (k < home && !tight(graph, a, k)) ++k;
    if (k == home) return;
    find_ways(graph, home);
    while (k < home && !(way_[k] != no_slot && tight(graph, a, k))) ++k;
    if (k == home) return;
    graph.take(a);
    graph.put(a, static_cast<slot>(k));
    while (k != home) {
      std::size_t const next = way_[k];
      if (next == graph.sink()) {
        graph.open_place(k);
      } else if (k == graph.sink()) {
        graph.close_place(next);
      } else {
        auto b = graph.who().first(k);
        while (b <= a || !tight(graph, b, next)) b = graph.who().next(b);
        count(graph, b, -1);
        graph.take(b);
        graph.put(b, static_cast<slot>(next));
        count(graph, b, +1);
      }
      k = next;
    }
  }

  /// way_[v] ← the next node on a tight way v → … → home for counted agents, or no_slot.
  void find_ways(slot_graph const& graph, std::size_t home) {
    way_.assign(nodes_, no_slot);
    way_[home] = static_cast<slot>(home);
    queue_.assign(1, static_cast<slot>(home));
    auto const visit = [&](std::size_t v, std::size_t next) {
      if (way_[v] != no_slot) return;
      way_[v] = static_cast<slot>(next);
      queue_.push_back(static_cast<slot>(v));
    };
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      std::size_t const to = queue_[i];
      if (to == graph.sink()) {
        for (std::size_t v = 0; v < graph.slot_count(); ++v)
          if (may_give(graph, v)) visit(v, to);
        continue;
      }
      if (may_get(graph, to)) visit(graph.sink(), to);
      for (std::size_t w = 0; w < words_; ++w)
        for (auto bits = before_[to * words_ + w]; bits != 0; bits &= bits - 1)
          visit(w * 64 + static_cast<std::size_t>(std::countr_zero(bits)), to);
    }
  }

  buffer<slot> heads_;  // tight arcs from slot j lead to heads_[begin_[j]] … heads_[begin_[j + 1] - 1]
  buffer<std::uint32_t> begin_;
  buffer<std::uint32_t> degree_;  // how many tight arcs lead to a node; 0 once stripped
  buffer<slot> queue_;
  buffer<slot> way_;
  std::size_t nodes_ = 0;
  std::size_t words_ = 0;
  buffer<std::uint32_t> movers_;  // [from][to]: how many agents, not yet fixed, could move
  buffer<std::uint64_t> before_;  // [to]: from which nodes an agent could move there, as bits
};

}  // namespace rota::dense::detail
