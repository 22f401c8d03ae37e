#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/flow/detail/slot_graph.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace rota::dense::detail {

/// Finds first prices, and puts each agent into its best slot at them.
///
/// The result is the same with any prices; good ones save most of the searches. There are three openings:
/// - for few agents a slot, a short auction: agents bid in turn for their best slot, up to where their second best is as
///   good; a full slot raises its price to the least bid of its members. Each agent is in its best slot throughout.
/// - for one agent a slot, all to be filled: the same, with the greatest utility of each slot as its first price.
/// - for many agents a slot, or if too many agents want the same for the auction to end: a sample. Prices come from a quarter
///   of the agents, and theirs from a quarter of these. A hash chooses them: a stride could follow classes of equal agents.
class opening {
public:
  /// Places all agents that take part; false if all pairs of one of them are forbidden. @pre all slots are empty
  [[nodiscard]] bool play(slot_graph& graph, std::size_t agents, work_limit const& limit) {
    homeless_ = membership::nobody;
    if (agents > crowd * graph.slot_count() || !auction(graph, agents)) sample(graph, agents, limit);
    graph.open_places(agents);
    return homeless_ == membership::nobody;
  }

  /// The first agent whose pairs are all forbidden, or `nobody`.
  [[nodiscard]] row_index homeless() const noexcept { return homeless_; }

private:
  using value = slot_graph::value;
  static constexpr std::size_t few = 8;     // with fewer agents a slot, a sample tells nothing
  static constexpr std::size_t crowd = 32;  // with more agents a slot, a sample tells more than an auction
  static constexpr unsigned quarter = 2;    // as a shift
  static constexpr value captive = (std::numeric_limits<value>::max)();  // the bid of an agent that has no second slot

  void place(slot_graph& graph, row_index a) {
    if (!graph.place(a)) homeless_ = (std::min)(homeless_, a);
  }

  // Auction -----------------------------------------------------------------------------------------------------------

  /// False, with all slots empty, if so many agents wait in the end that a sample tells more.
  bool auction(slot_graph& graph, std::size_t agents) {
    instance const& in = graph.problem();
    bid_.assign(in.agents, 0);
    waiting_.clear();
    bool const square = one_each(graph, agents);
    if (square) choose_for_slots(graph);
    bids_left_ = square ? agents - agents / 4 : agents - agents / 2;
    for (row_index a = 0; a < in.agents; ++a)
      if (in.takes_part(a) && graph.who().home(a) == no_slot)
        for (auto next = a; next != membership::nobody;) next = bid(graph, next);
    if (agents >= few * graph.slot_count() && 5 * waiting_.size() > 2 * agents) {
      graph.clear();
      return false;
    }
    graph.keep_ledgers();
    for (auto const a : waiting_)
      if (graph.who().home(a) == no_slot) place(graph, a);  // the others have bid again since
    return true;
  }

  /// Agent a enters its best slot, waits, displaces a member, or raises the price. @return the agent that bids next
  row_index bid(slot_graph& graph, row_index a) {
    auto const price = graph.prices();
    auto const [best, second, j] = kernel::best_two(graph.problem().row(a), price.data(), graph.slot_count());
    if (!graph.problem().present(a, j)) return wait(a);
    bid_[a] = second < absent / 2 ? captive : price[j] + (best - second);
    if (graph.who().count(j) < graph.bounds(j).upper) {
      graph.put(a, static_cast<slot>(j));
      return membership::nobody;
    }
    if (bids_left_ == 0 || graph.who().count(j) == 0) return wait(a);
    --bids_left_;
    auto const [rival, next] = least_bids(graph, j);
    auto const stays = bid_[rival];
    if (bid_[a] > stays) {
      graph.take(rival);
      graph.put(a, static_cast<slot>(j));
      auto const least = (std::min)(next, bid_[a]);
      price[j] = least == captive ? stays : least;
      return rival;
    }
    if (stays == price[j] || bid_[a] == captive) return wait(a);
    // If no member can leave, any price is right that a does not pay.
    price[j] = stays == captive ? bid_[a] + 1 : stays;
    return a;
  }
  row_index wait(row_index a) {
    waiting_.push_back(a);
    return membership::nobody;
  }
  struct least_bid {
    row_index agent;
    value next;  // the least bid of the others
  };
  [[nodiscard]] least_bid least_bids(slot_graph const& graph, std::size_t j) const {
    least_bid found{graph.who().first(j), (std::numeric_limits<value>::max)()};
    for (auto a = graph.who().next(found.agent); a != membership::nobody; a = graph.who().next(a)) {
      if (bid_[a] < bid_[found.agent]) {
        found = {a, bid_[found.agent]};
      } else {
        found.next = (std::min)(found.next, bid_[a]);
      }
    }
    return found;
  }

