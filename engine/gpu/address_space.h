// SPDX-License-Identifier: Apache-2.0
// What a limit on addresses (ulimit -v) leaves this process.
#pragma once

#include <cstdint>

namespace luxo::gpu {

/// Bytes that this process may still map; the most there is where nothing limits it. Cost: a system call, and
/// where there is a limit a small file.
[[nodiscard]] std::uint64_t addressSpaceLeft();

/// What a driver that draws on the processor takes beside its pictures: threads' stacks and its compiler,
/// which ends the process where an allocation fails. Measured with lavapipe 22.3 on two cores: 38 MiB do, 18
/// do not.
inline constexpr std::uint64_t kDriverBytes = std::uint64_t{64} << 20;

}  // namespace luxo::gpu
