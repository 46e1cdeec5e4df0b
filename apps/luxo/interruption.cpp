// SPDX-License-Identifier: Apache-2.0
#include "interruption.h"

#include <csignal>

namespace luxo {
namespace {

volatile std::sig_atomic_t received = 0;

extern "C" void remember(int signal) { received = signal; }

}  // namespace

void rememberInterruptions() {
  struct sigaction action {};
  action.sa_handler = remember;
  // SA_RESETHAND: the second signal meets the default action.
  action.sa_flags = SA_RESTART | int(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int interruptingSignal() { return received; }

}  // namespace luxo
