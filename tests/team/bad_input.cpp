// Each kind of bad message is refused by a name of its own, counted under it, and leaves the robot as it was.
#include <gtest/gtest.h>

#include "encoded.hpp"

#include <rota/team/print.hpp>
#include <rota/team/reception_counts.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace bad_input_test {

using rota::milliseconds;
using rota::reception_counts;
using rota::refusal;
using rota::verdict;
using rota::wire_fault;

namespace {

/// With a checksum that fits, so that the rest is looked at.
bytes sealed(bytes b) {
  auto const sum = rota::detail::crc32(b);
  for (unsigned shift = 0; shift < 32; shift += 8) b.push_back(static_cast<std::byte>(sum >> shift & 255));
  return b;
}
bytes unsealed(message const& m) {
  auto b = encoded(m);
  b.resize(b.size() - 4);
  return b;
}

struct bad_input : playground {
  /// Robot 5, in a reign of robot 9, with a change of robot 2 that the monitor still looks at.
  robot in_the_middle() {
    auto a = in_play(5);
    (void)think(a, sees(5));
    a.receive(says(2, 7, attack), start);
    (void)think(a, sees(5));
    a.receive(says(3, 7, defend), start);
    auto c = claim_by(9, 9, 3);
    c.version = 2;
    a.receive(c, start);
    return a;
  }

