#pragma once

#include "adapters/sandbox.hpp"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <string>
#include <vector>

#ifndef ROTA_PROGRAM
#define ROTA_PROGRAM ""
#endif

extern char** environ;

namespace rota::test {

struct run_result {
  int status = -1;
  std::string output;
  std::string complaint;
};

/// Runs the program `rota` that this build made.
inline run_result rota_program(std::vector<std::string> arguments) {
  sandbox const box;
  auto const out = box.path("out");
  auto const err = box.path("err");
  arguments.insert(arguments.begin(), ROTA_PROGRAM);
  std::vector<char*> argv;
  for (auto& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&files, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t child = 0;
  int status = -1;
  if (::posix_spawn(&child, ROTA_PROGRAM, &files, nullptr, argv.data(), environ) == 0) ::waitpid(child, &status, 0);
  posix_spawn_file_actions_destroy(&files);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(err)};
}

/// Misuse: exit 2, nothing on the output, one line that holds all of these.
inline void expect_complaint(run_result const& r, std::vector<std::string> const& parts) {
  EXPECT_EQ(r.status, 2) << r.output << r.complaint;
  EXPECT_EQ(r.output, "");
  EXPECT_EQ(r.complaint.find('\n'), r.complaint.size() - 1) << "one line, but: " << r.complaint;
  for (auto const& p : parts) EXPECT_NE(r.complaint.find(p), std::string::npos) << p << " not in: " << r.complaint;
}

/// Tests of the program; skipped where it was not built.
class program_test : public testing::Test {
protected:
  void SetUp() override {
    if (!fs::exists(ROTA_PROGRAM)) GTEST_SKIP() << "the program rota was not built";
  }
};

}  // namespace rota::test
