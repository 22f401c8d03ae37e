#pragma once

#include <cstddef>
#include <cstdint>

namespace rota::dense::detail {

/// A number of a row and where it stands; of equal ones the first.
struct row_entry {
  std::int64_t value;
  std::size_t at;
};

/// The two greatest numbers of a row, and where the first stands. `second` is `nothing` in a row of one.
struct row_leaders {
  static constexpr std::int64_t nothing = -(std::int64_t{3} << 61);  // less than any number, and can be subtracted
  std::int64_t first;
  std::int64_t second;
  std::size_t at;
};

}  // namespace rota::dense::detail
