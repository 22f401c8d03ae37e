#pragma once
/// @file
/// Messages as JSON, for logs, for debugging, and for programs in other languages. docs/protocol.md shows one of each kind.

#include <rota/adapters/alica/json.hpp>
#include <rota/core/result.hpp>
#include <rota/team/wire.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace rota {

/// Why a text is no message, and where: line and column, or the field as a JSON pointer.
struct json_fault {
  std::string place;
  std::string reason;

  friend bool operator==(json_fault const&, json_fault const&) = default;
};
[[nodiscard]] inline char const* reason_of(json_fault const& f) noexcept { return f.reason.c_str(); }

/// A longer text is refused unread.
inline constexpr std::size_t most_json_bytes = std::size_t{1} << 17U;

namespace detail {

/// Whether the number of an identifier stands for a signed one.
template <class Id>
[[nodiscard]] constexpr bool shown_signed() {
  if constexpr (requires { wire_id<Id>::is_signed; }) {
    return wire_id<Id>::is_signed;
  } else {
    return false;
  }
}

/// How a stance is written.
[[nodiscard]] constexpr std::string_view word_of(stance s) noexcept {
  return s == stance::abstains ? "abstains" : s == stance::dissents ? "dissents" : "none";
}

/// Puts an object together. Nothing is ever escaped.
class json_writer {
public:
  void open(std::string_view key, char bracket) {
    name(key);
    text_ += bracket;
    first_ = true;
  }
  void close(char bracket) {
    text_ += bracket;
    first_ = false;
  }
  template <class Number>
  void number(std::string_view key, Number x) {
    name(key);
    text_ += std::to_string(x);
  }
  /// @pre nothing in `text` needs to be escaped
  void word(std::string_view key, std::string_view text) {
    name(key);
    ((text_ += '"') += text) += '"';
  }
  template <class Id>
  void id(std::string_view key, Id const& x) {
    auto const n = wire_id<Id>::to(x);
    if constexpr (shown_signed<Id>()) {
      number(key, unzigzag(n));
    } else {
      number(key, n);
    }
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

private:
  /// Separates from what stands before; an entry of a list has no key.
  void name(std::string_view key) {
    if (!first_) text_ += ", ";
    first_ = false;
    if (!key.empty()) ((text_ += '"') += key) += "\": ";
  }

  std::string text_;
  bool first_ = true;
};

template <vocabulary V>
void write(json_writer& w, plan_message<V> const& m) {
  w.open("plan_message", '{');
  w.id("sender", m.sender);
  w.number("incarnation", m.number.incarnation.value);
  w.number("sequence", m.number.sequence);
  w.number("claims", m.claims);
  w.open("types", '[');
  for (participation<V> const& p : m.types) {
    w.open({}, '{');
    w.id("type", p.type);
    w.number("leads", p.leads);
    if (p.place) {
      w.open("place", '{');
      w.id("plan", p.place->plan);
      w.id("task", p.place->task);
      w.id("state", p.place->state);
      w.close('}');
    }
    if (p.fingerprint) w.number("fingerprint", *p.fingerprint);
    if (p.stance != stance::none) w.word("stance", word_of(p.stance));
    w.close('}');
  }
  w.close(']');
  w.close('}');
}

template <vocabulary V>
void write(json_writer& w, claim<V> const& c) {
  w.open("claim", '{');
  w.id("type", c.type);
  w.id("leader", c.leader);
  w.number("incarnation", c.incarnation.value);
  w.number("number", c.number);
  w.number("version", c.version);
  w.number("renewals", c.renewals);
  w.number("answers", c.answers);
  w.number("confidence", c.stamp.confidence);
  w.id("stamp", c.stamp.id);
  w.number("remaining_us", c.remaining.ns / 1000);
  if (!c.atoms.empty()) w.id("plan", c.atoms.begin()->plan);
  w.open("atoms", '[');
  for (std::size_t i = 0; i < c.atoms.size(); ++i) {
    w.open({}, '{');
    w.id("agent", c.atoms.begin()[i].agent);
    w.id("task", c.atoms.begin()[i].task);
    w.number("age_ms", round_up(c.ages[i], 1'000'000));
    w.close('}');
  }
  w.close(']');
  w.close('}');
}

/// Reads fields. The first thing that is wrong is remembered; from then on every number reads as 0.
class json_fields {
public:
  using node = nlohmann::json;

  /// A key of an object, and whether it may be missing.
  struct member {
    std::string_view name;
    bool optional = false;
  };

  [[nodiscard]] bool wrong() const noexcept { return !fault_.reason.empty(); }
  [[nodiscard]] json_fault fault() const { return fault_; }
  void fail(std::string place, std::string reason) {
    if (!wrong()) fault_ = {place.empty() ? "/" : std::move(place), std::move(reason)};
  }

