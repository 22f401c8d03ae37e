#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

/// Merges two sequences of signed atoms, each strictly ascending by atom. Which of two atoms is less cannot be
/// predicted, so no step branches on it. Each step waits for the one before it, so two merges run side by side, one
/// from each end.

namespace rota::detail {

/// b as 0 or 1. Hidden from the optimiser, which would turn a number made of a condition back into a branch.
constexpr std::size_t as_number(bool b) noexcept {
  std::size_t n = b;
  if (!std::is_constant_evaluated()) asm("" : "+r"(n));
  return n;
}

/// How many entries one step of a merge takes from each sequence, and how many it leaves: two entries of one atom leave
/// none if they cancel, one if they are equal.
struct merge_step {
  std::size_t from_x;
  std::size_t from_y;
  std::size_t left;

  template <class Entry>
  constexpr merge_step(Entry const& x, Entry const& y, bool x_first, bool y_first)
      : from_x(as_number(x_first)), from_y(as_number(y_first)), left((from_x ^ from_y) | (x.value == y.value)) {}
};

/// *out = *from, with the padding: so a large entry is copied by a few wide moves, not member by member.
template <class Entry>
constexpr void copy_whole(Entry* out, Entry const* from) {
  if constexpr (std::is_trivially_copyable_v<Entry>) {
    if (!std::is_constant_evaluated()) {
      std::memcpy(out, from, sizeof(Entry));
      return;
    }
  }
  *out = *from;
}

/// std::copy, without the call if there are few entries to copy.
template <class Entry>
constexpr Entry* copy_run(Entry const* first, Entry const* last, Entry* out) {
  if (last - first > 8) return std::copy(first, last, out);
  while (first != last) copy_whole(out++, first++);
  return out;
}

/// Merges sequences of similar length. O(|x| + |y|).
template <class Entry>
constexpr Entry* merge_evenly(Entry const* x, Entry const* x_end, Entry const* y, Entry const* y_end, Entry* out) {
  Entry* const end = out + (x_end - x) + (y_end - y);
  Entry* back = end;
  auto const at_the_front = [&] {
    merge_step const step(*x, *y, !(y->atom < x->atom), !(x->atom < y->atom));
    copy_whole(out, step.from_x ? x : y);
    x += step.from_x;
    y += step.from_y;
    out += step.left;
  };
  auto const at_the_back = [&] {
    auto const* const i = x_end - 1;
    auto const* const j = y_end - 1;
    merge_step const step(*i, *j, !(i->atom < j->atom), !(j->atom < i->atom));
    copy_whole(back - 1, step.from_x ? i : j);
    x_end -= step.from_x;
    y_end -= step.from_y;
    back -= step.left;
  };
  // The two ends cannot meet within so many steps.
  auto const safe_steps = [&] { return static_cast<std::size_t>((std::min)(x_end - x, y_end - y)) / 2; };
  for (auto steps = safe_steps(); steps > 1; steps = safe_steps())
    for (; steps > 0; --steps) {
      at_the_front();
      at_the_back();
    }
  while (x != x_end && y != y_end) at_the_front();
  out = copy_run(y, y_end, copy_run(x, x_end, out));
  return out == back ? end : std::move(back, end, out);
}

/// Merges a long sequence x and a short one y: finds the place of each entry of y by steps that double, and copies the
/// entries between. O(|y| log |x|) comparisons.
template <class Entry>
constexpr Entry* merge_into(Entry const* x, Entry const* x_end, Entry const* y, Entry const* y_end, Entry* out) {
  for (; y != y_end; ++y) {
    std::ptrdiff_t reach = 1;
    while (reach < x_end - x && x[reach].atom < y->atom) reach *= 2;
    auto const* const place = std::lower_bound(x + reach / 2, x + (std::min)(reach, x_end - x), y->atom,
                                               [](Entry const& entry, auto const& key) { return entry.atom < key; });
    out = std::copy(x, place, out);
    x = place;
    bool const partner = x != x_end && !(y->atom < x->atom);
    if (!partner || x->value == y->value) *out++ = *y;
    x += partner;
  }
  return std::copy(x, x_end, out);
}

/// Writes the clamped sum of two events, at most |x| + |y| entries, and returns their end.
template <class Entry>
constexpr Entry* merge(Entry const* x, Entry const* x_end, Entry const* y, Entry const* y_end, Entry* out) {
  constexpr std::size_t lopsided = 16;
  auto const m = static_cast<std::size_t>(x_end - x);
  auto const n = static_cast<std::size_t>(y_end - y);
  if (m / lopsided > n) return merge_into(x, x_end, y, y_end, out);
  if (n / lopsided > m) return merge_into(y, y_end, x, x_end, out);
  return merge_evenly(x, x_end, y, y_end, out);
}

}  // namespace rota::detail
