#include <gtest/gtest.h>

#include "program.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace rota::test {
namespace readme_test {

using readme = program_test;

/// What the README shows of `rota allocate` is what `rota allocate` prints.
TEST_F(readme, shows_what_the_program_prints) {
  std::ifstream in(std::string(ROTA_SOURCE_DIR) + "/README.md");
  std::ostringstream text;
  text << in.rdbuf();
  std::string const page = text.str();
  std::string const prompt = "$ rota allocate ";
  auto const at = page.find(prompt);
  ASSERT_NE(at, std::string::npos);
  auto const end_of_command = page.find('\n', at);
  auto const end = page.find("```", at);
  auto const command = page.substr(at + 7, end_of_command - at - 7);
  auto const shown = page.substr(end_of_command + 1, end - end_of_command - 1);
  std::istringstream words(command);
  std::vector<std::string> arguments;
  for (std::string word; words >> word;) arguments.push_back(word);

  auto const before = std::filesystem::current_path();
  std::filesystem::current_path(ROTA_SOURCE_DIR);
  auto const ran = rota_program(arguments);
  std::filesystem::current_path(before);
  EXPECT_EQ(ran.status, 0) << ran.complaint;
  EXPECT_EQ(ran.output, shown);
}

}  // namespace readme_test
}  // namespace rota::test
