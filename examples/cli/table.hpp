#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rota::cli {

/// One cell of a CSV file, and its place.
struct csv_cell {
  std::string text;
  std::size_t line = 1;
  std::size_t column = 1;  ///< in bytes
  bool quoted = false;

  [[nodiscard]] std::string place() const { return std::to_string(line) + ':' + std::to_string(column); }
};

/// The records of a CSV text (RFC 4180: quotes, doubled quotes, LF or CRLF). Empty lines at the end are dropped.
///
/// Throws `input_error` for an open quote, text behind a closing quote, or bytes that are not UTF-8.
[[nodiscard]] std::vector<std::vector<csv_cell>> parse_csv(std::string_view text, std::string const& file);

/// Utilities of agents on named columns, from a CSV file with the header `agent,COLUMN,…`.
struct utility_table {
  std::vector<std::string> agents;                        ///< ascending, so that nothing depends on the order of rows
  std::vector<csv_cell> columns;                          ///< as in the header, without `agent`
  std::vector<std::vector<std::optional<double>>> cells;  ///< row per agent; empty: forbidden
};

/// Throws `input_error` with file, line and column if the file is not such a table.
[[nodiscard]] utility_table read_utilities(std::string const& file);

/// The bytes of a text file without its byte order mark. Throws `input_error`.
[[nodiscard]] std::string read_text(std::string const& file);

}  // namespace rota::cli
