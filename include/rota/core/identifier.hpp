#pragma once

#include <rota/core/config.hpp>

#include <compare>
#include <concepts>
#include <cstdint>
#include <type_traits>

namespace rota {

/// A name: regular, totally ordered, cheap to copy. Enumerations, integers and `strong_id<Tag>` are identifiers.
///
/// Refuses `double` and `float`: NaN makes their order partial, and two robots may round differently.
template <class T>
concept identifier =
    std::regular<T> && std::totally_ordered<T> && std::is_trivially_copyable_v<T> && !std::floating_point<T>;

/// An identifier that is known only at run time, for names read from plan files or messages.
///
/// `Rep` is 64 bits by default, as ALICA's ids are; use an array of 16 bytes for UUIDs. Identifiers of different tags
/// do not convert to each other.
template <class Tag, class Rep = std::uint64_t>
struct strong_id {
  using rep = Rep;
  Rep value{};

  friend std::strong_ordering operator<=>(strong_id const&, strong_id const&) = default;
};

}  // namespace rota