  /// Whether every slot needs and takes exactly one agent.
  [[nodiscard]] static bool one_each(slot_graph const& graph, std::size_t agents) {
    if (agents != graph.slot_count()) return false;
    for (std::size_t k = 0; k < graph.slot_count(); ++k)
      if (!(graph.bounds(k) == slot_bounds{1, 1})) return false;
    return true;
  }
  /// Prices each slot at its greatest utility, and puts that agent into it unless it has a slot already.
  void choose_for_slots(slot_graph& graph) {
    instance const& in = graph.problem();
    auto const price = graph.prices().first(graph.slot_count());
    std::fill(price.begin(), price.end(), absent);
    fan_.assign(graph.slot_count(), 0);
    for (row_index a = 0; a < in.agents; ++a)
      if (in.takes_part(a)) kernel::raise(in.row(a), 0, a, price.data(), fan_.data(), graph.slot_count());
    for (auto k = graph.slot_count(); k-- > 0;) {
      auto const a = static_cast<row_index>(fan_[k]);
      if (price[k] == absent) {
        price[k] = 0;
      } else if (graph.who().home(a) == no_slot) {
        graph.put(a, static_cast<slot>(k));
        bid_[a] = price[k];
      }
    }
  }

  // Sample ------------------------------------------------------------------------------------------------------------

  void sample(slot_graph& graph, std::size_t agents, work_limit const& limit) {
    bounds_.clear();
    for (std::size_t k = 0; k < graph.slot_count(); ++k) bounds_.push_back(graph.bounds(k));
    unsigned shift = 0;
    while (agents >> shift >= 4 * graph.slot_count()) shift += quarter;
    smallest_ = shift;
    for (; shift > 0; shift -= quarter) {
      auto const some = place_some(graph, shift);
      for (std::size_t k = 0; k < graph.slot_count(); ++k) graph.set_bounds(k, scaled(bounds_[k], some, agents));
      graph.open_places(some);
      bool const interrupted = graph.balance(limit) == slot_graph::flow::interrupted;
      if (!graph.normalise()) std::fill(graph.prices().begin(), graph.prices().end(), 0);
      if (interrupted) break;
      graph.clear();
    }
    graph.clear();
    for (std::size_t k = 0; k < graph.slot_count(); ++k) graph.set_bounds(k, bounds_[k]);
    place_some(graph, 0);
  }
  static constexpr slot_bounds scaled(slot_bounds b, std::uint64_t some, std::uint64_t all) noexcept {
    auto const upper = (std::min)(some, (b.upper * some + all - 1) / all);
    return {static_cast<std::uint32_t>((std::min)(b.lower * some / all, upper)), static_cast<std::uint32_t>(upper)};
  }

  /// Puts one agent in 2^shift into its best slot, most of them to rest there. @return how many
  std::size_t place_some(slot_graph& graph, unsigned shift) {
    instance const& in = graph.problem();
    auto const price = std::as_const(graph).prices();
    auto const margin = usual_margin(graph);
    graph.let_rest(margin);
    graph.keep_ledgers();
    std::size_t some = 0;
    for (row_index a = 0; a < in.agents; ++a) {
      if (!in.takes_part(a) || !chosen(a, shift)) continue;
      auto const [best, second, j] = kernel::best_two(in.row(a), price.data(), graph.slot_count());
      if (!in.present(a, j)) {
        if (shift == 0) homeless_ = (std::min)(homeless_, a);
        continue;
      }
      ++some;
      bool const content = best - second >= margin;
      if (content && graph.has_ledger(j)) {
        graph.rest(a, static_cast<slot>(j));
      } else {
        graph.put(a, static_cast<slot>(j));
      }
    }
    return some;
  }
  /// The margin by which three of four agents prefer their best slot, in the smallest sample.
  [[nodiscard]] value usual_margin(slot_graph const& graph) {
    instance const& in = graph.problem();
    margins_.clear();
    for (row_index a = 0; a < in.agents; ++a) {
      if (!in.takes_part(a) || !chosen(a, smallest_)) continue;
      auto const [best, second, j] = kernel::best_two(in.row(a), graph.prices().data(), graph.slot_count());
      margins_.push_back(best - second);
    }
    if (margins_.empty()) return 0;
    auto const at = margins_.begin() + static_cast<std::ptrdiff_t>(margins_.size() / 4);
    std::nth_element(margins_.begin(), at, margins_.end());
    return (std::min)(*at, max_reach);  // an agent with one slot only prefers it beyond any number
  }
  [[nodiscard]] static constexpr bool chosen(row_index a, unsigned shift) noexcept {
    return mixed(a) <= ~std::uint32_t{0} >> shift;
  }
  static constexpr std::uint32_t mixed(std::uint32_t x) noexcept {
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
  }

  row_index homeless_ = membership::nobody;
  std::size_t bids_left_ = 0;
  buffer<value> bid_;  // an agent stays in its slot at least up to this price
  buffer<row_index> waiting_;
  buffer<value> fan_;  // the agent with the greatest utility for a slot
  buffer<slot_bounds> bounds_;
  unsigned smallest_ = 0;  // the sample of one agent in 2^smallest_ comes first
  buffer<value> margins_;
};

}  // namespace rota::dense::detail
