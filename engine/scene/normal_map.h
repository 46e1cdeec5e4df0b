// SPDX-License-Identifier: Apache-2.0
// How a material's map of normals bends the normal of a surface; shaders/lib/maps.glsl does the same in
// float.
#pragma once

#include "math/vec.h"
#include "scene/material.h"

namespace luxo {

/// Where the vectors of a map lie at a point of a surface that shows a side: the tangent, in the world, and
/// in w the sign of the bitangent w * cross(normal, tangent). Of the outer side, which the vectors are of;
/// where the other is shown, and the normal is turned over, both are negative. On triangles neither is unit:
/// w is as long as the interpolated normal was. All are 0 where nothing tells.
using NormalFrame = Vec4;

/// Of a formula's point with tangents along u and v (world), whose outer side has the unit normal `outward`.
/// `turned`: the other side is shown.
[[nodiscard]] NormalFrame normalFrame(const Vec3& su, const Vec3& sv, const Vec3& outward, bool turned);

/// Takes a vector of a map to the axes of the frame, right, up and outward on the surface: the image may be
/// turned or mirrored there. In object space to those of the world.
[[nodiscard]] Mat3 normalFromTexel(const Material& material, const Mat3& normalFromObject);

/// Unit; `normal` where the texel leads nowhere. `texel`: as the map has it, r, g, b.
[[nodiscard]] Vec3 bentNormal(const Material& material, const Mat3& normalFromTexel, const Vec3& texel,
                              const Vec3& normal, const NormalFrame& frame);

}  // namespace luxo
