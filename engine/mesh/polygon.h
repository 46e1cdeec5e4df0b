// SPDX-License-Identifier: Apache-2.0
// Polygons of model files as triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/vec.h"

namespace luxo {

/// The most corners of a polygon that is not convex: cutting off ears costs their square.
inline constexpr std::size_t kMaxConcaveCorners = 2048;

/// Adds corners (numbers in `points`, three a triangle, turning as the polygon does) of triangles that fill a
/// polygon of three corners or more, in the plane that it is nearest to. Of a convex one, or nearly, half of
/// the corners are cut off again and again: a corner is in few triangles, and these are not long, as a fan's
/// are, which take a hundred times as long to draw and to cast rays at. Else a fan, or with ears cut off
/// (Meisters, Polygons have ears, 1975). Where it crosses itself the triangles are as good as any. False: no
/// fan fills it, and it has more than kMaxConcaveCorners.
[[nodiscard]] bool addTriangles(std::span<const Vec3> points, std::vector<std::uint32_t>& corners);

}  // namespace luxo
