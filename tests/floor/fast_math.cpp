// Under -ffast-math a compiler may assume that nothing is NaN or infinite. What comes from outside is refused all the same.
#include <rota/rota.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>

int main() {
  // By their bits, and through volatile: else the compiler would compute with what it assumes.
  std::uint64_t volatile const not_a_number = 0x7ff8'0000'0000'0000, infinity = 0x7ff0'0000'0000'0000;
  double const nan = std::bit_cast<double>(not_a_number + 0), infinite = std::bit_cast<double>(infinity + 0);

  using rota::utility_fault;
  bool ok = !rota::quantise(nan) && rota::quantise(nan).error() == utility_fault::not_a_number;
  ok = ok && !rota::quantise(infinite) && rota::quantise(infinite).error() == utility_fault::positive_infinity;
  ok = ok && !rota::quantise(-infinite) && rota::quantise(-infinite).error() == utility_fault::negative_infinity;

  using rota::assign_fault;
  for (double const entry : {nan, infinite}) {
    auto const made = rota::assign(std::array{1.0, entry}, {rota::cardinality{0, 1}, rota::cardinality{0, 1}});
    ok = ok && !made &&
         made.error().reason ==
             (std::bit_cast<std::uint64_t>(entry) == infinity ? assign_fault::infinite : assign_fault::not_a_number);
  }

  struct beliefs {};
  using plan = rota::plan<rota::runtime_vocabulary, beliefs>;
  for (double const hysteresis : {nan, infinite, -infinite}) {
    auto const made = plan::make({.plan = {1},
                                  .tasks = {{{1}, {0, 1}, {0}}},
                                  .utility = [](auto, auto, beliefs const&) { return std::optional<double>(1.0); },
                                  .hysteresis = hysteresis});
    ok = ok && !made;
  }
  rota::hysteresis const endless{.relative = infinite};
  ok = ok && !rota::detail::beats({1}, {0}, rota::detail::margin_of(endless, 0, {0}));
  std::printf("NaN and infinity are %s\n", ok ? "refused" : "taken");
  return ok ? 0 : 1;
}
