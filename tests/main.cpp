#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  // Left alone, rapidcheck seeds itself from the clock: a failure today should still be one tomorrow.
  ::setenv("RC_PARAMS", "seed=20110301 max_success=1000", /*overwrite=*/0);
  testing::InitGoogleTest(&argc, argv);
  if (!GTEST_FLAG_GET(list_tests)) std::printf("RC_PARAMS=\"%s\"\n", std::getenv("RC_PARAMS"));
  return RUN_ALL_TESTS();
}
