// Equal inputs, equal allocations: here as this compiler and its flags have it; tests/search/digest for other flags.
#include "search/digest/digest.hpp"

#include <gtest/gtest.h>

namespace determinism_test {

TEST(best_allocation, is_the_same_from_every_compiler) { EXPECT_EQ(digest::compute(), digest::expected); }
TEST(pairwise, is_the_same_from_every_compiler) { EXPECT_EQ(digest::compute_of_pairs(), digest::expected_of_pairs); }

}  // namespace determinism_test
