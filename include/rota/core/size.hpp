#pragma once

#include <cstddef>
#include <cstdint>

namespace rota::detail {

/// n as a size. A plain cast would be useless where sizes have 64 bits, and some compile with -Wuseless-cast.
/// @pre n fits
template <class Size = std::size_t>
[[nodiscard]] constexpr Size to_size(std::uint64_t n) noexcept {
  if constexpr (sizeof(Size) < sizeof n)
    return static_cast<Size>(n);
  else
    return n;
}

}  // namespace rota::detail
