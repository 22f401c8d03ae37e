// Composition, difference, apply and the group, compared with code that does not use the library.
//
// `atoms:N`: N additions and N subtractions a side, 64-bit atoms, a quarter of them shared. `bits:N`: bit planes over N
// atoms, a quarter of them added and a quarter subtracted. A row with `peer:` does the same work on the same inputs.

#include "support.hpp"

#include <rota/algebra/apply.hpp>
#include <rota/algebra/delta.hpp>
#include <rota/algebra/dense_event.hpp>

#include <Eigen/SparseCore>
#include <boost/container/flat_set.hpp>
#include <boost/dynamic_bitset.hpp>
#include <roaring/roaring.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace {

using atom = std::uint64_t;
using event = rota::event<atom>;
using delta = rota::delta<atom>;
using atoms = rota::atom_set<atom>;
using sorted = std::vector<atom>;

/// An event as the two sets of Def. 3.
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

/// Def. 4 as the paper writes it.
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

event random_event(std::mt19937_64& random, std::size_t n, std::size_t atoms_in_all) {
  std::vector<atom> universe(atoms_in_all);
  for (std::size_t i = 0; i < universe.size(); ++i) universe[i] = i;
  for (std::size_t i = 0; i < 2 * n; ++i) std::swap(universe[i], universe[i + pick(random, universe.size() - i)]);
  auto const first = universe.begin();
  auto const half = static_cast<std::ptrdiff_t>(n);
  return *event::make(atoms(first, first + half), atoms(first + half, first + 2 * half));
}

using pair_of_events = std::pair<event, event>;

/// Too many pairs for the branch predictor to learn, and few enough to stay in the cache.
std::vector<pair_of_events> event_pairs(std::size_t n, std::size_t atoms_in_all) {
  auto random = seeded();
  std::vector<pair_of_events> pairs;
  for (std::size_t i = 0; i < std::clamp<std::size_t>((std::size_t{1} << 18) / (4 * n), 4, 1024); ++i) {
    auto e = random_event(random, n, atoms_in_all);
    pairs.emplace_back(std::move(e), random_event(random, n, atoms_in_all));
  }
  return pairs;
}
std::vector<pair_of_events> event_pairs(std::size_t n) { return event_pairs(n, 8 * n); }
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

/// A sum of sparse vectors, clamped.
using sparse_vector = Eigen::SparseVector<int, Eigen::ColMajor, std::int64_t>;

sparse_vector to_eigen(event const& e, std::size_t atoms_in_all) {
  sparse_vector v(static_cast<std::int64_t>(atoms_in_all));
  for (auto const& x : e) v.insertBack(static_cast<std::int64_t>(x.atom)) = to_int(x.value);
  return v;
}
sparse_vector compose_eigen(sparse_vector const& e, sparse_vector const& f) {
  sparse_vector r = e + f;
  r.coeffs() = r.coeffs().min(1).max(-1);
  r.prune(1);  // drops entries much smaller than 1, the zeros
  return r;
}
void compose_sparse_vectors(benchmark::State& state) {
  auto const pairs = event_pairs(size_of(state));
  auto const inputs = convert<sparse_vector>(pairs, [&](event const& e) { return to_eigen(e, 8 * size_of(state)); });
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    auto const r = compose_eigen(inputs[i].first, inputs[i].second);
    auto const expected = compose(pairs[i].first, pairs[i].second);
    check(static_cast<std::size_t>(r.nonZeros()) == expected.size(), "compose, Eigen: size");
    for (auto const& x : expected) check(r.coeff(std::int64_t(x.atom)) == to_int(x.value), "compose, Eigen");
  }
  rotate(state, inputs, [](auto const& p) { return compose_eigen(p.first, p.second); });
}

