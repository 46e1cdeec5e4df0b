// SPDX-License-Identifier: Apache-2.0
// How much of a pixel's area is covered, between two numbers that are proven: no sampling, no statistics.
//
// The pixel is cut into a quadtree of squares. Each square is the beam of all rays through it, and is decided
// for all of them at once: no bounds of the surface meet the beam, or Krawczyk's test with the beam's whole
// range of rays for its parameter proves that every one of them meets one smooth piece of the surface.
//
//     const reference::CoverageBounds part = reference::pixelCoverage(caster, x, y);
//     EXPECT_LE(part.lower, truth);
//     EXPECT_GE(part.upper, truth);
#pragma once

#include <cstdint>
#include <optional>

#include "reference/caster.h"

namespace luxo::reference {

/// Parts of a pixel's area, 0..1.
struct CoverageBounds {
  double lower = 0;  ///< proven to be covered
  double upper = 1;  ///< all but what is proven to be empty
};

/// Of the area of pixel (x, y), counted from the picture's upper left corner, the part whose rays meet
/// anything, opaque or not: of the whole scene, or of one node (an index into Snapshot::nodes) as if it were
/// alone. Depth range and back faces count as in the picture. `upper - lower` is at most `resolution`, unless
/// squares of a 32nd of that side were still undecided: whole pixels seen edge-on, curves along which
/// patches meet. Not of triangles. Cost: some 0.1 ms for a pixel that is covered or empty; a silhouette
/// through one takes about 100 us / resolution, through Bezier patches ten times that. Safe from any thread.
[[nodiscard]] CoverageBounds pixelCoverage(const Caster& caster, int x, int y, double resolution = 1.0 / 1024,
                                           std::optional<std::uint32_t> node = std::nullopt);

}  // namespace luxo::reference
