#pragma once

#include <rapidcheck.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace rota::testing {

namespace detail {

/// Shrinks a vector: drops the last entry, makes an entry zero, or halves one.
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

/// Generates vectors of numbers in {low, …, high}. The generators of sets, events and deltas are made of these: entry i
/// is about the i-th atom, and 0 does not mention it. @pre low ≤ 0 ≤ high
///
/// From the first case on, it reaches the interesting ones. The sizes come from a fixed list: many are small, so that
/// random values share atoms, and one is too large for inline storage. Each vector weighs the numbers differently, some
/// with 0. So vectors are often dense, sparse or of one sign, and pairs of them equal, nested or unrelated. Shrinks to
/// fewer entries and to zeros.
[[nodiscard]] inline rc::Gen<std::vector<int>> values(int low, int high) {
  return [low, high](rc::Random const& random, int) {
    static constexpr std::size_t sizes[] = {1, 2, 3, 3, 3, 6, 6, 24};
    static constexpr std::uint64_t weights[] = {0, 1, 2, 4};
    static constexpr std::uint64_t weights_of_zero[] = {0, 0, 1, 2};
    auto source = random;
    auto const kinds = static_cast<std::size_t>(high - low + 1);
    std::vector<std::uint64_t> up_to(kinds);  // the partial sums of the weights
    std::uint64_t total = 0;
    for (std::size_t k = 0; k < kinds; ++k) {
      auto const which = source.next() % 4;  // a variable, because g++ 12 with UBSan draws twice if it is an index
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

/// `make(v)` for v of `values(low, high)`. Shrinks as v does.
template <class T>
[[nodiscard]] rc::Gen<T> made_of(int low, int high, std::function<T(std::vector<int> const&)> make) {
  return rc::gen::map(
      values(low, high),
      std::move(make));  // a std::function, because each type that is mapped by costs half a second to compile
}

/// Uniform in {low, …, high} from the first case on. Shrinks towards zero. @pre low ≤ high
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
