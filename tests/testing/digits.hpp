#pragma once
/// Small numbers, of which most wrong models are made.

#include "testing/wrong.hpp"

#include <ostream>

/// A number from −4 to 4.
struct digit {
  int value = 0;
  friend bool operator==(digit, digit) = default;
  friend std::ostream& operator<<(std::ostream& out, digit x) { return out << x.value; }
};
/// The integers; what follows changes one thing.
struct integers {
  static digit combine(digit x, digit y) { return {x.value + y.value}; }
  static digit identity() { return {}; }
  static digit inverse(digit x) { return {-x.value}; }
};

template <>
struct rc::Arbitrary<digit> {
  static Gen<digit> arbitrary() {
    return gen::map(rota::testing::integer(-4, 4), [](int n) { return digit{n}; });
  }
};
