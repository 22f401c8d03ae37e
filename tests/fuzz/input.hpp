#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

/// Each program here is one function from bytes to a verdict: it returns, or it ends the process and says what broke.
extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size);

namespace fuzz {

/// Ends the process if `holds` is false, in every build type.
inline void require(bool holds, char const* what) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", what);
  std::abort();
}

/// The bytes of one input as numbers. From its end on, everything reads as 0.
class input {
public:
  input(std::uint8_t const* data, std::size_t size) : left_(data, size) {}

  [[nodiscard]] bool empty() const { return left_.empty(); }
  std::uint8_t byte() {
    if (left_.empty()) return 0;
    auto const x = left_.front();
    left_ = left_.subspan(1);
    return x;
  }
  /// A number below n. @pre 0 < n ≤ 256
  unsigned below(unsigned n) { return byte() % n; }
  std::uint64_t word() {
    std::uint64_t x = 0;
    for (int k = 0; k < 8; ++k) x = x << 8 | byte();
    return x;
  }
  /// Up to n bytes.
  std::span<std::uint8_t const> bytes(std::size_t n) {
    auto const some = left_.first(n < left_.size() ? n : left_.size());
    left_ = left_.subspan(some.size());
    return some;
  }

private:
  std::span<std::uint8_t const> left_;
};

}  // namespace fuzz
