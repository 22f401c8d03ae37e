#pragma once

#include <rota/search/instance.hpp>
#include <rota/search/kernels.hpp>
#include <rota/search/limits.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rota::dense {

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
/// Slots that can hold many agents keep a ledger: for each other slot the greatest gain of moving a member there, and whose
/// it is. An upper bound, since nobody looks for members who have left until their arc is about to be used. Members that
/// were content with their slot by a margin, when prices were known well, *rest*: prices then say how little they can gain,
/// and nobody asks them unless it comes to that.
///
/// Complexity: a search is O(s²) and a few reads of members that do not rest; memory O(n + s²).
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
    auto const n = in.agents, s = in.slots();
    home_.assign(n, no_slot);
    worth_.resize(n);
    next_.resize(n);
    previous_.resize(n);
    resting_.resize(n);
    price_.assign(s + 1, 0);
    places_.assign(s, 0);
    label_.resize(s + 1);
    open_price_.resize(s + 1);
    via_.resize(s + 1);
    distance_.resize(s + 1);
    settled_.resize(s + 1);
    targets_.resize(s + 1);
    bounds_.assign(in.bounds.begin(), in.bounds.end());
    ledger_of_.assign(s, no_slot);
    slot ledgers = 0;
    for (std::size_t k = 0; k < s; ++k)
      if (keeps_ledger(in.bounds[k])) ledger_of_[k] = ledgers++;
    gain_.resize(ledgers * s);
    mover_.resize(ledgers * s);
    clear();
    surplus_ = 0;
    done_ = {};
  }

  /// The same agents and slots, with some other numbers; false if the slots now ask for other ledgers: then `reset`.
  [[nodiscard]] bool adopt(instance const& in) {
    if (in.agents != home_.size() || in.slots() != slots()) return false;
    for (std::size_t k = 0; k < slots(); ++k)
      if (keeps_ledger(in.bounds[k]) != (ledger_of_[k] != no_slot)) return false;
    in_ = in;
    done_ = {};
    return true;
  }

  /// Takes everybody out. Prices stay.
  void clear() {
    head_.assign(slots(), nobody);
    tail_.assign(slots(), nobody);
    count_.assign(slots(), 0);
    total_ = 0;
    ledgers_kept_ = false;
    std::fill(home_.begin(), home_.end(), no_slot);
    std::fill(gain_.begin(), gain_.end(), no_gain);
    std::fill(mover_.begin(), mover_.end(), nobody);
  }

  [[nodiscard]] instance const& problem() const noexcept { return in_; }
  [[nodiscard]] std::size_t slots() const noexcept { return bounds_.size(); }
  [[nodiscard]] std::size_t sink() const noexcept { return bounds_.size(); }
  [[nodiscard]] slot home(std::size_t a) const noexcept { return home_[a]; }
  [[nodiscard]] std::span<slot const> homes() const noexcept { return home_; }
  [[nodiscard]] std::uint32_t count(std::size_t k) const noexcept { return count_[k]; }
  [[nodiscard]] slot_bounds bounds(std::size_t k) const noexcept { return bounds_[k]; }
  void set_bounds(std::size_t k, slot_bounds b) noexcept { bounds_[k] = b; }
  [[nodiscard]] value price(std::size_t k) const noexcept { return price_[k]; }
  [[nodiscard]] std::span<value> prices() noexcept { return price_; }
  [[nodiscard]] std::span<value const> prices() const noexcept { return price_; }
  [[nodiscard]] work const& done() const noexcept { return done_; }

  static constexpr row_index nobody = ~row_index{0};
  /// The members of a slot: first(k), then next(a) until `nobody`.
  [[nodiscard]] row_index first(std::size_t k) const noexcept { return head_[k]; }
  [[nodiscard]] row_index next(row_index a) const noexcept { return next_[a]; }

  /// Begins to keep ledgers, with what members there are. Nothing may be moved by `balance` before. O(n·s)
  void keep_ledgers() {
    ledgers_kept_ = true;
    for (row_index a = 0; a < home_.size(); ++a)
      if (home_[a] != no_slot) write_down(a);
  }

  /// The utility of everybody where it is.
  [[nodiscard]] value total() const noexcept { return total_; }

  /// Puts agent a, who is nowhere, into slot j. O(1), or O(s) where j keeps a ledger.
  void put(row_index a, slot j) {
    enter(a, j);
    resting_[a] = 0;
    previous_[a] = nobody;
    next_[a] = head_[j];
    (head_[j] == nobody ? tail_[j] : previous_[head_[j]]) = a;
    head_[j] = a;
  }
  /// From now on, at the present prices, agents can `rest` who prefer their slot by `margin` at least. @pre holds nobody
  void let_rest(value margin) {
    rest_price_ = price_;
    rest_margin_ = margin;
  }
  /// Puts agent a into slot j, behind those who do not rest. O(s). @pre j keeps a ledger, and a may rest there
  void rest(row_index a, slot j) {
    enter(a, j);
    resting_[a] = 1;
    next_[a] = nobody;
    previous_[a] = tail_[j];
    (tail_[j] == nobody ? head_[j] : next_[tail_[j]]) = a;
    tail_[j] = a;
  }
  [[nodiscard]] bool has_ledger(std::size_t j) const noexcept { return ledger_of_[j] != no_slot; }

  /// Takes agent a out of its slot. O(1).
  void take(row_index a) {
    slot const j = home_[a];
    ROTA_ASSERT(j != no_slot);
    (previous_[a] == nobody ? head_[j] : next_[previous_[a]]) = next_[a];
    (next_[a] == nobody ? tail_[j] : previous_[next_[a]]) = previous_[a];
    --count_[j];
    total_ -= worth_[a];
    home_[a] = no_slot;
  }
  /// Puts agent a where it is worth most at these prices; false if every pair of it is absent. O(s).
  bool place(row_index a) {
    auto const j = static_cast<slot>(kernel::best(in_.row(a), price_.data(), slots()));
    if (!in_.present(a, j)) return false;
    put(a, j);
    return true;
  }

  /// As many places as prices ask for, where `agents` are placed: the start of balancing. O(s).
  void open_places(std::size_t agents) {
    surplus_ = -static_cast<value>(agents);
    for (std::size_t k = 0; k < slots(); ++k) {
      auto const [least, most] = bounds_[k];
      places_[k] = price_[k] > price_[sink()]   ? most
                   : price_[k] < price_[sink()] ? least
                                                : std::clamp(count_[k], least, most);
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
      furthest = std::max(furthest, p < 0 ? -p : p);
    }
    return furthest <= 4 * max_reach;
  }

  /// A node with an excess, or the sink if it has one. @pre `balance` was stuck
  [[nodiscard]] std::size_t stuck_at() const noexcept { return settled_[0]; }
  /// Agents that a slot lacks, negative if it has too many; for the sink likewise.
  [[nodiscard]] value room(std::size_t v) const noexcept {
    return v == sink() ? -surplus_ : static_cast<value>(places_[v]) - static_cast<value>(count_[v]);
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
      for (std::size_t k = 0; (k = kernel::first_tight(gain, here, price_.data(), k, slots())) < slots(); ++k)
        if (k != j && really(k)) f(k);
    };
    if (auto const at = ledger_of_[j]; at != no_slot) {
      value const* const gain = gain_.data() + at * slots();
      visit(gain, price_[j], [&](std::size_t k) {
        while (gain[k] + price_[j] >= price_[k]) {
          if (current(j, k)) return true;
          repair(j, k);
        }
        return false;
      });
    } else {
      for (auto a = head_[j]; a != nobody; a = next_[a])
        visit(in_.row(a), price_[j] - worth_[a], [](std::size_t) { return true; });
    }
  }

  /// Makes counts fit the bounds whatever it costs, by moves of fewest hops; false if that is impossible. After that the
  /// invariants of prices do not hold. For those who cannot wait for `balance`.
  bool fill_anyhow(std::size_t agents) {
    surplus_ = -static_cast<value>(agents);
    for (std::size_t k = 0; k < slots(); ++k) {
      places_[k] = std::clamp(count_[k], bounds_[k].lower, bounds_[k].upper);
      surplus_ += places_[k];
    }
    for (std::size_t v = 0; v <= sink(); ++v)
      while (room(v) < 0)
        if (!nearest_by_hops(v)) return false;
    return true;
  }

