// small_vector against std::vector: random operation sequences, the inline-heap boundary, copies and moves.

#include "support/allocation_counter.hpp"

#include <rota/core/small_vector.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <memory>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace small_vector_test {

namespace {

enum class op {
  push_back,
  push_back_own_element,
  pop_back,
  insert,
  insert_own_element,
  erase,
  erase_range,
  clear,
  reserve,
  resize,
  assign_range,
  assign_list,
  copy_construct,
  copy_assign,
  move_construct,
  move_assign,
  self_copy_assign,
  self_move_assign,
  swap,
  refill_moved_from,
  count
};

struct step {
  op what{};
  std::size_t i = 0;
  std::size_t j = 0;

  friend std::ostream& operator<<(std::ostream& out, step const& s) {
    return out << "{op " << static_cast<int>(s.what) << ", " << s.i << ", " << s.j << "}";
  }
};

// Long enough to be on the heap themselves, so that the sanitizers notice a place destroyed twice or never.
std::string text(std::size_t i) {
  return "an element too long for the small string buffer, number " + std::to_string(i);
}

template <class V>
bool same(V const& v, std::vector<std::string> const& model) {
  if (v.size() != model.size() || v.empty() != model.empty() || v.capacity() < v.size()) return false;
  if (static_cast<std::size_t>(v.end() - v.begin()) != model.size() || v.data() != v.begin()) return false;
  for (std::size_t i = 0; i < model.size(); ++i)
    if (v[i] != model[i]) return false;
  return model.empty() || v.back() == model.back();
}

template <class V>
void perform(V& v, V& other, step const& s) {
  auto const at = v.empty() ? 0 : s.i % v.size();
  auto const gap = s.i % (v.size() + 1);
  auto const where = [&](std::size_t n) { return v.begin() + static_cast<std::ptrdiff_t>(n); };
  auto const range = [&] {
    std::vector<std::string> r;
    for (std::size_t k = 0; k < s.i % 12; ++k) r.push_back(text(s.j + k));
    return r;
  };
  switch (s.what) {
  case op::push_back: v.push_back(text(s.j)); break;
  case op::push_back_own_element:
    if (!v.empty()) v.push_back(v[at]);
    break;
  case op::pop_back:
    if (!v.empty()) v.pop_back();
    break;
  case op::insert: v.insert(where(gap), text(s.j)); break;
  case op::insert_own_element:
    if (!v.empty()) v.insert(where(gap), v[s.j % v.size()]);
    break;
  case op::erase:
    if (!v.empty()) v.erase(where(at));
    break;
  case op::erase_range: {
    auto const last = gap + s.j % (v.size() - gap + 1);
    v.erase(where(gap), where(last));
    break;
  }
  case op::clear: v.clear(); break;
  case op::reserve: v.reserve(s.i % 20); break;
  case op::resize: v.resize(s.i % 12); break;
  case op::assign_range: {
    auto const r = range();
    v.assign(r.begin(), r.end());
    break;
  }
  case op::assign_list: v = V{text(s.i), text(s.j), text(s.i)}; break;
  case op::copy_construct: {
    V copy(v);
    copy.push_back(text(s.j));  // must not be seen through v
    break;
  }
  case op::copy_assign: other = std::as_const(v); break;
  case op::move_construct: {
    V moved(std::move(v));
    v = std::move(moved);
    break;
  }
  case op::move_assign: other = std::exchange(v, V{}); break;
  case op::self_copy_assign: {
    auto& alias = v;
    v = std::as_const(alias);
    break;
  }
  case op::self_move_assign:
    if constexpr (!std::is_same_v<V, std::vector<std::string>>) {  // std::vector promises nothing here; ours is a no-op
      auto& alias = v;
      v = std::move(alias);
    }
    break;
  case op::swap: std::swap(v, other); break;
  case op::refill_moved_from: {
    V taken(std::move(v));
    v.clear();
    v.push_back(text(s.j));
    other = std::move(taken);
    break;
  }
  case op::count: break;
  }
}

/// The checker: compares V with std::vector after every step.
template <class V>
bool agrees_with_std_vector(std::vector<step> const& steps) {
  V v;
  V other;
  std::vector<std::string> model;
  std::vector<std::string> model_other;
  for (step const& s : steps) {
    perform(v, other, s);
    perform(model, model_other, s);
    if (!same(v, model) || !same(other, model_other)) return false;
    if ((v == other) != (model == model_other)) return false;
    if ((v <=> other) != (model <=> model_other)) return false;
  }
  return true;
}

auto steps() {
  // Resized, because inRange otherwise starts with the first few operations only.
  auto const below = [](std::size_t n) { return rc::gen::resize(100, rc::gen::inRange<std::size_t>(0, n)); };
  auto const one = rc::gen::map(rc::gen::tuple(below(static_cast<std::size_t>(op::count)), below(64), below(64)),
                                [](std::tuple<std::size_t, std::size_t, std::size_t> const& t) {
                                  return step{static_cast<op>(std::get<0>(t)), std::get<1>(t), std::get<2>(t)};
                                });
  return rc::gen::mapcat(below(40), [one](std::size_t n) { return rc::gen::container<std::vector<step>>(n, one); });
}

template <std::size_t N>
using strings = rota::small_vector<std::string, N>;

/// Wrong model: when it moves to the heap, it leaves one element behind.
struct loses_one_at_the_boundary : strings<4> {
  using strings<4>::strings;
  void push_back(std::string item) {
    bool const leaves = size() == capacity();
    strings<4>::push_back(std::move(item));
    if (leaves) pop_back();
  }
  friend bool operator==(loses_one_at_the_boundary const&, loses_one_at_the_boundary const&) = default;
  friend auto operator<=>(loses_one_at_the_boundary const&, loses_one_at_the_boundary const&) = default;
};

}  // namespace

