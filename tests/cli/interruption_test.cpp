// SPDX-License-Identifier: Apache-2.0
#include "interruption.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

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
    std::raise(SIGINT);
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGINT);
}

}  // namespace
}  // namespace luxo
