#pragma once

#include <optional>
#include <type_traits>
#include <utility>

namespace rota::detail {

/// f(), or `nullopt` if it threw. Where exceptions are switched off it is just f().
///
/// For the user's predicates and utilities: a decision every 30 ms must not end because one of them failed.
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
