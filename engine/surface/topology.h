// SPDX-License-Identifier: Apache-2.0
// Finds what the edges of a parameter rectangle are on the surface: seams, poles, borders; and which side is
// outside.
#pragma once

#include <span>

#include "surface/surface.h"

namespace luxo {

/// Looks at S, Su, Sv along the four edges and at the signed volume. Two points count as one when they differ
/// by less than 1e-12 of the surface's extent: a formula evaluated at 0 and at 2 pi differs by about 1e-16 of
/// it. Cost: about 2,500 evaluations. Throws Error(Scene) when the formula is finite nowhere or one point
/// everywhere; the message names the surface.
[[nodiscard]] Topology findTopology(const SurfaceFunction& function, const Domain& domain,
                                    std::span<const double> parameters, const SurfaceTraits& traits);

/// Unit limit of Su x Sv at (u, v), where the cross product itself may vanish: at a collapsed v edge it is
/// the limit from inside along the same u (there Su ~ Suv (v - v0)), elsewhere that of a neighbouring point.
[[nodiscard]] Vec3 limitNormal(const SurfaceFunction& function, const Domain& domain, double u, double v,
                               std::span<const double> parameters);

}  // namespace luxo
