#include "algebra/generators.hpp"

#include <utility>

namespace universe {
namespace {

/// Zeros with weight z and nonzero values with weight two; z is drawn once per vector.
rc::Gen<std::vector<int>> values_with_zeros(std::size_t atoms, int low, int high, std::vector<std::size_t> weights) {
  std::vector<int> nonzero;
  for (int x = low; x <= high; ++x)
    if (x != 0) nonzero.push_back(x);
  return rc::gen::mapcat(rc::gen::elementOf(std::move(weights)), [=](std::size_t zeros) {
    return rc::gen::container<std::vector<int>>(
        atoms, rc::gen::weightedOneOf<int>({{zeros, rc::gen::just(0)}, {2, rc::gen::elementOf(nonzero)}}));
  });
}

}  // namespace

rc::Gen<std::size_t> atom_count() { return rc::gen::element<std::size_t>(1, 2, 3, 6, 6, 24); }

rc::Gen<std::vector<int>> integers(std::size_t count, int low, int high) {
  return rc::gen::container<std::vector<int>>(count, integer(low, high));
}
rc::Gen<std::vector<int>> values(std::size_t atoms, int low, int high) {
  return values_with_zeros(atoms, low, high, {0, 1, 2, 6});
}

rc::Gen<event> event_over(std::size_t atoms) { return rc::gen::map(values(atoms, -1, 1), event_of); }
rc::Gen<atom_set> set_over(std::size_t atoms) { return rc::gen::map(values(atoms, 0, 1), set_of); }
rc::Gen<delta> delta_over(std::size_t atoms) { return rc::gen::map(values(atoms, -4, 4), delta_of<std::int64_t>); }
rc::Gen<std::vector<event>> events_over(std::size_t atoms, std::size_t count) {
  return rc::gen::container<std::vector<event>>(count, event_over(atoms));
}

}  // namespace universe
