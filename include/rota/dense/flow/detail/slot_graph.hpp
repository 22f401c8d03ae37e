#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/flow/detail/kernels.hpp>
#include <rota/dense/flow/detail/ledgers.hpp>
#include <rota/dense/flow/detail/membership.hpp>
#include <rota/dense/instance.hpp>
#include <rota/dense/limits.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rota::dense::detail {

/// Agents in slots, a price for each slot, and shortest ways to move agents from slots that have too many to slots that
/// lack some.
///
/// This is the flow agents → slots → sink, contracted to slots and sink. Agent a in slot j moves to k for the reduced cost
/// p_k − p_j − (u_ak − u_aj). A slot has `places` (units of flow to the sink) between its bounds, and trades places with the
/// sink: so a lower bound is an arc that must carry flow. A slot with more agents than places has an excess, one with fewer
/// a deficit. One search sends agents from all excesses to the nearest deficits at once.
///
/// Invariants: no arc has a negative reduced cost, so no agent would gain by moving at these prices; a slot that costs more
/// than the sink has the most places, one that costs less has the fewest. Once balanced, the assignment is therefore optimal.
///
/// Complexity: a search is O(s²), and repairs of a few entries of `ledgers`; memory O(n + s²).
class slot_graph {
public:
  using value = std::int64_t;

  /// How an attempt to balance ended.
  enum class flow : unsigned char { balanced, stuck, interrupted };

  /// Work done since `reset`.
  struct work {
    std::uint64_t searches = 0;
    std::uint64_t augmentations = 0;
    std::uint64_t relaxations = 0;  ///< arcs looked at
  };

  /// Begins with no agent placed and all prices 0.
  void reset(instance const& in) {
    in_ = in;
    auto const s = in.slot_count();
    price_.assign(s + 1, 0);
    places_.assign(s, 0);
    label_.resize(s + 1);
    open_price_.resize(s + 1);
    via_.resize(s + 1);
    distance_.resize(s + 1);
    settled_.resize(s + 1);
    targets_.resize(s + 1);
    bounds_.assign(in.bounds.begin(), in.bounds.end());
    who_.reset(in.agents, s);
    ledgers_.reset(in);
    surplus_ = 0;
    done_ = {};
  }

  /// Takes over changed numbers for the same agents and slots; false if their counts or the slots with ledgers differ: then
  /// call `reset`.
  [[nodiscard]] bool adopt(instance const& in) {
    if (in.agents != who_.homes().size() || in.slot_count() != slot_count() || !ledgers_.suit(in)) return false;
    in_ = in;
    done_ = {};
    return true;
  }

  /// Takes all agents out. Prices stay.
  void clear() {
    who_.reset(in_.agents, slot_count());
    ledgers_.close();
  }

  [[nodiscard]] instance const& problem() const noexcept { return in_; }
  [[nodiscard]] std::size_t slot_count() const noexcept { return bounds_.size(); }
  [[nodiscard]] std::size_t sink() const noexcept { return bounds_.size(); }
  [[nodiscard]] membership const& who() const noexcept { return who_; }
  [[nodiscard]] slot_bounds bounds(std::size_t k) const noexcept { return bounds_[k]; }
  void set_bounds(std::size_t k, slot_bounds b) noexcept { bounds_[k] = b; }
  [[nodiscard]] value price(std::size_t k) const noexcept { return price_[k]; }
  [[nodiscard]] std::span<value> prices() noexcept { return price_; }
  [[nodiscard]] std::span<value const> prices() const noexcept { return price_; }
  [[nodiscard]] work const& done() const noexcept { return done_; }

  /// Begins to keep ledgers. To be called before `balance`. O(n·s)
  void keep_ledgers() { ledgers_.open(in_, who_); }
  [[nodiscard]] bool has_ledger(std::size_t j) const noexcept { return ledgers_.has(j); }
  /// From now on, agents that prefer their slot by at least `margin` at the present prices can `rest`. @pre all slots are
  /// empty
  void let_rest(value margin) { ledgers_.let_rest(price_, margin); }

  /// Puts agent a into slot j. O(1), or O(s) if j keeps a ledger. @pre a is in no slot
  void put(row_index a, slot j) {
    who_.put(a, j, in_.at(a, j));
    ledgers_.write(in_, who_, a);
  }
  /// Puts agent a into slot j to rest there. O(s). @pre a is in no slot, j keeps a ledger, and a may rest there
  void rest(row_index a, slot j) {
    who_.rest(a, j, in_.at(a, j));
    ledgers_.write(in_, who_, a);
  }
  /// Takes agent a out of its slot. O(1).
  void take(row_index a) { who_.take(a); }
  /// Puts agent a into its best slot at these prices; false if all its pairs are forbidden. O(s).
  bool place(row_index a) {
    auto const j = static_cast<slot>(kernel::best(in_.row(a), price_.data(), slot_count()));
    if (!in_.present(a, j)) return false;
    put(a, j);
    return true;
  }