RC_GTEST_PROP(small_vector, is_std_vector_with_one_inline, ()) {
  RC_ASSERT(agrees_with_std_vector<strings<1>>(*steps().as("steps")));
}

RC_GTEST_PROP(small_vector, is_std_vector_with_four_inline, ()) {
  RC_ASSERT(agrees_with_std_vector<strings<4>>(*steps().as("steps")));
}

RC_GTEST_PROP(small_vector, is_std_vector_with_eight_inline, ()) {
  RC_ASSERT(agrees_with_std_vector<strings<8>>(*steps().as("steps")));
}

TEST(small_vector, sequences_reach_the_boundary_and_a_wrong_model_is_rejected) {
  constexpr int cases = 500;
  int crosses = 0;
  int moves_on_heap = 0;
  int rejects = 0;
  auto const gen = steps();
  for (int i = 0; i < cases; ++i) {
    auto const sequence = gen(rc::Random(static_cast<std::uint64_t>(i)), 50).value();
    strings<4> v;
    strings<4> other;
    bool crossed = false;
    bool moved = false;
    for (step const& s : sequence) {
      bool const on_heap = v.capacity() > 4;
      perform(v, other, s);
      crossed |= !on_heap && v.capacity() > 4;
      moved |= on_heap && (s.what == op::move_construct || s.what == op::move_assign || s.what == op::swap);
    }
    crosses += crossed;
    moves_on_heap += moved;
    rejects += !agrees_with_std_vector<loses_one_at_the_boundary>(sequence);
  }
  EXPECT_GE(crosses, cases / 2);
  EXPECT_GE(moves_on_heap, cases / 5);
  EXPECT_GE(rejects, cases / 10);
}

TEST(small_vector, a_moved_from_vector_is_empty_and_usable) {
  for (std::size_t const n : {0u, 3u, 4u, 5u, 9u}) {
    strings<4> v;
    for (std::size_t i = 0; i < n; ++i) v.push_back(text(i));
    strings<4> const copy = v;
    strings<4> const moved = std::move(v);
    EXPECT_EQ(moved, copy);
    EXPECT_TRUE(v.empty());
    EXPECT_EQ(v.capacity(), 4u);
    v.push_back(text(n));
    EXPECT_EQ(v.back(), text(n));
    EXPECT_EQ(moved, copy);
  }
}

