// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM: finish the frame at hand if it is soon done, keep what is done, leave nothing half
// written.
#pragma once

namespace luxo {

/// From now on the first SIGINT or SIGTERM is remembered. Who does not end by itself within two seconds of it
/// (a frame that takes longer, a driver that compiles), or is told a second time, ends there and then with
/// exit code 128 + signal: files appear whole or not at all, and temporary ones (base/temporary_files.h) are
/// removed.
void rememberInterruptions();

/// The remembered signal, or 0. A long job asks between its frames and ends with exit code 128 + signal.
[[nodiscard]] int interruptingSignal();

}  // namespace luxo