  /// Opens as many places as prices ask for while `agents` are placed; then `balance`. O(s).
  void open_places(std::size_t agents) {
    surplus_ = -static_cast<value>(agents);
    for (std::size_t k = 0; k < slot_count(); ++k) {
      auto const [least, most] = bounds_[k];
      places_[k] = price_[k] > price_[sink()]   ? most
                   : price_[k] < price_[sink()] ? least
                                                : std::clamp(who_.count(k), least, most);
      surplus_ += places_[k];
    }
  }

  /// As many places as members, within the bounds. O(s).
  void fit_places(std::size_t agents) {
    surplus_ = -static_cast<value>(agents);
    for (std::size_t k = 0; k < slot_count(); ++k) {
      places_[k] = std::clamp(who_.count(k), bounds_[k].lower, bounds_[k].upper);
      surplus_ += places_[k];
    }
  }

  /// Searches until no slot has an excess. A wide search ends at half as many deficits as there are sources, else at one.
  flow balance(work_limit const& limit, bool wide_searches = true) {
    for (;;) {
      if (done_.relaxations >= limit.steps || limit.stop()) return interrupted_unless_balanced();
      if (!find_sources()) return flow::balanced;
      if (!search(wide_searches)) return flow::stuck;
    }
  }
  /// Makes prices relative to the sink; false if they have drifted so far that sums might overflow.
  bool normalise() {
    value const zero = price_[sink()];
    value furthest = 0;
    for (auto& p : price_) {
      p -= zero;
      furthest = (std::max)(furthest, p < 0 ? -p : p);
    }
    return furthest <= 4 * max_reach;
  }

  /// A node with an excess. @pre `balance` was stuck
  [[nodiscard]] std::size_t stuck_at() const noexcept { return settled_[0]; }
  /// How many agents node v lacks; negative if it has too many.
  [[nodiscard]] value room(std::size_t v) const noexcept {
    return v == sink() ? -surplus_ : static_cast<value>(places_[v]) - static_cast<value>(who_.count(v));
  }

  /// Whether slot k may open one place more, or close one.
  [[nodiscard]] bool may_open(std::size_t k) const noexcept { return places_[k] < bounds_[k].upper; }
  [[nodiscard]] bool may_close(std::size_t k) const noexcept { return places_[k] > bounds_[k].lower; }
  void open_place(std::size_t k) noexcept { ++places_[k], ++surplus_; }
  void close_place(std::size_t k) noexcept { --places_[k], --surplus_; }

  /// Calls f(k) for each slot k ≠ j to which a member of j can move at reduced cost 0. O(s), repairs aside.
  template <class F>
  void for_each_tight(std::size_t j, F&& f) {
    auto const visit = [&](value const* gain, value here, auto&& really) {
      for (std::size_t k = 0; (k = kernel::first_tight(gain, here, price_.data(), k, slot_count())) < slot_count(); ++k)
        if (k != j && really(k)) f(k);
    };
    if (ledgers_.has(j)) {
      value const* const gain = ledgers_.gains(j);
      visit(gain, price_[j], [&](std::size_t k) {
        while (gain[k] + price_[j] >= price_[k]) {
          if (ledgers_.current(in_, who_, j, k)) return true;
          repair(j, k);
        }
        return false;
      });
    } else {
      for (auto a = who_.first(j); a != nobody; a = who_.next(a))
        visit(in_.row(a), price_[j] - who_.worth(a), [](std::size_t) { return true; });
    }
  }

private:
  static constexpr auto nobody = membership::nobody;
  static constexpr value unreached = value{1} << 60;  // greater than any sum of reduced costs
  static constexpr value closed = value{1} << 61;     // the price of a settled node: no offer reaches it

  // How a node was reached: from which node, by which agent. `nobody` is a place, or whom the ledger names.
  static constexpr value link(row_index a, std::size_t from) noexcept {
    return static_cast<value>(std::uint64_t{a} << 32 | from);
  }
  static constexpr value no_link = -1;
  [[nodiscard]] std::size_t from(std::size_t k) const noexcept { return static_cast<slot>(via_[k]); }
  [[nodiscard]] row_index by(std::size_t k) const noexcept {
    auto const a = static_cast<row_index>(static_cast<std::uint64_t>(via_[k]) >> 32);
    return a != nobody ? a : ledgers_.mover(from(k), k);
  }
  void repair(std::size_t j, std::size_t k) { done_.relaxations += ledgers_.repair(in_, who_, j, k); }

  bool find_sources() {
    sources_ = 0;
    for (std::size_t v = 0; v <= sink(); ++v)
      if (room(v) < 0) settled_[sources_++] = static_cast<slot>(v);
    return sources_ > 0;
  }
  flow interrupted_unless_balanced() { return find_sources() ? flow::interrupted : flow::balanced; }

