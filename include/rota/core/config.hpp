#pragma once
/// @file
/// `ROTA_COMPILED`: compile what is no template once per program instead of once per source file.
///
/// By default the library is header-only. With ROTA_COMPILED defined for every source file of a program, the solvers of
/// dense/ are declared in their headers only, and exactly one source file includes `rota/compiled.hpp`, which defines them.
/// Layouts and results are the same either way.

/// Marks a function that is no template and is defined in a header.
#ifdef ROTA_COMPILED
#define ROTA_INLINE
#else
#define ROTA_INLINE inline
#endif
