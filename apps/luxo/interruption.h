// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM: finish the frame at hand, keep what is done, leave nothing half written.
#pragma once

namespace luxo {

/// From now on the first SIGINT or SIGTERM is only remembered; a second of the same kind ends the process.
void rememberInterruptions();

/// The remembered signal, or 0. A long job asks between its frames and ends with exit code 128 + signal.
[[nodiscard]] int interruptingSignal();

}  // namespace luxo
