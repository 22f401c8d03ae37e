#include "table.hpp"

#include "command.hpp"

#include <rota/adapters/alica/files.hpp>
#include <rota/allocation/fixed_point.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

namespace rota::cli {
namespace {

constexpr std::size_t max_bytes = std::size_t{64} << 20U;

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t')) s.remove_suffix(1);
  return s;
}

using alica::detail::in_quotes;

class csv_parser {
public:
  csv_parser(std::string_view text, std::string const& file) : text_(text), file_(file) {}

  std::vector<std::vector<csv_cell>> run() {
    std::vector<std::vector<csv_cell>> records;
    while (at_ < text_.size()) {
      auto& record = records.emplace_back();
      do {
        record.push_back(text_.substr(at_, 1) == "\"" ? quoted_cell() : plain_cell());
      } while (take(','));
      end_line();
    }
    while (!records.empty() && records.back().size() == 1 && records.back()[0].text.empty() &&
           !records.back()[0].quoted)
      records.pop_back();
    return records;
  }

private:
  csv_cell here() const { return {{}, line_, at_ - line_start_ + 1, false}; }
  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool at_line_end() const {
    if (at_ >= text_.size() || text_[at_] == '\n') return true;
    if (text_[at_] != '\r') return false;
    if (text_.substr(at_, 2) == "\r\n") return true;
    throw input_error(file_, here().place(), "a carriage return alone: lines end with LF or CR LF");
  }
  void newline() {
    ++line_;
    line_start_ = at_;
  }
  void end_line() {
    take('\r');
    if (take('\n')) newline();
  }
  csv_cell plain_cell() {
    auto cell = here();
    auto const begin = at_;
    while (!at_line_end() && text_[at_] != ',') ++at_;
    cell.text = trimmed(text_.substr(begin, at_ - begin));
    if (cell.text.find('"') != std::string::npos) throw input_error(file_, cell.place(), "a quote inside a cell");
    return cell;
  }
  csv_cell quoted_cell() {
    auto cell = here();
    cell.quoted = true;
    ++at_;
    for (;;) {
      if (at_ >= text_.size()) throw input_error(file_, cell.place(), "the quote is never closed");
      char const c = text_[at_++];
      if (c == '"' && !take('"')) break;
      cell.text += c;
      if (c == '\n') newline();
    }
    if (!at_line_end() && text_[at_] != ',') throw input_error(file_, here().place(), "text behind a closing quote");
    return cell;
  }

  std::string_view text_;
  std::string const& file_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t line_start_ = 0;
};

std::optional<double> read_cell(csv_cell const& cell, std::string const& file) {
  auto const s = trimmed(cell.text);
  if (s.empty()) return std::nullopt;
  double x = 0;
  auto const [end, error] = std::from_chars(s.data(), s.data() + s.size(), x);
  if (end != s.data() + s.size() || (error != std::errc{} && error != std::errc::result_out_of_range))
    throw input_error(file, cell.place(), in_quotes(s) + " is no number");
  if (error != std::errc{} || !std::isfinite(x) || std::abs(x) > max_utility)
    throw input_error(file, cell.place(), in_quotes(s) + " is no utility: it must be finite and at most 2^30 in size");
  return x;
}

}  // namespace

std::string read_text(std::string const& file) {
  auto const seen = alica::detail::look_at(file, true);
  if (!seen || seen->canonical.empty()) throw input_error(file, "", "a folder, not a file");
  if (!seen->problem.empty()) throw input_error(file, "", seen->problem);
  auto bytes = alica::detail::read_bytes(file, max_bytes);
  if (auto const* why = std::get_if<alica::diagnostic>(&bytes)) throw input_error(file, "", why->reason);
  auto text = std::get<std::string>(std::move(bytes));
  if (auto const bad = alica::detail::first_bad_byte(text))
    throw input_error(file, alica::detail::line_index(text).place(*bad), "not UTF-8");
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

std::vector<std::vector<csv_cell>> parse_csv(std::string_view text, std::string const& file) {
  return csv_parser{text, file}.run();
}

utility_table read_utilities(std::string const& file) {
  auto const text = read_text(file);
  auto const records = parse_csv(text, file);
  if (records.empty()) throw input_error(file, "1:1", "empty: a header \"agent,TASK,...\" is expected");
  auto const& header = records.front();
  if (header.front().text != "agent")
    throw input_error(file, header.front().place(),
                      "the header begins with " + in_quotes(header.front().text) + ", not with \"agent\"");
  utility_table t;
  t.columns.assign(header.begin() + 1, header.end());
  if (t.columns.empty()) throw input_error(file, "1:1", "the header names no task");
  std::set<std::string> names;
  for (auto const& c : t.columns)
    if (!names.insert(c.text).second)
      throw input_error(file, c.place(), "the task " + in_quotes(c.text) + " stands twice");

  std::map<std::string, std::vector<std::optional<double>>> rows;
  for (std::size_t i = 1; i < records.size(); ++i) {
    auto const& r = records[i];
    if (r.size() != header.size())
      throw input_error(file, r.back().place(),
                        std::to_string(r.size()) + " cells, but the header has " + std::to_string(header.size()));
    if (r.front().text.empty()) throw input_error(file, r.front().place(), "an agent without a name");
    auto const [row, fresh] = rows.try_emplace(r.front().text);
    if (!fresh) throw input_error(file, r.front().place(), "the agent " + in_quotes(r.front().text) + " stands twice");
    for (std::size_t k = 1; k < r.size(); ++k) row->second.push_back(read_cell(r[k], file));
  }
  for (auto& [agent, cells] : rows) {
    t.agents.push_back(agent);
    t.cells.push_back(std::move(cells));
  }
  return t;
}

}  // namespace rota::cli
