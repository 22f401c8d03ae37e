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

/// Agents in slots, the price of each slot, and shortest ways to move one agent more from here to there.
///
/// The flow agents → slots → sink, contracted to slots and sink. Agent a in slot j can move to k for the reduced cost
/// p_k − p_j − (u_ak − u_aj). A slot holds `places` (units of flow to the sink), between its bounds; it trades places with
/// the sink, so that lower bounds are arcs which must carry flow. A slot with more agents than places has an excess, with
/// fewer a deficit. One search sends agents from all excesses to the nearest deficits at once.
///
/// Invariants: no arc has a negative reduced cost: nobody would rather be elsewhere at these prices; a slot that costs more
/// than the sink has all its places, one that costs less the fewest. Hence, balanced, optimality.
///
/// Complexity: a search is O(s²) and what it takes to repair a few entries of `ledgers`; memory O(n + s²).
class slot_graph {
public:
  using value = std::int64_t;

  /// What became of an attempt to balance.
  enum class flow : unsigned char { balanced, stuck, interrupted };

  /// Work done since `reset`.
  struct work {
    std::uint64_t searches = 0;
    std::uint64_t augmentations = 0;
    std::uint64_t relaxations = 0;  ///< arcs looked at
  };

  /// Nobody is placed, all prices are 0.
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

  /// The same agents and slots, with some other numbers; false if the slots now ask for other ledgers: then `reset`.
  [[nodiscard]] bool adopt(instance const& in) {
    if (in.agents != who_.homes().size() || in.slot_count() != slot_count() || !ledgers_.suit(in)) return false;
    in_ = in;
    done_ = {};
    return true;
  }

  /// Takes everybody out. Prices stay.
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

  /// Begins to keep ledgers, with what members there are. Nothing may be moved by `balance` before. O(n·s)
  void keep_ledgers() { ledgers_.open(in_, who_); }
  [[nodiscard]] bool has_ledger(std::size_t j) const noexcept { return ledgers_.has(j); }
  /// From now on agents can `rest` who prefer their slot by `margin` at least, at the present prices. @pre holds nobody
  void let_rest(value margin) { ledgers_.let_rest(price_, margin); }

  /// Puts agent a, who is nowhere, into slot j. O(1), or O(s) where j keeps a ledger.
  void put(row_index a, slot j) {
    who_.put(a, j, in_.at(a, j));
    ledgers_.write(in_, who_, a);
  }
  /// Puts agent a into slot j, behind those who do not rest. O(s). @pre j keeps a ledger, and a may rest there
  void rest(row_index a, slot j) {
    who_.rest(a, j, in_.at(a, j));
    ledgers_.write(in_, who_, a);
  }
  /// Takes agent a out of its slot. O(1).
  void take(row_index a) { who_.take(a); }
  /// Puts agent a where it is worth most at these prices; false if every pair of it is absent. O(s).
  bool place(row_index a) {
    auto const j = static_cast<slot>(kernel::best(in_.row(a), price_.data(), slot_count()));
    if (!in_.present(a, j)) return false;
    put(a, j);
    return true;
  }

  /// As many places as prices ask for, where `agents` are placed: the start of balancing. O(s).
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

  /// Searches until there is no excess. `wide_searches`: to half as many deficits as there are sources, not to one.
  flow balance(work_limit const& limit, bool wide_searches = true) {
    for (;;) {
      if (done_.relaxations >= limit.steps || limit.stop()) return interrupted_unless_balanced();
      if (!find_sources()) return flow::balanced;
      if (!search(wide_searches)) return flow::stuck;
    }
  }
  /// Prices relative to the sink; false if they have drifted so far that sums might not fit.
  bool normalise() {
    value const zero = price_[sink()];
    value furthest = 0;
    for (auto& p : price_) {
      p -= zero;
      furthest = (std::max)(furthest, p < 0 ? -p : p);
    }
    return furthest <= 4 * max_reach;
  }