/// Compressed bitmaps, which are designed for large sets of 32-bit numbers.
struct roaring_free {
  void operator()(roaring_bitmap_t* b) const { roaring_bitmap_free(b); }
};
using roaring = std::unique_ptr<roaring_bitmap_t, roaring_free>;
struct roaring_event {
  roaring plus;
  roaring minus;
};
roaring to_roaring(atoms const& c) {
  roaring r{roaring_bitmap_create()};
  for (atom const x : c) roaring_bitmap_add(r.get(), static_cast<std::uint32_t>(x));
  return r;
}
roaring_event to_roaring_event(event const& e) { return {to_roaring(e.additions()), to_roaring(e.subtractions())}; }
roaring_event compose_bitmaps(roaring_event const& e, roaring_event const& f) {
  roaring const plus{roaring_bitmap_or(e.plus.get(), f.plus.get())};
  roaring const minus{roaring_bitmap_or(e.minus.get(), f.minus.get())};
  return {roaring{roaring_bitmap_andnot(plus.get(), minus.get())},
          roaring{roaring_bitmap_andnot(minus.get(), plus.get())}};
}
bool same(roaring_event const& a, roaring_event const& b) {
  return roaring_bitmap_equals(a.plus.get(), b.plus.get()) && roaring_bitmap_equals(a.minus.get(), b.minus.get());
}
void compose_roaring(benchmark::State& state) {
  auto const pairs = event_pairs(size_of(state));
  auto const inputs = convert<roaring_event>(pairs, to_roaring_event);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    check(same(compose_bitmaps(inputs[i].first, inputs[i].second),
               to_roaring_event(compose(pairs[i].first, pairs[i].second))),
          "compose, CRoaring");
  rotate(state, inputs, [](auto const& p) { return compose_bitmaps(p.first, p.second); });
}

/// A lower bound for any composition: read both events and write as many bytes.
void copy_inputs(benchmark::State& state, std::vector<pair_of_events> const& pairs) {
  std::vector<event::entry> out(pairs.front().first.size() + pairs.front().second.size());
  rotate(state, pairs, [&](auto const& p) {
    std::memcpy(out.data(), p.first.begin(), p.first.size() * sizeof(event::entry));
    std::memcpy(out.data() + p.first.size(), p.second.begin(), p.second.size() * sizeof(event::entry));
    benchmark::ClobberMemory();
    return out.data();
  });
}
void compose_memcpy(benchmark::State& state) { copy_inputs(state, event_pairs(size_of(state))); }

/// A large event, and one of two entries.
std::vector<pair_of_events> lopsided_pairs(std::size_t n) {
  auto random = seeded();
  auto pairs = event_pairs(n);
  for (auto& p : pairs) p.second = random_event(random, 1, 8 * n);
  return pairs;
}
void compose_lopsided(benchmark::State& state) {
  auto const pairs = lopsided_pairs(size_of(state));
  for (auto const& [e, f] : pairs)
    check(to_naive<sorted>(compose(e, f)) == compose_sorted(to_naive<sorted>(e), to_naive<sorted>(f)), "lopsided");
  rotate(state, pairs, [](auto const& p) { return compose(p.first, p.second); });
}
void compose_lopsided_memcpy(benchmark::State& state) { copy_inputs(state, lopsided_pairs(size_of(state))); }

/// The events of `compose_sparse` in bit planes of one word.
template <std::size_t Bits>
void compose_fixed_planes(benchmark::State& state, std::vector<pair_of_events> const& pairs) {
  using universe = rota::index_universe<Bits>;
  auto const inputs =
      convert<rota::dense_event<universe>>(pairs, [](event const& e) { return to_dense(e, universe{}).value(); });
  for (std::size_t i = 0; i < pairs.size(); ++i)
    check(to_sparse(compose(inputs[i].first, inputs[i].second)) == compose(pairs[i].first, pairs[i].second), "planes");
  rotate(state, inputs, [](auto const& p) { return compose(p.first, p.second); });
}
void compose_one_word(benchmark::State& state) { compose_fixed_planes<64>(state, event_pairs(size_of(state))); }

std::vector<pair_of_events> plane_pairs(benchmark::State const& state) {
  return event_pairs(size_of(state) / 4, size_of(state));
}
template <std::size_t Bits>
void compose_fixed(benchmark::State& state) {
  compose_fixed_planes<Bits>(state, plane_pairs(state));
}
/// Planes over a universe that is known only at run time.
void compose_dense(benchmark::State& state) {
  std::vector<atom> numbers(size_of(state));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  atoms const all(numbers.begin(), numbers.end());
  rota::listed_universe<atom> const universe(all);
  auto const pairs = plane_pairs(state);
  auto const inputs = convert<rota::dense_event<rota::listed_universe<atom>>>(
      pairs, [&](event const& e) { return to_dense(e, universe).value(); });
  for (std::size_t i = 0; i < pairs.size(); ++i)
    check(to_sparse(compose(inputs[i].first, inputs[i].second)) == compose(pairs[i].first, pairs[i].second), "dense");
  rotate(state, inputs, [](auto const& p) { return compose(p.first, p.second); });
}

