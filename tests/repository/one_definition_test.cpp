#include "all_headers.hpp"

#include <gtest/gtest.h>

int the_other_unit_with_all_headers();

TEST(headers, define_everything_once_in_a_program_of_two_units) { EXPECT_EQ(the_other_unit_with_all_headers(), 1); }
