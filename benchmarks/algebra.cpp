// Composition, difference, application and the group, beside what one would write without the library.
//
// `atoms:N`: N additions and N subtractions a side, 64-bit atoms, a quarter of them shared. A row with `peer:` does the
// same work on the same inputs.

#include "support.hpp"

#include <rota/algebra/action.hpp>
#include <rota/algebra/delta.hpp>

#include <boost/container/flat_set.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace {

using atom = std::uint64_t;
using event = rota::event<atom>;
using delta = rota::delta<atom>;
using atoms = rota::atom_set<atom>;
using sorted = std::vector<atom>;

/// Two sets that Def. 3 calls an event.
template <class Set>
struct naive_event {
  Set plus;
  Set minus;
  friend bool operator==(naive_event const&, naive_event const&) = default;
};

template <class Set, class From>
Set to(From const& from) {
  return Set(from.begin(), from.end());
}
template <class Set>
naive_event<Set> to_naive(event const& e) {
  return {to<Set>(e.additions()), to<Set>(e.subtractions())};
}

/// Def. 4 as it stands in the paper.
template <class Set>
naive_event<Set> compose_naive(naive_event<Set> const& e, naive_event<Set> const& f) {
  auto part = [](Set const& in, Set const& in_too, Set const& out, Set const& out_too) {
    Set r = in;
    r.insert(in_too.begin(), in_too.end());
    for (atom const& x : out) r.erase(x);
    for (atom const& x : out_too) r.erase(x);
    return r;
  };
  return {part(e.plus, f.plus, e.minus, f.minus), part(e.minus, f.minus, e.plus, f.plus)};
}

sorted unite(sorted const& a, sorted const& b) {
  sorted r;
  r.reserve(a.size() + b.size());
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(r));
  return r;
}
sorted subtract(sorted const& a, sorted const& b) {
  sorted r;
  r.reserve(a.size());
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(r));
  return r;
}
naive_event<sorted> compose_sorted(naive_event<sorted> const& e, naive_event<sorted> const& f) {
  auto const plus = unite(e.plus, f.plus);
  auto const minus = unite(e.minus, f.minus);
  return {subtract(plus, minus), subtract(minus, plus)};
}

event random_event(std::mt19937_64& random, std::size_t n) {
  std::vector<atom> universe(8 * n);
  for (std::size_t i = 0; i < universe.size(); ++i) universe[i] = i;
  for (std::size_t i = 0; i < 2 * n; ++i) std::swap(universe[i], universe[i + pick(random, universe.size() - i)]);
  auto const first = universe.begin();
  auto const half = static_cast<std::ptrdiff_t>(n);
  return *event::make(atoms(first, first + half), atoms(first + half, first + 2 * half));
}

using pair_of_events = std::pair<event, event>;

/// So many pairs that the branch predictor cannot learn them, and few enough to stay in the cache.
std::vector<pair_of_events> event_pairs(std::size_t n) {
  auto random = seeded();
  std::vector<pair_of_events> pairs;
  for (std::size_t i = 0; i < std::min<std::size_t>(1024, (std::size_t{1} << 18) / (4 * n)); ++i) {
    auto e = random_event(random, n);
    pairs.emplace_back(std::move(e), random_event(random, n));
  }
  return pairs;
}
/// The same inputs in another representation.
template <class To, class From, class F>
std::vector<std::pair<To, To>> convert(std::vector<From> const& pairs, F f) {
  std::vector<std::pair<To, To>> r;
  for (auto const& [a, b] : pairs) r.emplace_back(f(a), f(b));
  return r;
}
std::size_t size_of(benchmark::State const& state) { return static_cast<std::size_t>(state.range(0)); }

void compose_sparse(benchmark::State& state) {
  auto const pairs = event_pairs(size_of(state));
  for (auto const& [e, f] : pairs)
    check(to_naive<sorted>(compose(e, f)) == compose_sorted(to_naive<sorted>(e), to_naive<sorted>(f)), "compose");
  rotate(state, pairs, [](auto const& p) { return compose(p.first, p.second); });
}

template <class Set>
void compose_peer(benchmark::State& state) {
  auto const pairs = event_pairs(size_of(state));
  auto const inputs = convert<naive_event<Set>>(pairs, to_naive<Set>);
  auto const& [e, f] = pairs.front();
  check(compose_naive(inputs.front().first, inputs.front().second) == to_naive<Set>(compose(e, f)), "compose, naive");
  rotate(state, inputs, [](auto const& p) { return compose_naive(p.first, p.second); });
}

void compose_set_algorithms(benchmark::State& state) {
  auto const inputs = convert<naive_event<sorted>>(event_pairs(size_of(state)), to_naive<sorted>);
  rotate(state, inputs, [](auto const& p) { return compose_sorted(p.first, p.second); });
}

