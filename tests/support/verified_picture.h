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

  /// What a picture of textures promises: nothing lost, every pixel's point right, and its colour within a
  /// code (1 / 255) of the truth, but for pixels at edges of triangles: beyond, (u, v) run otherwise;
  /// and 99.9 % within a tenth of one.
  Verified expectTrueColors(const Snapshot& snapshot, std::uint64_t pixels);

 private:
  /// Nothing lost, no pixel without a number, and so many on a surface.
  Verified expectWhole(const Snapshot& snapshot, std::uint64_t pixels);
};

}  // namespace luxo::test
