// SPDX-License-Identifier: Apache-2.0
// Settings of the whole process, which only an application may choose.
#pragma once

namespace luxo {

/// Keeps freed memory in the process. A CPU Vulkan driver allocates and frees its bins every frame, and by
/// default glibc gives the pages back each time: thousands of page faults a frame, a third of a small frame's
/// time. Call once, before any thread starts.
void tuneAllocator();

}  // namespace luxo
