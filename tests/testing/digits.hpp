#pragma once
/// Small numbers. Most wrong models are made of them.

#include "testing/wrong.hpp"

#include <ostream>

/// A number from −4 to 4.
struct digit {
  int value = 0;
  friend bool operator==(digit, digit) = default;
  friend std::ostream& operator<<(std::ostream& out, digit x) { return out << x.value; }
};
/// The integers. Each wrong model changes one thing.
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
