#pragma once

#include <cstdint>

namespace rota_test {

/// How often the global `operator new` (any overload, any thread) has been called so far in this program.
///
/// Every test program links the counting replacements, so two readings around a call tell what it allocates:
/// `auto n = allocation_count(); f(); EXPECT_EQ(allocation_count() - n, 0u);`
[[nodiscard]] std::uint64_t allocation_count() noexcept;

}  // namespace rota_test
