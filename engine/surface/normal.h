// SPDX-License-Identifier: Apache-2.0
// Unit normals, also where Su x Sv vanishes: at poles, apexes, cusps and collapsed edges.
#pragma once

#include <span>
#include <vector>

#include "math/vec.h"
#include "surface/patch.h"

namespace luxo {

/// Unit limit of Su x Sv at (u, v), approached from inside the domain. Where Su x Sv is not rounding noise it
/// is that direction; else its first-order term (Su ~ Suv (v - v0) at a collapsed v edge, on the same u);
/// where that vanishes too, extrapolated from neighbours, to 1e-7. `inputs` as in PatchInputs. +Y where no
/// tangent plane can be found.
[[nodiscard]] Vec3 limitNormal(const SurfaceFunction& function, const Domain& domain, double u, double v,
                               std::span<const double> inputs);
/// The same at every (u[i], v[i]), evaluated together.
[[nodiscard]] std::vector<Vec3> limitNormals(const SurfaceFunction& function, const Domain& domain,
                                             std::span<const double> u, std::span<const double> v,
                                             std::span<const double> inputs);

}  // namespace luxo
