#pragma once

#include <utility>

namespace rota::dense {

/// Owns a T that only its own source knows, so that headers which hold one need not include it. Made when first needed.
///
/// A copy owns nothing, and neither does what was moved from: each makes a T of its own when it needs one. Moving moves no
/// T, so views of what it holds stay valid.
template <class T>
class hidden {
public:
  hidden() = default;
  hidden(hidden const&) noexcept : hidden() {}
  hidden(hidden&& other) noexcept : hidden() { swap(other); }
  hidden& operator=(hidden const& other) noexcept {
    if (this != &other) hidden().swap(*this);
    return *this;
  }
  hidden& operator=(hidden&& other) noexcept {
    hidden(std::move(other)).swap(*this);
    return *this;
  }
  ~hidden() {
    if (item_ != nullptr) destroy_(item_);
  }
  void swap(hidden& other) noexcept {
    std::swap(item_, other.item_);
    std::swap(destroy_, other.destroy_);
  }

  /// The T; null if none has been needed yet.
  [[nodiscard]] T const* get() const noexcept { return item_; }
  /// The T, made if there is none. Only where T is complete.
  [[nodiscard]] T& made() {
    if (item_ == nullptr) {
      item_ = new T;
      destroy_ = [](T* item) { delete item; };
    }
    return *item_;
  }

private:
  T* item_ = nullptr;
  void (*destroy_)(T*) = nullptr;
};

}  // namespace rota::dense
