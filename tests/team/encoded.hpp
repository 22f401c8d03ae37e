#pragma once

#include <gtest/gtest.h>

#include "playground.hpp"

#include <rota/team/wire.hpp>

#include <array>
#include <cstddef>
#include <vector>

using bytes = std::vector<std::byte>;

/// What is on the air.
inline bytes encoded(message const& m) {
  std::array<std::byte, 8192> buffer{};
  auto const size = rota::encode(m, buffer);
  EXPECT_TRUE(size);
  return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size ? *size : 0)};
}
