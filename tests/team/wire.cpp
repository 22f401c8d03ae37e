// Messages as bytes: the same on every machine, whole or not at all.
#include <gtest/gtest.h>

#include "encoded.hpp"
#include "support/allocation_counter.hpp"
#include "support/messages.hpp"

#include <rota/team/wire.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace wire_test {

using rota::milliseconds;
using rota::wire_fault;

namespace {

std::string hex(bytes const& b) {
  static constexpr char digit[] = "0123456789abcdef";
  std::string s;
  for (auto x : b) s += {digit[static_cast<unsigned>(x) / 16], digit[static_cast<unsigned>(x) % 16], ' '};
  if (!s.empty()) s.pop_back();
  return s;
}
bytes from(std::string const& text) {
  bytes b;
  for (std::size_t i = 0; i + 1 < text.size(); i += 3)
    b.push_back(static_cast<std::byte>(std::stoi(text.substr(i, 2), nullptr, 16)));
  return b;
}

plan_message a_plan_message() {
  auto m = says(7, 1000, attack);
  m.number.incarnation = rota::incarnation::started_at(1'796'000'000);
  m.claims = 2;
  m.types[0].leads = 2;
  m.types[0].place->state = soccer::state::protect;
  return m;
}
claim a_claim() {
  auto c = claim_by(9, 1, 2);
  c.incarnation = rota::incarnation::started_at(1'796'000'000);
  for (int n = 2; n <= 6; ++n) c.atoms.insert(does(n, defend));
  c.ages.clear();
  for (int n = 1; n <= 6; ++n) c.ages.push_back(milliseconds(17 * n));
  c.remaining = milliseconds(1970);
  c.version = 3;
  c.renewals = 1;
  c.answers = 2;
  return c;
}

/// Golden bytes: version 2 of the form, on every machine, for ever.
TEST(wire, says_the_same_on_every_machine) {
  EXPECT_EQ(hex(encoded(a_plan_message())), "a4 07 80 92 b3 d8 06 e8 07 02 01 00 01 02 00 00 02 b8 b1 a4 ec");
  EXPECT_EQ(hex(encoded(a_claim())),
            "a5 00 09 80 92 b3 d8 06 02 03 01 02 00 09 d0 9e 78 06 00 01 00 11 02 01 22 03 01 33 04 01 44 05 01 55 "
            "06 01 66 06 f2 39 a9");
}

wire_fault reason(bytes const& b) { return rota::decode<soccer>(b).error(); }

TEST(wire, says_where_its_sender_stands) {
  auto m = a_plan_message();
  m.types[0].stance = rota::stance::dissents;
  EXPECT_EQ(hex(encoded(m)), "a4 07 80 92 b3 d8 06 e8 07 02 01 00 09 02 00 00 02 79 fa d4 dc");
  m.types[0] = {soccer::plan_type::play, std::nullopt, 0, std::nullopt, rota::stance::abstains};
  EXPECT_EQ(hex(encoded(m)), "a4 07 80 92 b3 d8 06 e8 07 02 01 00 04 00 9e b3 e4 9d");
  EXPECT_EQ(reason(from("a4 07 80 92 b3 d8 06 e8 07 02 01 00 0c 00 96 39 3d 55")), wire_fault::not_canonical)
      << "nobody does both";
}

TEST(wire, is_short) {
  EXPECT_LE(encoded(a_plan_message()).size(), 24u);
  EXPECT_LE(encoded(a_claim()).size(), 60u);
  auto m = a_plan_message();
  m.types[0].fingerprint = 0x12345678;
  EXPECT_EQ(encoded(m).size(), encoded(a_plan_message()).size() + 4);
}

rc::Gen<message> any_message() { return rota_test::any_message<soccer>(); }

TEST(wire, brings_back_what_was_said) {
  int long_ones = 0;
  EXPECT_TRUE(rc::check("decode ∘ encode = id", [&] {
    auto const m = *any_message();
    auto const b = encoded(m);
    long_ones += b.size() > 80;
    auto const back = rota::decode<soccer>(b);
    RC_ASSERT(back.has_value());
    RC_ASSERT(*back == m);
  }));
  EXPECT_GT(long_ones, 20);
}

TEST(wire, rounds_times_to_the_safe_side) {
  auto c = a_claim();
  c.remaining = rota::nanoseconds(1'999'999);
  c.ages[0] = rota::nanoseconds(1);
  auto const back = std::get<claim>(*rota::decode<soccer>(encoded(c)));
  EXPECT_EQ(back.remaining, rota::microseconds(1999));
  EXPECT_EQ(back.ages[0], milliseconds(1));
}

/// Whatever bytes are accepted are the ones that would be written: so nothing is said in two ways.
TEST(wire, has_one_form_for_each_message) {
  std::map<wire_fault, int> seen;
  int accepted = 0;
  EXPECT_TRUE(rc::check("encode ∘ decode = id where it is defined", [&] {
    auto b = encoded(*any_message());
    // Changed here and there, with a checksum that fits, so that the fields themselves are looked at.
    int const changes = *rc::gen::inRange(0, 3);
    b.resize(b.size() - 4);
    for (int i = 0; i < changes && b.size() > 1; ++i) {
      auto const at = 1 + *rc::gen::inRange<std::size_t>(0, b.size() - 1);
      switch (*rc::gen::inRange(0, 3)) {
      case 0: b[at] = static_cast<std::byte>(*rc::gen::inRange(0, 256)); break;
      case 1: b.erase(b.begin() + static_cast<std::ptrdiff_t>(at)); break;
      default: b.insert(b.begin() + static_cast<std::ptrdiff_t>(at), std::byte{0x80});
      }
    }
    auto const sum = rota::detail::crc32(b);
    for (unsigned shift = 0; shift < 32; shift += 8) b.push_back(static_cast<std::byte>(sum >> shift & 255));
    auto const m = rota::decode<soccer>(b);
    if (!m) {
      ++seen[m.error()];
      return;
    }
    ++accepted;
    RC_ASSERT(encoded(*m) == b);
  }));
  EXPECT_GT(accepted, 300);
  for (auto f : {wire_fault::cut_short, wire_fault::too_long, wire_fault::not_canonical, wire_fault::out_of_range})
    EXPECT_GT(seen[f], 3) << static_cast<int>(f);
  EXPECT_EQ(seen[wire_fault::checksum], 0);
}

TEST(wire, a_flipped_bit_is_refused) {
  for (auto const& whole : {encoded(a_plan_message()), encoded(a_claim())})
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
      auto b = whole;
      b[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
      EXPECT_FALSE(rota::decode<soccer>(b)) << bit;
    }
}

TEST(wire, a_message_that_lost_its_end_or_got_a_longer_one_is_refused) {
  for (auto const& whole : {encoded(a_plan_message()), encoded(a_claim())}) {
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_FALSE(rota::decode<soccer>(std::span(whole).first(size))) << size;
    auto longer = whole;
    for (int more = 1; more < 40; ++more) {
      longer.push_back(std::byte{0});
      EXPECT_FALSE(rota::decode<soccer>(longer)) << more;
    }
  }
}

TEST(wire, what_is_not_ours_says_so) {
  EXPECT_EQ(reason({}), wire_fault::cut_short);
  EXPECT_EQ(reason(from("47 45 54 20 2f")), wire_fault::foreign);
  EXPECT_EQ(reason(from("a2 07 80 9a b4 d8 06 e8")), wire_fault::version);
  auto many = a_plan_message();
  for (int i = 0; i < 64; ++i) many.types.push_back(many.types[0]);
  std::array<std::byte, 8192> buffer{};
  EXPECT_EQ(rota::encode(message{many}, buffer).error(), wire_fault::too_many);
  auto c = a_claim();
  c.ages.pop_back();
  EXPECT_EQ(rota::encode(message{c}, buffer).error(), wire_fault::unequal_ages);
  c = a_claim();
  c.remaining = rota::nanoseconds(-1);
  EXPECT_EQ(rota::encode(message{c}, buffer).error(), wire_fault::negative_time);
  c = a_claim();
  c.ages[2] = rota::nanoseconds(-1);
  EXPECT_EQ(rota::encode(message{c}, buffer).error(), wire_fault::negative_time);
  c = a_claim();
  c.atoms.insert({agent(8), soccer::plan::kickoff, attack});
  c.ages.push_back({});
  EXPECT_EQ(rota::encode(message{c}, buffer).error(), wire_fault::mixed_plans);
}

TEST(wire, a_buffer_that_is_too_small_is_left_at_that) {
  auto const m = message{a_claim()};
  auto const size = encoded(m).size();
  for (std::size_t room = 0; room < size; ++room) {
    std::vector<std::byte> buffer(room);
    EXPECT_EQ(rota::encode(m, std::span(buffer)).error(), wire_fault::no_room) << room;
  }
  std::vector<std::byte> buffer(size);
  EXPECT_EQ(rota::encode(m, std::span(buffer)).value(), size);
}

/// The check value that the catalogue of CRCs gives for CRC-32/ISO-HDLC.
TEST(wire, the_checksum_is_the_one_it_is_called) {
  std::array<std::byte, 9> nine{};
  for (unsigned i = 0; i < 9; ++i) nine[i] = static_cast<std::byte>('1' + i);
  EXPECT_EQ(rota::detail::crc32(nine), 0xcbf43926u);
  static_assert(rota::detail::crc32({}) == 0);
}

TEST(wire, small_numbers_of_either_sign_are_short) {
  for (std::int64_t x :
       {std::int64_t{0}, std::int64_t{-1}, std::int64_t{63}, std::int64_t{-64}, INT64_MAX, INT64_MIN}) {
    EXPECT_EQ(rota::detail::unzigzag(rota::detail::zigzag(x)), x);
    EXPECT_EQ(rota::wire_id<std::int64_t>::from(rota::wire_id<std::int64_t>::to(x)), x);
    EXPECT_EQ(rota::detail::zigzag(x) < 128, x >= -64 && x < 64);
  }
}

TEST(wire, neither_way_allocates) {
  std::array<std::byte, 256> buffer{};
  for (auto const& m : {message{a_plan_message()}, message{a_claim()}}) {
    auto const before = rota_test::allocation_count();
    bool fine = true;
    for (int i = 0; i < 100; ++i) {
      auto const size = rota::encode(m, buffer);
      auto const back = rota::decode<soccer>(std::span(buffer).first(*size));
      fine &= back && *back == m;
    }
    EXPECT_EQ(rota_test::allocation_count() - before, 0u);
    EXPECT_TRUE(fine);
  }
}

/// One attacks, everybody else defends.
rota::plan_type<soccer, view> play_for_six() {
  using plan = rota::plan<soccer, view>;
  rota::additive_utility<soccer, view> const worth = [](soccer::agent a, soccer::task t, view const& v) {
    return std::optional<double>(t == attack ? v.attack[static_cast<std::size_t>(a)] : 0.125);
  };
  auto p = plan::make(
      {.plan = soccer::plan::normal, .tasks = {{attack, {1, 1}, {}}, {defend, {0, 9}, {}}}, .utility = worth});
  return *rota::plan_type<soccer, view>::make(play_id, {*p});
}

/// Six robots on the air in bytes, each message decoded by the five others; three are sure that they are closest, so that one
/// leads, and claims about all six.
TEST(wire, a_team_on_the_air_allocates_nothing) {
  auto const play = play_for_six();
  auto const members = make_team(6);
  rota::workspace space;
  std::vector<robot> team;
  for (int n = 1; n <= 6; ++n) {
    rota::robot_options options;
    options.first_message = start + milliseconds(13 * n);
    options.fingerprints = true;
    team.emplace_back(agent(n), squad(6), rota::incarnation{1}, options).enter(play, start);
  }
  std::array<std::byte, 256> buffer{};
  std::size_t claims_of_six = 0;
  std::uint64_t thinking = 0, speaking = 0, writing = 0, reading = 0, hearing = 0;
  auto const counted = [](std::uint64_t& sum, auto const& f) {
    auto const before = rota_test::allocation_count();
    f();
    sum += rota_test::allocation_count() - before;
  };
  for (int ms = 0; ms < 20'000; ++ms) {
    if (ms == 10'000) claims_of_six = 0, thinking = speaking = writing = reading = hearing = 0;  // now it is steady
    auto const now = start + milliseconds(ms);
    for (std::size_t i = 0; i < 6; ++i) {
      if (ms % 30 == static_cast<int>(4 * i))
        counted(thinking, [&] { (void)team[i].deliberate(play, members, sees(i < 3 ? int(i) + 1 : 1), now, space); });
      while (team[i].next_due() <= now) {
        std::optional<message> m;
        counted(speaking, [&] { m = team[i].next_message(now); });
        if (!m) break;
        if (auto const* c = std::get_if<claim>(&*m)) claims_of_six += c->atoms.size() == 6;
        std::size_t size = 0;
        counted(writing, [&] { size = *rota::encode(*m, buffer); });
        for (std::size_t to = 0; to < 6; ++to) {
          if (to == i) continue;
          std::optional<rota::result<message, wire_fault>> back;
          counted(reading, [&] { back = rota::decode<soccer>(std::span(buffer).first(size)); });
          ASSERT_TRUE(*back);
          counted(hearing, [&] { team[to].receive(**back, now); });
        }
      }
    }
  }
  EXPECT_GT(claims_of_six, 20u);
  EXPECT_EQ(thinking, 0u);
  EXPECT_EQ(speaking, 0u);
  EXPECT_EQ(writing, 0u);
  EXPECT_EQ(reading, 0u);
  EXPECT_EQ(hearing, 0u);
}

/// Bytes from anywhere, into a robot: decoded or not, nothing breaks.
TEST(wire, bytes_from_anywhere_break_no_robot) {
  auto const play = make_play();
  robot a(agent(1), squad(9), rota::incarnation{1});
  a.enter(play, start);
  EXPECT_TRUE(rc::check("refused or received", [&] {
    auto b = encoded(*any_message());
    int const flips = *rc::gen::inRange(0, 4);
    for (int i = 0; i < flips; ++i)
      b[*rc::gen::inRange<std::size_t>(0, b.size())] ^= static_cast<std::byte>(1 << *rc::gen::inRange(0, 8));
    if (auto const m = rota::decode<soccer>(b)) a.receive(*m, start + milliseconds(*rc::gen::inRange(0, 10000)));
    RC_ASSERT(a.believes(play_id)->takes_part(agent(1)));
  }));
}

}  // namespace

}  // namespace wire_test