  /// Whether x is an object with these keys and no others.
  bool object(node const& x, std::string const& place, std::initializer_list<member> keys) {
    if (!x.is_object()) fail(place, shown(x) + ", not an object");
    if (wrong()) return false;
    for (auto const& [name, value] : x.items()) {
      bool known = false;
      for (member const& k : keys) known = known || k.name == name;
      if (!known) fail(place, "the key " + alica::detail::in_quotes(name) + " is unknown here");
    }
    for (member const& k : keys)
      if (!k.optional && !x.contains(k.name)) fail(place, "the key \"" + std::string(k.name) + "\" is missing");
    return !wrong();
  }
  /// The list under a key, or nullptr. It has at most `most` entries.
  node const* list(node const& of, std::string const& place, std::string_view key, std::size_t most) {
    auto const& x = of[std::string(key)];
    if (!x.is_array()) fail(at(place, key), shown(x) + ", not a list");
    if (x.size() > most) fail(at(place, key), "more than " + std::to_string(most) + " entries");
    return wrong() ? nullptr : &x;
  }
  std::uint64_t number(node const& of, std::string const& place, std::string_view key,
                       std::uint64_t most = (std::numeric_limits<std::uint64_t>::max)()) {
    if (wrong()) return 0;
    auto const& x = of[std::string(key)];
    if (x.is_number_unsigned() && x.get<std::uint64_t>() <= most) return x.get<std::uint64_t>();
    fail(at(place, key), shown(x) + ", not a whole number from 0 to " + std::to_string(most));
    return 0;
  }
  rota::stance stance(node const& of, std::string const& place, std::string_view key) {
    auto const& x = of[std::string(key)];
    for (auto const s : {stance::abstains, stance::dissents})
      if (x == word_of(s)) return s;
    fail(at(place, key), shown(x) + ", neither \"abstains\" nor \"dissents\"");
    return stance::none;
  }
  template <class Id>
  Id id(node const& of, std::string const& place, std::string_view key) {
    constexpr auto most = wire_id<Id>::most;
    if constexpr (shown_signed<Id>()) {
      if (wrong()) return wire_id<Id>::from(0);
      auto const& x = of[std::string(key)];
      bool const fits = x.is_number_integer() && (!x.is_number_unsigned() || x.get<std::uint64_t>() <= most / 2);
      if (fits && zigzag(x.get<std::int64_t>()) <= most) return wire_id<Id>::from(zigzag(x.get<std::int64_t>()));
      fail(at(place, key), shown(x) + ", not a whole number from " + std::to_string(unzigzag(most)) + " to " +
                               std::to_string(most / 2));
      return wire_id<Id>::from(0);
    } else {
      return wire_id<Id>::from(number(of, place, key, most));
    }
  }
  static std::string at(std::string const& place, std::string_view key) { return place + '/' + std::string(key); }
  static std::string at(std::string const& place, std::size_t index) { return place + '/' + std::to_string(index); }

private:
  static std::string shown(node const& x) {
    if (x.is_object()) return "an object";
    if (x.is_array()) return "a list";
    if (x.is_string()) return alica::detail::in_quotes(x.get_ref<std::string const&>());
    return x.dump();
  }

