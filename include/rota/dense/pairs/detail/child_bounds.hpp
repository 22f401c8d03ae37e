#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/dense/pairs/detail/cut_account.hpp>
#include <rota/dense/pairs/detail/lane_kernels.hpp>
#include <rota/dense/pairs/detail/model.hpp>
#include <rota/dense/pairs/detail/price_table.hpp>
#include <rota/dense/pairs/detail/search_path.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

namespace rota::dense::detail {

/// What a subtree must allow to be searched, in quanta.
struct value_bar {
  static constexpr std::int32_t none = (std::numeric_limits<std::int32_t>::min)();

  std::int32_t enough = none;  ///< a subtree that allows no more has nothing better than the best
  std::int32_t par = none;     ///< a subtree that allows just this may be as good as the best; or `none`
  bool tied = false;           ///< an assignment as good as the best may have been cut

  /// Whether nothing in a subtree can be better than the best.
  bool cuts(std::int32_t allowed) {
    tied |= allowed == par;
    return allowed <= enough;
  }
};

/// Makes the children of a node, without those that cannot be better than the best.
///
/// Children are cut twice: by the bounds of the node, which are known for all slots at once; then each by its own.
class child_bounds {
public:
  void prepare(pair_model const& model, suffix_bounds const& suffix, price_table& prices, search_path& path,
               value_bar& bar, cut_account& account) {
    model_ = &model;
    suffix_ = &suffix;
    prices_ = &prices;
    path_ = &path;
    bar_ = &bar;
    account_ = &account;
    agents_ = model.agents();
    slots_ = model.slot_count();
    kernel_ = choose_child_kernel(model.stride(), model.floored());
    children_.resize(agents_ * slots_);
    fields_of_child_.resize(slots_ * model.stride());
    no_table_.assign(slots_ * model.stride(), 0);
    price_stride_ = (std::max)(slots_, price_table::most_slots);
    child_prices_.resize(slots_ * price_stride_);
    job_.resize(slots_);
    sums_.resize(slots_);
    most_by_slot_.fill(0);
    credit_.assign(agents_ + 1, first_credit);
    placements_ = 0;
    tries_ = 0;
  }

  /// Placements tried.
  [[nodiscard]] std::uint64_t placements() const { return placements_; }

  /// Makes the children of the node at depth d that may be better than the best, the most promising first.
  /// @param self the node, as a child of its parent
  void grow(std::size_t d, pair_child const& self) {
    pair_node& node = path_->node(d);
    pair_child* const list = &children_[d * slots_];
    node.next = node.last = list;
    lane_node const lanes = path_->lanes(d);
    std::int32_t others = (std::numeric_limits<std::int32_t>::max)() / 2;
    if (suffix_->counted(d)) {
      others = others_allow(d, lanes, self);
      if (others == value_bar::none) return;
    } else {
      most_by_slot_.fill(0);
    }
    std::size_t const open = cut_by_node(d, lanes, candidates(d), others, list);
    std::size_t const ready = set_job(d, lanes, list, open);
    placements_ += ready;
    kernel_(lanes, job_.data(), ready, sums_.data());
    node.last = list + cut_by_own(d, lanes, list, ready);
  }

private:
  static constexpr std::int32_t first_credit = 200;  // improvements of prices tried at a depth, without success
  static constexpr std::uint32_t try_every = 64;     // and besides, one of so many
  static constexpr std::size_t few = 4;              // agents left: too few for prices to be improved

  /// What the next agent gets in each slot, a stride apart.
  static lane const* next_field(lane_node const& lanes) { return lanes.fields + lanes.first - 1; }

