#pragma once

#include <rota/adapters/alica/draft.hpp>

#include <pugixml.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rota::alica::detail {

/// The first thing in the raw text of an XML file that is refused: its place and the reason.
struct xml_offence {
  std::size_t offset = 0;
  std::string reason;
};

/// Refuses references to entities that XML itself does not define, and too many elements and attributes. O(n).
///
/// pugixml leaves unknown entities as they are, and a name that silently reads "&x;" would be wrong.
[[nodiscard]] inline std::optional<xml_offence> find_offence(std::string_view s, load_options const& limits) {
  auto const skip = [&](std::size_t at, std::string_view open, std::string_view close) {
    if (s.compare(at, open.size(), open) != 0) return at;
    auto const end = s.find(close, at + open.size());
    return end == std::string_view::npos ? s.size() : end + close.size();
  };
  std::size_t marks = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s[i] == '<') {
      for (auto const& [open, close] :
           {std::pair<std::string_view, std::string_view>{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}) {
        if (auto const after = skip(i, open, close); after != i) {
          i = after - 1;
          break;
        }
      }
      ++marks;
    } else if (s[i] == '=') {
      ++marks;
    } else if (s[i] == '&') {
      auto const end = s.find(';', i);
      auto const name =
          end == std::string_view::npos || end - i > 12 ? std::string_view{} : s.substr(i + 1, end - i - 1);
      bool const known = name == "amp" || name == "lt" || name == "gt" || name == "quot" || name == "apos" ||
                         (name.size() > 1 && name[0] == '#');
      if (!known) return xml_offence{i, "a reference to an entity that XML does not define"};
    }
    if (marks > 2 * limits.max_elements)
      return xml_offence{i, "more than " + std::to_string(limits.max_elements) + " elements"};
  }
  return std::nullopt;
}

/// The name without its namespace prefix.
[[nodiscard]] inline std::string_view local_name(std::string_view qualified) {
  auto const colon = qualified.rfind(':');
  return colon == std::string_view::npos ? qualified : qualified.substr(colon + 1);
}

/// One element of an XML plan file, and its place in the file.
class xml_cursor {
public:
  static constexpr file_format format = file_format::xml;
  static constexpr std::string_view choices = "plans";

  xml_cursor(pugi::xml_node node, line_index const& lines) : node_(node), lines_(&lines) {}

  /// "LINE:COLUMN <name>".
  [[nodiscard]] std::string place() const { return place_of(node_); }
  [[nodiscard]] std::string place(std::string_view key) const { return place() + ' ' + std::string(key); }

  [[nodiscard]] field<identity> natural(std::string_view key) const {
    return parsed(key, parse_natural, ", not a whole number from 0 to 18446744073709551615");
  }
  [[nodiscard]] field<double> real(std::string_view key) const {
    return parsed(key, parse_real, ", not a finite number");
  }
  [[nodiscard]] field<bool> flag(std::string_view key) const {
    auto const known = [](std::string_view s) -> std::optional<bool> {
      if (s == "true" || s == "1") return true;
      if (s == "false" || s == "0") return false;
      return std::nullopt;
    };
    return parsed(key, known, ", neither true nor false");
  }
  [[nodiscard]] field<std::string> text(std::string_view key) const {
    return parsed(key, [](std::string_view s) { return std::optional<std::string>(s); }, "");
  }
  /// `<key>File.ext#id</key>` or `<key href="File.ext#id"/>`.
  [[nodiscard]] field<reference> refers(std::string_view key) const {
    std::string const name(key);
    auto const child = node_.child(name.c_str());
    if (!child) return {};
    if (child.next_sibling(name.c_str())) return {{}, "there twice"};
    std::string_view const s = child.attribute("href") ? child.attribute("href").value() : child.text().get();
    if (auto r = parse_reference(s)) return {std::move(r), {}};
    return {{}, in_quotes(s) + ", no reference \"File.ext#id\""};
  }
  /// The child elements of this name.
  [[nodiscard]] field<std::vector<xml_cursor>> list(std::string_view key) const {
    std::vector<xml_cursor> all;
    std::string const name(key);
    for (auto const child : node_.children(name.c_str())) all.emplace_back(child, *lines_);
    return {std::move(all), {}};
  }
  [[nodiscard]] field<xml_cursor> precondition() const {
    for (auto const c : node_.children("conditions"))
      if (local_name(c.attribute("xsi:type").value()) == "PreCondition") return {xml_cursor{c, *lines_}, {}};
    return {};
  }
  [[nodiscard]] field<std::vector<priority_entry>> priorities() const {
    std::vector<priority_entry> all;
    for (auto const child : node_.children("taskPriorities")) {
      xml_cursor const c{child, *lines_};
      std::string key = child.attribute("key").value();
      auto p = priority_entry{parse_reference(key), c.real("value"), std::move(key), c.place()};
      if (!p.value.value && p.value.wrong.empty()) p.value.wrong = "missing";
      all.push_back(std::move(p));
    }
    return {std::move(all), {}};
  }

  /// Collects every declared id and every loose reference below this element. @pre depth is bounded
  void survey(draft& out, sort what) const { survey(out, node_, what); }

private:
  std::string place_of(pugi::xml_node n) const {
    auto const offset = n.offset_debug();
    auto const at = offset <= 0 ? std::string{} : lines_->place(static_cast<std::size_t>(offset) - 1) + ' ';
    return at + '<' + n.name() + '>';
  }
  template <class Parse>
  auto parsed(std::string_view key, Parse parse, std::string_view expected) const
      -> field<typename decltype(parse(std::string_view{}))::value_type> {
    pugi::xml_attribute found;
    for (auto const a : node_.attributes()) {
      if (key != a.name()) continue;
      if (found) return {{}, "there twice"};
      found = a;
    }
    if (!found) return {};
    if (auto v = parse(std::string_view(found.value()))) return {std::move(v), {}};
    return {{}, in_quotes(found.value()) + std::string(expected)};
  }
  void survey(draft& out, pugi::xml_node n, sort what) const {
    std::string_view const name = n.name();
    std::string_view const parent = n.parent().name();
    if (auto const id = parse_natural(n.attribute("id").value()))
      out.declared.push_back({*id, what, n.attribute("name").value(), place_of(n)});
    bool const needed = (name == "task" && parent == "entryPoints") || (name == "plan" && parent == choices);
    auto const note = [&](char const* s) {
      if (auto const r = parse_reference(s)) out.loose.push_back({*r, sort::other, {}, place_of(n)});
    };
    if (!needed) {
      if (auto const href = n.attribute("href")) note(href.value());
      if (auto const entry = n.attribute("entryPoint")) note(entry.value());
      std::string_view const inner = n.text().get();
      if (inner.find('#') != std::string_view::npos) note(n.text().get());
    }
    for (auto const child : n.children())
      if (child.type() == pugi::node_element) survey(out, child, sort_of_list(child.name()));
  }

  pugi::xml_node node_;
  line_index const* lines_;
};

/// The first node nested deeper than the limit, if any. Without recursion. O(n).
[[nodiscard]] inline pugi::xml_node too_deep(pugi::xml_node top, std::size_t limit) {
  std::size_t depth = 1;
  for (auto n = top.first_child(); n;) {
    if (depth > limit) return n;
    if (n.first_child()) {
      n = n.first_child();
      ++depth;
      continue;
    }
    while (n && n != top && !n.next_sibling()) {
      n = n.parent();
      --depth;
    }
    if (!n || n == top) break;
    n = n.next_sibling();
  }
  return {};
}

}  // namespace rota::alica::detail
