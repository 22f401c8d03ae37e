#pragma once

#include <rota/adapters/alica/draft.hpp>

#include <nlohmann/json.hpp>

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rota::alica::detail {

/// Checks a JSON text before anything is built from it: syntax, depth, size, repeated keys.
///
/// Stops at the first defect and says where it is. nlohmann's parser keeps its own stack, so deep texts do not overflow it.
class json_guard {
public:
  using number_integer_t = nlohmann::json::number_integer_t;
  using number_unsigned_t = nlohmann::json::number_unsigned_t;
  using number_float_t = nlohmann::json::number_float_t;
  using string_t = nlohmann::json::string_t;
  using binary_t = nlohmann::json::binary_t;

  json_guard(std::string_view text, load_options const& limits) : text_(text), limits_(limits) {}

  /// Whether the whole text is JSON within the limits. nlohmann takes a zero byte for the end of the text, so what stands behind
  /// one would go unread.
  [[nodiscard]] bool passes() {
    auto const zero = text_.find('\0');
    if (zero != std::string_view::npos) return fail(line_index(text_).place(zero), "no JSON: a zero byte");
    return nlohmann::json::sax_parse(text_, this);
  }

  std::string place;   ///< of the defect
  std::string reason;  ///< of the defect

  bool null() { return value(); }
  bool boolean(bool) { return value(); }
  bool number_integer(number_integer_t) { return value(); }
  bool number_unsigned(number_unsigned_t) { return value(); }
  bool number_float(number_float_t, string_t const&) { return value(); }
  bool string(string_t const&) { return value(); }
  bool binary(binary_t const&) { return value(); }
  bool start_object(std::size_t) { return value() && open(true); }
  bool start_array(std::size_t) { return value() && open(false); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(string_t const& k) {
    bool const fresh = open_.back().keys.insert(k).second;
    open_.back().key = k;
    return fresh || fail(pointer(), "the key " + in_quotes(k) + " stands twice in one object");
  }
  bool parse_error(std::size_t position, std::string const&, nlohmann::json::exception const& e) {
    auto const at = position == 0 ? 0 : position - 1;
    if (at >= text_.size()) return fail(line_index(text_).place(text_.size()), "cut off: the JSON text ends too early");
    std::string_view what = e.what();  // "[json.exception…] parse error at line 1, column 2: syntax error …"
    if (auto const tag = what.find("] "); what.starts_with('[') && tag != std::string_view::npos)
      what.remove_prefix(tag + 2);
    if (auto const colon = what.find(": "); colon != std::string_view::npos) what.remove_prefix(colon + 2);
    if (auto const token = what.find("; last read"); token != std::string_view::npos) what = what.substr(0, token);
    return fail(line_index(text_).place(at), "no JSON: " + std::string(what.substr(0, 160)));
  }

private:
  bool fail(std::string where, std::string why) {
    place = std::move(where);
    reason = std::move(why);
    return false;
  }
  bool value() {
    if (!open_.empty()) ++open_.back().count;
    return ++elements_ <= limits_.max_elements ||
           fail(pointer(), "more than " + std::to_string(limits_.max_elements) + " values");
  }
  bool open(bool object) {
    if (open_.size() == limits_.max_depth)
      return fail(pointer(), "nested deeper than " + std::to_string(limits_.max_depth) + " levels");
    open_.push_back({object, 0, {}, {}});
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }
  /// The position of the parser as a JSON pointer, cut to a line.
  std::string pointer() const {
    std::string out;
    for (level const& l : open_) {
      out += '/';
      out += l.object ? l.key : std::to_string(l.count == 0 ? 0 : l.count - 1);
      if (out.size() > 100) return out.substr(0, out.find_last_of('/')) + "/…";
    }
    return out.empty() ? "/" : out;
  }

  struct level {
    bool object;
    std::size_t count;
    std::string key;
    std::set<std::string, std::less<>> keys;
  };

  std::string_view text_;
  load_options const& limits_;
  std::vector<level> open_;
  std::size_t elements_ = 0;
};

/// One object of a JSON plan file, and its place in the file. `null` counts as absent.
class json_cursor {
public:
  static constexpr file_format format = file_format::json;
  static constexpr std::string_view choices = "annotatedPlans";

  json_cursor(nlohmann::json const& node, std::string pointer) : node_(&node), pointer_(std::move(pointer)) {}

  [[nodiscard]] std::string place() const { return pointer_.empty() ? "/" : pointer_; }
  [[nodiscard]] std::string place(std::string_view key) const { return pointer_ + '/' + escaped(key); }

  [[nodiscard]] field<identity> natural(std::string_view key) const {
    auto const* v = member(key);
    if (v == nullptr) return {};
    if (!v->is_number_unsigned()) return {{}, shown(*v) + ", not a whole number from 0 to 18446744073709551615"};
    return {v->template get<identity>(), {}};
  }
  [[nodiscard]] field<double> real(std::string_view key) const {
    auto const* v = member(key);
    if (v == nullptr) return {};
    if (!v->is_number()) return {{}, shown(*v) + ", not a number"};
    return {v->template get<double>(), {}};
  }
  [[nodiscard]] field<bool> flag(std::string_view key) const {
    auto const* v = member(key);
    if (v == nullptr) return {};
    if (!v->is_boolean()) return {{}, shown(*v) + ", neither true nor false"};
    return {v->template get<bool>(), {}};
  }
  [[nodiscard]] field<std::string> text(std::string_view key) const {
    auto const* v = member(key);
    if (v == nullptr) return {};
    if (!v->is_string()) return {{}, shown(*v) + ", not a text"};
    return {v->template get<std::string>(), {}};
  }
  [[nodiscard]] field<reference> refers(std::string_view key) const {
    auto const* v = member(key);
    if (v == nullptr) return {};
    if (auto r = as_reference(*v)) return {std::move(r), {}};
    return {{}, shown(*v) + ", no reference \"File.ext#id\""};
  }
  /// The objects of the list under a key.
  [[nodiscard]] field<std::vector<json_cursor>> list(std::string_view key) const {
    auto const* v = member(key);
    if (v == nullptr) return {};
    if (!v->is_array()) return {{}, shown(*v) + ", not a list"};
    std::vector<json_cursor> all;
    for (std::size_t i = 0; i < v->size(); ++i) {
      if (!(*v)[i].is_object()) return {{}, "a list whose entry " + std::to_string(i) + " is no object"};
      all.emplace_back((*v)[i], place(key) + '/' + std::to_string(i));
    }
    return {std::move(all), {}};
  }
  /// The plan's precondition: an object.
  [[nodiscard]] field<json_cursor> precondition() const {
    auto const* v = member("preCondition");
    if (v == nullptr) return {};
    if (!v->is_object()) return {{}, shown(*v) + ", not an object"};
    return {json_cursor{*v, place("preCondition")}, {}};
  }
  /// The entries of `taskPriorities`, an object whose keys are references.
  [[nodiscard]] field<std::vector<priority_entry>> priorities() const {
    auto const* v = member("taskPriorities");
    if (v == nullptr) return {};
    if (!v->is_object()) return {{}, shown(*v) + ", not an object"};
    json_cursor const inner{*v, place("taskPriorities")};
    std::vector<priority_entry> all;
    for (auto const& [key, value] : v->items()) {
      auto p = priority_entry{parse_reference(key), inner.real(key), key, inner.place(key)};
      if (value.is_null()) p.value.wrong = "null, not a number";
      all.push_back(std::move(p));
    }
    return {std::move(all), {}};
  }

  /// Collects every declared id and every loose reference below this object. @pre depth is bounded
  void survey(draft& out, sort what) const { survey(out, *node_, pointer_, what, ""); }

private:
  nlohmann::json const* member(std::string_view key) const {
    auto const at = node_->find(key);
    return at == node_->end() || at->is_null() ? nullptr : &*at;
  }
  static std::string escaped(std::string_view key) {
    std::string out;
    for (char const c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return out;
  }
  static std::string shown(nlohmann::json const& v) {
    if (v.is_object()) return "an object";
    if (v.is_array()) return "a list";
    if (v.is_string()) return in_quotes(v.get_ref<std::string const&>());
    return v.dump();
  }
  static std::optional<reference> as_reference(nlohmann::json const& v) {
    if (v.is_string()) return parse_reference(v.get_ref<std::string const&>());
    if (v.is_number_unsigned()) return reference{{}, v.get<identity>()};
    return std::nullopt;
  }
  /// The keys whose bare numbers are references into the same file.
  static bool is_inner_reference(std::string_view key) {
    return key == "state" || key == "inState" || key == "outState" || key == "entryPoint" || key == "inTransitions" ||
           key == "outTransitions";
  }
  static void survey(draft& out, nlohmann::json const& v, std::string const& pointer, sort what, std::string_view key) {
    if (v.is_object()) {
      auto const id = v.find("id");
      auto const name = v.find("name");
      if (id != v.end() && id->is_number_unsigned())
        out.declared.push_back({id->get<identity>(), what,
                                name != v.end() && name->is_string() ? name->get<std::string>() : std::string{},
                                pointer.empty() ? "/" : pointer});
      for (auto const& [k, inner] : v.items()) {
        bool const needed = (what == sort::entry_point && k == "task") || (key == choices && k == "plan");
        bool const prose = k == "comment" || k == "name" || k == "conditionString";
        if (!needed && !prose) survey(out, inner, pointer + '/' + escaped(k), sort::other, k);
      }
    } else if (v.is_array()) {
      for (std::size_t i = 0; i < v.size(); ++i)
        survey(out, v[i], pointer + '/' + std::to_string(i), sort_of_list(key), key);
    } else if (v.is_string() || (v.is_number_unsigned() && is_inner_reference(key))) {
      auto const r = as_reference(v);
      bool const names_a_file = r && kind_of(r->file) != file_kind::none;
      if (r && (names_a_file || v.is_number_unsigned())) out.loose.push_back({*r, sort::other, {}, pointer});
    }
  }

  nlohmann::json const* node_;
  std::string pointer_;
};

}  // namespace rota::alica::detail