  /// The value of the node plus a bound on the gains of the agents after the next one, at the prices of its counts; sets
  /// `most_by_slot_`.
  /// `value_bar::none` if that cuts the node.
  std::int32_t others_allow(std::size_t d, lane_node const& lanes, pair_child const& self) {
    pair_node const& node = path_->node(d);
    price_table::state& s = prices_->at(d, node.counts);
    std::int32_t all = self.rest;
    if (s.version != self.price_version) [[unlikely]] {
      // Prices have changed since: they may even cut the node.
      lane_node const with_next{lanes.fields, lanes.slot_count, lanes.stride, lanes.first - 1, lanes.floor};
      lane_child const itself{no_table_.data(), s.prices.data()};
      kernel_(with_next, &itself, 1, &all);
      ++placements_;
      std::int32_t const allowed = node.value + all + s.most;
      if (bar_->cuts(allowed)) {
        account_->tell_bound(path_->at(), d, no_slot, allowed);
        ++account_->tally(d).by_bound;
        return value_bar::none;
      }
    }
    if (!s.by_slot) prices_->bound_by_slot(s);
    std::copy(s.most_by_slot.begin(), s.most_by_slot.end(), most_by_slot_.begin());
    lane const* const field = next_field(lanes);
    std::int32_t next = (std::numeric_limits<std::int32_t>::min)();
    for (std::size_t y = 0; y < slots_; ++y) next = std::max<std::int32_t>(next, field[y * lanes.stride] - s.prices[y]);
    return node.value + all - next;
  }

  /// The slots that the next agent may take, as far as counts, presence and symmetry go.
  std::uint64_t candidates(std::size_t d) {
    pair_tally& tally = account_->tally(d + 1);
    std::uint64_t slot_set = path_->open(d);
    std::uint64_t const all = path_->all_slots();
    if (slot_set != all) {
      tally.by_cardinality += size_of(all & ~slot_set);
      account_->tell_all(path_->at(), d, all & ~slot_set, pair_cut::cardinality);
    }
    if (std::uint64_t const absent_from = slot_set & ~path_->candidates(d); absent_from != 0) {
      tally.by_absence += size_of(absent_from);
      account_->tell_all(path_->at(), d, absent_from, pair_cut::absence);
      slot_set &= ~absent_from;
    }
    if (std::uint64_t const earlier = slot_set & path_->before_twin(d); earlier != 0) {
      tally.by_symmetry += size_of(earlier);
      account_->tell_all(path_->at(), d, earlier, pair_cut::symmetry);
      slot_set &= ~earlier;
    }
    return slot_set;
  }

  /// Lists the children that the node itself allows. @return how many
  std::size_t cut_by_node(std::size_t d, lane_node const& lanes, std::uint64_t slot_set, std::int32_t others,
                          pair_child* list) {
    lane const* const field = next_field(lanes);
    std::int32_t const* const shares = model_->shares(d);
    std::int32_t const value = path_->node(d).value;
    value_bar bar = *bar_;
    std::size_t tried = 0;
    std::size_t count = 0;
    // No branches: nobody could predict them.
    for (std::uint64_t s = slot_set; s != 0; s &= s - 1, ++tried) {
      auto const x = static_cast<std::size_t>(std::countr_zero(s));
      std::int32_t const own = field[x * lanes.stride];
      list[count].value = value + own + shares[x];
      list[count].at = static_cast<slot>(x);
      count += bar.cuts(others + own + most_by_slot_[x]) ? 0U : 1U;
    }
    bar_->tied = bar.tied;
    account_->tally(d + 1).by_bound += tried - count;
    if (account_->heard())
      for (std::uint64_t s = slot_set; s != 0; s &= s - 1) {
        auto const x = static_cast<std::size_t>(std::countr_zero(s));
        std::int32_t const allowed = others + field[x * lanes.stride] + most_by_slot_[x];
        if (bar.cuts(allowed)) account_->tell_bound(path_->at(), d, static_cast<slot>(x), allowed);
      }
    return count;
  }

  /// Sets the kernel's input for each child, without those that turn out impossible. @return how many are left
  std::size_t set_job(std::size_t d, lane_node const& lanes, pair_child* list, std::size_t count) {
    bool const counted = suffix_->counted(d + 1);
    lane const* const field = next_field(lanes);
    packed_counts const counts = path_->node(d).counts;
    std::size_t ready = 0;
    for (std::size_t i = 0; i < count; ++i) {
      pair_child& c = list[ready];
      c.value = list[i].value;
      c.at = list[i].at;
      if (model_->dead(field[c.at * lanes.stride])) {
        ++account_->tally(d + 1).by_absence;
        account_->tell_all(path_->at(), d, std::uint64_t{1} << c.at, pair_cut::absence);
        continue;
      }
      lane* const prices = &child_prices_[ready * price_stride_];
      if (!counted) {
        c.allowed = suffix_->greatest(d + 1);
        price_full_slots(c.at, prices);
      } else if (!take_prices(d + 1, counts, c, prices)) {
        ++account_->tally(d + 1).by_cardinality;
        account_->tell_all(path_->at(), d, std::uint64_t{1} << c.at, pair_cut::cardinality);
        continue;
      }
      job_[ready++] = {model_->table(d, c.at), prices};
    }
    return ready;
  }