using bitset = boost::dynamic_bitset<std::uint64_t>;
struct bitset_event {
  bitset plus;
  bitset minus;
};
/// By the same formula as ours.
bitset_event compose_bitsets(bitset_event const& e, bitset_event const& f) {
  auto const plus = e.plus | f.plus;
  auto const minus = e.minus | f.minus;
  return {plus - minus, minus - plus};
}
void compose_dynamic_bitset(benchmark::State& state) {
  auto const to_bitsets = [&](event const& e) {
    bitset_event r{bitset(size_of(state)), bitset(size_of(state))};
    for (auto const& x : e) (x.value == rota::sign::plus ? r.plus : r.minus).set(x.atom);
    return r;
  };
  auto const pairs = plane_pairs(state);
  auto const inputs = convert<bitset_event>(pairs, to_bitsets);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    auto const r = compose_bitsets(inputs[i].first, inputs[i].second);
    auto const expected = to_bitsets(compose(pairs[i].first, pairs[i].second));
    check(r.plus == expected.plus && r.minus == expected.minus, "compose, dynamic_bitset");
  }
  rotate(state, inputs, [](auto const& p) { return compose_bitsets(p.first, p.second); });
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
void sizes(Benchmark* b) { b->ArgName("atoms")->Arg(1)->Arg(4)->Arg(16)->Arg(64)->Arg(256)->Arg(4096)->Arg(65536); }
void plane_sizes(Benchmark* b) { b->ArgName("bits")->Arg(64)->Arg(256)->Arg(4096)->Arg(65536); }
void few_sizes(Benchmark* b) { b->ArgName("atoms")->Arg(4)->Arg(64)->Arg(4096); }

BENCHMARK(compose_sparse)->Name("compose/sparse")->Apply(sizes);
BENCHMARK(compose_peer<std::set<atom>>)->Name("compose/sparse/peer:std_set_naive")->Apply(sizes);
BENCHMARK(compose_peer<boost::container::flat_set<atom>>)
    ->Name("compose/sparse/peer:boost_flat_set_naive")
    ->Apply(sizes);
BENCHMARK(compose_set_algorithms)->Name("compose/sparse/peer:std_set_algorithms")->Apply(sizes);
BENCHMARK(compose_sparse_vectors)->Name("compose/sparse/peer:eigen_sum_clamped")->Apply(sizes);
BENCHMARK(compose_roaring)->Name("compose/sparse/peer:croaring_32_bit")->Apply(sizes);
BENCHMARK(compose_memcpy)->Name("compose/sparse/peer:memcpy_of_input")->Apply(sizes);
BENCHMARK(compose_lopsided)->Name("compose/lopsided")->ArgName("atoms")->Arg(65536);
BENCHMARK(compose_lopsided_memcpy)->Name("compose/lopsided/peer:memcpy_of_input")->ArgName("atoms")->Arg(65536);
BENCHMARK(compose_one_word)->Name("compose/one_word")->ArgName("atoms")->Arg(1)->Arg(4);
BENCHMARK(compose_dense)->Name("compose/dense")->Apply(plane_sizes);
BENCHMARK(compose_fixed<64>)->Name("compose/dense/peer:rota_compile_time_size")->ArgName("bits")->Arg(64);
BENCHMARK(compose_fixed<4096>)->Name("compose/dense/peer:rota_compile_time_size")->ArgName("bits")->Arg(4096);
BENCHMARK(compose_dynamic_bitset)->Name("compose/dense/peer:boost_dynamic_bitset")->Apply(plane_sizes);
BENCHMARK(difference_sparse)->Name("difference")->Apply(few_sizes);
BENCHMARK(difference_set_algorithms)->Name("difference/peer:std_set_algorithms")->Apply(few_sizes);
BENCHMARK(apply_sparse)->Name("apply")->Apply(few_sizes);
BENCHMARK(apply_set_algorithms)->Name("apply/peer:std_set_algorithms")->Apply(few_sizes);
BENCHMARK(delta_sum)->Name("delta_sum")->Apply(few_sizes);
BENCHMARK(delta_sum_map)->Name("delta_sum/peer:std_map")->Apply(few_sizes);

}  // namespace
