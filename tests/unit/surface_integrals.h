// SPDX-License-Identifier: Apache-2.0
// Curvatures of surfaces, and integrals over them, from their exact derivatives.
#pragma once

#include <functional>
#include <vector>

#include "surface/surface.h"

namespace luxo {

/// S and its derivatives at one point.
struct Jet {
  Vec3 position, du, dv, duu, duv, dvv;

  [[nodiscard]] Vec3 cross() const { return glm::cross(du, dv); }
};
[[nodiscard]] std::vector<Jet> jetsOf(const Surface& surface, std::uint32_t patch,
                                      const std::vector<double>& u, const std::vector<double>& v);

/// The integral of f over the (u,v) plane: a Gauss-Legendre sum over cells of 8 x 8 points, `cells` squared
/// of them if the surface has one patch, fewer for each of many. `orientation` is the patch's.
[[nodiscard]] Vec4 integrate(const Surface& surface, int cells,
                             const std::function<Vec4(const Jet& jet, double orientation)>& f);

[[nodiscard]] double gaussianCurvature(const Jet& jet);
/// For the normal Su x Sv.
[[nodiscard]] double meanCurvature(const Jet& jet);

}  // namespace luxo
