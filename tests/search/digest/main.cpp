// The same number, whatever the flags: see CMakeLists.txt for those it is compiled with.
#include "search/digest/digest.hpp"

#include <cstdio>

int main() {
  auto const got = digest::compute();
  auto const of_pairs = digest::compute_of_pairs();
  std::printf("%#018llx %#018llx\n", static_cast<unsigned long long>(got), static_cast<unsigned long long>(of_pairs));
  return got == digest::expected && of_pairs == digest::expected_of_pairs ? 0 : 1;
}
