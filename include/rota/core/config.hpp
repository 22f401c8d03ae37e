#pragma once
/// @file
/// Says in one line when the compiler is older than what is tested (`tests/floor/run`).
///
/// `ROTA_COMPILED`: compile what is no template once per program instead of once per source file.
///
/// By default the library is header-only. With ROTA_COMPILED defined for every source file of a program, the solvers of
/// dense/ are declared in their headers only, and exactly one source file includes `rota/compiled.hpp`, which defines them.
/// Layouts and results are the same either way.

#if defined(_MSC_VER) && !defined(__clang__)
#error "rota needs g++ 11 or later, or clang 15 or later"
#elif defined(__apple_build_version__)
// Numbered otherwise, and not tested.
#elif defined(__clang_major__) && __clang_major__ < 15
#error "rota needs clang 15 or later"
#elif !defined(__clang__) && defined(__GNUC__) && __GNUC__ < 11
#error "rota needs g++ 11 or later"
#elif __cplusplus < 202002L
#error "rota needs C++20: compile with -std=c++20"
#endif

#include <cstddef>  // tells which standard library this is
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 170000
#error "rota needs libc++ 17 or later, or libstdc++ 11 or later"
#endif

/// Marks a function that is no template and is defined in a header.
#ifdef ROTA_COMPILED
#define ROTA_INLINE
#else
#define ROTA_INLINE inline
#endif
