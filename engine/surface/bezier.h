// SPDX-License-Identifier: Apache-2.0
// Bicubic Bezier patches: any number of them, sharing one compiled formula.
#pragma once

#include <array>
#include <vector>

#include "math/vec.h"
#include "surface/surface.h"

namespace luxo {

/// Control points row by row: point 4 j + i pulls toward (u, v) = (i / 3, j / 3). The outer points of the
/// four rows and columns are the patch's edges; an edge whose four points are equal collapses to one.
using BezierPatch = std::array<Vec3, 16>;

/// Patch k lies on u in [k, k + 1], v in [0, 1]: S = sum Bi(u - k) Bj(v) P(4 j + i), Bi the cubic Bernstein
/// polynomials. Patches whose edges have the same control points are joined, whichever way they run. Bounds
/// come from the control points of the part in question (convex hull), tighter than intervals and equally
/// rigorous. Throws Error(Scene) for no patches or a control point that is not finite.
[[nodiscard]] Surface bezier(const std::vector<BezierPatch>& patches,
                             SurfaceTraits traits = {.name = "bezier"});

}  // namespace luxo
