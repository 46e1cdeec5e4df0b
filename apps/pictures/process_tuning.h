// SPDX-License-Identifier: Apache-2.0
// Settings of the whole process, which only an application may choose.
#pragma once

namespace luxo {

/// Keeps freed memory in the process. A CPU Vulkan driver allocates and frees its bins every frame, and by
/// default glibc gives the pages back each time: thousands of page faults a frame, a third of a small frame's
/// time. Under a limit on addresses (ulimit -v) it keeps memory together instead. Call once, before any
/// thread starts.
void tuneAllocator();

/// Gives freed memory to the system after all: for when a program rests, or has kept long enough what resizes
/// and old pictures left in pieces. Cost: some milliseconds, and page faults of what is needed again.
void giveMemoryBack();

/// A limit on file sizes (ulimit -f) becomes an error of the write instead of a signal that ends the process.
/// The driver writes its shader cache from threads of its own, where nothing else could keep the signal away.
void ignoreFileSizeSignal();

/// Where a limit (ulimit -u, ulimit -v, a container's) leaves few threads, all of them are the driver's, and
/// this program works in one. Call once, before any work. Cost: 32 threads at most that do nothing, 0.3 ms.
void fitThreadsToProcess();

/// Since this process began, as near as it can tell: how long a user has been waiting.
[[nodiscard]] double processMilliseconds();

}  // namespace luxo
