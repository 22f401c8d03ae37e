#pragma once
/// @file
/// Text for names, atoms, times and numbers. A header of its own, since deciding needs no strings.
///
/// Your own names are used wherever a value is printed: give the identifier a `to_string` beside its type, and
/// `In(left, kickoff, attack)` is printed instead of `In(1, 0, 1)`.

#include <rota/core/atom.hpp>
#include <rota/core/finite.hpp>
#include <rota/core/result.hpp>
#include <rota/core/time.hpp>

#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <type_traits>

namespace rota {

namespace detail {

/// What `to_string` finds beside the type of its argument, and nothing else.
namespace beside {

void to_string();

template <class T>
concept printable = requires(T const& x) { std::string(to_string(x)); };
template <printable T>
[[nodiscard]] std::string text(T const& x) {
  return std::string(to_string(x));
}
template <class T, class Names>
concept printable_with = requires(T const& x, Names const& name) { std::string(to_string(x, name)); };
template <class Names, printable_with<Names> T>
[[nodiscard]] std::string text(T const& x, Names const& name) {
  return std::string(to_string(x, name));
}

}  // namespace beside

template <class T>
concept has_floating_to_chars = requires(char* p, T x) { std::to_chars(p, p, x, std::chars_format::fixed); };

/// "d.ddd" × 10^exponent, from digits without leading zeros: 1e-05 ≤ |x| < 1e16 without an exponent.
[[nodiscard]] inline std::string decimal(bool negative, std::string digits, int exponent) {
  while (digits.size() > 1 && digits.back() == '0') digits.pop_back();
  std::string out = negative ? "-" : "";
  auto const count = static_cast<int>(digits.size());
  if (exponent < -5 || exponent >= 16) {
    auto const size = std::to_string(std::abs(exponent));
    out += digits.substr(0, 1) + (count > 1 ? "." + digits.substr(1) : "");
    return out + (exponent < 0 ? "e-" : "e+") + (size.size() < 2 ? "0" : "") + size;
  }
  if (exponent < 0) return out + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  if (count <= exponent + 1) return out + digits + std::string(static_cast<std::size_t>(exponent + 1 - count), '0');
  auto const whole = static_cast<std::size_t>(exponent) + 1;
  return out + digits.substr(0, whole) + "." + digits.substr(whole);
}

/// `number(x)` for libraries without std::to_chars of double: the fewest digits that printf and strtod agree on. Both
/// read and write the locale's decimal point, which is dropped. @pre x is finite
[[nodiscard]] inline std::string number_by_printf(double const& x) {
  char text[64];
  for (int precision = 0;; ++precision) {
    std::snprintf(text, sizeof text, "%.*e", precision, x);
    if (precision >= 16 || !(std::strtod(text, nullptr) < x || std::strtod(text, nullptr) > x)) break;
  }
  std::string digits;
  char const* p = text;
  for (; *p != 'e'; ++p)
    if (*p >= '0' && *p <= '9') digits += *p;
  return decimal(has_minus_sign(x), digits, std::atoi(p + 1));
}

/// x in decimal, in the fewest digits from which the same double is read back, whatever the locale: `-1234.5`, `1e+16`,
/// `inf`, `nan`.
template <std::same_as<double> T>
[[nodiscard]] std::string number(T const& x) {
  if (is_nan(x)) return "nan";
  if (!is_finite(x)) return has_minus_sign(x) ? "-inf" : "inf";
  if constexpr (has_floating_to_chars<T>) {
    auto const size = x < 0 ? -x : x;
    auto const format =
        size == 0 || (size >= 1e-5 && size < 1e16) ? std::chars_format::fixed : std::chars_format::scientific;
    char text[64];
    return std::string(text, std::to_chars(text, text + sizeof text, x, format).ptr);
  } else {
    return number_by_printf(x);
  }
}
template <std::same_as<float> T>
[[nodiscard]] std::string number(T const& x) {
  return number(static_cast<double>(x));
}
template <std::integral T>
[[nodiscard]] std::string number(T n) {
  return std::to_string(n);
}

/// Bytes in hexadecimal; sixteen of them grouped as a UUID.
template <class Bytes>
[[nodiscard]] std::string hexadecimal(Bytes const& bytes) {
  constexpr char digits[] = "0123456789abcdef";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes.size() == 16 && (i == 4 || i == 6 || i == 8 || i == 10)) out += '-';
    auto const byte = static_cast<unsigned>(bytes[i]);
    out += digits[byte >> 4 & 15];
    out += digits[byte & 15];
  }
  return out;
}

