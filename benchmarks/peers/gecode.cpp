// Gecode's depth-first branch and bound on one thread. Set-up is posting the model; solving is the search, root
// propagation included, on a clone of the model. Agents in order of their coupling, for each first the slot that earns
// most with those already placed, and a copy per node: of orders by size, by failures, least slots first, recomputation
// and a redundant bound per agent none was faster.

#include "searchable.hpp"

#include <gecode/int.hh>
#include <gecode/minimodel.hh>
#include <gecode/search.hh>

#include <limits>

namespace peers {
namespace {

using Gecode::IntArgs;
using Gecode::IntVar;
using Gecode::IntVarArgs;

class model : public Gecode::IntMaximizeSpace {
public:
  /// @pre `in` outlives it and its copies
  explicit model(pairwise_instance const& in)
      : in_(&in), slots(*this, static_cast<int>(in.agents), 0, static_cast<int>(in.slots()) - 1) {
    auto const m = in.slots();
    Gecode::IntSetArgs cardinalities(static_cast<int>(m));
    IntArgs values(static_cast<int>(m));
    for (std::size_t s = 0; s < m; ++s) {
      auto const i = static_cast<int>(s);
      cardinalities[i] = Gecode::IntSet(static_cast<int>(in.bounds.lower[s]), static_cast<int>(in.bounds.upper[s]));
      values[i] = i;
    }
    Gecode::count(*this, slots, cardinalities, values);

    IntVarArgs terms;
    for (std::size_t a = 0; a < in.agents; ++a) {
      IntArgs const row = entries(in.unary, a * m, m);
      IntVar const u(*this, least(row), most(row));
      Gecode::element(*this, row, slots[static_cast<int>(a)], u);
      terms << u;
    }
    for (std::size_t a = 1; a < in.agents; ++a)
      for (std::size_t b = 0; b < a; ++b) {
        IntArgs const table = entries(in.pairs, in.table(a, b), m * m);
        IntVar const u(*this, least(table), most(table));
        auto const width = static_cast<int>(m);
        Gecode::element(*this, table, slots[static_cast<int>(b)], width, slots[static_cast<int>(a)], width, u);
        terms << u;
      }
    std::int64_t low = 0;
    std::int64_t high = 0;
    for (IntVar const& u : terms) {
      low += u.min();
      high += u.max();
    }
    total_ = IntVar(*this, static_cast<int>(low), static_cast<int>(high));
    Gecode::linear(*this, terms, Gecode::IRT_EQ, total_);
    Gecode::branch(*this, slots, Gecode::INT_VAR_NONE(), Gecode::INT_VAL(&best_slot));
  }

  Space* copy() override { return new model(*this); }
  IntVar cost() const override { return total_; }

private:
  explicit model(model& other) : Gecode::IntMaximizeSpace(other), in_(other.in_) {
    slots.update(*this, other.slots);
    total_.update(*this, other.total_);
  }

  static IntArgs entries(std::vector<std::int64_t> const& from, std::size_t first, std::size_t n) {
    IntArgs out(static_cast<int>(n));
    for (std::size_t i = 0; i < n; ++i) out[static_cast<int>(i)] = static_cast<int>(from[first + i]);
    return out;
  }
  static int least(IntArgs const& x) { return *std::min_element(x.begin(), x.end()); }
  static int most(IntArgs const& x) { return *std::max_element(x.begin(), x.end()); }

  /// Where agent i earns most by itself and with the agents before it, which have their slots.
  static int best_slot(Space const& home, IntVar x, int i) {
    auto const& self = static_cast<model const&>(home);
    auto const a = static_cast<std::size_t>(i);
    auto best = std::numeric_limits<std::int64_t>::min();
    int slot = x.min();
    for (Gecode::IntVarValues v(x); v(); ++v) {
      auto const s = static_cast<std::size_t>(v.val());
      std::int64_t earned = self.in_->at(a, s);
      for (std::size_t b = 0; b < a; ++b)
        earned += self.in_->pair(a, s, b, static_cast<std::size_t>(self.slots[static_cast<int>(b)].val()));
      if (earned <= best) continue;
      best = earned;
      slot = v.val();
    }
    return slot;
  }

  pairwise_instance const* in_;
  IntVar total_;

public:
  Gecode::IntVarArray slots;
};

class gecode : public peer {
public:
  explicit gecode(pairwise_instance const& in) : model_(in), root_(model_.instance) {}

  bool solve() override {
    Gecode::Search::Options options;
    options.threads = 1;
    options.c_d = 1;
    Gecode::BAB<model> search(&root_, options);
    best_.reset();
    while (model* const better = search.next()) best_.reset(better);
    return best_ != nullptr;
  }

  assignment answer() const override {
    return model_.original(
        [&](std::size_t a, std::size_t s) { return best_->slots[static_cast<int>(a)].val() == static_cast<int>(s); });
  }

private:
  searchable model_;
  model root_;
  std::unique_ptr<model> best_;
};

/// Its integers have 32 bits.
effort of_branching(pairwise_instance const& in) {
  return in.agents <= 8 ? effort::quick : in.agents <= 10 ? effort::slow : effort::never;
}
[[maybe_unused]] bool const added = add<gecode>("gecode", of_branching);

}  // namespace
}  // namespace peers
