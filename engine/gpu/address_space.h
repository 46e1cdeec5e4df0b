// SPDX-License-Identifier: Apache-2.0
// What a limit on addresses (ulimit -v) leaves this process.
#pragma once

#include <cstdint>
#include <string_view>

namespace luxo::gpu {

/// Bytes that this process may still map; the most there is where nothing limits it. Takes no memory, and may
/// be called by what handles a signal. Cost: a system call, and where there is a limit a small file.
[[nodiscard]] std::uint64_t addressSpaceLeft();

/// What a driver that draws on the processor takes, once it is loaded, beside its pictures: threads' stacks
/// and its compiler, which ends the process where an allocation fails. Of it, what is left to do once the
/// device is open. Measured with lavapipe 22.3 on two cores: the lamp needs 86 MiB, the teapot 44 more and
/// its pixels.
inline constexpr std::uint64_t kDriverBytes = std::uint64_t{160} << 20;
inline constexpr std::uint64_t kCompilerBytes = std::uint64_t{112} << 20;

/// What the compiler takes for the shaders of one more pipeline, or of one more drawing, on all cores.
/// Measured: without it the built-in catalogue and glass ended in the driver at most limits from 470 to 600
/// MiB; with 48 MiB glass did once, in some hundred runs on a busy machine.
inline constexpr std::uint64_t kShaderBytes = std::uint64_t{64} << 20;

/// Error(Retry), naming what could not be done, where less than kShaderBytes is left. Cost:
/// addressSpaceLeft().
void requireRoomForShaders(std::string_view what);

}  // namespace luxo::gpu
