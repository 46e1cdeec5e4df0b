// SPDX-License-Identifier: Apache-2.0
// Where rays begin inside a shell: the near plane's section through it.
//
// Such a ray has come into the slab by no face of it, so nothing begins to search where it does. What is
// searched for from where it leaves is the surface it met last, and it may have met more.
#pragma once

#include <vector>

#include "draw/pixel_rows.h"
#include "shell/shell.h"

namespace luxo {

/// Appends rectangles that hold every pixel whose rays begin inside the part's slab, a pixel around each
/// included; one for each prism (a triangle of the top and its place in the bottom) that the near plane cuts
/// in the picture. Cost: some 50 ns per triangle.
void appendNearSection(const View& view, const SnapshotNode& node, const Shell& shell,
                       const Shell::Part& part, std::vector<PixelRect>& rects);

}  // namespace luxo
