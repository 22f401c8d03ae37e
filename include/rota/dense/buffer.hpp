#pragma once

#include <rota/core/assert.hpp>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace rota::dense {

/// A growing array of plain values: the part of std::vector that solvers need. Each instantiation of std::vector costs a
/// unit hundredths of a second to compile, and there are a dozen kinds of values here.
///
/// Never shrinks. Complexity and guarantees as std::vector.
template <class T>
class buffer {
  static_assert(std::is_trivially_copyable_v<T>);

public:
  buffer() = default;
  buffer(buffer const& other) { assign(other.begin(), other.end()); }
  buffer(buffer&& other) noexcept { swap(other); }
  buffer& operator=(buffer const& other) {
    if (this != &other) assign(other.begin(), other.end());
    return *this;
  }
  buffer& operator=(buffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~buffer() { delete[] items_; }

  void swap(buffer& other) noexcept {
    std::swap(items_, other.items_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  [[nodiscard]] T* data() noexcept { return items_; }
  [[nodiscard]] T const* data() const noexcept { return items_; }
  [[nodiscard]] T* begin() noexcept { return items_; }
  [[nodiscard]] T const* begin() const noexcept { return items_; }
  [[nodiscard]] T* end() noexcept { return items_ + size_; }
  [[nodiscard]] T const* end() const noexcept { return items_ + size_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  /// @pre i < size()
  [[nodiscard]] T& operator[](std::size_t i) noexcept {
    ROTA_ASSERT(i < size_);
    return items_[i];
  }
  [[nodiscard]] T const& operator[](std::size_t i) const noexcept {
    ROTA_ASSERT(i < size_);
    return items_[i];
  }

  void clear() noexcept { size_ = 0; }
  void reserve(std::size_t wanted) {
    if (wanted <= capacity_) return;
    T* const bigger = new T[wanted];
    std::copy(begin(), end(), bigger);
    delete[] std::exchange(items_, bigger);
    capacity_ = wanted;
  }
  /// New elements are T{}.
  void resize(std::size_t wanted) {
    reserve(wanted);
    if (wanted > size_) std::fill(items_ + size_, items_ + wanted, T{});
    size_ = wanted;
  }
  void assign(std::size_t count, T value) {
    size_ = 0;
    reserve(count);
    std::fill(items_, items_ + count, value);
    size_ = count;
  }
  template <class I>
    requires(!std::is_integral_v<I>)
  void assign(I first, I last) {
    size_ = 0;
    reserve(static_cast<std::size_t>(last - first));
    size_ = static_cast<std::size_t>(std::copy(first, last, items_) - items_);
  }
  void push_back(T value) {
    if (size_ == capacity_) reserve(2 * capacity_ + 8);
    items_[size_++] = value;
  }

private:
  T* items_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace rota::dense
