// SPDX-License-Identifier: Apache-2.0
// Whether a light in a lamp shade, or a spot, can reach a box. "No" is a proof.
#pragma once

#include "math/bounds.h"
#include "scene/shade.h"
#include "scene/spot_cone.h"

namespace luxo {

/// False only when every point within `slack` metres of the transformed box is in the shade's shadow: a plane
/// separates the box from the cone of light, and another one from the inside of the shade. Cost: 8 corners, 7
/// planes.
[[nodiscard]] bool canLight(const ShadeRule& rule, const Transform& worldFromObject, const Box& boundsObject,
                            double slack);

/// The same of a spot at a point: all are outside of its outer cone. Cost: 8 corners, 2 planes.
[[nodiscard]] bool canLight(const SpotCone& cone, const Vec3& positionWorld, const Transform& worldFromObject,
                            const Box& boundsObject, double slack);

}  // namespace luxo