  /// Takes prices and bound of the counts that the child has. @return false if they grow into no final counts
  bool take_prices(std::size_t depth, packed_counts counts, pair_child& c, lane* prices) {
    price_table::state const& s = prices_->at(depth, counts + suffix_->space().unit(c.at));
    if (s.most == price_table::impossible) return false;
    c.allowed = s.most;
    c.price_version = s.version;
    std::memcpy(prices, s.prices.data(), sizeof s.prices);  // the next call of at() may overwrite the state
    return true;
  }

  /// Where counts bound nothing: nobody goes to a full slot, and the others are free.
  void price_full_slots(slot at, lane* prices) const {
    for (std::size_t y = 0; y < slots_; ++y)
      prices[y] = (at == y ? path_->filled_by_one_more(y) : path_->full(y)) ? pair_model::most_price - 1 : 0;
  }

  /// Cuts children by their own bounds, and sorts the others. @return how many are left
  std::size_t cut_by_own(std::size_t d, lane_node const& lanes, pair_child* list, std::size_t ready) {
    bool const improvable = suffix_->counted(d + 1) && agents_ - d - 1 >= few;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < ready; ++i) {
      pair_child c = list[i];
      c.rest = sums_[i];
      c.allowed += c.value + c.rest;
      if (c.allowed > bar_->enough && improvable) improve(d, lanes, c);
      if (bar_->cuts(c.allowed)) {
        account_->tell_bound(path_->at(), d, c.at, c.allowed);
        continue;
      }
      std::size_t at = kept++;
      for (; at > 0 && list[at - 1].allowed < c.allowed; --at) list[at] = list[at - 1];
      list[at] = c;
    }
    account_->tally(d + 1).by_bound += ready - kept;
    return kept;
  }

  /// Looks for better prices for a child that is not cut, now and then: at first everywhere, then where it helped.
  void improve(std::size_t d, lane_node const& lanes, pair_child& c) {
    bool const due = ++tries_ % try_every == 0;
    std::int32_t& credit = credit_[d + 1];
    if (!due && credit <= 0) return;
    price_table::state& s = prices_->at(d + 1, path_->node(d).counts + suffix_->space().unit(c.at));
    if (!due && s.credit <= 0) return;
    --s.credit;
    --credit;
    place(lanes, model_->table(d, c.at), fields_of_child_.data());
    lane_node const below{fields_of_child_.data(), slots_, lanes.stride, lanes.first, lanes.floor};
    c.allowed = prices_->improve(s, below, c.value, c.allowed, bar_->enough);
    if (c.allowed > bar_->enough) return;
    s.credit = static_cast<std::int16_t>(s.credit + price_table::first_credit);
    credit += price_table::first_credit;
  }

  pair_model const* model_ = nullptr;
  suffix_bounds const* suffix_ = nullptr;
  price_table* prices_ = nullptr;
  search_path* path_ = nullptr;
  value_bar* bar_ = nullptr;
  cut_account* account_ = nullptr;
  child_kernel kernel_ = nullptr;
  std::size_t agents_ = 0;
  std::size_t slots_ = 0;
  std::size_t price_stride_ = 0;
  std::uint64_t placements_ = 0;
  std::uint32_t tries_ = 0;
  std::array<std::int32_t, max_pair_slots> most_by_slot_{};  // [slot]: bound on the suffix with the next agent there
  buffer<std::int32_t> credit_;                              // [depth]
  buffer<pair_child> children_;                              // [depth, …]
  buffer<lane> fields_of_child_;                             // [slot, lane]
  buffer<lane> no_table_;                                    // placing nobody adds nothing
  buffer<lane> child_prices_;                                // [child, slot]
  buffer<lane_child> job_;                                   // [child]
  buffer<std::int32_t> sums_;                                // [child]
};

}  // namespace rota::dense::detail
