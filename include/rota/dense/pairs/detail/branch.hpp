#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/price_table.hpp>
#include <rota/dense/pairs/instance.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

namespace rota::dense::detail {

/// The best assignment that a search has seen, by the caller's numbers.
struct pair_best {
  bool found = false;
  std::int64_t value = pair_model::nothing;
  buffer<slot> assignment;
};

/// Depth-first branch and bound over agents by rank, the most promising slot first; iterative.
///
/// A child is cut when what `suffix_bounds` and `price_table` allow it is not above the best value, when its counts grow
/// into no final counts, when it contains something forbidden, or when an interchangeable agent before it took a later
/// slot. Twice: by the bounds of the node, which are known for all slots at once, then by its own.
/// Class invariant: cut, open and evaluated assignments add up to all. O(n·m·stride) memory.
class pair_branch {
public:
  void prepare(pair_model const& model, suffix_bounds const& suffix, price_table& prices,
               std::span<std::uint32_t const> lower, std::span<std::uint32_t const> upper) {
    model_ = &model;
    suffix_ = &suffix;
    prices_ = &prices;
    lower_ = lower;
    upper_ = upper;
    agents_ = model.agents();
    slots_ = model.slot_count();
    row_ = slots_ * model.stride();
    kernel_ = choose_lane_kernel(model.stride(), model.floored());
    frames_.resize(agents_ + 1);
    children_.resize(agents_ * slots_);
    fields_.resize((agents_ + 1) * row_);
    scratch_.resize(row_);
    zeros_.assign(row_, 0);
    at_.assign(agents_, no_slot);
    partial_.resize(agents_);
    price_stride_ = (std::max)(slots_, price_table::most_slots);
    child_prices_.resize(slots_ * price_stride_);
    job_.resize(slots_);
    sums_.resize(slots_);
    allowed_.assign(agents_, ~std::uint64_t{0});
    present_.resize(agents_);
    most_by_.fill(0);
    tallies_.assign(agents_ + 1, {});
    saved_.assign(agents_ + 1, {});
    nodes_ = 0;
    tries_ = 0;
    tied_ = false;
    bound_ = pair_model::nothing;
    credit_.assign(agents_ + 1, first_credit);
  }

  /// Improves on the best until it is proved to be the best, or the budget is spent. @return whether it is proved
  template <class Observer>
  bool run(pair_best& best, std::uint64_t budget, stop_request const& stop, Observer& observer) {
    settling_ = false;
    aim(best, best.value);
    return descend(best, budget, stop, observer) == end::exhausted;
  }

  /// Among equals of the best: finds the lexicographically smallest assignment. @return whether it is proved
  ///
  /// Agent by agent in the caller's order: is there an equal one with a smaller slot here and the same slots before?
  /// The searches are over disjoint parts, so that all together cost about one proof. The account stays as it is.
  /// @pre `run` has proved the best
  bool settle(pair_best& best, std::uint64_t budget, stop_request const& stop) {
    no_observer nobody;
    settling_ = true;
    saved_ = tallies_;
    bool proved = true;
    for (std::size_t a = 0; a < agents_ && proved; ++a) {
      std::size_t const rank = model_->rank_of(a);
      while (proved) {
        std::uint64_t const earlier = (std::uint64_t{1} << best.assignment[a]) - 1;
        if ((earlier & present_at(rank)) == 0) break;
        allowed_[rank] = earlier;
        aim(best, best.value - 1);
        end const how = descend(best, budget, stop, nobody);
        if (how == end::exhausted) break;
        proved = how == end::found;
      }
      allowed_[rank] = std::uint64_t{1} << best.assignment[a];
    }
    tallies_.swap(saved_);
    return proved;
  }

