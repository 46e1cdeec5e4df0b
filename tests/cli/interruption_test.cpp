// SPDX-License-Identifier: Apache-2.0
#include "interruption.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "base/temporary_files.h"

namespace luxo {
namespace {

/// What waitpid says of a process that runs `body`; signals must not touch the tests themselves.
int statusOf(const auto& body) {
  const pid_t child = fork();
  if (child == 0) {
    rememberInterruptions();
    body();
    _exit(interruptingSignal());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(Interruption, FirstSignalIsRemembered) {
  EXPECT_EQ(WEXITSTATUS(statusOf([] {})), 0);
  EXPECT_EQ(WEXITSTATUS(statusOf([] { std::raise(SIGINT); })), SIGINT);
  EXPECT_EQ(WEXITSTATUS(statusOf([] { std::raise(SIGTERM); })), SIGTERM);
}

TEST(Interruption, SecondSignalEndsTheProcess) {
  const int status = statusOf([] {
    std::raise(SIGINT);
    std::raise(SIGTERM);
  });
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
}

// What would go on for ever ends, and takes its temporary files along, but not those that are done.
TEST(Interruption, WhoTakesTooLongEndsByItself) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "interrupted";
  std::filesystem::create_directories(folder);
  for (const char* name : {"done", "written"}) std::ofstream(folder / name) << "x";
  const int status = statusOf([&] {
    const TemporaryName written((folder / "written").string());
    { const TemporaryName done((folder / "done").string()); }
    std::raise(SIGINT);
    for (;;) pause();
  });
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
  EXPECT_TRUE(std::filesystem::exists(folder / "done"));
  EXPECT_FALSE(std::filesystem::exists(folder / "written"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace luxo