  /// What is on the air goes the whole way: decoded, received, counted.
  static void hear(robot& a, bytes const& b, rota::instant now, reception_counts& counts) {
    if (auto const m = rota::decode<soccer>(b)) {
      counts.count(a.receive(*m, now));
    } else {
      counts.count(m.error());
    }
  }
};

/// Every reason that there is, as a robot meets it.
std::vector<std::pair<message, refusal>> every_refusal() {
  std::vector<std::pair<message, refusal>> bad;
  auto const add = [&](refusal why, message const& m) { bad.emplace_back(m, why); };
  auto const with = [](auto m, auto const& change) {
    change(m);
    return m;
  };
  auto const sound = says(2, 8, defend);
  auto const ruling = claim_by(9, 9, 4);

  add(refusal::own_id, says(5, 1, attack));
  add(refusal::own_id, claim_by(5, 5));
  add(refusal::own_later_life, with(says(5, 1, attack), [](auto& m) { m.number.incarnation = {2}; }));
  add(refusal::own_former_life, with(claim_by(5, 5), [](auto& c) { c.incarnation = {0}; }));
  add(refusal::stranger, says(42, 1, attack));
  add(refusal::stranger, claim_by(42, 42));
  add(refusal::stranger, with(ruling, [](auto& c) { c.atoms = {does(42, attack)}; }));
  add(refusal::too_many_types, with(says_nothing(2, 8), [](auto& m) {
        for (int i = 0; i <= 64; ++i) m.types.push_back({soccer::plan_type(i)});
      }));
  add(refusal::number_out_of_reach, says(2, 8 + rota::most_jump, defend));
  add(refusal::number_out_of_reach, says(2, ~std::uint64_t{0}, defend));
  add(refusal::number_out_of_reach, with(sound, [](auto& m) { m.number.incarnation = {0}; }));
  add(refusal::number_out_of_reach, with(sound, [](auto& m) { m.claims = ~std::uint64_t{0}; }));
  add(refusal::number_out_of_reach, with(ruling, [](auto& c) { c.number = 0; }));
  add(refusal::number_out_of_reach, with(ruling, [](auto& c) { c.number = 5 + rota::most_jump; }));
  add(refusal::number_out_of_reach, with(ruling, [](auto& c) { c.incarnation = {~std::uint64_t{0}}; }));
  add(refusal::number_out_of_reach, with(ruling, [](auto& c) { c.version = ~std::uint64_t{0}; }));
  add(refusal::types_not_ascending, with(sound, [](auto& m) { m.types.push_back(m.types[0]); }));
  add(refusal::types_not_ascending, with(sound, [](auto& m) {
        m.types.insert(m.types.begin(), rota::participation<soccer>{defence_id, std::nullopt});
      }));
  add(refusal::unknown_task, with(sound, [](auto& m) { m.types[0].place->plan = soccer::plan::kickoff; }));
  add(refusal::unknown_task, with(sound, [](auto& m) { m.types[0].place->task = soccer::task(200); }));
  add(refusal::unknown_task, with(ruling, [](auto& c) { c.atoms = {does(9, soccer::task::support)}; }));
  add(refusal::not_executed, with(ruling, [](auto& c) { c.type = defence_id; }));
  add(refusal::malformed_allocation, with(ruling, [](auto& c) {
        c.atoms.insert(does(9, defend));
        c.ages.push_back({});
      }));
  add(refusal::foreign_stamp, with(ruling, [](auto& c) { c.stamp.id = agent(8); }));
  add(refusal::foreign_stamp, with(claim_by(9, 3, 3), [](auto& c) { c.version = 2; }));
  add(refusal::foreign_stamp, with(claim_by(9, 9, 3), [](auto& c) { c.stamp.confidence = 7, c.version = 3; }));
  add(refusal::foreign_claim, with(sound, [](auto& m) { m.types[0].leads = 1; }));
  add(refusal::remaining_time, with(ruling, [](auto& c) { c.remaining = rota::seconds(3); }));
  add(refusal::remaining_time, with(ruling, [](auto& c) { c.remaining = {}; }));
  add(refusal::remaining_time, with(ruling, [](auto& c) { c.remaining = rota::microseconds(INT64_MAX / 1000); }));
  add(refusal::malformed_allocation, with(ruling, [](auto& c) { c.ages[0] = rota::seconds(200'000'000); }));
  return bad;
}

TEST_F(bad_input, each_kind_is_refused_counted_by_name_and_leaves_no_trace) {
  auto a = in_the_middle();
  ASSERT_TRUE(a.rule(play_id)->obeying());
  auto const now = start + milliseconds(20);
  auto const before = a;
  auto const digest = a.digest(now);
  reception_counts counts, expected;
  for (auto const& [m, reason] : every_refusal()) {
    rota::reception<soccer> r;
    r.verdict = verdict::refused;
    r.reason = reason;
    expected.count(r);
    if (reason == refusal::too_many_types) {  // more than the written form holds
      counts.count(a.receive(m, now));
    } else {
      hear(a, encoded(m), now, counts);
    }
    EXPECT_EQ(counts, expected) << rota::to_string(reason);
    EXPECT_EQ(a, before) << rota::to_string(reason);
    EXPECT_EQ(a.digest(now), digest);
  }
  rota::robot_options off;
  off.resolution = false;
  auto deaf = in_play(5, off);
  auto const untouched = deaf;
  hear(deaf, encoded(claim_by(9, 9)), now, counts);
  EXPECT_EQ(deaf, untouched);
  for (std::size_t i = 1; i < reception_counts::refusals; ++i)
    EXPECT_GT(counts.of(static_cast<refusal>(i)), 0u) << rota::to_string(static_cast<refusal>(i));
  EXPECT_EQ(counts.accepted() + counts.stale(), 0u);
}

TEST_F(bad_input, what_is_replayed_is_stale_and_leaves_no_trace) {
  auto a = in_the_middle();
  auto const before = a;
  auto const now = start + milliseconds(20);
  reception_counts counts;
  for (std::uint64_t n : {0u, 1u, 6u, 7u}) hear(a, encoded(says(2, n, defend)), now, counts);
  auto former = claim_by(2, 2, 9);
  former.incarnation = {0};
  EXPECT_EQ(a.receive(former, now).verdict, verdict::refused) << "no life has the number 0";
  EXPECT_EQ(counts.stale(), 4u);
  EXPECT_EQ(a, before);

  auto reborn = says(2, 1, defend);
  reborn.number.incarnation = {2};
  a.receive(reborn, now);
  auto const reheard = a;
  hear(a, encoded(claim_by(2, 2)), now, counts);
  EXPECT_EQ(counts.stale(), 5u) << "a claim of a life that is over";
  EXPECT_EQ(a, reheard);
}

TEST_F(bad_input, bytes_that_are_no_message_are_counted_by_name) {
  auto a = in_the_middle();
  auto const before = a;
  auto const m = message{says(2, 8, defend)};
  auto const whole = encoded(m);
  reception_counts counts;
  auto const expect = [&](wire_fault why, bytes const& b) {
    auto const n = counts.of(why);
    auto const all = counts.refused();
    hear(a, b, start, counts);
    EXPECT_EQ(counts.of(why), n + 1) << rota::to_string(why);
    EXPECT_EQ(counts.refused(), all + 1);
    EXPECT_EQ(a, before);
  };
  for (std::size_t size = 0; size < whole.size(); ++size) {
    auto const n = counts.of(wire_fault::cut_short) + counts.of(wire_fault::checksum);
    hear(a, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}, start, counts);
    EXPECT_EQ(counts.of(wire_fault::cut_short) + counts.of(wire_fault::checksum), n + 1) << size;
  }
  EXPECT_EQ(a, before);
  auto b = unsealed(m);
  b.resize(b.size() - 2);
  expect(wire_fault::cut_short, sealed(b));
  b = unsealed(m);
  b.push_back(std::byte{0});
  expect(wire_fault::too_long, sealed(b));
  b = whole;
  b.push_back(std::byte{0});
  expect(wire_fault::too_long, b);
  b = whole;
  b[3] ^= std::byte{16};
  expect(wire_fault::checksum, b);
  b = unsealed(m);
  b[0] = std::byte{0xa2};
  expect(wire_fault::version, sealed(b));
  b[0] = std::byte{'{'};
  expect(wire_fault::foreign, sealed(b));
  b = unsealed(m);
  b[1] = std::byte{0x82};
  b.insert(b.begin() + 2, std::byte{0});  // sender 2, in two bytes
  expect(wire_fault::not_canonical, sealed(b));
  b = unsealed(m);
  b[1] = std::byte{0x80};
  b.insert(b.begin() + 2, std::byte{2});  // sender 256 of at most 255
  expect(wire_fault::out_of_range, sealed(b));
}