  /// Whether some other assignment may be worth as much as the best.
  [[nodiscard]] bool tied() const { return tied_; }
  /// Placements tried.
  [[nodiscard]] std::uint64_t nodes() const { return nodes_; }
  /// If `run` was stopped: no assignment that is still open is worth more.
  [[nodiscard]] std::int64_t open_bound() const { return bound_; }
  [[nodiscard]] std::span<pair_tally const> account() const { return tallies_; }

private:
  enum class end { exhausted, stopped, found };
  static constexpr std::uint64_t poll_every = 512;
  static constexpr std::int32_t first_credit = 200;  // improvements of prices tried at a depth, without success
  static constexpr std::uint32_t try_every = 64;     // and besides, one of so many
  static constexpr std::size_t few = 4;              // agents left: too few for prices to be improved
  static constexpr std::int32_t cut_off = (std::numeric_limits<std::int32_t>::min)();

  struct child {
    std::int32_t allowed = 0;  // at most, by the bounds
    std::int32_t value = 0;    // of the agents placed
    std::int32_t rest = 0;     // what the unplaced allow at the prices of that version
    std::uint32_t version = 0;
    slot at = 0;
  };
  struct frame {
    child* next = nullptr;
    child* last = nullptr;
    packed_counts counts = 0;
    std::uint64_t open = 0;     // slots that take more
    std::uint64_t wanting = 0;  // slots below their lower bound
    std::int32_t value = 0;
    std::uint32_t missing = 0;  // agents that lower bounds still ask for
  };

  static std::uint64_t number_of(std::uint64_t slot_set) {
    std::uint64_t count = 0;
    for (; slot_set != 0; slot_set &= slot_set - 1) ++count;
    return count;
  }
  [[nodiscard]] std::uint64_t all_slots() const {
    return slots_ == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << slots_) - 1;
  }
  [[nodiscard]] std::uint64_t present_at(std::size_t d) const {
    std::uint64_t present = 0;
    for (std::size_t x = 0; x < slots_; ++x) present |= model_->present(d, x) ? std::uint64_t{1} << x : 0;
    return present;
  }
  [[nodiscard]] lane_node node_at(std::size_t d) const {
    return {&fields_[d * row_], slots_, model_->stride(), model_->lane_of(d + 1), model_->floor()};
  }

  /// From now on, what allows no value above `value` is cut.
  void aim(pair_best const& best, std::int64_t value) {
    enough_ = model_->quanta(value);
    // Only a cut that allows exactly this much can hide an equal of the best.
    par_ = best.found && model_->exact(enough_) == best.value ? enough_ : cut_off;
  }

  void start() {
    std::copy(model_->fields().begin(), model_->fields().end(), fields_.begin());
    for (std::size_t d = 0; d < agents_; ++d) {
      std::uint64_t const present = present_at(d);
      present_[d] = present & allowed_[d];
      for (std::uint64_t out = present & ~allowed_[d]; out != 0; out &= out - 1)
        fields_[static_cast<std::size_t>(std::countr_zero(out)) * model_->stride() + model_->lane_of(d)] =
            model_->repellent(d);
    }
    count_.assign(slots_, 0);
    frame& root = frames_[0];
    root = {};
    for (std::size_t s = 0; s < slots_; ++s) {
      root.missing += lower_[s];
      root.open |= upper_[s] > 0 ? std::uint64_t{1} << s : 0;
      root.wanting |= lower_[s] > 0 ? std::uint64_t{1} << s : 0;
    }
  }

  template <class Observer>
  end descend(pair_best& best, std::uint64_t budget, stop_request const& stop, Observer& observer) {
    std::size_t const last = agents_ - 1;
    bool const counted = suffix_->counted(agents_);
    std::uint64_t poll = nodes_ + poll_every;
    std::uint64_t pause = (std::min)(poll, budget);
    start();
    std::size_t d = 0;
    grow(0, {}, observer);
    for (;;) {
      frame& f = frames_[d];
      if (f.next == f.last) {
        if (d == 0) return end::exhausted;
        --count_[at_[--d]];
        continue;
      }
      if (nodes_ >= pause) {
        if (nodes_ >= budget || stop()) return leave(d);
        poll = nodes_ + poll_every;
        pause = (std::min)(poll, budget);
      }
      child const c = *f.next++;
      if (c.allowed <= enough_) {
        tied_ |= c.allowed == par_;
        cut(observer, d, c.at, c.allowed);
        ++tallies_[d + 1].by_bound;
        continue;
      }
      at_[d] = c.at;
      if (d == last) {
        ++tallies_[agents_].leaves;
        if (evaluate(best)) return end::found;
        continue;
      }
      place(node_at(d), model_->table(d, c.at), &fields_[(d + 1) * row_]);
      std::uint32_t const count = ++count_[c.at];
      std::uint64_t const bit = std::uint64_t{1} << c.at;
      frame& g = frames_[++d];
      g.value = c.value;
      g.counts = counted ? f.counts + suffix_->space().unit(c.at) : 0;
      g.missing = f.missing - (count <= lower_[c.at] ? 1 : 0);
      g.open = count == upper_[c.at] ? f.open & ~bit : f.open;
      g.wanting = count == lower_[c.at] ? f.wanting & ~bit : f.wanting;
      grow(d, c, observer);
    }
  }

