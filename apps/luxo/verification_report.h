// SPDX-License-Identifier: Apache-2.0
// What `luxo verify` prints: the same numbers for people and for programs.
#pragma once

#include <string>

#include "draw/statistics.h"
#include "reference/verification.h"
#include "report.h"
#include "scene/scene.h"

namespace luxo {

struct VerificationReport {
  std::string scene, shading;
  DeviceReport device;
  PixelSize size;
  double time = 0;
  FrameStatistics statistics;  ///< of the picture judged
  double truthMs = 0;          ///< that the ground truth took
  Verification verification;
  std::size_t approximateShadows = 0;  ///< lights whose shadows are not exact, but held against exact ones
};

/// A table, then the worst pixels of each kind with the names of their nodes.
[[nodiscard]] std::string verificationText(const VerificationReport& report, const Scene& scene,
                                           const Snapshot& snapshot);

/// JSON with stable names; more may be added. What does not apply, and what is infinite, is null.
[[nodiscard]] std::string verificationJson(const VerificationReport& report, const Scene& scene,
                                           const Snapshot& snapshot);

}  // namespace luxo