/// A whole number of nanoseconds in this unit, exactly: `1.5`.
[[nodiscard]] inline std::string in_unit(std::int64_t ns, std::uint64_t unit) {
  auto const size = ns < 0 ? 0 - static_cast<std::uint64_t>(ns) : static_cast<std::uint64_t>(ns);
  std::string out = (ns < 0 ? "-" : "") + std::to_string(size / unit);
  if (auto rest = size % unit; rest != 0) {
    out += '.';
    for (; rest != 0; rest = rest * 10 % unit) out += static_cast<char>('0' + rest * 10 / unit);
  }
  return out;
}

}  // namespace detail

/// Prints a name. The default wherever a function takes a way to name agents, plans, tasks and states.
///
/// Uses the `to_string(id)` that stands beside the type of the identifier (or a friend of the vocabulary, if the type
/// is nested in it), whatever string type it returns. Without one it prints the number of an enumeration, an integer or
/// a `strong_id`, and bytes in hexadecimal; "?" for anything else.
struct default_names {
  static constexpr char const* unknown = "?";

  template <class Id>
  [[nodiscard]] std::string operator()(Id const& id) const {
    if constexpr (detail::beside::printable<Id>) {
      return detail::beside::text(id);
    } else if constexpr (std::is_enum_v<Id>) {
      return detail::number(static_cast<std::underlying_type_t<Id>>(id));
    } else if constexpr (requires { detail::number(id); }) {
      return detail::number(id);
    } else if constexpr (std::constructible_from<std::string, Id const&>) {
      return std::string(id);
    } else if constexpr (requires { static_cast<unsigned char>(id[id.size() - 1]); }) {
      return detail::hexadecimal(id);
    } else {
      return unknown;
    }
  }
};

namespace detail {

/// x, with these names if x is made of names; else `name(x)`.
template <class T, class Names>
[[nodiscard]] std::string text(T const& x, Names const& name) {
  if constexpr (beside::printable_with<T, Names>)
    return beside::text(x, name);
  else
    return name(x);
}

/// `{a, b}`, of what `text(x)` makes of each element.
template <class Range, class Text>
[[nodiscard]] std::string braced(Range const& range, Text const& text) {
  std::string out = "{";
  for (auto const& x : range) {
    if (out.size() > 1) out += ", ";
    out += text(x);
  }
  return out + "}";
}

}  // namespace detail

template <class Tag, class Rep>
[[nodiscard]] std::string to_string(strong_id<Tag, Rep> const& id) {
  return default_names{}(id.value);
}

/// `In(a, p, t)`. `name(id)` turns agents, plans and tasks into strings.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string to_string(in<V> const& x, Names const& name = {}) {
  return "In(" + name(x.agent) + ", " + name(x.plan) + ", " + name(x.task) + ")";
}
/// `In(a, p, t, z)`.
template <vocabulary V, class Names = default_names>
[[nodiscard]] std::string to_string(in_state<V> const& x, Names const& name = {}) {
  return "In(" + name(x.agent) + ", " + name(x.plan) + ", " + name(x.task) + ", " + name(x.state) + ")";
}

/// `1.5 s`, `30 ms`, `250 us`, `7 ns`: exact, in the largest unit of which there is at least one.
[[nodiscard]] inline std::string to_string(duration d) {
  struct unit {
    std::uint64_t ns;
    char const* name;
  };
  auto const size = d.ns < 0 ? 0 - static_cast<std::uint64_t>(d.ns) : static_cast<std::uint64_t>(d.ns);
  for (auto const& u : {unit{1'000'000'000, " s"}, unit{1'000'000, " ms"}, unit{1'000, " us"}})
    if (size >= u.ns) return detail::in_unit(d.ns, u.ns) + u.name;
  return d.ns == 0 ? "0 s" : std::to_string(d.ns) + " ns";
}
/// `12.5 s` since the start of that clock, exact; or `never`.
[[nodiscard]] inline std::string to_string(instant t) {
  return t == never ? "never" : detail::in_unit(t.ns, 1'000'000'000) + " s";
}

/// The value, or `refused: ` and the refusal.
template <class T, class Refusal, class Names = default_names>
[[nodiscard]] std::string to_string(result<T, Refusal> const& r, Names const& name = {}) {
  return r.has_value() ? detail::text(*r, name) : "refused: " + detail::text(r.error(), name);
}

}  // namespace rota
