#pragma once
/// @file
/// Random pairwise instances as plain numbers, and enumeration as their oracle.

#include "support/dice.hpp"

#include <rota/dense/pairs/solver.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pairs_world {

using rota::dense::absent;
using rota::dense::no_slot;
using rota::dense::pair_cut;
using rota::dense::pair_outcome;
using rota::dense::pair_solver;
using rota::dense::slot;
using rota_test::any_seed;
using rota_test::dice;

using choice = std::vector<slot>;

struct table {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::vector<std::int64_t> worth;
};

/// An instance that owns its numbers.
struct problem {
  std::size_t agents = 0;
  std::size_t slots = 0;
  std::vector<std::int64_t> unary;
  std::vector<table> tables;
  std::vector<rota::dense::slot_bounds> bounds;
  mutable std::vector<rota::dense::coupling> couplings;

  rota::dense::pair_instance view() const {
    couplings.clear();
    for (table const& t : tables) couplings.push_back({t.first, t.second, t.worth});
    return {agents, unary, couplings, bounds};
  }
};

/// The value of an assignment by definition; nothing if it is not valid.
inline std::optional<std::int64_t> value_of(problem const& p, choice const& x) {
  std::vector<std::uint32_t> count(p.slots, 0);
  std::int64_t sum = 0;
  for (std::size_t a = 0; a < p.agents; ++a) {
    std::int64_t const u = p.unary[a * p.slots + x[a]];
    if (u == absent) return std::nullopt;
    sum += u;
    ++count[x[a]];
  }
  for (std::size_t s = 0; s < p.slots; ++s)
    if (count[s] < p.bounds[s].lower || count[s] > p.bounds[s].upper) return std::nullopt;
  for (table const& t : p.tables) {
    std::int64_t const w = t.worth[x[t.first] * p.slots + x[t.second]];
    if (w == absent) return std::nullopt;
    sum += w;
  }
  return sum;
}

/// Calls f on each completion of the partial assignment, in lexicographic order.
template <class F>
void completions(problem const& p, choice& x, std::size_t a, F&& f) {
  while (a < p.agents && x[a] != no_slot) ++a;
  if (a == p.agents) return f(std::as_const(x));
  for (slot s = 0; s < p.slots; ++s) {
    x[a] = s;
    completions(p, x, a + 1, f);
  }
  x[a] = no_slot;
}

struct optimum {
  std::optional<std::int64_t> value;
  choice first;  // the lexicographically smallest
  int equals = 0;
};

inline optimum enumerate(problem const& p) {
  optimum best;
  choice x(p.agents, no_slot);
  completions(p, x, 0, [&](choice const& c) {
    auto const v = value_of(p, c);
    if (!v || (best.value && *v < *best.value)) return;
    if (best.value && *v == *best.value) {
      ++best.equals;
      return;
    }
    best = {v, c, 1};
  });
  return best;
}

inline std::uint64_t power(std::uint64_t base, std::size_t exponent) {
  std::uint64_t r = 1;
  while (exponent-- > 0) r *= base;
  return r;
}

/// How many assignments the account of a search covers, modulo 2^64.
inline std::uint64_t accounted(pair_solver const& s, problem const& p) {
  std::uint64_t sum = 0;
  auto const account = s.account();
  for (std::size_t d = 0; d < account.size(); ++d) {
    auto const& t = account[d];
    sum += power(p.slots, p.agents - d) *
           (t.leaves + t.by_bound + t.by_cardinality + t.by_absence + t.by_symmetry + t.open);
  }
  return sum;
}

template <class F>
class observer final : public rota::dense::pair_observer {
public:
  explicit observer(F const& hear) : hear_(hear) {}
  void operator()(std::span<slot const> partial, pair_cut why, std::int64_t bound) override {
    hear_(partial, why, bound);
  }

private:
  F const& hear_;
};

inline choice chosen(rota::dense::outcome const& found) { return {found.assignment.begin(), found.assignment.end()}; }

struct flavour {
  std::int64_t levels = 10;  // how many different values; few make ties
  int absent_slots = 0;      // per cent
  int absent_pairs = 0;
  int coupled = 100;
  bool negative = true;
  bool kinds = false;  // interchangeable agents
  bool bounded = true;
};

inline std::int64_t number(dice& d, flavour const& f) {
  auto const v = static_cast<std::int64_t>(d.bits() % static_cast<std::uint64_t>(f.levels));
  return f.negative ? v - f.levels / 2 : v;
}