  /// A node with an excess, or the sink if it has one. @pre `balance` was stuck
  [[nodiscard]] std::size_t stuck_at() const noexcept { return settled_[0]; }
  /// Agents that a slot lacks, negative if it has too many; for the sink likewise.
  [[nodiscard]] value room(std::size_t v) const noexcept {
    return v == sink() ? -surplus_ : static_cast<value>(places_[v]) - static_cast<value>(who_.count(v));
  }

  /// Whether a place of slot k may be given to the sink, or taken from it.
  [[nodiscard]] bool may_open(std::size_t k) const noexcept { return places_[k] < bounds_[k].upper; }
  [[nodiscard]] bool may_close(std::size_t k) const noexcept { return places_[k] > bounds_[k].lower; }
  void open_place(std::size_t k) noexcept { ++places_[k]; }
  void close_place(std::size_t k) noexcept { --places_[k]; }

  /// Calls f(k) for each slot k ≠ j to which some member of j may move at no cost (reduced). O(s), repairs aside.
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

  /// Makes counts fit the bounds whatever it costs, by moves of fewest hops; false if that is impossible. After that the
  /// invariants of prices do not hold. For those who cannot wait for `balance`.
  bool fill_anyhow(std::size_t agents) {
    surplus_ = -static_cast<value>(agents);
    for (std::size_t k = 0; k < slot_count(); ++k) {
      places_[k] = std::clamp(who_.count(k), bounds_[k].lower, bounds_[k].upper);
      surplus_ += places_[k];
    }
    for (std::size_t v = 0; v <= sink(); ++v)
      while (room(v) < 0)
        if (!nearest_by_hops(v)) return false;
    return true;
  }

private:
  static constexpr auto nobody = membership::nobody;
  static constexpr value unreached = value{1} << 60;  // further than any sum of reduced costs
  static constexpr value closed = value{1} << 61;     // the price at which nothing is offered to a settled node

  // How a node was reached: from which node, by which agent; `nobody` stands for a place, or for whom the ledger names.
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

  /// Dijkstra on reduced costs from all sources, then one agent along each way found that no other way has used up.
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

  /// v is final, at distance d; offers its neighbours what lies behind it.
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

  /// Whether the way to k is what it says: its last step may rest on what a ledger remembers.
  [[nodiscard]] bool trustworthy(std::size_t k) const {
    auto const j = from(k);
    return k == sink() || j == sink() || !ledgers_.has(j) || ledgers_.current(in_, who_, j, k);
  }
  /// Looks again for the way to k.
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

  /// Moves agents along the way to `target`, if nobody on it has moved since it was found. All its arcs are tight.
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
    if (target == sink()) ++surplus_;
    if (source == sink()) --surplus_;
    for (std::size_t k = target; k != source;) {
      std::size_t const j = from(k);
      if (k == sink()) {
        ++places_[j];
      } else if (j == sink()) {
        --places_[k];
      } else {
        auto const a = by(k);
        take(a);
        put(a, static_cast<slot>(k));
      }
      k = j;
    }
  }

  /// Sends one unit from `source` to a deficit as few hops away as any.
  bool nearest_by_hops(std::size_t source) {
    std::fill(via_.begin(), via_.end(), no_link);
    std::fill(label_.begin(), label_.end(), unreached);
    label_[source] = 0;
    settled_[0] = static_cast<slot>(source);
    for (std::size_t i = 0, end = 1; i < end; ++i) {
      std::size_t const v = settled_[i];
      if (room(v) > 0) {
        send(v);
        return true;
      }
      auto const reach = [&](std::size_t k, value way) {
        if (label_[k] == 0) return;
        label_[k] = 0;
        via_[k] = way;
        settled_[end++] = static_cast<slot>(k);
      };
      if (v == sink()) {
        for (std::size_t k = 0; k < slot_count(); ++k)
          if (may_close(k)) reach(k, link(nobody, v));
        continue;
      }
      if (may_open(v)) reach(sink(), link(nobody, v));
      for (auto a = who_.first(v); a != nobody && end <= slot_count(); a = who_.next(a))
        for (std::size_t k = 0; k < slot_count(); ++k)
          if (in_.present(a, k)) reach(k, link(a, v));
    }
    return false;
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