  /// Stopped: what is open, and what it allows.
  end leave(std::size_t d) {
    for (std::size_t i = 0; i <= d; ++i) {
      frame const& f = frames_[i];
      if (f.next == f.last) continue;
      tallies_[i + 1].open += static_cast<std::uint64_t>(f.last - f.next);
      bound_ = (std::max)(bound_, model_->exact(f.next->allowed));  // the first allows most
    }
    return end::stopped;
  }

  /// A complete assignment. @return whether that is all that was asked for
  bool evaluate(pair_best& best) {
    for (std::size_t r = 0; r < agents_; ++r) partial_[model_->agent_at(r)] = at_[r];
    std::int64_t const value = model_->value(partial_);
    if (settling_) {
      if (value < best.value) return false;
      best.assignment = partial_;
      return true;
    }
    if (value <= best.value) {
      tied_ |=
          best.found && value == best.value && !std::equal(partial_.begin(), partial_.end(), best.assignment.begin());
      return false;
    }
    best.found = true;
    best.value = value;
    best.assignment = partial_;
    tied_ = false;
    aim(best, value);
    return false;
  }

  /// The children of the node at depth d that may be better than the best, the most promising first.
  template <class Observer>
  void grow(std::size_t d, child const& self, Observer& observer) {
    std::size_t const e = d + 1;
    pair_model const& model = *model_;
    frame& f = frames_[d];
    child* const list = &children_[d * slots_];
    f.next = f.last = list;
    pair_tally& tally = tallies_[e];
    lane_node const node = node_at(d);
    lane const* const field = node.fields + model.lane_of(d);
    std::int32_t others = (std::numeric_limits<std::int32_t>::max)() / 2;
    if (suffix_->counted(d)) {
      others = others_allow(d, f, self, observer);
      if (others == cut_off) return;
    } else {
      most_by_.fill(0);
    }
    std::uint64_t const slot_set = candidates(d, f, observer);
    // By what the node itself allows. Without branches, for nobody could predict them.
    std::int32_t const* const shares = model.shares(d);
    std::size_t tried = 0;
    std::size_t count = 0;
    bool par = false;
    for (std::uint64_t s = slot_set; s != 0; s &= s - 1) {
      auto const x = static_cast<std::size_t>(std::countr_zero(s));
      std::int32_t const own = field[x * node.stride];
      std::int32_t const allowed = others + own + most_by_[x];
      list[count].value = f.value + own + shares[x];
      list[count].at = static_cast<slot>(x);
      count += allowed > enough_ ? 1 : 0;
      par |= allowed == par_;
      ++tried;
      if (allowed <= enough_) cut(observer, d, static_cast<slot>(x), allowed);
    }
    tied_ |= par;
    std::size_t const ready = prepare_job(d, f, list, count, observer);
    std::size_t const impossible = count - ready;
    nodes_ += ready;
    kernel_(node, job_.data(), ready, sums_.data());
    bool const improvable = suffix_->counted(e) && agents_ - e >= few;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < ready; ++i) {
      child c = list[i];
      c.rest = sums_[i];
      c.allowed += c.value + c.rest;
      if (c.allowed > enough_ && improvable) improve(node, e, f.counts, c);
      if (c.allowed <= enough_) {
        tied_ |= c.allowed == par_;
        cut(observer, d, c.at, c.allowed);
        continue;
      }
      std::size_t at = kept++;
      for (; at > 0 && list[at - 1].allowed < c.allowed; --at) list[at] = list[at - 1];
      list[at] = c;
    }
    tally.by_bound += tried - impossible - kept;
    f.last = list + kept;
  }

  /// The slots that the next agent could take, as far as counts, presence and symmetry go.
  template <class Observer>
  std::uint64_t candidates(std::size_t d, frame const& f, Observer& observer) {
    pair_tally& tally = tallies_[d + 1];
    std::uint64_t slot_set = f.missing >= agents_ - d ? f.open & f.wanting : f.open;
    std::uint64_t const all = all_slots();
    if (slot_set != all) {
      tally.by_cardinality += number_of(all & ~slot_set);
      cut_all(observer, d, all & ~slot_set, pair_cut::cardinality);
    }
    if (std::uint64_t const out = slot_set & ~present_[d]; out != 0) {
      tally.by_absence += number_of(out);
      cut_all(observer, d, out, pair_cut::absence);
      slot_set &= present_[d];
    }
    if (std::uint32_t const twin = model_->twin_before(d); twin != no_slot) {
      std::uint64_t const earlier = slot_set & ((std::uint64_t{1} << at_[twin]) - 1);
      tally.by_symmetry += number_of(earlier);
      cut_all(observer, d, earlier, pair_cut::symmetry);
      slot_set &= ~earlier;
    }
    return slot_set;
  }

  /// What the node has and the agents after the next one allow, at the prices of its state; sets most_by_. Or `cut_off`.
  template <class Observer>
  std::int32_t others_allow(std::size_t d, frame const& f, child const& self, Observer& observer) {
    price_table::state& s = prices_->at(d, f.counts);
    lane_node const node = node_at(d);
    std::int32_t all = self.rest;
    if (s.version != self.version) [[unlikely]] {
      // Other prices by now: they may even cut the node.
      lane_node const whole{node.fields, node.slot_count, node.stride, node.first - 1, node.floor};
      lane_child const itself{zeros_.data(), s.prices.data()};
      kernel_(whole, &itself, 1, &all);
      ++nodes_;
      std::int32_t const allowed = f.value + all + s.most;
      if (allowed <= enough_) {
        tied_ |= allowed == par_;
        cut(observer, d, no_slot, allowed);
        ++tallies_[d].by_bound;
        return cut_off;
      }
    }
    if (!s.by_slot) prices_->split(s);
    std::copy(s.most_by.begin(), s.most_by.end(), most_by_.begin());
    lane const* const field = node.fields + node.first - 1;
    std::int32_t own = (std::numeric_limits<std::int32_t>::min)();
    for (std::size_t y = 0; y < slots_; ++y) own = std::max<std::int32_t>(own, field[y * node.stride] - s.prices[y]);
    return f.value + all - own;
  }

  /// Sets what the kernel needs for each child, without those that turn out impossible. @return how many are left
  template <class Observer>
  std::size_t prepare_job(std::size_t d, frame const& f, child* list, std::size_t count, Observer& observer) {
    std::size_t const e = d + 1;
    pair_model const& model = *model_;
    pair_tally& tally = tallies_[e];
    bool const counted = suffix_->counted(e);
    lane const* const field = &fields_[d * row_] + model.lane_of(d);
    std::size_t ready = 0;
    for (std::size_t i = 0; i < count; ++i) {
      child& c = list[ready];
      c.value = list[i].value;
      c.at = list[i].at;
      if (model.dead(field[c.at * model.stride()])) {
        ++tally.by_absence;
        cut_all(observer, d, std::uint64_t{1} << c.at, pair_cut::absence);
        continue;
      }
      lane* const prices = &child_prices_[ready * price_stride_];
      if (counted) {
        price_table::state const& s = prices_->at(e, f.counts + suffix_->space().unit(c.at));
        if (s.most == price_table::impossible) {
          ++tally.by_cardinality;
          cut_all(observer, d, std::uint64_t{1} << c.at, pair_cut::cardinality);
          continue;
        }
        c.allowed = s.most;
        c.version = s.version;
        std::memcpy(prices, s.prices.data(), sizeof s.prices);  // at() may overwrite the state
      } else {
        c.allowed = suffix_->greatest(e);
        for (std::size_t y = 0; y < slots_; ++y)
          prices[y] = count_[y] + (c.at == y ? 1 : 0) == upper_[y] ? pair_model::most_price - 1 : 0;
      }
      job_[ready++] = {model.table(d, c.at), prices};
    }
    return ready;
  }

  /// Better prices for a child that is not cut, now and then: at first everywhere, then where it helped.
  void improve(lane_node const& node, std::size_t e, packed_counts counts, child& c) {
    bool const due = ++tries_ % try_every == 0;
    if (!due && credit_[e] <= 0) return;
    price_table::state& s = prices_->at(e, counts + suffix_->space().unit(c.at));
    if (!due && s.credit <= 0) return;
    --s.credit;
    --credit_[e];
    place(node, model_->table(e - 1, c.at), scratch_.data());
    lane_node const below{scratch_.data(), slots_, node.stride, node.first, node.floor};
    c.allowed = prices_->improve(s, below, c.value, c.allowed, enough_);
    if (c.allowed > enough_) return;
    s.credit = static_cast<std::int16_t>(s.credit + price_table::first_credit);
    credit_[e] += price_table::first_credit;
  }

  /// Tells an observer about the child of the node at depth d in slot x; or about the node, if x is no_slot.
  template <class Observer>
  void cut(Observer& observer, std::size_t d, slot x, std::int32_t allowed) {
    if constexpr (!std::is_same_v<Observer, no_observer>)
      observer(placed(d, x), pair_cut::bound, model_->exact(allowed));
  }
  template <class Observer>
  void cut_all(Observer& observer, std::size_t d, std::uint64_t slot_set, pair_cut why) {
    if constexpr (!std::is_same_v<Observer, no_observer>)
      for (; slot_set != 0; slot_set &= slot_set - 1)
        observer(placed(d, static_cast<slot>(std::countr_zero(slot_set))), why, pair_model::nothing);
  }
  std::span<slot const> placed(std::size_t d, slot x) {
    std::fill(partial_.begin(), partial_.end(), no_slot);
    for (std::size_t r = 0; r < d; ++r) partial_[model_->agent_at(r)] = at_[r];
    if (x != no_slot) partial_[model_->agent_at(d)] = x;
    return partial_;
  }

  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::size_t row_ = 0;  // lanes of the fields of a node
  std::size_t price_stride_ = 0;
  std::int32_t enough_ = 0;  // quanta that allow nothing better
  std::int32_t par_ = 0;     // quanta that allow just the best value
  std::uint64_t nodes_ = 0;
  std::uint32_t tries_ = 0;
  bool settling_ = false;
  bool tied_ = false;
  std::int64_t bound_ = 0;
  pair_model const* model_ = nullptr;
  suffix_bounds const* suffix_ = nullptr;
  price_table* prices_ = nullptr;
  lane_kernel kernel_ = nullptr;
  std::span<std::uint32_t const> lower_;
  std::span<std::uint32_t const> upper_;
  std::array<std::int32_t, max_pair_slots> most_by_{};
  buffer<std::int32_t> credit_;    // [depth]
  buffer<std::uint64_t> allowed_;  // [rank]: slots, as bits
  buffer<std::uint64_t> present_;  // [rank]: of these, the ones there are
  buffer<std::uint32_t> count_;    // [slot]
  buffer<slot> at_;                // [rank]
  buffer<slot> partial_;           // [agent]
  buffer<frame> frames_;           // [depth]
  buffer<child> children_;         // [depth, …]
  buffer<lane> fields_;            // [depth, slot, lane]
  buffer<lane> scratch_;
  buffer<lane> zeros_;
  buffer<lane> child_prices_;
  buffer<lane_child> job_;
  buffer<std::int32_t> sums_;
  buffer<pair_tally> tallies_;  // [depth]
  buffer<pair_tally> saved_;
};

}  // namespace rota::dense::detail
