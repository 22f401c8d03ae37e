#pragma once
/// @file
/// Many allocations boiled down to one number, which must be the same whatever compiled and ran the program.

#include <rota/dense/pairs/solver.hpp>
#include <rota/search/reallocate.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace digest {

/// What it must come to.
inline constexpr std::uint64_t expected = 0x4d2b4176de63c070;

/// The same of pairwise utilities, large enough for every part of their solver.
inline constexpr std::uint64_t expected_of_pairs = 0xaae60531eda45f87;

/// SplitMix64: numbers that need no library.
class stream {
public:
  explicit stream(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t below(std::uint64_t n) { return bits() % n; }
  /// A number in [0, 1) with 53 bits.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

private:
  std::uint64_t state_;
};

class hash {
public:
  void add(std::uint64_t x) { value_ = (value_ ^ x) * 0x100000001b3u + (value_ >> 31); }
  [[nodiscard]] std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

using vocabulary = rota::runtime_vocabulary;
using atom = rota::in<vocabulary>;

/// n agents, t tasks: what each is worth, alone and two together, in thirds, sevenths and other numbers that round.
struct beliefs {
  std::size_t tasks = 0;
  std::vector<double> worth;
  std::vector<double> together;
};

inline rota::plan_type<vocabulary, beliefs> make_type(stream& r, std::size_t tasks, bool coupled) {
  using part = rota::utility_part<vocabulary, beliefs>;
  std::vector<rota::plan<vocabulary, beliefs>> plans;
  for (std::uint64_t id = 1, last = 1 + r.below(2); id <= last; ++id) {
    rota::plan_description<vocabulary, beliefs> d;
    d.plan = {id};
    for (std::size_t t = 0; t < tasks; ++t) {
      auto const lower = static_cast<std::uint32_t>(r.below(5) == 0);
      auto const more = static_cast<std::uint32_t>(1 + r.below(3));
      d.tasks.push_back({{t}, {lower, lower + more}, {}});
    }
    rota::additive_utility<vocabulary, beliefs> const alone = [](auto a, auto t, beliefs const& b) {
      return std::optional{b.worth[a.value * b.tasks + t.value]};
    };
    rota::weighted_sum<vocabulary, beliefs> sum{{1.0 / 3, part{alone}}, {0.1, part{rota::similarity{}}}};
    if (coupled) {
      sum.push_back(
          {0.7, part{rota::pairwise_utility<vocabulary, beliefs>{
                    {}, [](auto a, auto s, auto b, auto t, beliefs const& x) {
                      return x.together[(a.value * 7 + s.value * 5 + b.value * 3 + t.value) % x.together.size()];
                    }}}});
    }
    d.utility = sum;
    d.hysteresis = r.uniform() / 7;
    plans.push_back(rota::plan<vocabulary, beliefs>::make(std::move(d)).value());
  }
  return rota::plan_type<vocabulary, beliefs>::make({1}, std::move(plans)).value();
}

/// A team that reallocates as its beliefs change a little.
inline void play(stream& r, hash& h, std::size_t agents, std::size_t tasks, bool coupled, bool ties) {
  auto const type = make_type(r, tasks, coupled);
  rota::team<vocabulary> members;
  for (std::uint64_t a = 0; a < agents; ++a) members.add({a});
  beliefs b{tasks, {}, {}};
  auto const draw = [&] { return ties ? static_cast<double>(r.below(3)) / 7 : r.uniform() * 3 - 0.5; };
  for (std::size_t i = 0; i < agents * tasks; ++i) b.worth.push_back(draw());
  for (std::size_t i = 0; i < 31; ++i) b.together.push_back(draw());
  rota::workspace space;
  rota::allocation_atoms<vocabulary> current;
  for (int tick = 0; tick < 8; ++tick) {
    rota::problem<vocabulary, beliefs> p{type, members, b};
    p.change_cost = 0.01;
    auto const next = reallocate(p.running(current), {.relative = 0.03}, space, {.nodes = 20000});
    h.add(static_cast<std::uint64_t>(next.reason));
    h.add(static_cast<std::uint64_t>(next.utility * rota::fixed_utility::units_per_one));
    for (atom const& x : next.atoms) h.add(x.agent.value * 1000 + x.plan.value * 100 + x.task.value);
    current = next.atoms;
    for (std::size_t i = 0; i < 1 + agents / 4; ++i) b.worth[r.below(b.worth.size())] = draw();
  }
}

/// Dense problems, tie-heavy and not, cold and warm.
inline void solve(stream& r, hash& h, std::size_t agents, std::size_t slots, std::uint64_t levels) {
  std::vector<std::int64_t> u(agents * slots);
  auto const draw = [&] {
    auto const x = r.below(levels);
    return r.below(12) == 0 ? rota::dense::absent : static_cast<std::int64_t>(x);
  };
  for (auto& x : u) x = draw();
  std::vector<rota::dense::slot_bounds> bounds;
  for (std::size_t s = 0; s < slots; ++s)
    bounds.push_back({0, static_cast<std::uint32_t>(agents / slots + 1 + r.below(2))});
  rota::dense::instance const in{agents, u, bounds};
  rota::dense::flow_solver solver;
  auto out = solver.solve(in);
  for (int step = 0; step < 5; ++step) {
    h.add(static_cast<std::uint64_t>(out.obstacle == rota::dense::flow_obstacle::none ? 0 : 1 + int(out.obstacle)));
    h.add(static_cast<std::uint64_t>(out.value));
    for (auto const s : out.assignment) h.add(s);
    rota::dense::row_index const row[] = {static_cast<rota::dense::row_index>(r.below(agents))};
    for (std::size_t s = 0; s < slots; ++s) u[row[0] * slots + s] = draw();
    out = solver.resolve(in, row);
  }
}

inline std::uint64_t compute() {
  stream r(20110301);
  hash h;
  for (int i = 0; i < 60; ++i) {  // one draw a statement: the order of arguments is the compiler's
    auto const agents = 1 + r.below(9);
    auto const tasks = 1 + r.below(5);
    play(r, h, agents, tasks, false, i % 2 == 0);
  }
  for (int i = 0; i < 30; ++i) {
    auto const agents = 1 + r.below(5);
    auto const tasks = 1 + r.below(3);
    play(r, h, agents, tasks, true, i % 2 == 0);
  }
  for (int i = 0; i < 60; ++i) {
    auto const agents = 1 + r.below(150);
    auto const slots = 1 + r.below(20);
    solve(r, h, agents, slots, i % 3 == 0 ? 4 : i % 3 == 1 ? 1000 : 1u << 30);
  }
  return h.value();
}

/// A dense problem of pairs, solved to the end and for a while: the same answer, and as much work.
inline void couple(stream& r, hash& h, std::size_t agents, std::size_t slots, bool idle) {
  std::vector<std::int64_t> alone(agents * slots);
  auto const draw = [&] { return static_cast<std::int64_t>(r.uniform() * rota::fixed_utility::units_per_one); };
  for (auto& u : alone) u = draw();
  std::vector<std::vector<std::int64_t>> tables(agents * (agents - 1) / 2);
  std::vector<rota::dense::coupling> couplings;
  for (std::uint32_t a = 0; a < agents; ++a)
    for (std::uint32_t b = a + 1; b < agents; ++b) {
      auto& table = tables[couplings.size()];
      for (std::size_t i = 0; i < slots * slots; ++i) table.push_back(draw() - draw());
      couplings.push_back({a, b, table});
    }
  std::vector<rota::dense::slot_bounds> bounds(slots, {0, static_cast<std::uint32_t>((agents + slots - 1) / slots)});
  if (idle) bounds.back().upper = static_cast<std::uint32_t>(agents);
  rota::dense::pair_solver solver;
  for (std::uint64_t const nodes : {std::uint64_t{2000}, ~std::uint64_t{0}}) {
    auto const out = solver.solve({agents, alone, couplings, bounds}, {nodes, {}});
    h.add(out.proved());
    h.add(static_cast<std::uint64_t>(out.value));
    h.add(static_cast<std::uint64_t>(out.bound));
    h.add(out.work.nodes);
    for (auto const s : out.assignment) h.add(s);
  }
}

inline std::uint64_t compute_of_pairs() {
  stream r(20110302);
  hash h;
  for (int i = 0; i < 8; ++i) {
    auto const agents = 9 + r.below(5);
    auto const slots = 3 + r.below(3);
    couple(r, h, agents, slots, i % 2 == 0);
  }
  couple(r, h, 18, 4, true);
  return h.value();
}

}  // namespace digest