private:
  static constexpr value unreached = value{1} << 60;  // further than any sum of reduced costs
  static constexpr value closed = value{1} << 61;     // the price at which nothing is offered to a settled node
  static constexpr value no_gain = -(value{1} << 61);

  /// Below five agents, asking each is as quick as keeping books.
  static constexpr bool keeps_ledger(slot_bounds b) noexcept { return b.upper > 4; }

  // How a node was reached: from which node, by which agent; `nobody` stands for a place, or for whom the ledger names.
  static constexpr value link(row_index a, std::size_t from) noexcept {
    return static_cast<value>(std::uint64_t{a} << 32 | from);
  }
  static constexpr value no_link = -1;
  [[nodiscard]] std::size_t from(std::size_t k) const noexcept { return static_cast<slot>(via_[k]); }
  [[nodiscard]] row_index by(std::size_t k) const noexcept {
    auto const a = static_cast<row_index>(static_cast<std::uint64_t>(via_[k]) >> 32);
    return a != nobody ? a : static_cast<row_index>(mover_[ledger_of_[from(k)] * slots() + k]);
  }
  [[nodiscard]] value gain_of(row_index a, std::size_t k) const noexcept { return in_.at(a, k) - worth_[a]; }
  void enter(row_index a, slot j) {
    ROTA_ASSERT(home_[a] == no_slot);
    home_[a] = j;
    worth_[a] = in_.at(a, j);
    total_ += worth_[a];
    ++count_[j];
    if (ledgers_kept_) write_down(a);
  }
  void write_down(row_index a) {
    if (auto const at = ledger_of_[home_[a]]; at != no_slot)
      kernel::raise(in_.row(a), worth_[a], a, gain_.data() + at * slots(), mover_.data() + at * slots(), slots());
  }

  /// At least what anybody who rests in j gains by moving to k.
  [[nodiscard]] value gain_at_rest(std::size_t j, std::size_t k) const noexcept {
    return rest_price_[k] - rest_price_[j] - rest_margin_;
  }
  /// Whether the ledger of j names a member for k, with what it gains now.
  [[nodiscard]] bool current(std::size_t j, std::size_t k) const {
    auto const at = ledger_of_[j] * slots() + k;
    auto const a = static_cast<row_index>(mover_[at]);
    return a != nobody && home_[a] == j && gain_[at] == gain_of(a, k);
  }
  /// Looks for who gains most by moving from j to k: among those who do not rest; if that leaves it open, names nobody, and
  /// looks among all of them when it is called again.
  void repair(std::size_t j, std::size_t k) {
    auto const at = ledger_of_[j] * slots() + k;
    bool const all = mover_[at] == nobody;
    value best = no_gain;
    row_index who = nobody;
    auto a = head_[j];
    for (; a != nobody && (all || resting_[a] == 0); a = next_[a]) {
      value const gain = gain_of(a, k);
      bool const more = gain > best;
      best = more ? gain : best;
      who = more ? a : who;
      ++done_.relaxations;
    }
    if (a != nobody) {
      value const unseen = std::min(gain_[at], gain_at_rest(j, k));
      if (best < unseen) best = unseen, who = nobody;
    }
    gain_[at] = best;
    mover_[at] = who;
  }

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
        nearest = kernel::least(label_.data(), slots() + 1, unreached);
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
    done_.relaxations += slots();
    if (v == sink()) {
      for (std::size_t k = 0; k < slots(); ++k)
        if (may_close(k)) offer(k, base + open_price_[k], link(nobody, v));
      return kernel::least(label_.data(), slots() + 1, unreached);
    }
    if (may_open(v)) offer(sink(), base + open_price_[sink()], link(nobody, v));
    row_entry nearest{unreached, slots()};
    if (auto const at = ledger_of_[v]; at != no_slot) {
      nearest = kernel::relax(base, open_price_.data(), gain_.data() + at * slots(), link(nobody, v), label_.data(),
                              via_.data(), slots(), unreached);
    } else if (head_[v] == nobody) {
      nearest = kernel::least(label_.data(), slots(), unreached);
    } else {
      for (auto a = head_[v]; a != nobody; a = next_[a])
        nearest = kernel::relax(base + worth_[a], open_price_.data(), in_.row(a), link(a, v), label_.data(),
                                via_.data(), slots(), unreached);
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
    return k == sink() || j == sink() || ledger_of_[j] == no_slot || current(j, k);
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
      } else if (auto const at = ledger_of_[v]; at != no_slot) {
        offer(k, base - gain_[at * slots() + k], link(nobody, v));
      } else {
        for (auto a = head_[v]; a != nobody; a = next_[a]) offer(k, base - gain_of(a, k), link(a, v));
      }
    }
  }

  /// Moves agents along the way to `target`, if nobody on it has moved since it was found. All its arcs are tight.
  void send(std::size_t target) {
    std::size_t source = target;
    while (via_[source] != no_link) {
      std::size_t const j = from(source);
      bool const open = source == sink() ? may_open(j) : j == sink() ? may_close(source) : home_[by(source)] == j;
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
        for (std::size_t k = 0; k < slots(); ++k)
          if (may_close(k)) reach(k, link(nobody, v));
        continue;
      }
      if (may_open(v)) reach(sink(), link(nobody, v));
      for (auto a = head_[v]; a != nobody && end <= slots(); a = next_[a])
        for (std::size_t k = 0; k < slots(); ++k)
          if (in_.present(a, k)) reach(k, link(a, v));
    }
    return false;
  }

  instance in_;
  std::vector<slot> home_;                  // of each agent
  std::vector<value> worth_;                // of each agent in its slot
  std::vector<row_index> next_, previous_;  // members of a slot, linked, those who rest last
  std::vector<row_index> head_, tail_;
  std::vector<unsigned char> resting_;
  std::vector<value> rest_price_;
  value rest_margin_ = 0;
  bool ledgers_kept_ = false;
  value total_ = 0;
  std::vector<std::uint32_t> count_;   // members of a slot
  std::vector<std::uint32_t> places_;  // units from a slot to the sink
  std::vector<slot_bounds> bounds_;
  value surplus_ = 0;  // excess of the sink
  std::vector<value> price_;
  std::vector<slot> ledger_of_;  // of a slot, its row in the two below
  std::vector<value> gain_;      // at least what any member gains by moving
  std::vector<value> mover_;     // who
  std::vector<value> label_;     // tentative distance, `unreached` once final
  std::vector<value> open_price_;
  std::vector<value> via_;
  std::vector<value> distance_;
  std::vector<slot> settled_;
  std::vector<slot> targets_;
  std::size_t sources_ = 0;
  work done_;
};

}  // namespace rota::dense
