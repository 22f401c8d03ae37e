#pragma once
/// @file
/// `std::format` and `fmt::format` of every value that `rota/print.hpp` prints, with the format of strings:
/// `std::format("{:>12}", rota::milliseconds(30))`. Each where its library is there; without either, this header does
/// nothing. Include fmt before it if you configure fmt by macros.

#include <rota/print.hpp>

#include <string_view>
#include <version>

#if defined(__cpp_lib_format)
#include <format>

template <rota::printable T>
struct std::formatter<T, char> {
  constexpr auto parse(std::format_parse_context& context) { return as_text.parse(context); }
  template <class Context>
  auto format(T const& x, Context& context) const {
    return as_text.format(rota::detail::printed(x), context);
  }
  std::formatter<std::string_view, char>
      as_text;  // a member, for as a base it would put quotes around elements of ranges
};
#endif

#if !defined(FMT_VERSION) && __has_include(<fmt/core.h>)
#include <fmt/core.h>
#endif
#if defined(FMT_VERSION)
FMT_BEGIN_NAMESPACE

template <class T, class Char>
struct is_range;
/// A set of atoms is printed as we say it, not as a range, if fmt/ranges.h is included too.
template <rota::printable T>
struct is_range<T, char> {
  static constexpr bool value = false;
};
template <rota::printable T>
struct formatter<T, char, void> {
  template <class ParseContext>
  FMT_CONSTEXPR auto parse(ParseContext& context) {
    return as_text.parse(context);
  }
  template <class Context>
  auto format(T const& x, Context& context) const {
    auto const text = rota::detail::printed(x);
    return as_text.format(string_view(text.data(), text.size()), context);
  }
  formatter<string_view, char> as_text;
};

FMT_END_NAMESPACE
#endif
