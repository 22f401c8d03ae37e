#pragma once

#include <rapidcheck.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace rota::testing {

namespace detail {

/// Towards nothing: without the last entry, an entry zero, an entry halved.
inline rc::Seq<std::vector<int>> smaller_values(std::vector<int> const& v) {
  std::vector<std::vector<int>> smaller;
  if (!v.empty()) smaller.emplace_back(v.begin(), v.end() - 1);
  for (std::size_t i = 0; i < v.size(); ++i)
    for (int const x : {0, v[i] / 2})
      if (x != v[i] && (x != 0 || smaller.empty() || smaller.back() != v)) {
        smaller.push_back(v);
        smaller.back()[i] = x;
      }
  return rc::seq::fromContainer(std::move(smaller));
}

}  // namespace detail

/// Vectors of numbers in {low, …, high}, from which the generators of sets, events and deltas are made: entry i is about
/// the i-th atom, 0 says nothing about it. @pre low ≤ 0 ≤ high
///
/// Never tame: sizes from a fixed list with many small ones, so that random values meet, up to one that leaves inline
/// storage; and each vector has weights of its own for the numbers, zero weights among them. So values that are dense,
/// sparse, of one sign, equal, nested and unrelated are all frequent, and nothing waits for a size that grows. Shrinks to
/// fewer entries and to zeros.
[[nodiscard]] inline rc::Gen<std::vector<int>> values(int low, int high) {
  return [low, high](rc::Random const& random, int) {
    static constexpr std::size_t sizes[] = {1, 2, 3, 3, 3, 6, 6, 24};
    static constexpr std::uint64_t weights[] = {0, 1, 2, 4};
    static constexpr std::uint64_t weights_of_zero[] = {0, 0, 1, 2};
    auto source = random;
    auto const kinds = static_cast<std::size_t>(high - low + 1);
    std::vector<std::uint64_t> up_to(kinds);  // the weights, summed
    std::uint64_t total = 0;
    for (std::size_t k = 0; k < kinds; ++k) {
      auto const which = source.next() % 4;  // by itself: as an index, g++ 12 under UBSan draws it twice
      total += low + static_cast<int>(k) == 0 ? weights_of_zero[which] : weights[which];
      up_to[k] = total;
    }
    auto const size = source.next() % 8;
    std::vector<int> v(sizes[size]);
    for (int& x : v) {
      auto kind = source.next() % (total == 0 ? kinds : total);
      if (total != 0) {
        auto const point = kind;
        for (kind = 0; up_to[kind] <= point;) ++kind;
      }
      x = low + static_cast<int>(kind);
    }
    return rc::shrinkable::shrinkRecur(std::move(v), &detail::smaller_values);
  };
}

/// What `make` makes of `values(low, high)`. Shrinks with them.
template <class T>
[[nodiscard]] rc::Gen<T> made_of(int low, int high, std::function<T(std::vector<int> const&)> make) {
  return rc::gen::map(values(low, high), std::move(make));  // erased: rapidcheck costs half a second per mapping type
}

/// Uniform in {low, …, high} from the first case on, and shrinking towards zero. @pre low ≤ high
[[nodiscard]] inline rc::Gen<int> integer(int low, int high) {
  return [low, high](rc::Random const& random, int) {
    auto source = random;
    int const n = low + static_cast<int>(source.next() % static_cast<std::uint64_t>(high - low + 1));
    return rc::shrinkable::shrinkRecur(int{n}, [low, high](int x) {
      std::vector<int> smaller;
      for (int const y : {0, x / 2, x - (x > 0) + (x < 0)})
        if (y != x && low <= y && y <= high) smaller.push_back(y);
      return rc::seq::fromContainer(std::move(smaller));
    });
  };
}

}  // namespace rota::testing
