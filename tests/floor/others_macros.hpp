#pragma once
/// @file
/// What other people's headers define, after the standard library and before rota: each use of such a name is an error.

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <charconv>
#include <chrono>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#if __has_include(<format>)
#include <format>
#endif
#include <fstream>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <ostream>
#include <set>
#include <source_location>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>
#if __has_include(<Eigen/Sparse>)
#include <Eigen/Sparse>
#include <boost/random.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <rapidcheck.h>
#endif

#if __has_include(<fmt/format.h>)
#include <fmt/format.h>
#endif

#define rota_took_a_macro #
// windows.h
#define min(a, b) rota_took_a_macro
#define max(a, b) rota_took_a_macro
#define near rota_took_a_macro
#define far rota_took_a_macro
#define small rota_took_a_macro
#define interface rota_took_a_macro
#define pascal rota_took_a_macro
#define IN rota_took_a_macro
#define OUT rota_took_a_macro
#define OPTIONAL rota_took_a_macro
#define ERROR rota_took_a_macro
#define DELETE rota_took_a_macro
#define IGNORE rota_took_a_macro
#define STRICT rota_took_a_macro
// Qt
#define slots rota_took_a_macro
#define signals rota_took_a_macro
#define emit rota_took_a_macro
#define foreach rota_took_a_macro
#define forever rota_took_a_macro
// X11
#define None rota_took_a_macro
#define Bool rota_took_a_macro
#define Status rota_took_a_macro
#define Success rota_took_a_macro
#define True rota_took_a_macro
#define False rota_took_a_macro
// sys/sysmacros.h
#define major(x) rota_took_a_macro
#define minor(x) rota_took_a_macro
#define makedev(x, y) rota_took_a_macro
// Apple's AssertMacros.h
#define check(x) rota_took_a_macro
#define verify(x) rota_took_a_macro
#define require(x, y) rota_took_a_macro
