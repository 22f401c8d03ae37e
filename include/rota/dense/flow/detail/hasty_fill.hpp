#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/flow/detail/membership.hpp>
#include <rota/dense/flow/detail/slot_graph.hpp>

#include <cstddef>

namespace rota::dense::detail {

/// Moves agents until all slots are within their bounds, whatever it costs: for a search that met its limit. First each
/// member of an overfull slot moves to the best slot with room; chains of fewest hops move the rest.
///
/// Breaks the invariants of prices. O(n·s), and O(n·s) for each chain.
class hasty_fill {
public:
  /// False if it is impossible. @pre all `agents` that take part are placed
  [[nodiscard]] bool play(slot_graph& graph, std::size_t agents) {
    graph.fit_places(agents);
    for (std::size_t v = 0; v < graph.sink(); ++v) spill(graph, v);
    for (stuck_at_ = 0; stuck_at_ <= graph.sink(); ++stuck_at_)
      while (graph.room(stuck_at_) < 0)
        if (!move_chain(graph, stuck_at_)) return false;
    return true;
  }

  /// A node with an excess. @pre `play` returned false
  [[nodiscard]] std::size_t stuck_at() const noexcept { return stuck_at_; }

private:
  static constexpr auto nobody = membership::nobody;

  /// Moves members of slot v to where there is room, each to its best such slot, while v has too many.
  static void spill(slot_graph& graph, std::size_t v) {
    instance const& in = graph.problem();
    auto const worth = [&](row_index a, std::size_t k) { return in.at(a, k) - graph.price(k); };
    for (auto a = graph.who().first(v), next = nobody; a != nobody && graph.room(v) < 0; a = next) {
      next = graph.who().next(a);
      auto best = graph.sink();
      for (std::size_t k = 0; k < graph.slot_count(); ++k) {
        bool const free = graph.room(k) > 0 || (graph.room(graph.sink()) > 0 && graph.may_open(k));
        if (free && in.present(a, k) && (best == graph.sink() || worth(a, k) > worth(a, best))) best = k;
      }
      if (best == graph.sink()) continue;
      if (graph.room(best) <= 0) graph.open_place(best);
      graph.take(a);
      graph.put(a, static_cast<slot>(best));
    }
  }

  /// Moves one unit along a shortest chain from `source` to a node with room.
  bool move_chain(slot_graph& graph, std::size_t source) {
    auto const sink = graph.sink();
    from_.assign(sink + 1, no_slot);
    by_.resize(sink + 1);
    queue_.assign(1, static_cast<slot>(source));
    from_[source] = static_cast<slot>(source);
    std::size_t unseen = graph.slot_count() - (source != sink);  // slots
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      std::size_t const v = queue_[i];
      if (graph.room(v) > 0) {
        move(graph, source, v);
        return true;
      }
      auto const reach = [&](std::size_t k, row_index by) {
        if (from_[k] != no_slot) return;
        from_[k] = static_cast<slot>(v);
        by_[k] = by;
        queue_.push_back(static_cast<slot>(k));
        unseen -= k != sink;
      };
      if (v == sink) {
        for (std::size_t k = 0; k < sink; ++k)
          if (graph.may_close(k)) reach(k, nobody);
        continue;
      }
      if (graph.may_open(v)) reach(sink, nobody);
      for (auto a = graph.who().first(v); a != nobody && unseen > 0; a = graph.who().next(a))
        for (std::size_t k = 0; k < sink; ++k)
          if (graph.problem().present(a, k)) reach(k, a);
    }
    return false;
  }
  void move(slot_graph& graph, std::size_t source, std::size_t target) const {
    for (auto k = target; k != source; k = from_[k]) {
      if (k == graph.sink()) {
        graph.open_place(from_[k]);
      } else if (from_[k] == graph.sink()) {
        graph.close_place(k);
      } else {
        graph.take(by_[k]);
        graph.put(by_[k], static_cast<slot>(k));
      }
    }
  }

  std::size_t stuck_at_ = 0;
  buffer<slot> from_;     // the node before, on the chain to a node; `no_slot` if there is none yet
  buffer<row_index> by_;  // the agent of that step; `nobody` if it is a place
  buffer<slot> queue_;
};

}  // namespace rota::dense::detail