/// What no composition can beat by much: reading both events and writing as many bytes.
void compose_memcpy(benchmark::State& state) {
  auto const pairs = event_pairs(size_of(state));
  std::vector<event::entry> out(4 * size_of(state));
  rotate(state, pairs, [&](auto const& p) {
    std::memcpy(out.data(), p.first.begin(), p.first.size() * sizeof(event::entry));
    std::memcpy(out.data() + p.first.size(), p.second.begin(), p.second.size() * sizeof(event::entry));
    benchmark::ClobberMemory();
    return out.data();
  });
}

std::vector<std::pair<atoms, atoms>> set_pairs(std::size_t n) {
  return convert<atoms>(event_pairs(n), [](event const& e) { return e.additions(); });
}

void difference_sparse(benchmark::State& state) {
  auto const pairs = set_pairs(size_of(state));
  for (auto const& [c, d] : pairs) {
    auto const e = difference(c, d);
    check(to<sorted>(e.additions()) == subtract(to<sorted>(d), to<sorted>(c)), "difference, added");
    check(to<sorted>(e.subtractions()) == subtract(to<sorted>(c), to<sorted>(d)), "difference, removed");
  }
  rotate(state, pairs, [](auto const& p) { return difference(p.first, p.second); });
}
void difference_set_algorithms(benchmark::State& state) {
  auto const inputs = convert<sorted>(set_pairs(size_of(state)), [](atoms const& c) { return to<sorted>(c); });
  rotate(state, inputs,
         [](auto const& p) { return std::pair{subtract(p.second, p.first), subtract(p.first, p.second)}; });
}

void apply_sparse(benchmark::State& state) {
  std::vector<std::pair<event, atoms>> inputs;
  for (auto const& [c, d] : set_pairs(size_of(state))) {
    inputs.emplace_back(difference(c, d), c);
    check(*apply(inputs.back().first, c) == d, "apply");
  }
  rotate(state, inputs, [](auto const& p) { return apply(p.first, p.second); });
}
void apply_set_algorithms(benchmark::State& state) {
  std::vector<std::pair<naive_event<sorted>, sorted>> inputs;
  for (auto const& [c, d] : set_pairs(size_of(state)))
    inputs.emplace_back(to_naive<sorted>(difference(c, d)), to<sorted>(c));
  rotate(state, inputs, [](auto const& p) { return unite(subtract(p.second, p.first.minus), p.first.plus); });
}

using map_delta = std::map<atom, std::int64_t>;

map_delta add_maps(map_delta d, map_delta const& e) {
  for (auto const& [x, n] : e)
    if (auto const at = d.emplace(x, 0).first; (at->second += n) == 0) d.erase(at);
  return d;
}
map_delta to_map(delta const& d) {
  map_delta r;
  for (auto const& [x, n] : d) r.emplace(x, n);
  return r;
}

void delta_sum(benchmark::State& state) {
  auto const pairs = convert<delta>(event_pairs(size_of(state)), [](event const& e) { return delta{e}; });
  for (auto const& [d, e] : pairs) check(to_map(d + e) == add_maps(to_map(d), to_map(e)), "sum of deltas");
  rotate(state, pairs, [](auto const& p) { return p.first + p.second; });
}
void delta_sum_map(benchmark::State& state) {
  auto const inputs = convert<map_delta>(event_pairs(size_of(state)), [](event const& e) { return to_map(delta{e}); });
  rotate(state, inputs, [](auto const& p) { return add_maps(p.first, p.second); });
}

using benchmark::internal::Benchmark;
void sizes(Benchmark* b) { b->ArgName("atoms")->Arg(1)->Arg(4)->Arg(16)->Arg(64)->Arg(256)->Arg(4096); }
void few_sizes(Benchmark* b) { b->ArgName("atoms")->Arg(4)->Arg(64)->Arg(4096); }

BENCHMARK(compose_sparse)->Name("compose/sparse")->Apply(sizes);
BENCHMARK(compose_peer<std::set<atom>>)->Name("compose/sparse/peer:std_set_naive")->Apply(sizes);
BENCHMARK(compose_peer<boost::container::flat_set<atom>>)
    ->Name("compose/sparse/peer:boost_flat_set_naive")
    ->Apply(sizes);
BENCHMARK(compose_set_algorithms)->Name("compose/sparse/peer:std_set_algorithms")->Apply(sizes);
BENCHMARK(compose_memcpy)->Name("compose/sparse/peer:memcpy_of_input")->Apply(sizes);
BENCHMARK(difference_sparse)->Name("difference")->Apply(few_sizes);
BENCHMARK(difference_set_algorithms)->Name("difference/peer:std_set_algorithms")->Apply(few_sizes);
BENCHMARK(apply_sparse)->Name("apply")->Apply(few_sizes);
BENCHMARK(apply_set_algorithms)->Name("apply/peer:std_set_algorithms")->Apply(few_sizes);
BENCHMARK(delta_sum)->Name("delta_sum")->Apply(few_sizes);
BENCHMARK(delta_sum_map)->Name("delta_sum/peer:std_map")->Apply(few_sizes);

}  // namespace