TEST_F(bad_input, counts_are_told_in_words) {
  reception_counts counts;
  EXPECT_EQ(rota::to_string(counts), "0 accepted, 0 stale, 0 refused");
  auto a = in_play(5);
  hear(a, encoded(says(2, 1, defend)), start, counts);
  hear(a, encoded(says(2, 1, defend)), start, counts);
  hear(a, encoded(says(42, 1, defend)), start, counts);
  hear(a, encoded(says(43, 1, defend)), start, counts);
  hear(a, {}, start, counts);
  EXPECT_EQ(rota::to_string(counts),
            "1 accepted, 1 stale, 3 refused: 1 because it ends too early, 2 because its sender, or an agent that it is "
            "about, is not in the roster");
  EXPECT_EQ(rota::to_string(static_cast<refusal>(reception_counts::refusals)), "?") << "a reason that is not counted";
  EXPECT_EQ(rota::to_string(static_cast<wire_fault>(reception_counts::wire_faults)), "?");
}

/// From whatever state: a message with one thing wrong is refused by that name, or for another of its faults, and changes
/// nothing; nor does any message that was heard before.
TEST_F(bad_input, leaves_no_trace_whatever_came_before) {
  auto const bad = every_refusal();
  reception_counts counts;
  EXPECT_TRUE(rc::check("refused or stale is unchanged", [&] {
    auto a = in_play(5);
    auto now = start;
    std::vector<message> heard;
    int const steps = *rc::gen::inRange(1, 12).as("steps");
    for (int i = 0; i < steps; ++i) {
      now += milliseconds(*rc::gen::inRange(0, 200));
      int const who = *rc::gen::inRange(1, 10);
      message m = says(who, *rc::gen::inRange<std::uint64_t>(1, 9), *rc::gen::element(attack, defend));
      if (*rc::gen::inRange(0, 3) == 0) m = claim_by(who, who, *rc::gen::inRange<std::uint64_t>(1, 4));
      a.receive(m, now);
      heard.push_back(m);
      if (*rc::gen::arbitrary<bool>()) (void)think(a, sees(*rc::gen::inRange(1, 10)), now);
    }
    for (std::size_t i = 0; i < bad.size() + heard.size(); ++i) {
      auto const before = a;
      auto const r = a.receive(i < bad.size() ? bad[i].first : heard[i - bad.size()], now);
      counts.count(r);
      if (r.verdict == verdict::accepted) continue;  // it is news to this robot
      RC_ASSERT(a == before);
      RC_ASSERT((r.reason == refusal::none) == (r.verdict == verdict::stale));
    }
  }));
  EXPECT_GT(counts.refused(), 10'000u);
  EXPECT_GT(counts.stale(), 100u);
}

}  // namespace

}  // namespace bad_input_test
