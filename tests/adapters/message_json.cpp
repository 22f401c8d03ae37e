// Messages as JSON: what the bytes say, for people; whole or not at all.
#include <gtest/gtest.h>

#include "support/messages.hpp"

#include <rota/adapters/message_json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace message_json_test {

using rota::json_fault;
using rota::wire_fault;

namespace {

/// Names of every kind that `wire_id` knows: small, signed, wide.
struct names {
  enum class agent : std::uint8_t {};
  enum class plan_type : std::int8_t {};
  using plan = rota::strong_id<struct plan_tag, std::int64_t>;
  using task = rota::strong_id<struct task_tag>;
  enum class state : std::uint16_t {};
};
using message = rota::message<names>;
using claim = rota::claim<names>;
using plan_message = rota::plan_message<names>;

constexpr names::agent agent(int n) { return static_cast<names::agent>(n); }

plan_message a_plan_message() {
  plan_message m{agent(7), {{1'796'000'000}, 1000}, 2, {}};
  rota::participation<names> p;
  p.type = names::plan_type(-1);
  p.leads = 2;
  p.place = rota::placement<names>{{-3}, {4}, names::state(2)};
  p.fingerprint = 305'419'896;
  m.types.push_back(p);
  p = {};
  p.type = names::plan_type(5);
  p.stance = rota::stance::abstains;
  m.types.push_back(p);
  return m;
}
claim a_claim() {
  claim c;
  c.atoms = {{agent(1), {-3}, {4}}, {agent(9), {-3}, {18'446'744'073'709'551'615U}}};
  c.ages = {rota::milliseconds(17), rota::duration{}};
  c.type = names::plan_type(-1);
  c.leader = agent(9);
  c.stamp = {5, agent(9)};
  c.incarnation = {1'796'000'000};
  c.number = 2;
  c.version = 3;
  c.remaining = rota::milliseconds(1970);
  c.renewals = 1;
  c.answers = 2;
  return c;
}

constexpr auto plan_text =
    R"({"rota": 2, "plan_message": {"sender": 7, "incarnation": 1796000000, "sequence": 1000, "claims": 2, "types": )"
    R"([{"type": -1, "leads": 2, "place": {"plan": -3, "task": 4, "state": 2}, "fingerprint": 305419896}, )"
    R"({"type": 5, "leads": 0, "stance": "abstains"}]}})";
constexpr auto claim_text =
    R"({"rota": 2, "claim": {"type": -1, "leader": 9, "incarnation": 1796000000, "number": 2, "version": 3, "renewals": 1, "answers": 2, )"
    R"("confidence": 5, "stamp": 9, "remaining_us": 1970000, "plan": -3, "atoms": [{"agent": 1, "task": 4, "age_ms": 17}, )"
    R"({"agent": 9, "task": 18446744073709551615, "age_ms": 0}]}})";

/// The text with one thing replaced, which stands there once.
std::string with(std::string const& text, std::string const& what, std::string const& by) {
  auto const at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  EXPECT_EQ(text.find(what, at + 1), std::string::npos) << what;
  return std::string(text).replace(at, what.size(), by);
}
json_fault fault(std::string const& text) {
  auto const m = rota::read_json<names>(text);
  EXPECT_FALSE(m) << text;
  return m ? json_fault{} : m.error();
}

TEST(message_json, is_written_like_this) {
  EXPECT_EQ(*rota::write_json(message{a_plan_message()}), plan_text);
  EXPECT_EQ(*rota::write_json(message{a_claim()}), claim_text);
  claim nobody = a_claim();
  nobody.atoms = {};
  nobody.ages.clear();
  EXPECT_NE(rota::write_json(message{nobody})->find(R"("remaining_us": 1970000, "atoms": []})"), std::string::npos);
}

TEST(message_json, is_read_in_any_layout_and_order) {
  EXPECT_EQ(*rota::read_json<names>(plan_text), message{a_plan_message()});
  EXPECT_EQ(*rota::read_json<names>(claim_text), message{a_claim()});
  auto const pretty = nlohmann::json::parse(claim_text).dump(8);  // its keys in alphabetical order
  EXPECT_EQ(*rota::read_json<names>(pretty), message{a_claim()});
}

/// The JSON form and the bytes say the same, also where times are rounded.
TEST(message_json, says_what_the_bytes_say) {
  int long_ones = 0;
  auto const check = [&](auto vocabulary) {
    using V = decltype(vocabulary);
    EXPECT_TRUE(rc::check("read_json ∘ write_json = decode ∘ encode", [&] {
      auto m = *rota_test::any_message<V>();
      if (auto* c = std::get_if<rota::claim<V>>(&m)) {
        c->remaining += rota::nanoseconds(*rc::gen::inRange(0, 1000));
        for (auto& age : c->ages) age += rota::nanoseconds(*rc::gen::inRange(0, 1'000'000));
      }
      std::array<std::byte, 4096> buffer{};
      auto const bytes = rota::decode<V>(std::span(buffer).first(*rota::encode(m, buffer)));
      auto const text = rota::write_json(m);
      RC_ASSERT(text.has_value());
      auto const back = rota::read_json<V>(*text);
      RC_ASSERT(back.has_value());
      RC_ASSERT(*back == *bytes);
      RC_ASSERT(*rota::write_json(*back) == *text);
      long_ones += text->size() > 500;
    }));
  };
  check(names{});
  check(rota::runtime_vocabulary{});
  EXPECT_GT(long_ones, 100);
}

TEST(message_json, what_has_no_bytes_has_no_json) {
  auto const refusal = [](message const& m) {
    std::array<std::byte, 8192> buffer{};
    auto const text = rota::write_json(m);
    EXPECT_FALSE(text);
    EXPECT_EQ(text.error(), rota::encode(m, buffer).error());
    return text.error();
  };
  auto many = a_plan_message();
  for (int i = 0; i < 63; ++i) many.types.push_back(many.types[1]);
  EXPECT_EQ(refusal(many), wire_fault::too_many);
  auto c = a_claim();
  c.ages.pop_back();
  EXPECT_EQ(refusal(c), wire_fault::unequal_ages);
  c = a_claim();
  c.ages[1] = rota::nanoseconds(-1);
  EXPECT_EQ(refusal(c), wire_fault::negative_time);
  c = a_claim();
  c.atoms = {{agent(1), {-3}, {4}}, {agent(9), {-2}, {4}}};
  EXPECT_EQ(refusal(c), wire_fault::mixed_plans);
}

TEST(message_json, a_field_that_is_wrong_is_named) {
  auto const expect = [](std::string const& text, std::string const& what, std::string const& by,
                         json_fault const& wanted) {
    auto const f = fault(with(text, what, by));
    EXPECT_EQ(f.place, wanted.place) << by;
    EXPECT_EQ(f.reason, wanted.reason) << by;
  };
  auto const byte = ", not a whole number from 0 to 255";
  for (std::string const bad : {"256", "-1", "7.0", "7e0", "18446744073709551616", "null", "true"}) {
    auto const f = fault(with(plan_text, R"("sender": 7)", R"("sender": )" + bad));
    EXPECT_EQ(f.place, "/plan_message/sender") << bad;
    EXPECT_NE(f.reason.find(byte), std::string::npos) << f.reason;
  }
  expect(plan_text, R"("sender": 7)", R"("sender": "7")", {"/plan_message/sender", "\"7\"" + std::string(byte)});
  expect(plan_text, R"("sender": 7)", R"("sender": [7])", {"/plan_message/sender", "a list" + std::string(byte)});
  auto const signed_byte = ", not a whole number from -128 to 127";
  for (std::string const bad : {"128", "-129", "9223372036854775808", "-9223372036854775809", "0.5", "{}"}) {
    auto const f = fault(with(claim_text, R"("type": -1)", R"("type": )" + bad));
    EXPECT_EQ(f.place, "/claim/type") << bad;
    EXPECT_NE(f.reason.find(signed_byte), std::string::npos) << f.reason;
  }
  expect(plan_text, "305419896", "4294967296",
         {"/plan_message/types/0/fingerprint", "4294967296, not a whole number from 0 to 4294967295"});
  expect(plan_text, R"("state": 2)", R"("state": -2)",
         {"/plan_message/types/0/place/state", "-2, not a whole number from 0 to 65535"});
  expect(plan_text, R"({"plan": -3, "task": 4, "state": 2})", "null",
         {"/plan_message/types/0/place", "null, not an object"});
  expect(claim_text, "1970000", "9223372036854776",
         {"/claim/remaining_us", "9223372036854776, not a whole number from 0 to 9223372036854775"});
  expect(claim_text, R"("age_ms": 17)", R"("age_ms": -1)",
         {"/claim/atoms/0/age_ms", "-1, not a whole number from 0 to 9223372036854"});
}

TEST(message_json, exactly_its_keys_belong_in_an_object) {
  auto const expect = [](std::string const& text, std::string const& what, std::string const& by,
                         json_fault const& wanted) { EXPECT_EQ(fault(with(text, what, by)), wanted) << by; };
  expect(claim_text, R"("number": 2, )", "", {"/claim", "the key \"number\" is missing"});
  expect(claim_text, R"("number": 2)", R"("number": 2, "numbers": 2)",
         {"/claim", "the key \"numbers\" is unknown here"});
  expect(claim_text, R"("number": 2)", R"("number": 2, "number": 2)",
         {"/claim/number", "the key \"number\" stands twice in one object"});
  expect(claim_text, R"("plan": -3, )", "", {"/claim", "it names a plan if and only if it has atoms"});
  for (auto const* const word : {R"("assents")", R"("none")", "1", "null"})
    expect(plan_text, R"("abstains")", word,
           {"/plan_message/types/1/stance", std::string(word) + ", neither \"abstains\" nor \"dissents\""});
  expect(plan_text, R"("leads": 0)", R"("leads": 0, "Place": 1)",
         {"/plan_message/types/1", "the key \"Place\" is unknown here"});
  expect(plan_text, R"("rota": 2, )", "", {"/", "the key \"rota\" is missing"});
  expect(plan_text, R"("rota": 2)", R"("rota": 1)", {"/rota", "another version of the form"});
  expect(plan_text, R"("plan_message")", R"("plan")", {"/", "the key \"plan\" is unknown here"});
  EXPECT_EQ(fault(R"({"rota": 2})"), (json_fault{"/", "neither one plan message nor one claim"}));
  EXPECT_EQ(fault(R"({"rota": 2, "claim": {}, "plan_message": {}})").reason, "neither one plan message nor one claim");
  EXPECT_EQ(fault("[]"), (json_fault{"/", "a list, not an object"}));
  EXPECT_EQ(fault(R"({"rota": 2, "claim": 7})"), (json_fault{"/claim", "7, not an object"}));
}

TEST(message_json, atoms_ascend) {
  auto const swapped = with(claim_text, R"("agent": 1,)", R"("agent": 10,)");
  EXPECT_EQ(fault(swapped), (json_fault{"/claim/atoms/1", "the atoms repeat or are out of order"}));
  auto const twice = with(with(claim_text, R"("agent": 1,)", R"("agent": 9,)"), "18446744073709551615", "4");
  EXPECT_EQ(fault(twice).place, "/claim/atoms/1");
}

TEST(message_json, hostile_texts_are_refused_with_a_place) {
  EXPECT_EQ(fault("").reason, "cut off: the JSON text ends too early");
  for (std::size_t size = 1; size + 1 < std::string(claim_text).size(); ++size)
    EXPECT_FALSE(fault(std::string(claim_text).substr(0, size)).place.empty());
  EXPECT_EQ(fault(std::string(claim_text) + "}").place, "1:" + std::to_string(std::string(claim_text).size() + 1));
  EXPECT_NE(fault(R"({"rota": )" + std::string(100'000, '[')).reason.find("nested deeper than 8"), std::string::npos);
  EXPECT_NE(fault(with(plan_text, R"("claims")", "\"cl\xff\"")).reason.find("UTF-8"), std::string::npos);
  EXPECT_NE(fault(with(plan_text, R"("claims": 2)", R"("claims": 1e999)")).reason.find("no JSON"), std::string::npos);
  EXPECT_EQ(fault(with(plan_text, R"("claims": 2)", R"("claims": 1e999)")).reason.find("exception"), std::string::npos);
  std::string const zero(1, '\0');
  for (auto const& behind : {zero, zero + "garbage", zero + std::string(plan_text)})
    EXPECT_EQ(fault(plan_text + behind).reason, "no JSON: a zero byte");
  auto const lines = fault(with(plan_text, R"("claims")", R"("cl\na\u0000ims")")).reason;
  EXPECT_EQ(lines.find_first_of(std::string("\n\0", 2)), std::string::npos) << lines;
  EXPECT_EQ(fault(std::string(rota::most_json_bytes + 1, ' ')), (json_fault{"/", "longer than 131072 bytes"}));
  std::string many =
      R"({"rota": 2, "plan_message": {"sender": 7, "incarnation": 1, "sequence": 1, "claims": 0, "types": [)";
  for (int i = 0; i < 65; ++i) many += std::string(i == 0 ? "" : ", ") + R"({"type": 1, "leads": 0})";
  EXPECT_EQ(fault(many + "]}}"), (json_fault{"/plan_message/types", "more than 64 entries"}));
  std::string zeros = R"({"rota": [0)";
  for (int i = 0; i < 5000; ++i) zeros += ",0";
  EXPECT_NE(fault(zeros + "]}").reason.find("more than 4096 values"), std::string::npos);
}

/// The greatest messages there are fit, however widely they are laid out.
TEST(message_json, the_greatest_message_can_be_read) {
  rota::claim<> c;
  c.leader = c.stamp.id = {~std::uint64_t{0}};
  c.incarnation = {~std::uint64_t{0}};
  for (std::uint64_t i = 0; i < rota::most_wire_atoms; ++i) {
    c.atoms.insert({{~std::uint64_t{0} - i}, {~std::uint64_t{0}}, {~std::uint64_t{0}}});
    c.ages.push_back(rota::milliseconds(9'000'000'000'000));
  }
  auto const text = *rota::write_json(rota::message<>{c});
  EXPECT_EQ(*rota::read_json<rota::runtime_vocabulary>(nlohmann::json::parse(text).dump(8)), rota::message<>{c});
}

/// The messages of docs/protocol.md: the first has the bytes that stand there, too.
TEST(message_json, what_the_documentation_shows_is_read) {
  std::ifstream in(std::string(ROTA_SOURCE_DIR) + "/docs/protocol.md");
  std::string const page{std::istreambuf_iterator<char>(in), {}};
  std::vector<rota::message<>> shown;
  std::string const fence = "```json\n";
  for (auto at = page.find(fence); at != std::string::npos; at = page.find(fence, at + 1)) {
    auto const begin = at + fence.size();
    auto const m = rota::read_json<rota::runtime_vocabulary>(page.substr(begin, page.find("```", begin) - begin));
    ASSERT_TRUE(m) << m.error().place << ": " << m.error().reason;
    shown.push_back(*m);
  }
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_EQ(std::get<rota::claim<>>(shown[1]).atoms.size(), 2u);
  std::array<std::byte, 64> buffer{};
  auto const size = rota::encode(shown[0], buffer);
  std::string hex;
  for (auto const b : std::span(buffer).first(*size)) {
    constexpr char digits[] = "0123456789abcdef";
    hex += {digits[static_cast<unsigned>(b) / 16], digits[static_cast<unsigned>(b) % 16], ' '};
  }
  hex.back() = '\n';
  EXPECT_NE(page.find(hex), std::string::npos) << hex;
}

/// A bit changed here and there: read as the message that it says, or refused with a reason; never half.
TEST(message_json, a_changed_text_is_read_as_what_it_says_or_refused) {
  int read = 0, refused = 0;
  EXPECT_TRUE(rc::check("whole or not at all", [&] {
    auto text = *rota::write_json(*rota_test::any_message<names>());
    int const changes = *rc::gen::inRange(1, 3);
    for (int i = 0; i < changes; ++i) {
      auto& c = text[*rc::gen::inRange<std::size_t>(0, text.size())];
      bool const digit = c >= '0' && c <= '9';
      c = digit ? *rc::gen::element('0', '1', '9', '-')
                : *rc::gen::weightedElement<char>({{3, c}, {1, ','}, {1, '\xff'}});
    }
    auto const m = rota::read_json<names>(text);
    if (!m) {
      ++refused;
      RC_ASSERT(!m.error().place.empty() && !m.error().reason.empty());
      return;
    }
    ++read;
    RC_ASSERT(*rota::read_json<names>(*rota::write_json(*m)) == *m);
  }));
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace

}  // namespace message_json_test
