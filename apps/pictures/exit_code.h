// SPDX-License-Identifier: Apache-2.0
// How a program of luxo ends: one number for scripts, two lines for people.
#pragma once

#include <functional>

#include "base/error.h"

namespace luxo {

/// The documented exit codes. A signal ends with 128 + its number: 130 (SIGINT), 143 (SIGTERM).
namespace exit_code {
inline constexpr int kDone = 0;  ///< every output exists and meets what was asked
inline constexpr int kInternal = 1;
inline constexpr int kUsage = 2;
inline constexpr int kScene = 3;
inline constexpr int kDevice = 4;
inline constexpr int kWrite = 5;
inline constexpr int kRequirement = 6;
inline constexpr int kSomeFramesFailed = 7;
inline constexpr int kRetry = 75;
inline constexpr int kSignal = 128;
}  // namespace exit_code

[[nodiscard]] int exitCodeOf(ErrorKind kind);

/// Runs the program's body and gives its exit code. What it throws becomes "error: ..." and "help: ..." on
/// stderr and the code of its kind; out of memory is worth retrying, any other exception is internal. Memory
/// that is short where nothing catches, as in threads of drivers, ends the program with the same words and
/// code.
[[nodiscard]] int runToExitCode(const std::function<int()>& body);

}  // namespace luxo
