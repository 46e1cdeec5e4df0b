// SPDX-License-Identifier: Apache-2.0
// How far a device may draw what it draws from where it is: single precision, and the raster's grid.
#pragma once

#include <span>

#include "math/frustum.h"
#include "scene/snapshot.h"

namespace luxo {

/// Single precision on the way from object to clip space: matrices and vertices rounded to 2^-24 and at most
/// eight operations, relative to the lengths that are added up.
inline constexpr double kVertexSlack = 0x1p-20;

/// Vertices are snapped to the raster by at most half of 1/16 pixel: Vulkan asks for 4 subpixel bits.
inline constexpr double kSnapPx = 1.0 / 32;

/// Pixels: how far a device of kSubpixelBits (gpu/device.h) may draw corners of triangles beside where they
/// are. Its grid is 1/256 (half a cell's diagonal, once more where clipping makes new corners), and float
/// moves them by up to kOutlinePx (draw/exact_data.cpp).
inline constexpr double kMovedPx = 1.0 / 64;

/// Twice the area of a convex polygon that is projected (x and y in pixels, y down; z is not looked at),
/// positive where it turns from x to y, clockwise on the screen; 0 where it is so narrow that a device, which
/// moves corners by at most kMovedPx along x and y, may see it either way. Cost: three nanoseconds a corner.
[[nodiscard]] double certainArea(std::span<const Vec3> corners);

/// Lines are drawn one pixel wide, and every implementation picks its own pixels beside the ideal line.
inline constexpr double kLinePx = 1;

/// Metres by which single precision may move a point of the node's surface. Not finite where its bounds are
/// not.
[[nodiscard]] double vertexSlack(const View& view, const SnapshotNode& node);

/// What of the space a draw may show: the picture, grown by the snap, by where pixels are sampled and, of
/// lines, by their width.
[[nodiscard]] Frustum drawnFrustum(const View& view, bool lines);

}  // namespace luxo
