// SPDX-License-Identifier: Apache-2.0
// Exact pictures held against the ground truth, pixel by pixel.
#pragma once

#include "reference/verification.h"
#include "support/picture.h"

namespace luxo::test {

class VerifiedPictureTest : public PictureTest {
 protected:
  struct Verified {
    FrameStatistics statistics;  ///< of the colours
    Verification verification;
  };

  /// Shadows that are not exact are held against those that are.
  [[nodiscard]] Verified verified(const Snapshot& snapshot, double shellPx = DrawOptions{}.shellTolerancePx);

  /// What an exact picture promises: nothing lost, every pixel within a thousandth, 110 dB, and coverage
  /// wrong nowhere but within 0.01 px of the silhouette. At least `pixels` of it are on a surface.
  Verified expectTheTruth(const Snapshot& snapshot, std::uint64_t pixels);
};

}  // namespace luxo::test