inline problem random_problem(dice& d, std::size_t n, std::size_t m, flavour const& f) {
  problem p;
  p.agents = n;
  p.slots = m;
  for (std::size_t i = 0; i < n * m; ++i) p.unary.push_back(d.chance(f.absent_slots) ? absent : number(d, f));
  std::vector<std::size_t> kind(n);
  for (std::size_t a = 0; a < n; ++a) kind[a] = f.kinds ? d.bits() % (1 + n / 3) : a;
  auto const symmetric = [&](std::vector<std::int64_t>& w) {
    for (std::size_t x = 0; x < m; ++x)
      for (std::size_t y = 0; y < x; ++y) w[x * m + y] = w[y * m + x];
  };
  std::vector<std::vector<std::int64_t>> between_kinds(n * n);
  for (std::size_t a = 0; a < n; ++a) {
    if (kind[a] != a)
      for (std::size_t b = 0; b < a; ++b)
        if (kind[b] == kind[a]) {
          // A constant that is added in every slot changes nothing.
          std::int64_t const more = d.chance(30) ? d.below(5) : 0;
          for (std::size_t x = 0; x < m; ++x) {
            std::int64_t const u = p.unary[b * m + x];
            p.unary[a * m + x] = u == absent ? absent : u + more;
          }
          break;
        }
    for (std::size_t b = 0; b < a; ++b) {
      auto& w = between_kinds[std::min(kind[a], kind[b]) * n + std::max(kind[a], kind[b])];
      if (w.empty() || !f.kinds) {
        w.assign(m * m, 0);
        if (d.chance(f.coupled))
          for (auto& v : w) v = d.chance(f.absent_pairs) ? absent : number(d, f);
        if (kind[a] == kind[b]) symmetric(w);
      }
      bool const zero = std::all_of(w.begin(), w.end(), [](auto v) { return v == 0; });
      if (zero && d.chance(80)) continue;
      // Tables are for the smaller kind first, and come either way round.
      table t{static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(a), w};
      if (kind[b] > kind[a]) std::swap(t.first, t.second);
      if (d.chance(50)) {
        std::swap(t.first, t.second);
        for (std::size_t x = 0; x < m; ++x)
          for (std::size_t y = 0; y < m; ++y) t.worth[y * m + x] = w[x * m + y];
      }
      p.tables.push_back(t);
      // Named twice, they are added up.
      if (d.chance(10) && std::none_of(w.begin(), w.end(), [](auto v) { return v == absent; })) {
        table half = t;
        for (std::size_t i = 0; i < m * m; ++i) half.worth[i] = number(d, f), p.tables.back().worth[i] -= half.worth[i];
        p.tables.push_back(half);
      }
    }
  }
  d.shuffle(p.tables);
  for (std::size_t s = 0; s < m; ++s) {
    rota::dense::slot_bounds b{0, static_cast<std::uint32_t>(n)};
    if (f.bounded && d.chance(40)) b.lower = static_cast<std::uint32_t>(d.below(3));
    if (f.bounded && d.chance(60)) b.upper = b.lower + static_cast<std::uint32_t>(d.below(1 + static_cast<int>(n) / 2));
    if (d.chance(5)) b.upper = ~std::uint32_t{0};
    p.bounds.push_back(b);
  }
  return p;
}

/// Random sizes with at most `most` assignments, and a random flavour.
inline problem any_problem(dice& d, std::uint64_t most) {
  std::size_t const m = d.chance(5) ? 1 : 2 + d.bits() % 5;
  std::size_t n = 1;
  while (n < 10 && power(m, n + 1) <= most) ++n;
  if (d.chance(30)) n = 1 + d.bits() % n;
  flavour f;
  std::int64_t const levels[] = {1, 2, 3, 10, 1000, std::int64_t{1} << 20, std::int64_t{1} << 40};
  f.levels = levels[d.bits() % 7];
  if (d.chance(30)) f.absent_slots = d.below(40);
  if (d.chance(30)) f.absent_pairs = d.below(25);
  if (d.chance(40)) f.coupled = d.below(100);
  f.negative = d.chance(60);
  f.kinds = d.chance(30);
  f.bounded = d.chance(80);
  return random_problem(d, n, m, f);
}

/// Some way to divide the work.
inline rota::dense::pair_effort any_effort(dice& d) {
  rota::dense::pair_effort e;
  e.plain_nodes = d.chance(60) ? 0 : d.chance(50) ? d.bits() % 300 : 16384;
  if (d.chance(80)) e.exact_suffix = d.bits() % 6;
  if (d.chance(80)) e.bounded_suffix = d.bits() % 6;
  return e;
}

/// Every pair is coupled, and the size makes the solver use all its parts.
inline problem dense_problem(std::uint64_t seed, std::size_t n, std::size_t m) {
  dice d(seed);
  problem p = random_problem(d, n, m, {.levels = 1 << 20, .bounded = false});
  for (auto& b : p.bounds) b.upper = static_cast<std::uint32_t>((n + m - 1) / m + 1);
  p.bounds[0].lower = 1;
  return p;
}

}  // namespace pairs_world
