#pragma once
/// @file
/// The one header that asks what compiler and processor offer for inner loops. Vector types are an extension that g++ and
/// clang share; there are no intrinsics.
///
/// A kernel is written as a plain loop and as a loop over vectors. Both return the same numbers, ties included.
/// - `ROTA_SIMD`: 1 if the compiler has vector types, else 0: then only the plain loops exist.
/// - `ROTA_SIMD_AVX2`: 1 if single functions can be compiled for AVX2 besides, whatever flags the unit has. Mark such a
///   function `ROTA_FOR_AVX2`, and call it only where `simd::has_avx2()` says so.
///
/// Define `ROTA_NO_SIMD` to use the plain loops only.
/// The check at run time stays when the unit itself is compiled with -mavx2: the linker may keep this unit's functions for
/// units that were compiled without.

#include <cstddef>

#define ROTA_SIMD 0
#if !defined(ROTA_NO_SIMD) && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#undef ROTA_SIMD
#define ROTA_SIMD 1
/// The elements of the vector variable `v` in the order of the indices that follow.
#define ROTA_SIMD_PERMUTE(v, ...) __builtin_shufflevector(v, v, __VA_ARGS__)
#elif __has_builtin(__builtin_shuffle)  // g++ 11
#undef ROTA_SIMD
#define ROTA_SIMD 1
#define ROTA_SIMD_PERMUTE(v, ...) __builtin_shuffle(v, decltype(v){__VA_ARGS__})
#endif
#endif

#if ROTA_SIMD && defined(__x86_64__)
#define ROTA_SIMD_AVX2 1
#define ROTA_FOR_AVX2 [[gnu::target("avx2")]] inline
#else
#define ROTA_SIMD_AVX2 0
#endif

/// A function that takes the instruction set of the function that calls it.
#if ROTA_SIMD
#define ROTA_SIMD_INLINE [[gnu::always_inline]] inline
#else
#define ROTA_SIMD_INLINE inline
#endif

namespace rota::detail::simd {

/// Whether the processor has AVX2. It was asked when the program started: a load and a test.
[[nodiscard]] inline bool has_avx2() noexcept {
#if ROTA_SIMD_AVX2
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

#if ROTA_SIMD

/// `Count` numbers side by side: in registers, and in memory at any address where a T may lie.
template <class T, std::size_t Count>
struct lanes {
  typedef T vector __attribute__((vector_size(Count * sizeof(T))));
  // A struct, since clang before 17 forgets the alignment of a vector type that depends on template parameters.
  struct [[gnu::packed, gnu::may_alias]] memory {
    vector v;
  };
};

/// The `Count` numbers from p on: `lanes_at<4>(p).v` is read or written as one vector.
template <std::size_t Count, class T>
ROTA_SIMD_INLINE typename lanes<T, Count>::memory const& lanes_at(T const* p) noexcept {
  return *reinterpret_cast<typename lanes<T, Count>::memory const*>(p);
}
template <std::size_t Count, class T>
ROTA_SIMD_INLINE typename lanes<T, Count>::memory& lanes_at(T* p) noexcept {
  return *reinterpret_cast<typename lanes<T, Count>::memory*>(p);
}

#endif

}  // namespace rota::detail::simd
