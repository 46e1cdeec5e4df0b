// SPDX-License-Identifier: Apache-2.0
// The Utah teapot (Martin Newell, 1975): 32 bicubic Bezier patches.
#pragma once

#include <vector>

#include "surface/bezier.h"
#include "surface/surface.h"

namespace luxo {

/// Height of the classic data: the usual version, as James Blinn drew it, whose heights are those of the
/// original divided by 1.3. The body's radius is 2, the spout reaches to x = 3.525 in control points.
inline constexpr double kTeapotHeight = 3.15;

/// The classic control points, y up, axis +Y, standing on y = 0, spout toward +X, handle toward -X. All
/// patches are turned so that Su x Sv points to the side that is seen. In order: the quarters, from +X toward
/// -Z, of bottom, lower body, upper body, rim, lid and knob; upper and lower handle, lower and upper spout,
/// of each the half in +Z, then that in -Z. Sections that look round leave the circle by up to 0.4 %; the
/// bottom (Frank Crow's) is not flat; the lid does not touch the rim.
[[nodiscard]] std::vector<BezierPatch> teapotPatches();

/// `height` metres from the table to the top of the knob, other sizes in proportion. It has borders where
/// spout and handle end, and so is drawn two-sided.
[[nodiscard]] Surface teapot(double height = kTeapotHeight);

}  // namespace luxo
