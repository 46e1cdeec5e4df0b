// SPDX-License-Identifier: Apache-2.0
#include "interruption.h"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>

#include "base/temporary_files.h"
#include "exit_code.h"

namespace luxo {
namespace {

/// Of the two seconds that are promised; the rest is for the end itself, on a machine that is busy.
constexpr itimerval kPatience{.it_interval = {}, .it_value = {.tv_sec = 1, .tv_usec = 700'000}};

volatile std::sig_atomic_t received = 0;

[[noreturn]] void end() {
  removeTemporaryFiles();
  _exit(exit_code::kSignal + received);
}

extern "C" void remember(int signal) {
  if (received != 0) end();
  received = signal;
  setitimer(ITIMER_REAL, &kPatience, nullptr);
}

extern "C" void losePatience(int) { end(); }

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace

void rememberInterruptions() {
  handle(SIGINT, remember);
  handle(SIGTERM, remember);
  handle(SIGALRM, losePatience);
}

int interruptingSignal() { return received; }

}  // namespace luxo
