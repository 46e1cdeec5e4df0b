// SPDX-License-Identifier: Apache-2.0
#include "process_tuning.h"

#include <climits>
#include <csignal>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace luxo {
namespace {

const std::chrono::steady_clock::time_point kProcessStart = std::chrono::steady_clock::now();

}  // namespace

void tuneAllocator() {
#ifdef __GLIBC__
  constexpr int kMiB = 1 << 20;
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  mallopt(M_MMAP_THRESHOLD, 32 * kMiB);  // the largest that glibc takes
  mallopt(M_TOP_PAD, 64 * kMiB);
#endif
}

void ignoreFileSizeSignal() { std::signal(SIGXFSZ, SIG_IGN); }

std::chrono::steady_clock::time_point processStart() { return kProcessStart; }

}  // namespace luxo
