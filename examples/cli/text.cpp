#include "text.hpp"

#include <rota/adapters/alica/text.hpp>

#include <charconv>
#include <cstdio>

namespace rota::cli {
namespace {

std::string printed(char const* format, double x) {
  char text[64];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

}  // namespace

std::string printable(std::string_view s) {
  constexpr char digits[] = "0123456789abcdef";
  std::string out;
  auto const escape = [&](char kind, unsigned value, int from) {
    out += '\\';
    out += kind;
    for (int shift = from; shift >= 0; shift -= 4) out += digits[value >> static_cast<unsigned>(shift) & 15U];
  };
  auto const byte = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
  while (!s.empty()) {
    auto const sound = alica::detail::first_bad_byte(s).value_or(s.size());
    for (std::size_t i = 0; i < sound; ++i) {
      unsigned const b = byte(i);
      // In valid UTF-8 these characters have two or three bytes, so i + 1 and i + 2 are inside the text.
      unsigned const two = b == 0xC2 || b == 0xD8 ? (b & 31U) << 6U | (byte(i + 1) & 63U) : 0;
      unsigned const three = b == 0xE2 ? 0x2000U | (byte(i + 1) & 63U) << 6U | (byte(i + 2) & 63U) : 0;
      if (b < 0x20 || b == 0x7F) {
        escape('x', b, 4);
      } else if ((two >= 0x80 && two <= 0x9F) || two == 0x61C) {
        escape('u', two, 12);
        i += 1;
      } else if (three == 0x200E || three == 0x200F || (three >= 0x2028 && three <= 0x202E) ||
                 (three >= 0x2066 && three <= 0x2069)) {
        escape('u', three, 12);
        i += 2;
      } else {
        out += s[i];
      }
    }
    if (sound == s.size()) break;
    escape('x', byte(sound), 4);
    s.remove_prefix(sound + 1);
  }
  return out;
}

std::string joined(std::vector<std::string> const& names) {
  constexpr std::size_t limit = 400;
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) out += ", ";
    if (out.size() + names[i].size() > limit && i > 0) return out + "… (" + std::to_string(names.size()) + " in all)";
    out += names[i];
  }
  return out;
}

std::string number(double x) {
  char text[32];
  auto const end = std::to_chars(text, text + sizeof text, x).ptr;
  return {text, end};
}

std::string percent(double share) { return printed("%.1f %%", share * 100); }

std::string milliseconds_text(double ms) {
  if (ms < 1000) return printed("%.0f ms", ms);
  if (ms < 60'000) return printed("%.1f s", ms / 1000);
  return printed("%.1f min", ms / 60'000);
}

std::string interval(cardinality c) {
  return std::to_string(c.lower()) + ".." + (c.is_bounded() ? std::to_string(c.upper()) : "*");
}

std::string padded(std::string s, std::size_t width) {
  std::size_t shown = 0;
  for (char const c : s) shown += (static_cast<unsigned char>(c) & 0xC0U) != 0x80;
  if (shown < width) s.append(width - shown, ' ');
  return s;
}

std::string counted(std::size_t n, std::string_view what) {
  return std::to_string(n) + ' ' + std::string(what) + (n == 1 ? "" : "s");
}

}  // namespace rota::cli
