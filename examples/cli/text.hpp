#pragma once

#include <rota/model/cardinality.hpp>

#include <charconv>
#include <string>
#include <string_view>

namespace rota::cli {

/// The text with control characters made visible, so that no file can draw on the terminal or break a line.
[[nodiscard]] inline std::string printable(std::string_view s) {
  constexpr char digits[] = "0123456789abcdef";
  std::string out;
  for (char const c : s) {
    auto const b = static_cast<unsigned char>(c);
    if (b >= 0x20 && b != 0x7F) {
      out += c;
    } else {
      out += "\\x";
      out += digits[b >> 4U];
      out += digits[b & 15U];
    }
  }
  return out;
}

/// The shortest decimal that reads back as the same number.
[[nodiscard]] inline std::string number(double x) {
  char text[32];
  auto const end = std::to_chars(text, text + sizeof text, x).ptr;
  return {text, end};
}

/// "MIN..MAX"; no upper bound reads "*".
[[nodiscard]] inline std::string interval(cardinality c) {
  return std::to_string(c.min()) + ".." + (c.is_bounded() ? std::to_string(c.max()) : "*");
}

/// Spaces behind the text, to a column. Counts code points.
[[nodiscard]] inline std::string padded(std::string s, std::size_t width) {
  std::size_t shown = 0;
  for (char const c : s) shown += (static_cast<unsigned char>(c) & 0xC0U) != 0x80;
  if (shown < width) s.append(width - shown, ' ');
  return s;
}

/// "1 agent", "2 agents".
[[nodiscard]] inline std::string counted(std::size_t n, std::string_view what) {
  return std::to_string(n) + ' ' + std::string(what) + (n == 1 ? "" : "s");
}

}  // namespace rota::cli
