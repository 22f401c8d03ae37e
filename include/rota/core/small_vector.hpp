#pragma once

#include <rota/core/assert.hpp>

#include <algorithm>
#include <compare>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>

namespace rota {

namespace detail {

struct filled {};

/// N places for a type that is trivially copied. Assigning starts its lifetime, so only constant expressions need the
/// places to be filled first.
template <class T, std::size_t N>
union unfilled_places {
  constexpr unfilled_places() noexcept {}
  constexpr explicit unfilled_places(filled) : items{} {}
  T items[N];
};
template <class T, std::size_t N>
struct filled_places {
  T items[N]{};
};

}  // namespace detail

/// A sequence that keeps up to `N` elements inside the object, and allocates only for more.
///
/// Not boost::container::small_vector: Boost 1.74 offers it in no constant expression, and it costs three times
/// `<vector>` to include. This one stays short because elements are regular and default constructible. A removed
/// element keeps its last value until it is overwritten.
///
/// Complexity: as std::vector; move is O(N) while inline.
template <std::semiregular T, std::size_t N>
class small_vector {
public:
  using value_type = T;
  using size_type = std::size_t;
  using iterator = T*;
  using const_iterator = T const*;
  static constexpr bool nothrow_movable = std::is_nothrow_move_assignable_v<T>;

  constexpr small_vector() : inline_(no_places()) {}
  // It delegates, so that the destructor runs if copying an element throws.
  constexpr small_vector(std::initializer_list<T> items) : small_vector(items.begin(), items.end()) {}
  template <std::input_iterator I, std::sentinel_for<I> S>
  constexpr small_vector(I first, S last) : small_vector() {
    assign(first, last);
  }

  constexpr small_vector(small_vector const& other) : small_vector(other.begin(), other.end()) {}
  constexpr small_vector(small_vector&& other) noexcept(nothrow_movable) : small_vector() { take(other); }
  constexpr small_vector& operator=(small_vector const& other) {
    if (this != &other) assign(other.begin(), other.end());
    return *this;
  }
  constexpr small_vector& operator=(small_vector&& other) noexcept(nothrow_movable) {
    if (this != &other) {
      release(std::exchange(heap_, nullptr));
      take(other);
    }
    return *this;
  }
  constexpr ~small_vector() { release(heap_); }

  [[nodiscard]] constexpr T* data() noexcept { return heap_ ? heap_ : inline_.items; }
  [[nodiscard]] constexpr T const* data() const noexcept { return heap_ ? heap_ : inline_.items; }
  [[nodiscard]] constexpr T* begin() noexcept { return data(); }
  [[nodiscard]] constexpr T* end() noexcept { return data() + size_; }
  [[nodiscard]] constexpr T const* begin() const noexcept { return data(); }
  [[nodiscard]] constexpr T const* end() const noexcept { return data() + size_; }
  [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }
  [[nodiscard]] constexpr std::size_t capacity() const noexcept { return capacity_; }
  [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }

  /// @pre `i < size()`
  [[nodiscard]] constexpr T& operator[](std::size_t i) noexcept {
    ROTA_ASSERT(i < size_);
    return data()[i];
  }
  [[nodiscard]] constexpr T const& operator[](std::size_t i) const noexcept {
    ROTA_ASSERT(i < size_);
    return data()[i];
  }
  /// @pre `!empty()`
  [[nodiscard]] constexpr T& back() noexcept { return (*this)[size_ - 1]; }
  [[nodiscard]] constexpr T const& back() const noexcept { return (*this)[size_ - 1]; }

  constexpr void clear() noexcept { size_ = 0; }

  constexpr void reserve(std::size_t wanted) {
    if (wanted <= capacity_) return;
    struct owner {  // std::unique_ptr works in no constant expression before C++23
      T* items;
      constexpr ~owner() { release(items); }
    } bigger{obtain(wanted)};
    std::move(begin(), end(), bigger.items);
    std::swap(heap_, bigger.items);
    capacity_ = wanted;
  }

