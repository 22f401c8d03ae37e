// CBC. Set-up is filling its model; solving is Cbc_solve on a fresh clone, made outside the time.
//
// Additive utilities are a linear program with integral vertices, which CBC gives to Clp: twenty times as fast as telling
// it of integers. For pairs it branches and bounds on Kaufman's and Broeckx's linearisation, one column per agent and slot
// for what the agent earns there with those before it; the local polytope, with a column per pair of choices, took 1 to 6
// times as long. Preprocessing, cuts and heuristics are off: with them it took 2 to 10 times as long.

#include "coin.hpp"
#include "network.hpp"
#include "searchable.hpp"

#include <algorithm>

namespace peers {
namespace {

class cbc_additive : public peer {
public:
  explicit cbc_additive(additive_instance const& in) : agents_(in.agents), net_(in) {
    for (std::size_t a = 0; a < in.agents; ++a) program_.add_row(1, 1);
    for (std::size_t s = 0; s < in.slots(); ++s) program_.add_row(in.bounds.lower[s], in.bounds.upper[s]);
    for (std::size_t e = 0; e < net_.pairs; ++e) {
      auto const& arc = net_.arcs[e];
      int const column = program_.add_column(static_cast<double>(arc.cost), 0, coin_program::infinite);
      program_.set(arc.from, column, 1);
      program_.set(arc.to, column, 1);
    }
    program_.load();
  }

  bool rewind() override {
    program_.rewind();
    return true;
  }
  bool solve() override { return program_.solve(); }
  assignment answer() const override {
    return net_.read(agents_, [&](std::size_t e) { return program_.value(static_cast<int>(e)) > 0.5; });
  }

private:
  std::size_t agents_;
  network net_;
  coin_program program_;
};

class cbc_pairwise : public peer {
public:
  explicit cbc_pairwise(pairwise_instance const& in) : model_(in) {
    choose_slots();
    for (std::size_t a = 1; a < model_.instance.agents; ++a)
      for (std::size_t s = 0; s < in.slots(); ++s) earn(a, s);
    program_.load();
  }

  bool rewind() override {
    program_.rewind();
    return true;
  }
  bool solve() override { return program_.solve(); }
  assignment answer() const override {
    return model_.original([&](std::size_t a, std::size_t s) { return program_.value(column(a, s)) > 0.5; });
  }

private:
  int column(std::size_t a, std::size_t s) const { return static_cast<int>(a * model_.instance.slots() + s); }

  void choose_slots() {
    auto const& in = model_.instance;
    for (std::size_t s = 0; s < in.slots(); ++s) program_.add_row(in.bounds.lower[s], in.bounds.upper[s]);
    for (std::size_t a = 0; a < in.agents; ++a) {
      int const one = program_.add_row(1, 1);
      for (std::size_t s = 0; s < in.slots(); ++s) {
        int const chosen = program_.add_column(-static_cast<double>(in.at(a, s)), 0, 1);
        program_.make_integer(chosen);
        program_.set(one, chosen, 1);
        program_.set(static_cast<int>(s), chosen, 1);
      }
    }
  }

  /// A column for what agent a earns in slot s with those before it: at most the sum over these, if a is there, else 0.
  void earn(std::size_t a, std::size_t s) {
    auto const& in = model_.instance;
    double least = 0;
    double most = 0;
    for (std::size_t b = 0; b < a; ++b) {
      auto const row = in.pairs.begin() + static_cast<std::ptrdiff_t>(in.table(a, b) + s * in.slots());
      auto const [low, high] = std::minmax_element(row, row + static_cast<std::ptrdiff_t>(in.slots()));
      least += static_cast<double>(*low);
      most += static_cast<double>(*high);
    }
    int const earned = program_.add_column(-1, -coin_program::infinite, coin_program::infinite);
    int const if_there = program_.add_row(-coin_program::infinite, 0);
    program_.set(if_there, earned, 1);
    program_.set(if_there, column(a, s), -most);
    int const with_those = program_.add_row(-coin_program::infinite, -least);
    program_.set(with_those, earned, 1);
    program_.set(with_those, column(a, s), -least);
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t t = 0; t < in.slots(); ++t)
        program_.set(with_those, column(b, t), -static_cast<double>(in.pair(a, s, b, t)));
  }

  searchable model_;
  coin_program program_;
};

effort of_linear(additive_instance const& in) {
  auto const pairs = in.utility.size();
  return pairs <= 10'000 ? effort::quick : pairs <= 100'000 ? effort::slow : effort::never;
}
effort of_integer(pairwise_instance const& in) {
  return in.agents <= 5 ? effort::quick : in.agents <= 10 ? effort::slow : effort::never;
}
[[maybe_unused]] bool const added = add<cbc_additive>("cbc", of_linear) && add<cbc_pairwise>("cbc", of_integer);

}  // namespace
}  // namespace peers
