// SPDX-License-Identifier: Apache-2.0
#include "process_tuning.h"
#include "base/stopwatch.h"

#include <oneapi/tbb/global_control.h>
#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <climits>
#include <csignal>
#include <mutex>
#include <thread>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace luxo {
namespace {

const Stopwatch kProcess;

}  // namespace

void tuneAllocator() {
#ifdef __GLIBC__
  constexpr int kMiB = 1 << 20;
  // A limit on addresses counts what is only reserved, too: 64 MiB for the arena of each thread, which would
  // leave the driver nothing.
  rlimit addresses{};
  if (getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY) {
    mallopt(M_ARENA_MAX, 1);
    return;
  }
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  mallopt(M_MMAP_THRESHOLD, 32 * kMiB);  // the largest that glibc takes
  mallopt(M_TOP_PAD, 64 * kMiB);
#endif
}

void giveMemoryBack() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

void ignoreFileSizeSignal() { std::signal(SIGXFSZ, SIG_IGN); }

void fitThreadsToProcess() {
  // What this program and a driver that draws on the processor start on a machine of this many cores; a limit
  // that bites leaves few, and on a large machine a part is enough to see that there is none.
  const std::size_t wanted = std::min<std::size_t>(2 * std::thread::hardware_concurrency() + 8, 32);
  std::vector<pthread_t> started;
  started.reserve(wanted);
  // All at once: they wait for this. Not std::thread, whose threads free memory: each would take an arena of
  // 64 MiB of addresses for good, where a limit may be on just those.
  static std::mutex gate;
  {
    const std::lock_guard closed(gate);
    const auto wait = [](void*) -> void* {
      const std::lock_guard opened(gate);
      return nullptr;
    };
    pthread_t thread{};
    while (started.size() < wanted && pthread_create(&thread, nullptr, wait, nullptr) == 0)
      started.push_back(thread);
  }
  for (const pthread_t thread : started) pthread_join(thread, nullptr);
  if (started.size() < wanted) {
    using oneapi::tbb::global_control;
    // Never taken back: with that oneTBB would start the threads that cannot be started, as the process ends.
    static const auto* one = new global_control(global_control::max_allowed_parallelism, 1);
    static_cast<void>(one);
  }
}

double processMilliseconds() { return kProcess.milliseconds(); }

}  // namespace luxo
