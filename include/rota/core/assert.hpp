#pragma once
/// @file
/// `ROTA_ASSERT(condition)`: misuse by the programmer, named in each `@pre`.
///
/// Define it before the first include to route failures to your engine, or to `((void)0)` to drop the checks.
/// Whatever it is, no layout and no result of a correct program changes.

#ifndef ROTA_ASSERT
#include <cassert>
#define ROTA_ASSERT(condition) assert(condition)
#endif