  /// Dijkstra on reduced costs from all sources; then one agent moves along each way that is still open.
  bool search(bool wide) {
    ++done_.searches;
    std::size_t const enough = wide ? (sources_ + 1) / 2 : 1;
    auto const sources = sources_;
    std::fill(label_.begin(), label_.end(), unreached);
    std::copy(price_.begin(), price_.end(), open_price_.begin());
    std::fill(via_.begin(), via_.end(), no_link);
    for (std::size_t i = 0; i < sources; ++i) open_price_[settled_[i]] = closed;
    row_entry nearest{};
    for (std::size_t i = 0; i < sources; ++i) nearest = settle(settled_[i], 0, i);
    std::size_t passed = sources;
    std::size_t found = 0;
    value reach = 0;
    while (nearest.value < unreached) {
      auto const [d, v] = nearest;
      if (!trustworthy(v)) {
        correct(v, passed);
        nearest = kernel::least(label_.data(), slot_count() + 1, unreached);
        continue;
      }
      reach = d;
      if (room(v) > 0) targets_[found++] = static_cast<slot>(v);
      if (found == enough) break;
      nearest = settle(v, d, passed++);
    }
    if (found == 0) return false;
    for (std::size_t i = 0; i < passed; ++i) price_[settled_[i]] += reach - distance_[settled_[i]];
    [[maybe_unused]] auto const before = done_.augmentations;
    for (std::size_t i = 0; i < found; ++i) send(targets_[i]);
    ROTA_ASSERT(done_.augmentations > before);
    return true;
  }

  /// Makes v final at distance d, and offers its neighbours the ways through it.
  /// @return the nearest node that is not final
  row_entry settle(std::size_t v, value d, std::size_t order) {
    settled_[order] = static_cast<slot>(v);
    distance_[v] = d;
    label_[v] = unreached;
    value const base = d - price_[v];
    open_price_[v] = closed;
    done_.relaxations += slot_count();
    if (v == sink()) {
      for (std::size_t k = 0; k < slot_count(); ++k)
        if (may_close(k)) offer(k, base + open_price_[k], link(nobody, v));
      return kernel::least(label_.data(), slot_count() + 1, unreached);
    }
    if (may_open(v)) offer(sink(), base + open_price_[sink()], link(nobody, v));
    row_entry nearest{unreached, slot_count()};
    if (ledgers_.has(v)) {
      nearest = kernel::relax(base, open_price_.data(), ledgers_.gains(v), link(nobody, v), label_.data(), via_.data(),
                              slot_count(), unreached);
    } else if (who_.first(v) == nobody) {
      nearest = kernel::least(label_.data(), slot_count(), unreached);
    } else {
      for (auto a = who_.first(v); a != nobody; a = who_.next(a))
        nearest = kernel::relax(base + who_.worth(a), open_price_.data(), in_.row(a), link(a, v), label_.data(),
                                via_.data(), slot_count(), unreached);
    }
    if (label_[sink()] < nearest.value) nearest = {label_[sink()], sink()};
    return nearest;
  }
  void offer(std::size_t k, value distance, value way) {
    if (distance < label_[k]) label_[k] = distance, via_[k] = way;
  }

  /// Whether the way to k is open as labelled: its last step may be an outdated entry of a ledger.
  [[nodiscard]] bool trustworthy(std::size_t k) const {
    auto const j = from(k);
    return k == sink() || j == sink() || !ledgers_.has(j) || ledgers_.current(in_, who_, j, k);
  }
  /// Repairs that entry and finds the way to k anew.
  void correct(std::size_t k, std::size_t passed) {
    repair(from(k), k);
    label_[k] = unreached;
    for (std::size_t i = 0; i < passed; ++i) {
      std::size_t const v = settled_[i];
      value const base = distance_[v] - price_[v] + price_[k];
      if (v == sink()) {
        if (may_close(k)) offer(k, base, link(nobody, v));
      } else if (ledgers_.has(v)) {
        offer(k, base - ledgers_.gains(v)[k], link(nobody, v));
      } else {
        for (auto a = who_.first(v); a != nobody; a = who_.next(a))
          offer(k, base - (in_.at(a, k) - who_.worth(a)), link(a, v));
      }
    }
  }

  /// Moves agents along the way to `target`, unless one on it has moved since it was found. All its arcs are tight.
  void send(std::size_t target) {
    std::size_t source = target;
    while (via_[source] != no_link) {
      std::size_t const j = from(source);
      bool const open = source == sink() ? may_open(j) : j == sink() ? may_close(source) : who_.home(by(source)) == j;
      if (!open) return;
      source = j;
    }
    if (room(source) >= 0) return;
    ++done_.augmentations;
    for (std::size_t k = target; k != source;) {
      std::size_t const j = from(k);
      if (k == sink()) {
        open_place(j);
      } else if (j == sink()) {
        close_place(k);
      } else {
        auto const a = by(k);
        take(a);
        put(a, static_cast<slot>(k));
      }
      k = j;
    }
  }

  instance in_;
  membership who_;
  ledgers ledgers_;
  buffer<std::uint32_t> places_;  // units from a slot to the sink
  buffer<slot_bounds> bounds_;
  value surplus_ = 0;  // excess of the sink
  buffer<value> price_;
  buffer<value> label_;  // tentative distance, `unreached` once final
  buffer<value> open_price_;
  buffer<value> via_;
  buffer<value> distance_;
  buffer<slot> settled_;
  buffer<slot> targets_;
  std::size_t sources_ = 0;
  work done_;
};

}  // namespace rota::dense::detail
