#pragma once

#include <rota/adapters/alica/model.hpp>
#include <rota/core/finite.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#ifndef __cpp_lib_to_chars
#include <locale>
#include <sstream>
#endif

namespace rota::alica::detail {

/// The offset of the first byte that is not valid UTF-8, if any. Overlong forms, surrogates and NUL are not valid. O(n).
[[nodiscard]] inline std::optional<std::size_t> first_bad_byte(std::string_view s) {
  std::size_t i = 0;
  auto const byte = [&](std::size_t k) { return k < s.size() ? static_cast<unsigned char>(s[k]) : 0U; };
  while (i < s.size()) {
    unsigned const b = byte(i);
    if (b == 0) return i;
    if (b < 0x80) {
      ++i;
      continue;
    }
    std::size_t const length = b >= 0xC2 && b <= 0xDF ? 2 : b >= 0xE0 && b <= 0xEF ? 3 : b >= 0xF0 && b <= 0xF4 ? 4 : 0;
    if (length == 0) return i;
    unsigned const low = b == 0xE0 ? 0xA0 : b == 0xF0 ? 0x90 : 0x80;
    unsigned const high = b == 0xED ? 0x9F : b == 0xF4 ? 0x8F : 0xBF;
    if (byte(i + 1) < low || byte(i + 1) > high) return i;
    for (std::size_t k = 2; k < length; ++k)
      if (byte(i + k) < 0x80 || byte(i + k) > 0xBF) return i;
    i += length;
  }
  return std::nullopt;
}

/// Finds lines and columns in a text. A view of the text.
class line_index {
public:
  /// O(n).
  explicit line_index(std::string_view text) : size_(text.size()) {
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') newlines_.push_back(i);
  }
  /// "LINE:COLUMN" of an offset. Both count from 1, columns in bytes. O(log n).
  [[nodiscard]] std::string place(std::size_t offset) const {
    offset = (std::min)(offset, size_);
    auto const after = std::lower_bound(newlines_.begin(), newlines_.end(), offset);
    auto const start = after == newlines_.begin() ? 0 : *(after - 1) + 1;
    return std::to_string(after - newlines_.begin() + 1) + ':' + std::to_string(offset - start + 1);
  }

private:
  std::size_t size_;
  std::vector<std::size_t> newlines_;
};

/// The text as a whole number ≥ 0, or nothing if it is anything else.
[[nodiscard]] inline std::optional<identity> parse_natural(std::string_view s) {
  identity n = 0;
  auto const [end, error] = std::from_chars(s.data(), s.data() + s.size(), n);
  if (s.empty() || error != std::errc{} || end != s.data() + s.size()) return std::nullopt;
  return n;
}

/// The text as a finite number, or nothing if it is anything else.
[[nodiscard]] inline std::optional<double> parse_real(std::string_view s) {
  double x = 0;
#ifdef __cpp_lib_to_chars
  auto const [end, error] = std::from_chars(s.data(), s.data() + s.size(), x);
  if (s.empty() || error != std::errc{} || end != s.data() + s.size() || !rota::detail::is_finite(x))
    return std::nullopt;
#else  // libc++ 19 has no from_chars of double; this refuses subnormal numbers besides
  if (s.empty() || s.find_first_not_of("-.0123456789eE") != std::string_view::npos) return std::nullopt;
  std::istringstream in{std::string(s)};
  in.imbue(std::locale::classic());
  if (!(in >> x) || in.peek() != std::istringstream::traits_type::eof() || !rota::detail::is_finite(x))
    return std::nullopt;
#endif
  return x;
}

/// "File.ext#id", with the file relative to the referring one; or a bare id, with `file` empty.
struct reference {
  std::string file;
  identity id = 0;

  [[nodiscard]] std::string text() const { return file + '#' + std::to_string(id); }
};

/// Reads "File.ext#id", "#id" or "id". Nothing if the id is not a number, or the file name has control characters.
[[nodiscard]] inline std::optional<reference> parse_reference(std::string_view s) {
  auto const hash = s.rfind('#');
  auto const id = parse_natural(hash == std::string_view::npos ? s : s.substr(hash + 1));
  if (!id) return std::nullopt;
  auto const file = hash == std::string_view::npos ? std::string_view{} : s.substr(0, hash);
  for (char const c : file)
    if (static_cast<unsigned char>(c) < 0x20) return std::nullopt;
  return reference{std::string(file), *id};
}

/// The extension of a path, with its dot.
[[nodiscard]] inline std::string_view extension_of(std::string_view file) {
  auto const slash = file.rfind('/');
  auto const name = slash == std::string_view::npos ? file : file.substr(slash + 1);
  auto const dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : name.substr(dot);
}

/// The kind of a file of this name.
[[nodiscard]] inline file_kind kind_of(std::string_view file) {
  auto const extension = extension_of(file);
  if (extension == ".pml") return file_kind::plan;
  if (extension == ".pty") return file_kind::plan_type;
  if (extension == ".tsk") return file_kind::task_repository;
  if (extension == ".rst") return file_kind::role_set;
  if (extension == ".rdefset") return file_kind::role_definitions;
  if (extension == ".beh") return file_kind::behaviour;
  if (extension == ".cnd") return file_kind::conditions;
  return file_kind::none;
}

/// Why a file of this name, which is not a plan file, is not read.
[[nodiscard]] inline std::string_view why_ignored(std::string_view file) {
  auto const extension = extension_of(file);
  if (extension == ".pmlex") return "no plan file: layout of ALICA's editor";
  if (extension == ".graph") return "no plan file: role graph of ALICA's editor";
  if (extension == ".conf" || extension == ".yaml") return "no plan file: configuration";
  return "no plan file: its extension is none of theirs";
}

/// The name in quotes, cut to fit a line. Control characters, which could make it look like two lines, become `?`.
[[nodiscard]] inline std::string in_quotes(std::string_view s) {
  constexpr std::size_t limit = 60;
  std::string out = "\"";
  auto cut = (std::min)(s.size(), limit);
  while (cut > 0 && cut < s.size() && (static_cast<unsigned char>(s[cut]) & 0xC0U) == 0x80) --cut;
  for (char const c : s.substr(0, cut)) out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return out + (cut < s.size() ? "…\"" : "\"");
}

}  // namespace rota::alica::detail
