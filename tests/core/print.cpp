#include <rota/core/print.hpp>

#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <tuple>

namespace printing {

using rota::detail::number;
using rota::detail::number_by_printf;

enum class rank : std::uint8_t { captain = 1, mate };
std::string_view to_string(rank r) { return r == rank::captain ? "captain" : "mate"; }

struct crew {
  enum class watch : std::int8_t { none = -1, first = 1 };
  friend char const* to_string(watch w) { return w == watch::none ? "none" : "first"; }

  using agent = rank;
  using plan_type = int;
  enum class plan : std::uint64_t { greatest = std::numeric_limits<std::uint64_t>::max() };
  using task = watch;
  using state = rota::strong_id<crew>;
};

struct mast_tag;
std::string to_string(rota::strong_id<mast_tag> id) { return "mast " + std::to_string(id.value); }

struct mute {
  int x = 0;
  friend auto operator<=>(mute const&, mute const&) = default;
};

TEST(default_names, prefer_the_to_string_beside_the_type) {
  rota::default_names const name;
  EXPECT_EQ(name(rank::captain), "captain");                // a string_view, beside an enumeration
  EXPECT_EQ(name(crew::watch::none), "none");               // a char const*, friend of the vocabulary
  EXPECT_EQ(name(rota::strong_id<mast_tag>{3}), "mast 3");  // beside the tag
}

TEST(default_names, print_numbers_where_there_is_no_name) {
  rota::default_names const name;
  EXPECT_EQ(name(crew::plan::greatest), "18446744073709551615");
  EXPECT_EQ(name(-7), "-7");
  EXPECT_EQ(name(std::uint8_t{65}), "65");
  EXPECT_EQ(name(rota::strong_id<crew>{12}), "12");
  EXPECT_EQ(name(std::string("ready")), "ready");
  EXPECT_EQ(name(mute{}), "?");
}

TEST(default_names, print_bytes_in_hexadecimal_and_sixteen_of_them_as_a_uuid) {
  rota::default_names const name;
  EXPECT_EQ(name(rota::strong_id<crew, std::array<std::uint8_t, 3>>{{1, 0xab, 255}}), "01abff");
  std::array<std::uint8_t, 16> bytes{};
  for (std::size_t i = 0; i < 16; ++i) bytes[i] = static_cast<std::uint8_t>(0x10 * i + i);
  EXPECT_EQ(name(rota::strong_id<crew, std::array<std::uint8_t, 16>>{bytes}), "00112233-4455-6677-8899-aabbccddeeff");
}

TEST(atoms, print_in_the_notation_of_the_paper) {
  EXPECT_EQ(to_string(rota::in<crew>{rank::mate, crew::plan{7}, crew::watch::first}), "In(mate, 7, first)");
  EXPECT_EQ(to_string(rota::in_state<crew>{rank::captain, {}, crew::watch::none, {4}}), "In(captain, 0, none, 4)");
  EXPECT_EQ(to_string(rota::in<>{{1}, {2}, {3}}), "In(1, 2, 3)");
}

TEST(atoms, take_a_function_that_names) {
  auto const name = [](auto const& id) { return "#" + std::to_string(id.value); };
  EXPECT_EQ(to_string(rota::in<>{{1}, {2}, {3}}, name), "In(#1, #2, #3)");
}

TEST(times, print_exactly_in_a_unit_that_fits) {
  EXPECT_EQ(to_string(rota::milliseconds(1500)), "1.5 s");
  EXPECT_EQ(to_string(rota::milliseconds(30)), "30 ms");
  EXPECT_EQ(to_string(rota::microseconds(-250)), "-250 us");
  EXPECT_EQ(to_string(rota::nanoseconds(999)), "999 ns");
  EXPECT_EQ(to_string(rota::nanoseconds(2'000'000'001)), "2.000000001 s");
  EXPECT_EQ(to_string(rota::duration{}), "0 s");
  EXPECT_EQ(to_string(rota::duration{std::numeric_limits<std::int64_t>::min()}), "-9223372036.854775808 s");
  EXPECT_EQ(to_string(rota::instant{} + rota::milliseconds(12'500)), "12.5 s");
  EXPECT_EQ(to_string(rota::instant{-1}), "-0.000000001 s");
  EXPECT_EQ(to_string(rota::never), "never");
}

std::tuple<double, char const*> const written[] = {{0.0, "0"},
                                                   {-0.0, "-0"},
                                                   {1.0, "1"},
                                                   {-1234.5, "-1234.5"},
                                                   {0.1, "0.1"},
                                                   {100000.0, "100000"},
                                                   {1e15, "1000000000000000"},
                                                   {1e16, "1e+16"},
                                                   {1.5e16, "1.5e+16"},
                                                   {1e-5, "0.00001"},
                                                   {9.5e-6, "9.5e-06"},
                                                   {1e300, "1e+300"},
                                                   {5e-324, "5e-324"},
                                                   {1.0 / 3.0, "0.3333333333333333"}};

TEST(numbers, are_as_short_as_reading_back_allows) {
  for (auto const& [x, text] : written) EXPECT_EQ(number(x), text);
  EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(number(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(number(-std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(number(0.5f), "0.5");
  EXPECT_EQ(number(std::uint64_t{18446744073709551615u}), "18446744073709551615");
}

TEST(numbers, are_the_same_where_the_library_has_no_to_chars) {
  for (auto const& [x, text] : written) EXPECT_EQ(number_by_printf(x), text);
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    auto const x = std::bit_cast<double>(random() & ~(std::uint64_t{1} << 62));  // finite
    EXPECT_EQ(std::strtod(number(x).c_str(), nullptr), x);
    EXPECT_EQ(number_by_printf(x), number(x));
  }
}

/// Sets a locale with a decimal comma, built for this test if it is not installed.
bool set_german_locale() {
  if (std::setlocale(LC_ALL, "de_DE.UTF-8")) return true;
  auto const folder = testing::TempDir() + "rota_locales";
  auto const build = "mkdir -p '" + folder + "' && localedef -i de_DE -f UTF-8 '" + folder + "/de_DE.UTF-8'";
  ::setenv("LOCPATH", folder.c_str(), 0);
  return std::system((build + " >/dev/null 2>&1").c_str()) == 0 && std::setlocale(LC_ALL, "de_DE.UTF-8");
}

TEST(numbers, do_not_follow_the_locale) {
  std::string const before = std::setlocale(LC_ALL, nullptr);
  if (!set_german_locale()) GTEST_SKIP() << "no German locale on this machine";
  EXPECT_EQ(std::to_string(0.5), "0,500000");  // what would happen
  EXPECT_EQ(number(-1234.5), "-1234.5");
  EXPECT_EQ(number_by_printf(-1234.5), "-1234.5");
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace printing
