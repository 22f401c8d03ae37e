#pragma once
/// @file
/// `ROTA_ASSERT(condition)` checks a `@pre`; `ROTA_REPORT(text)` prints a line of text before the program ends.
///
/// Define either before the first include to route failures to your engine, or as `((void)0)` to drop it. Neither
/// changes a layout, or a result of a correct program.

#include <rota/core/config.hpp>

#ifndef ROTA_ASSERT
#include <cassert>
#define ROTA_ASSERT(condition) assert(condition)
#endif

/// Called with a line of text just before the program ends because a refused `result` was taken for a value.
#ifndef ROTA_REPORT
#include <cstdio>
#define ROTA_REPORT(text) ((void)std::fputs(text, stderr))
#endif
