#pragma once

#include <optional>
#include <type_traits>
#include <utility>

namespace rota::detail {

/// f(), or `nullopt` if it threw. With -fno-exceptions it is just f().
///
/// For the user's predicates and utilities: a team must be able to decide although one of them fails.
template <class F>
[[nodiscard]] std::optional<std::invoke_result_t<F&>> guarded(F&& f) {
#if defined(__cpp_exceptions)
  try {
    return f();
  } catch (...) {
    return std::nullopt;
  }
#else
  return f();
#endif
}

}  // namespace rota::detail
