// SPDX-License-Identifier: Apache-2.0
// Whether the shadow of a box can reach another one. "No" is a proof.
#pragma once

#include "math/bounds.h"
#include "math/vec.h"

namespace luxo {

/// `light`: w = 1 a point; w = 0 the direction toward it. False only when no segment (ray) from a point of
/// `receiver` to the light meets `caster`: a face of the caster has the light and the receiver in front of
/// it, or a plane along the light's rays, through an edge of either box, parts the two. Boxes that are
/// infinite, or hold the light, may. Cost: at most 50 planes, 16 corners each.
[[nodiscard]] bool mayShadow(const Vec4& light, const Box& caster, const Box& receiver);

}  // namespace luxo