  constexpr void resize(std::size_t wanted) {
    reserve(wanted);
    for (std::size_t i = size_; i < wanted; ++i) data()[i] = T{};
    size_ = wanted;
  }

  constexpr void push_back(T const& item) {
    if (size_ == capacity_) return grow(T(item));
    data()[size_++] = item;
  }
  constexpr void push_back(T&& item) {
    if (size_ == capacity_) return grow(std::move(item));
    data()[size_++] = std::move(item);
  }
  /// Calls `write(first)`, which writes at most `most` elements from `first` on and returns their end, and appends
  /// these. For loops that cannot afford to check the capacity for each element.
  template <std::invocable<T*> F>
  constexpr void append(std::size_t most, F&& write) {
    reserve(size_ + most);
    T* const first = end();
    size_ += static_cast<std::size_t>(write(first) - first);
  }
  /// @pre `!empty()`
  constexpr void pop_back() noexcept {
    ROTA_ASSERT(size_ > 0);
    --size_;
  }

  constexpr T* insert(T const* where, T item) {
    auto const at = where - data();
    push_back(std::move(item));
    std::rotate(data() + at, end() - 1, end());
    return data() + at;
  }
  constexpr T* erase(T const* where) { return erase(where, where + 1); }
  constexpr T* erase(T const* first, T const* last) {
    auto const at = first - data();
    auto const count = last - first;
    if (count > 0) std::move(data() + at + count, end(), data() + at);  // no self-move: it would empty a string
    size_ -= static_cast<std::size_t>(count);
    return data() + at;
  }

  template <class I, class S>
  constexpr void assign(I first, S last) {
    size_ = 0;
    if constexpr (std::sized_sentinel_for<S, I>) reserve(static_cast<std::size_t>(last - first));
    for (; first != last; ++first) push_back(*first);
  }

  friend constexpr bool operator==(small_vector const& a, small_vector const& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }
  friend constexpr auto operator<=>(small_vector const& a, small_vector const& b)
    requires std::three_way_comparable<T>
  {
    return std::lexicographical_compare_three_way(a.begin(), a.end(), b.begin(), b.end());
  }

private:
  // Assigning starts the lifetime of a trivially copied element; filling the places first would double the cost of a
  // large result.
  static constexpr bool needs_no_filling =
      std::is_trivially_copyable_v<T> && alignof(T) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__;

  using places = std::conditional_t<needs_no_filling, detail::unfilled_places<T, N>, detail::filled_places<T, N>>;

  static constexpr places no_places() {
    if constexpr (needs_no_filling) {
      return std::is_constant_evaluated() ? places(detail::filled{}) : places();
    } else {
      return places();
    }
  }
  static constexpr T* obtain(std::size_t count) {
    if (!needs_no_filling || std::is_constant_evaluated()) return new T[count]{};
    constexpr auto most = (std::numeric_limits<std::size_t>::max)();
    return static_cast<T*>(::operator new(count <= most / sizeof(T) ? count * sizeof(T) : most));
  }
  static constexpr void release(T* items) noexcept {
    if (!needs_no_filling || std::is_constant_evaluated()) {
      delete[] items;
    } else if (items) {
      ::operator delete(items);
    }
  }
  constexpr void grow(T item) {
    reserve(capacity_ < 4 ? 8 : 2 * capacity_);
    data()[size_++] = std::move(item);
  }
  constexpr void take(small_vector& other) noexcept(nothrow_movable) {
    heap_ = std::exchange(other.heap_, nullptr);
    capacity_ = std::exchange(other.capacity_, N);
    size_ = std::exchange(other.size_, 0);
    if (!heap_) std::move(other.begin(), other.begin() + size_, inline_.items);
  }

  places inline_;
  T* heap_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = N;
};

}  // namespace rota
