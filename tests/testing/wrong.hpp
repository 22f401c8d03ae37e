#pragma once
/// Which laws a wrong model breaks. Each model is wrong in one way, and the tests name exactly the laws that it should
/// break: a law that cannot fail tests nothing.

#include "testing/sample.hpp"

#include <rota/testing/check.hpp>

#include <gtest/gtest.h>

#include <string>

/// The names of the laws that the model breaks, in alphabetical order, with blanks between them; empty if it breaks
/// none.
inline std::string broken(rota::testing::bundle const& b) {
  std::string names;
  for (auto const& [name, why] : broken_laws(b)) names += (names.empty() ? "" : " ") + name;
  return names;
}
