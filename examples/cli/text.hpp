#pragma once

#include <rota/model/cardinality.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rota::cli {

/// The text with everything escaped that could control the terminal, or break or reorder a line: control characters of ASCII
/// (\x1b) and Unicode (\u009b), directions of writing (\u202e), line separators, bytes that are not UTF-8 (\xff).
[[nodiscard]] std::string printable(std::string_view s);

/// The names in one line; if they are many, only the first.
[[nodiscard]] std::string joined(std::vector<std::string> const& names);

/// The shortest decimal that reads back as the same number.
[[nodiscard]] std::string number(double x);

/// "12.3 %".
[[nodiscard]] std::string percent(double share);

/// "115 ms", "4.2 s", "5.0 min".
[[nodiscard]] std::string milliseconds_text(double ms);

/// "MIN..MAX"; no upper bound reads "*".
[[nodiscard]] std::string interval(cardinality c);

/// The text, filled with spaces to a width in code points.
[[nodiscard]] std::string padded(std::string s, std::size_t width);

/// "1 agent", "2 agents".
[[nodiscard]] std::string counted(std::size_t n, std::string_view what);

}  // namespace rota::cli
