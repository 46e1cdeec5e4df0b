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
/// polygon of three corners or more: a fan of a convex one, else with ears cut off in the plane that it is
/// nearest to (Meisters, Polygons have ears, 1975). Where it crosses itself the triangles are as good as any.
/// False: it is not convex and has more than kMaxConcaveCorners.
[[nodiscard]] bool addTriangles(std::span<const Vec3> points, std::vector<std::uint32_t>& corners);

}  // namespace luxo
