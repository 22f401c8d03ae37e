#include "support/allocation_counter.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <thread>
#include <vector>

namespace {

// Compilers may elide a new whose result goes nowhere; a call through a volatile pointer they may not.
template <class F>
std::uint64_t allocations(F f) {
  F* volatile opaque = &f;
  auto const before = rota_test::allocation_count();
  (*opaque)();
  return rota_test::allocation_count() - before;
}

void* volatile kept_alive;

struct alignas(128) wide {
  std::byte bytes[128];
};

TEST(allocation_counter, sees_every_form_of_new) {
  EXPECT_EQ(allocations([] {
              auto p = std::make_unique<int>(1);
              kept_alive = p.get();
            }),
            1u);
  EXPECT_EQ(allocations([] {
              auto p = std::make_unique<int[]>(7);
              kept_alive = p.get();
            }),
            1u);
  EXPECT_EQ(allocations([] {
              auto p = std::make_unique<wide>();
              kept_alive = p.get();
            }),
            1u);
  EXPECT_EQ(allocations([] {
              auto p = std::make_unique<wide[]>(3);
              kept_alive = p.get();
            }),
            1u);
  EXPECT_EQ(allocations([] {
              std::unique_ptr<int> p{new (std::nothrow) int};
              kept_alive = p.get();
            }),
            1u);
  EXPECT_EQ(allocations([] {
              std::unique_ptr<int[]> p{new (std::nothrow) int[3]};
              kept_alive = p.get();
            }),
            1u);
  EXPECT_EQ(allocations([] {
              std::unique_ptr<wide> p{new (std::nothrow) wide};
              kept_alive = p.get();
            }),
            1u);
  EXPECT_EQ(allocations([] {
              std::unique_ptr<wide[]> p{new (std::nothrow) wide[2]};
              kept_alive = p.get();
            }),
            1u);
}

TEST(allocation_counter, sees_nothing_where_nothing_is_allocated) {
  std::vector<int> v;
  v.reserve(8);
  EXPECT_EQ(allocations([&] {
              for (int i = 0; i < 8; ++i) v.push_back(i);
            }),
            0u);
  EXPECT_EQ(allocations([&] { v.push_back(8); }), 1u) << "positive control: the ninth element must not fit";
}

TEST(allocation_counter, keeps_the_alignment_asked_for) {
  auto const p = std::make_unique<wide>();
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(p.get()) % alignof(wide), 0u);
}

TEST(allocation_counter, loses_no_count_between_threads) {
  auto const before = rota_test::allocation_count();
  auto const work = [] {
    for (int i = 0; i < 1000; ++i) {
      auto p = std::make_unique<int>(i);
      kept_alive = p.get();
    }
  };
  {
    std::jthread const a{work};
    std::jthread const b{work};
  }
  EXPECT_GE(rota_test::allocation_count() - before, 2000u);
}

}  // namespace
