#if __has_include(<fmt/core.h>)
#define FMT_HEADER_ONLY
#include <fmt/core.h>
#include <fmt/ranges.h>
#endif

#include <rota/format.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace formatted_test {

using atoms = rota::atom_set<int>;

#ifdef FMT_VERSION
TEST(formatted, by_fmt) {
  EXPECT_EQ(fmt::format("{} at {}", atoms{2, 1}, rota::milliseconds(30)), "{1, 2} at 30 ms");
  EXPECT_EQ(fmt::format("[{:>7}|{:<3}]", rota::milliseconds(30), rota::sign::plus), "[  30 ms|+  ]");
  EXPECT_EQ(fmt::format("{}", rota::event<int>::subtraction(4)), "({}, {4})");
  EXPECT_EQ(fmt::format("{}", std::vector{rota::sign::plus, rota::sign::zero}), "[+, 0]");
}
#endif

#ifdef __cpp_lib_format
TEST(formatted, by_the_standard_library) {
  EXPECT_EQ(std::format("{} at {}", atoms{2, 1}, rota::milliseconds(30)), "{1, 2} at 30 ms");
  EXPECT_EQ(std::format("[{:>7}|{:<3}]", rota::milliseconds(30), rota::sign::plus), "[  30 ms|+  ]");
  EXPECT_EQ(std::format("{}", rota::event<int>::subtraction(4)), "({}, {4})");
#ifdef __cpp_lib_format_ranges
  EXPECT_EQ(std::format("{}", std::vector{rota::sign::plus, rota::sign::zero}), "[+, 0]");
#endif
}
#endif

TEST(formatted, the_header_is_harmless_where_neither_is_there) {
  EXPECT_EQ(to_string(rota::milliseconds(30)), "30 ms");
}

}  // namespace formatted_test
