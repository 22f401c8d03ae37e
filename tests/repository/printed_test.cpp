#include <rota/print.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <iomanip>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace printed_test {

struct crew {
  enum class agent : std::uint8_t { ann = 1, bob };
  enum class plan_type : std::uint8_t {};
  enum class plan : std::uint8_t {};
  enum class task : std::uint8_t { steer };
  enum class state : std::uint8_t {};
  friend char const* to_string(agent a) { return a == agent::ann ? "ann" : "bob"; }
};
using atom = rota::in<crew>;

/// A type of a user's that is made of ours, and prints otherwise.
template <class T>
struct box {
  T content;
  friend std::string to_string(box const&) { return "what to_string says"; }
  friend std::ostream& operator<<(std::ostream& out, box const&) { return out << "a box"; }
};

struct deck_tag;
std::string to_string(rota::strong_id<deck_tag> id) { return "deck " + std::to_string(id.value); }

template <class T>
concept streamable = requires(std::ostream& out, T const& x) { out << x; };

template <class T>
std::string streamed(T const& x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

TEST(printed, values_of_every_room_go_into_a_stream) {
  EXPECT_EQ(streamed(atom{crew::agent::bob, {}, {}}), "In(bob, 0, 0)");
  EXPECT_EQ(streamed(rota::event<atom>::addition({crew::agent::ann, {}, {}})), "({In(ann, 0, 0)}, {})");
  EXPECT_EQ(streamed(rota::atom_set<int>{2, 1}), "{1, 2}");
  EXPECT_EQ(streamed(rota::allocation<crew>{{}, {{crew::agent::bob, {}, {}}}}), "0: {In(bob, 0, 0)}");
  EXPECT_EQ(streamed(rota::sign::minus), "-");
  EXPECT_EQ(streamed(rota::milliseconds(30)), "30 ms");
  EXPECT_EQ(streamed(rota::never), "never");
  EXPECT_EQ(streamed(rota::strong_id<crew>{5}), "5");
  EXPECT_EQ(streamed(rota::cardinality{1, 3}), "1..3");
  EXPECT_EQ(streamed(rota::dense::status{}), to_string(rota::dense::status{}));
  EXPECT_EQ(streamed(rota::utility_fault::not_a_number), to_string(rota::utility_fault::not_a_number));
  rota::violation<crew> v;
  v.what = rota::clause::idle_forbidden;
  v.agent = crew::agent::ann;
  EXPECT_EQ(streamed(v), "agent ann has no task");  // by its describe
}

TEST(printed, your_to_string_goes_before_ours) { EXPECT_EQ(streamed(rota::strong_id<deck_tag>{2}), "deck 2"); }

TEST(printed, a_stream_pads_a_value_as_one_word) {
  std::ostringstream out;
  out << std::setw(8) << rota::milliseconds(30) << '|' << std::setw(3) << rota::sign::plus;
  EXPECT_EQ(out.str(), "   30 ms|  +");
}

TEST(printed, types_that_are_not_ours_are_left_alone) {
  EXPECT_EQ(streamed(box<rota::event<atom>>{}), "a box");
  static_assert(!streamable<crew::agent>, "an enumeration of yours: its to_string is used within our values only");
  static_assert(!streamable<std::vector<rota::event<atom>>> && !streamable<std::optional<rota::instant>>);
  static_assert(!rota::printable<int> && !rota::printable<std::string> && !rota::printable<char const*>);
}

}  // namespace printed_test
