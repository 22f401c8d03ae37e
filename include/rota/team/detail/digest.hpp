#pragma once

#include <rota/core/identifier.hpp>
#include <rota/core/time.hpp>

#include <concepts>
#include <cstdint>
#include <optional>
#include <type_traits>

namespace rota::detail {

/// Folds values into 64 bits. Instants count relative to `now`, so equal states at different times have equal digests.
class state_digest {
public:
  explicit constexpr state_digest(instant now) noexcept : now_(now) {}

  [[nodiscard]] constexpr std::uint64_t value() const noexcept { return value_; }

  template <class T>
    requires std::integral<T> || std::is_enum_v<T>
  constexpr state_digest& operator()(T x) noexcept {
    mix(static_cast<std::uint64_t>(x));
    return *this;
  }
  constexpr state_digest& operator()(instant t) noexcept {
    mix(static_cast<std::uint64_t>(moved(t, instant{} - now_).ns));
    return *this;
  }
  /// An instant that decides nothing once it is past.
  constexpr state_digest& until(instant t) noexcept {
    mix(t > now_ ? static_cast<std::uint64_t>(t.ns - now_.ns) : 0);
    return *this;
  }
  constexpr state_digest& operator()(duration d) noexcept {
    mix(static_cast<std::uint64_t>(d.ns));
    return *this;
  }
  template <class Tag, class Rep>
  constexpr state_digest& operator()(strong_id<Tag, Rep> const& id) noexcept {
    return (*this)(id.value);
  }
  template <class T>
  constexpr state_digest& operator()(std::optional<T> const& x) {
    mix(x.has_value());
    return x ? (*this)(*x) : *this;
  }
  /// Classes that know what they consist of.
  template <class T>
    requires requires(T const& x, state_digest& d) { x.digest_into(d); }
  constexpr state_digest& operator()(T const& x) {
    x.digest_into(*this);
    return *this;
  }
  template <class T, class... More>
  constexpr state_digest& operator()(T const& x, More const&... more) {
    (*this)(x);
    return (*this)(more...);
  }
  template <class Range>
  constexpr state_digest& all(Range const& r) {
    std::uint64_t count = 0;
    for (auto const& x : r) (*this)(x), ++count;
    mix(count);
    return *this;
  }

private:
  constexpr void mix(std::uint64_t x) noexcept {
    value_ = (value_ ^ x) * 0x9e3779b97f4a7c15u;
    value_ ^= value_ >> 29;
    value_ = value_ * 0xbf58476d1ce4e5b9u;
    value_ ^= value_ >> 32;
  }

  instant now_;
  std::uint64_t value_ = 0x726f7461;
};

}  // namespace rota::detail