TEST(small_vector, insert_and_erase_return_the_place) {
  rota::small_vector<int, 2> v{1, 2, 4};
  EXPECT_EQ(*v.insert(v.begin() + 2, 3), 3);
  EXPECT_EQ(v, (rota::small_vector<int, 2>{1, 2, 3, 4}));
  EXPECT_EQ(*v.erase(v.begin()), 2);
  auto const* const after = v.erase(v.begin() + 1, v.end());
  EXPECT_EQ(after, v.end());
  EXPECT_EQ(v, (rota::small_vector<int, 2>{2}));
}

TEST(small_vector, append_keeps_what_was_written_and_no_more) {
  for (std::size_t had : {0u, 3u, 4u, 9u}) {
    strings<4> v;
    for (std::size_t i = 0; i < had; ++i) v.push_back(text(i));
    strings<4> expected = v;
    expected.push_back(text(20));
    expected.push_back(text(21));
    v.append(7, [](std::string* out) {
      *out++ = text(20);
      *out++ = text(21);
      *out = text(22);  // taken back
      return out;
    });
    EXPECT_EQ(v, expected) << "after " << had;
  }
}

TEST(small_vector, allocates_only_past_its_inline_capacity) {
  auto const before = rota_test::allocation_count();
  rota::small_vector<int, 8> v;
  for (int i = 0; i < 8; ++i) v.push_back(i);
  rota::small_vector<int, 8> copy = v;
  rota::small_vector<int, 8> moved = std::move(copy);
  copy = moved;
  auto const inside = rota_test::allocation_count() - before;
  v.push_back(8);
  auto const outside = rota_test::allocation_count() - before;
  EXPECT_EQ(inside, 0u);
  EXPECT_EQ(outside, 1u);
}

TEST(small_vector, moving_from_the_heap_steals_the_storage) {
  rota::small_vector<int, 2> v{1, 2, 3};
  auto const* const storage = v.data();
  auto const before = rota_test::allocation_count();
  rota::small_vector<int, 2> const moved = std::move(v);
  EXPECT_EQ(rota_test::allocation_count() - before, 0u);
  EXPECT_EQ(moved.data(), storage);
}

TEST(small_vector, erasing_nothing_changes_nothing) {
  strings<2> v{text(0), text(1), text(2)};
  strings<2> const before = v;
  for (std::size_t i = 0; i <= v.size(); ++i) {
    v.erase(v.begin() + i, v.begin() + i);
    EXPECT_EQ(v, before) << "at " << i;
  }
}

namespace {

constexpr int sum_in_a_constant_expression() {
  rota::small_vector<int, 2> v;
  for (int i = 5; i > 0; --i) v.push_back(i);
  std::sort(v.begin(), v.end());
  rota::small_vector<int, 2> w = v;
  v = std::move(w);
  v.erase(v.begin());
  v.insert(v.begin(), 10);
  int weighted = 0;
  for (std::size_t i = 0; i < v.size(); ++i) weighted = 10 * weighted + v[i];
  return weighted;
}
static_assert(sum_in_a_constant_expression() == 102345);
static_assert(rota::small_vector<int, 4>{1, 2} < rota::small_vector<int, 4>{1, 2, 0});
static_assert(rota::small_vector<int, 4>{1, 3} > rota::small_vector<int, 4>{1, 2, 9, 9, 9});

}  // namespace

#ifndef NDEBUG
TEST(small_vector_death, misuse_is_asserted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  rota::small_vector<int, 2> v{1};
  EXPECT_DEATH((void)v[1], "i < size_");
  v.clear();
  EXPECT_DEATH(v.pop_back(), "size_ > 0");
}
#endif

}  // namespace small_vector_test
