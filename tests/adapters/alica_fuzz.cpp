#include "sandbox.hpp"

#include <gtest/gtest.h>

#include <random>

namespace rota::test {
namespace alica_fuzz_test {

std::vector<fs::path> shipped_files() {
  std::vector<fs::path> out;
  for (auto const& e : fs::recursive_directory_iterator(own_files()))
    if (e.is_regular_file() && alica::detail::kind_of(e.path().string()) != alica::file_kind::none)
      out.push_back(e.path());
  std::sort(out.begin(), out.end());
  return out;
}

alica::detail::draft read(fs::path const& file, std::string_view bytes) {
  return read_document(bytes, alica::detail::kind_of(file.string()));
}

TEST(alica_fuzz, cut_off_at_every_byte_is_refused) {
  auto const files = shipped_files();
  ASSERT_EQ(files.size(), 11u);
  for (auto const& file : files) {
    auto const whole = slurp(file);
    EXPECT_FALSE(read(file, whole).refused());
    auto const end = whole.find_last_not_of(" \n") + 1;
    for (std::size_t n = 0; n < end; ++n) {
      auto const d = read(file, std::string_view(whole).substr(0, n));
      ASSERT_EQ(d.diagnostics.size(), 1u) << file << " cut at " << n;
      ASSERT_TRUE(d.refused());
    }
  }
}

TEST(alica_fuzz, flipped_bytes_load_or_are_refused) {
  std::mt19937 random{20110301};
  std::size_t refused = 0;
  std::size_t total = 0;
  for (auto const& file : shipped_files()) {
    auto const whole = slurp(file);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      for (char const c : {static_cast<char>(whole[i] ^ static_cast<char>(1U << (random() % 8))),
                           static_cast<char>(random()), "\"<>&{}[],:#0-9e\0"[random() % 16]}) {
        auto bytes = whole;
        bytes[i] = c;
        auto const d = read(file, bytes);
        ++total;
        refused += d.refused();
        ASSERT_TRUE(!d.refused() || !d.diagnostics.front().reason.empty());
      }
    }
  }
  EXPECT_GT(refused, total / 5) << "the flips reach the interesting cases";
  EXPECT_LT(refused, total * 19 / 20);
}

TEST(alica_fuzz, spliced_pieces_load_or_are_refused) {
  std::mt19937 random{20110301};
  auto const files = shipped_files();
  for (int round = 0; round < 3000; ++round) {
    auto const& file = files[random() % files.size()];
    auto const a = slurp(file);
    auto const b = slurp(files[random() % files.size()]);
    auto const bytes = a.substr(0, random() % a.size()) + b.substr(random() % b.size());
    auto const d = read(file, bytes);
    ASSERT_TRUE(!d.refused() || !d.diagnostics.front().reason.empty());
  }
}

// On disk, with everything that follows: the mutilated file is refused or loaded, and the sound ones stay.
TEST(alica_fuzz, a_folder_with_one_mutilated_file_never_fails) {
  std::mt19937 random{20110301};
  for (auto const* format : {"json", "xml"}) {
    sandbox box;
    fs::copy(own_files() / format, box.folder(), fs::copy_options::recursive);
    for (auto const& e : fs::recursive_directory_iterator(box.folder())) {
      if (!e.is_regular_file()) continue;
      auto const name = e.path().lexically_relative(box.folder()).string();
      auto const whole = slurp(e.path());
      for (int round = 0; round < 60; ++round) {
        auto bytes = whole;
        for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(' ' + random() % 95);
        auto const file = box.write(name, bytes);
        auto const m = box.load();
        for (auto const& d : m.documents) {
          bool const has_error = std::any_of(m.diagnostics.begin(), m.diagnostics.end(), [&](auto const& x) {
            return x.file == d.file && x.severity == alica::severity::error;
          });
          ASSERT_EQ(has_error, d.status == alica::file_status::refused) << d.file;
        }
        for (auto const& p : m.plans)
          for (auto const& entry : p.entry_points) ASSERT_NE(m.find_task(p.root, entry.task), nullptr);
        for (auto const& t : m.plan_types)
          for (auto const& c : t.plans) ASSERT_TRUE(!c.activated || m.find_plan(t.root, c.plan) != nullptr);
      }
      box.write(name, whole);
    }
  }
}

TEST(alica_fuzz, real_files_cut_off_are_refused) {
  if (!fs::exists(real_files())) GTEST_SKIP() << "no folder " << real_files();
  for (auto const& e : fs::recursive_directory_iterator(real_files())) {
    if (!e.is_regular_file() || alica::detail::kind_of(e.path().string()) == alica::file_kind::none) continue;
    auto const whole = slurp(e.path());
    auto const end = whole.find_last_not_of(" \r\n") + 1;
    for (std::size_t n = 0; n < end; n += 1 + end / 150) {
      auto const d = read(e.path(), std::string_view(whole).substr(0, n));
      ASSERT_TRUE(d.refused()) << e.path() << " cut at " << n;
    }
  }
}

}  // namespace alica_fuzz_test
}  // namespace rota::test