  json_fault fault_;
};

template <vocabulary V>
void read(json_fields& f, nlohmann::json const& x, plan_message<V>& m) {
  std::string const here = "/plan_message";
  if (!f.object(x, here, {{"sender"}, {"incarnation"}, {"sequence"}, {"claims"}, {"types"}})) return;
  m.sender = f.id<typename V::agent>(x, here, "sender");
  m.number.incarnation.value = f.number(x, here, "incarnation");
  m.number.sequence = f.number(x, here, "sequence");
  m.claims = f.number(x, here, "claims");
  auto const* const types = f.list(x, here, "types", m.most_types);
  for (std::size_t i = 0; types != nullptr && i < types->size(); ++i) {
    auto const place = f.at(f.at(here, "types"), i);
    auto const& entry = (*types)[i];
    if (!f.object(entry, place, {{"type"}, {"leads"}, {"place", true}, {"fingerprint", true}, {"stance", true}}))
      return;
    participation<V> p;
    p.type = f.id<typename V::plan_type>(entry, place, "type");
    p.leads = f.number(entry, place, "leads");
    if (entry.contains("place")) {
      auto const inner = f.at(place, "place");
      auto const& where = entry["place"];
      if (!f.object(where, inner, {{"plan"}, {"task"}, {"state"}})) return;
      p.place = placement<V>{f.id<typename V::plan>(where, inner, "plan"), f.id<typename V::task>(where, inner, "task"),
                             f.id<typename V::state>(where, inner, "state")};
    }
    if (entry.contains("fingerprint"))
      p.fingerprint = static_cast<std::uint32_t>(f.number(entry, place, "fingerprint", 0xffffffffU));
    if (entry.contains("stance")) p.stance = f.stance(entry, place, "stance");
    m.types.push_back(p);
  }
}

template <vocabulary V>
void read(json_fields& f, nlohmann::json const& x, claim<V>& c) {
  constexpr auto longest = static_cast<std::uint64_t>((std::numeric_limits<std::int64_t>::max)());
  std::string const here = "/claim";
  if (!f.object(x, here,
                {{"type"},
                 {"leader"},
                 {"incarnation"},
                 {"number"},
                 {"version"},
                 {"renewals"},
                 {"answers"},
                 {"confidence"},
                 {"stamp"},
                 {"remaining_us"},
                 {"plan", true},
                 {"atoms"}}))
    return;
  c.type = f.id<typename V::plan_type>(x, here, "type");
  c.leader = f.id<typename V::agent>(x, here, "leader");
  c.incarnation.value = f.number(x, here, "incarnation");
  c.number = f.number(x, here, "number");
  c.version = f.number(x, here, "version");
  c.renewals = static_cast<std::uint32_t>(f.number(x, here, "renewals", 0xffffffffU));
  c.answers = static_cast<std::uint32_t>(f.number(x, here, "answers", 0xffffffffU));
  c.stamp.confidence = static_cast<std::uint32_t>(f.number(x, here, "confidence", 0xffffffffU));
  c.stamp.id = f.id<typename V::agent>(x, here, "stamp");
  c.remaining = microseconds(static_cast<std::int64_t>(f.number(x, here, "remaining_us", longest / 1000)));
  auto const* const list = f.list(x, here, "atoms", most_wire_atoms);
  if (list == nullptr) return;
  if (list->empty() == x.contains("plan")) f.fail(here, "it names a plan if and only if it has atoms");
  auto const plan = list->empty() ? typename V::plan{} : f.id<typename V::plan>(x, here, "plan");
  small_vector<in<V>, 8> atoms;
  for (std::size_t i = 0; i < list->size(); ++i) {
    auto const place = f.at(f.at(here, "atoms"), i);
    auto const& entry = (*list)[i];
    if (!f.object(entry, place, {{"agent"}, {"task"}, {"age_ms"}})) return;
    in<V> atom;
    atom.agent = f.id<typename V::agent>(entry, place, "agent");
    atom.plan = plan;
    atom.task = f.id<typename V::task>(entry, place, "task");
    c.ages.push_back(milliseconds(static_cast<std::int64_t>(f.number(entry, place, "age_ms", longest / 1'000'000))));
    if (!atoms.empty() && !(atoms.back() < atom)) f.fail(place, "the atoms repeat or are out of order");
    if (f.wrong()) return;
    atoms.push_back(atom);
  }
  c.atoms = allocation_atoms<V>::from_ascending(std::move(atoms));
}

}  // namespace detail

/// A message as one line of JSON. It says what the bytes of `encode` say, with times rounded alike, and is refused like them;
/// so `read_json` brings back what `decode` would.
template <vocabulary V>
[[nodiscard]] result<std::string, wire_fault> write_json(message<V> const& m) {
  return std::visit(
      [](auto const& one) -> result<std::string, wire_fault> {
        if (auto const fault = detail::unwritable(one)) return refused{*fault};
        detail::json_writer w;
        w.open({}, '{');
        w.number("rota", wire_version);
        detail::write(w, one);
        w.close('}');
        return w.take();
      },
      m);
}

/// Reads a message, whole or not at all: exactly the keys of its kind, each once, in any order; whole numbers within their
/// ranges; atoms in ascending order. What it says is still hostile: `robot::receive` judges it.
///
/// Throws only for lack of memory. O(bytes).
template <vocabulary V>
[[nodiscard]] result<message<V>, json_fault> read_json(std::string_view text) {
  if (text.size() > most_json_bytes)
    return refused{json_fault{"/", "longer than " + std::to_string(most_json_bytes) + " bytes"}};
  alica::load_options limits;
  limits.max_depth = 8;
  limits.max_elements = 4096;
  alica::detail::json_guard guard{text, limits};
  if (!guard.passes()) return refused{json_fault{guard.place, guard.reason}};
  auto const tree = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  detail::json_fields f;
  message<V> m;
  if (f.object(tree, {}, {{"rota"}, {"plan_message", true}, {"claim", true}})) {
    if (f.number(tree, {}, "rota") != wire_version) f.fail("/rota", "another version of the form");
    if (tree.contains("plan_message") == tree.contains("claim")) f.fail({}, "neither one plan message nor one claim");
    if (f.wrong()) return refused{f.fault()};
    if (tree.contains("claim")) {
      detail::read(f, tree["claim"], m.template emplace<claim<V>>());
    } else {
      detail::read(f, tree["plan_message"], m.template emplace<plan_message<V>>());
    }
  }
  if (f.wrong()) return refused{f.fault()};
  return m;
}

}  // namespace rota
