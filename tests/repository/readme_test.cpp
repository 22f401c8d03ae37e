#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

std::string read(std::string const& name) {
  std::ifstream in(std::string(ROTA_SOURCE_DIR) + "/" + name);
  EXPECT_TRUE(in) << name;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The first code block of the README is an example that the build compiles and the tests run.
TEST(readme, its_first_example_is_the_compiled_one) {
  auto const readme = read("README.md");
  std::string const fence = "```cpp\n";
  auto const begin = readme.find(fence);
  ASSERT_NE(begin, std::string::npos);
  auto const end = readme.find("```", begin + fence.size());
  EXPECT_EQ(readme.substr(begin + fence.size(), end - begin - fence.size()), read("examples/first.cpp"));
}

/// The code in docs/algebra.md is out of an example that the build compiles, and which is all static_assert.
TEST(readme, the_code_of_the_algebra_page_is_compiled) {
  auto const page = read("docs/algebra.md");
  auto const compiled = read("examples/algebra.cpp");
  std::string const fence = "```cpp\n";
  int blocks = 0;
  for (auto begin = page.find(fence); begin != std::string::npos; begin = page.find(fence, begin + 1), ++blocks) {
    auto const code = begin + fence.size();
    auto const block = page.substr(code, page.find("```", code) - code);
    EXPECT_NE(compiled.find(block), std::string::npos) << block;
  }
  EXPECT_GE(blocks, 7);
}

/// Every relative link of README and docs leads to a file.
TEST(readme, its_links_lead_somewhere) {
  namespace fs = std::filesystem;
  int links = 0;
  std::vector<fs::path> pages{fs::path(ROTA_SOURCE_DIR) / "README.md"};
  for (auto const& entry : fs::directory_iterator(fs::path(ROTA_SOURCE_DIR) / "docs"))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  for (auto const& page : pages) {
    std::ifstream in(page);
    for (std::string line; std::getline(in, line);) {
      for (auto at = line.find("]("); at != std::string::npos; at = line.find("](", at + 1)) {
        auto const target = line.substr(at + 2, line.find(')', at) - at - 2);
        if (target.find("://") != std::string::npos || target.empty() || target[0] == '#') continue;
        ++links;
        EXPECT_TRUE(fs::exists(page.parent_path() / target.substr(0, target.find('#')))) << page << ": " << target;
      }
    }
  }
  EXPECT_GT(links, 5);
}

}  // namespace
