#pragma once
/// @file
/// `ROTA_LIFETIMEBOUND` behind a parameter: the object refers to its argument, which must outlive it. Clang warns where it
/// sees that it does not.

#if defined(__has_cpp_attribute) && defined(__clang__)
#if __has_cpp_attribute(clang::lifetimebound)
#define ROTA_LIFETIMEBOUND [[clang::lifetimebound]]
#endif
#endif
#ifndef ROTA_LIFETIMEBOUND
#define ROTA_LIFETIMEBOUND
#endif
